// Improvement of flat tets in passes of local modifications ("steps", tet_steps.h).
//
// Each pass visits the tets that are too flat, worst first. A tet is visited again only if the tets
// at one of its vertices have changed. Steps for up to 64 tets are searched in parallel while the
// mesh does not change. Then they are applied in order. If an earlier step has changed a tet that a
// later step uses, the later step is searched again. The result does not depend on the number of
// threads.
//
// In the last passes, held (constrained) vertices of tets that are still too flat may move, unless
// release_angle is 0. Tets that are still too flat after these passes and have no neighbor are
// removed, unless keep_boundary is set.
#include "tets/tet_improvement.h"

#include "base/parallel.h"
#include "base/per_thread.h"
#include "geometry/tet_facets.h"
#include "tets/tet_complex.h"
#include "tets/tet_steps.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

namespace bindpose
{

namespace
{
using Tet = TetComplex::Tet;

class Improver
{
public:
  Improver(ExecutionContext& context, TetMesh& mesh, std::vector<char> constrained,
    const OntoSurface& surface, const ImproveOptions& options, Improvement& improvement)
    : mesh_(mesh), tets_(mesh), options_(options), rules_(options, surface),
      improvement_(improvement), context_(context),
      silent_context_({}, [&context] { return context.canceled(); }),
      moved_(static_cast<std::size_t>(mesh.points.rows()), 0)
  {
    const auto tets = static_cast<double>(mesh.tets.rows() + small_mesh_tets);
    this->maximum_evaluations_ = std::min(options.effort * tets, large + per_tet_of_large * tets);
    this->rules_.constrained = std::move(constrained);
    this->rules_.immovable_since.resize(this->moved_.size(), 0);
    this->silent_context_.set_threads(context.threads());
  }

  bool run()
  {
    constexpr Index last_passes = 4; // passes in which held vertices may move
    constexpr Index first_passes = 3; // passes before vertices are inserted
    const Index passes = this->options_.passes - last_passes;
    // There are up to three groups of passes. Held vertices may move only in the third group. These
    // two values are the progress at the ends of the first two groups; the third group ends at
    // progress 0.97.
    const double first_end = this->options_.insert ? 0.4 : 0.0;
    const double second_end = this->options_.release_angle > 0.0 ? 0.85 : 0.97;
    bool completed = true;
    if (this->options_.insert)
    {
      completed = this->passes(first_passes, this->options_.angle, 0.0, first_end);
      this->rules_.insert = true;
      this->last_search_.clear();
    }
    completed = completed &&
      this->passes(passes - (this->options_.insert ? first_passes : 0), this->options_.angle,
        first_end, second_end);
    if (completed && this->options_.release_angle > 0.0)
    {
      this->rules_.may_move_constrained = true;
      this->last_search_.clear();
      completed = this->passes(last_passes, this->options_.release_angle, second_end, 0.97);
    }
    if (completed && !this->options_.keep_boundary)
    {
      this->remove_isolated_tets();
    }
    this->tets_.write(this->mesh_);
    return completed;
  }

private:
  /// Constants of the limit for the number of evaluations (computed tet qualities). Small meshes
  /// get more evaluations per tet than large meshes.
  static constexpr Index small_mesh_tets = 1000; // tets
  static constexpr double large = 2.5e7; // evaluations
  static constexpr double per_tet_of_large = 400.0;
  /// Number of tets whose steps are searched in parallel. It is large enough for many threads and
  /// small enough that the tets are rarely neighbors.
  static constexpr std::size_t maximum_batch = 64;
  static constexpr Index per_task = 2;

  bool exhausted() const
  {
    return static_cast<double>(this->evaluations_) > this->maximum_evaluations_;
  }

  /// Run up to `maximum` passes. Progress goes from `begin` to `end`. @return false if canceled.
  bool passes(Index maximum, double angle, double begin, double end)
  {
    const double required_quality = TetComplex::quality_of_angle(angle);
    const double per_pass = (end - begin) / static_cast<double>(std::max<Index>(1, maximum));
    for (Index pass = 0; pass < maximum; ++pass)
    {
      Count count;
      const ProgressRange range(this->context_, begin + per_pass * static_cast<double>(pass),
        begin + per_pass * static_cast<double>(pass + 1));
      if (!this->pass(required_quality, count))
      {
        return false;
      }
      // the passes end if a pass improves at most one in 60 of the tets that it tries
      constexpr Index tets_per_improvement = 60;
      if (tets_per_improvement * count.improved <= count.tried)
      {
        break;
      }
    }
    return true;
  }

  struct Count
  {
    Index tried = 0;
    Index improved = 0;
  };

  bool pass(double required_quality, Count& count)
  {
    const std::vector<Index> flat = this->flat_tets(required_quality);
    std::vector<Index> batch; // tets of the current batch
    std::vector<Index> deferred; // tets of the following batches
    const auto is_due = [&](Index t)
    // Skip tets that an earlier step has improved enough, and tets without a changed vertex.
    { return this->tets_.quality(t) < required_quality && this->changed(t); };
    for (std::size_t next = 0; (next < flat.size() || !deferred.empty()) && !this->exhausted();)
    {
      const std::vector<Index> first = std::exchange(deferred, {});
      batch.clear();
      ++this->batch_;
      const auto choose = [&](Index t)
      {
        if (is_due(t))
        {
          (batch.size() < maximum_batch && this->reserve_vertices(t) ? batch : deferred)
            .push_back(t);
        }
      };
      std::for_each(first.begin(), first.end(), choose);
      for (; batch.size() < maximum_batch && deferred.size() < maximum_batch && next < flat.size();
           ++next)
      {
        choose(flat[next]);
      }
      if (!this->find_steps(batch))
      {
        return false;
      }
      this->context_.progress(
        static_cast<double>(next) / static_cast<double>(std::max<std::size_t>(1, flat.size())));
      const std::uint64_t before = this->tets_.changes();
      for (std::size_t i = 0; i < batch.size(); ++i)
      {
        const TetStep& step = this->steps_[i];
        if (step.kind != TetStep::Kind::none && this->changed_since(before, step))
        {
          deferred.push_back(batch[i]);
          continue;
        }
        ++count.tried;
        if (step.kind == TetStep::Kind::none)
        {
          this->last_search_[batch[i]] = before;
          this->rules_.failed_insertions[batch[i]] += step.insertion_failed ? 1 : 0;
          continue;
        }
        ++count.improved;
        this->apply(step);
        deferred.push_back(batch[i]);
      }
    }
    return true;
  }

  /// Reserve the tet's vertices for this batch, so that no two searches move the same vertex.
  /// @return false if another tet has reserved a vertex that may move.
  bool reserve_vertices(Index t)
  {
    this->reserving_batch_.resize(static_cast<std::size_t>(this->tets_.vertex_count()), 0);
    const Tet& tet = this->tets_.tet(t);
    const auto moves = [&](Index v) { return may_move(this->tets_, this->rules_, v); };
    if (std::any_of(tet.begin(), tet.end(),
          [&](Index v) { return this->reserving_batch_[v] == this->batch_ && moves(v); }))
    {
      return false;
    }
    for (const Index v : tet)
    {
      this->reserving_batch_[v] = this->batch_;
    }
    return true;
  }

  /// For each tet, search for a step. The tets are processed in parallel; the mesh does not change.
  /// @return false if canceled.
  bool find_steps(const std::vector<Index>& tets)
  {
    const auto tet_ids = static_cast<std::size_t>(this->tets_.tet_id_limit());
    this->last_search_.resize(tet_ids, 0);
    this->rules_.failed_insertions.resize(tet_ids, 0);
    this->steps_.resize(maximum_batch);
    const bool completed =
      parallel_for(this->silent_context_, static_cast<Index>(tets.size()), per_task,
        [&](Index begin, Index end)
        {
          this->searches_.use_object([&]
            { return std::make_unique<TetStepSearch>(this->tets_, this->rules_); },
            [&](TetStepSearch& search)
            {
              for (Index i = begin; i < end; ++i)
              {
                search.find(tets[i], this->steps_[i]);
              }
            });
        });
    this->evaluations_ = 0;
    this->searches_.for_each(
      [&](const TetStepSearch& search) { this->evaluations_ += search.evaluations(); });
    for (std::size_t i = 0; i < tets.size() && completed; ++i)
    {
      for (const Index v : this->steps_[i].immovable)
      {
        this->rules_.immovable_since[v] = this->tets_.stamp(v);
      }
    }
    return completed;
  }

  /// Report whether a tet that the step uses has been removed or changed since the change counter
  /// was `before`.
  bool changed_since(std::uint64_t before, const TetStep& step) const
  {
    const auto has_changed = [&](Index t)
    { return !this->tets_.alive(t) || this->last_change(t) > before; };
    const std::vector<Index>& tets = step.kind == TetStep::Kind::move
      ? this->tets_.tets_of_vertex(step.vertex)
      : step.kind == TetStep::Kind::insert ? step.cavity.tets
                                           : step.removed;
    return std::any_of(tets.begin(), tets.end(), has_changed);
  }

  void apply(const TetStep& step)
  {
    switch (step.kind)
    {
      case TetStep::Kind::none:
        return;
      case TetStep::Kind::swap:
      case TetStep::Kind::contract:
        for (const Index t : step.removed)
        {
          this->tets_.remove(t);
        }
        for (const Tet& tet : step.added)
        {
          this->tets_.add(tet);
        }
        this->improvement_.collapsed_edges += step.kind == TetStep::Kind::contract;
        this->improvement_.removed_tets += step.added.empty();
        return;
      case TetStep::Kind::move:
        this->tets_.move(step.vertex, step.position);
        (this->rules_.constrained[step.vertex] ? this->improvement_.released_vertices
                                               : this->improvement_.moved_vertices) +=
          !this->moved_[step.vertex];
        this->moved_[step.vertex] = 1;
        return;
      case TetStep::Kind::insert:
        fill_cavity(this->tets_, step.position, step.cavity);
        this->rules_.constrained.push_back(0);
        this->rules_.immovable_since.push_back(0);
        this->moved_.push_back(1);
        ++this->improvement_.inserted_vertices;
        return;
    }
  }

  /// Return the value of the mesh's change counter at the last change of any vertex of the tet.
  std::uint64_t last_change(Index t) const
  {
    std::uint64_t last = 0;
    for (const Index v : this->tets_.tet(t))
    {
      last = std::max(last, this->tets_.stamp(v));
    }
    return last;
  }

  /// Report whether a vertex of the tet has changed since a step for this tet was last searched.
  bool changed(Index t) const
  {
    return t >= static_cast<Index>(this->last_search_.size()) ||
      this->last_search_[t] < this->last_change(t);
  }

  std::vector<Index> flat_tets(double required_quality) const
  {
    std::vector<Index> flat;
    for (Index t = 0; t < this->tets_.tet_id_limit(); ++t)
    {
      if (this->tets_.quality(t) < required_quality)
      {
        flat.push_back(t);
      }
    }
    std::sort(flat.begin(), flat.end(),
      [&](Index a, Index b)
      {
        return this->tets_.quality(a) != this->tets_.quality(b)
          ? this->tets_.quality(a) < this->tets_.quality(b)
          : a < b;
      });
    return flat;
  }

  /// Remove tets that are still too flat, share no facet with another tet and have no held vertex.
  void remove_isolated_tets()
  {
    const std::vector<Index> flat =
      this->flat_tets(TetComplex::quality_of_angle(this->options_.release_angle));
    for (const Index t : flat)
    {
      const Tet& tet = this->tets_.tet(t);
      const bool constrained =
        std::any_of(tet.begin(), tet.end(), [&](Index v) { return this->rules_.constrained[v]; });
      const bool is_isolated = std::all_of(
        tet.begin(), tet.end(), [&](Index v) { return this->tets_.neighbor_across(t, v) < 0; });
      if (!constrained && is_isolated)
      {
        this->tets_.remove(t);
        ++this->improvement_.removed_tets;
      }
    }
  }

  TetMesh& mesh_;
  TetComplex tets_;
  const ImproveOptions& options_;
  TetStepRules rules_;
  Improvement& improvement_;
  ExecutionContext& context_;
  ExecutionContext silent_context_; ///< context of the parallel loops; it reports no progress
  double maximum_evaluations_ = 0.0;
  Index evaluations_ = 0;
  std::vector<char> moved_;
  /// Per tet: value of the mesh's change counter when a step for this tet was last searched.
  std::vector<std::uint64_t> last_search_;
  std::vector<Index> reserving_batch_; ///< per vertex: the last batch that reserved it
  Index batch_ = 0;
  std::vector<TetStep> steps_; ///< steps found for the tets of the current batch
  PerThread<TetStepSearch> searches_;
};
} // namespace

bool improve_tets(ExecutionContext& context, TetMesh& mesh, std::vector<char> constrained,
  const OntoSurface& surface, const ImproveOptions& options, Improvement& improvement)
{
  improvement = Improvement();
  return Improver(context, mesh, std::move(constrained), surface, options, improvement).run();
}

} // namespace bindpose

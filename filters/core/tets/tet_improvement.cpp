// Improvement of flat tets in passes of local modifications ("steps", tet_steps.h).
//
// Each pass visits the tets that are too flat, worst first. A tet is visited again only if the tets
// at one of its vertices have changed. Steps for up to 64 tets are searched in parallel while the
// mesh does not change. Then they are applied in order. A step is searched again if an earlier step
// changed a tet that it uses. The result does not depend on the number of threads.
//
// In the last passes, held (constrained) vertices of tets that are still too flat may move, unless
// least_angle is 0. Tets that are still too flat after these passes and have no neighbor are
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
  Improver(ExecutionContext& context, TetMesh& mesh, std::vector<char> held,
    const OntoSurface& surface, const ImproveOptions& options, Improvement& done)
    : mesh_(mesh), tets_(mesh), options_(options), rules_(options, surface), done_(done),
      context_(context), quiet_({}, [&context] { return context.canceled(); }),
      moved_(static_cast<std::size_t>(mesh.points.rows()), 0)
  {
    const auto tets = static_cast<double>(mesh.tets.rows() + small);
    this->most_evaluations_ = std::min(options.effort * tets, large + per_tet_of_large * tets);
    this->rules_.held = std::move(held);
    this->rules_.stays.resize(this->moved_.size(), 0);
    this->quiet_.set_threads(context.threads());
  }

  bool run()
  {
    constexpr Index last_passes = 4; // passes in which held vertices may move
    constexpr Index first_passes = 3; // passes before vertices are inserted
    const Index passes = this->options_.passes - last_passes;
    bool whole = this->passes(this->options_.insert ? first_passes : passes, this->options_.angle);
    if (whole && this->options_.insert)
    {
      this->rules_.insert = true;
      this->tried_.clear();
      whole = this->passes(passes - first_passes, this->options_.angle);
    }
    if (whole && this->options_.least_angle > 0.0)
    {
      this->rules_.release = true;
      this->tried_.clear();
      whole = this->passes(last_passes, this->options_.least_angle);
    }
    if (whole && !this->options_.keep_boundary)
    {
      this->drop_lone_tets();
    }
    this->tets_.write(this->mesh_);
    return whole;
  }

private:
  /// Constants of the limit for the number of evaluations (computed tet qualities). Small meshes
  /// get more evaluations per tet than large meshes.
  static constexpr Index small = 1000; // tets
  static constexpr double large = 2.5e7; // evaluations
  static constexpr double per_tet_of_large = 400.0;
  /// Number of tets whose steps are searched in parallel. It is large enough for many threads and
  /// small enough that the tets are rarely neighbors.
  static constexpr std::size_t most_at_once = 64;
  static constexpr Index per_task = 2;

  bool exhausted() const
  {
    return static_cast<double>(this->evaluations_) > this->most_evaluations_;
  }

  /// Run up to `most` passes. @return false if canceled.
  bool passes(Index most, double angle)
  {
    const double enough = TetComplex::quality_of_angle(angle);
    for (Index pass = 0; pass < most; ++pass)
    {
      Count count;
      if (!this->pass(enough, count))
      {
        return false;
      }
      this->context_.progress(static_cast<double>(pass + 1) / static_cast<double>(most));
      constexpr Index worth_a_pass = 60; // the passes end if a pass improves at most one in 60 tets
      if (worth_a_pass * count.improved <= count.tried)
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

  bool pass(double enough, Count& count)
  {
    const std::vector<Index> flat = this->flat_tets(enough);
    std::vector<Index> now; // tets of the current batch
    std::vector<Index> later; // tets of the following batches
    const auto is_due = [&](Index t)
    // An earlier step may have improved the tet.
    { return this->tets_.quality(t) < enough && this->changed(t); };
    for (std::size_t next = 0; (next < flat.size() || !later.empty()) && !this->exhausted();)
    {
      const std::vector<Index> first = std::exchange(later, {});
      now.clear();
      ++this->turn_;
      const auto choose = [&](Index t)
      {
        if (is_due(t))
        {
          (now.size() < most_at_once && this->claim(t) ? now : later).push_back(t);
        }
      };
      std::for_each(first.begin(), first.end(), choose);
      for (; now.size() < most_at_once && later.size() < most_at_once && next < flat.size(); ++next)
      {
        choose(flat[next]);
      }
      if (!this->look_at(now))
      {
        return false;
      }
      const std::uint64_t before = this->tets_.changes();
      for (std::size_t i = 0; i < now.size(); ++i)
      {
        const TetStep& step = this->steps_[i];
        if (step.kind != TetStep::Kind::none && this->touched_since(before, step))
        {
          later.push_back(now[i]);
          continue;
        }
        ++count.tried;
        if (step.kind == TetStep::Kind::none)
        {
          this->tried_[now[i]] = before;
          continue;
        }
        ++count.improved;
        this->take(step);
        later.push_back(now[i]);
      }
    }
    return true;
  }

  /// Reserve the tet's vertices for this batch, so that no two searches move the same vertex.
  /// @return false if another tet has reserved a vertex that may move.
  bool claim(Index t)
  {
    this->claims_.resize(static_cast<std::size_t>(this->tets_.vertex_count()), 0);
    const Tet& tet = this->tets_.tet(t);
    const auto moves = [&](Index v) { return may_move(this->tets_, this->rules_, v); };
    if (std::any_of(tet.begin(), tet.end(),
          [&](Index v) { return this->claims_[v] == this->turn_ && moves(v); }))
    {
      return false;
    }
    for (const Index v : tet)
    {
      this->claims_[v] = this->turn_;
    }
    return true;
  }

  /// Search a step for each tet while the mesh does not change. @return false if canceled.
  bool look_at(const std::vector<Index>& tets)
  {
    this->tried_.resize(static_cast<std::size_t>(this->tets_.tet_ids()), 0);
    this->steps_.resize(most_at_once);
    const bool whole = parallel_for(this->quiet_, static_cast<Index>(tets.size()), per_task,
      [&](Index begin, Index end)
      {
        this->searches_.with([&]
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
    for (std::size_t i = 0; i < tets.size() && whole; ++i)
    {
      for (const Index v : this->steps_[i].stay)
      {
        this->rules_.stays[v] = this->tets_.stamp(v);
      }
    }
    return whole;
  }

  /// Report whether a tet that the step uses has been removed or changed since the change counter
  /// was `before`.
  bool touched_since(std::uint64_t before, const TetStep& step) const
  {
    const auto touched = [&](Index t) { return !this->tets_.alive(t) || this->newest(t) > before; };
    const std::vector<Index>& tets = step.kind == TetStep::Kind::move
      ? this->tets_.tets_at(step.vertex)
      : step.kind == TetStep::Kind::insert ? step.cavity.tets
                                           : step.removed;
    return std::any_of(tets.begin(), tets.end(), touched);
  }

  void take(const TetStep& step)
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
        for (const Tet& tet : step.fresh)
        {
          this->tets_.add(tet);
        }
        this->done_.collapsed_edges += step.kind == TetStep::Kind::contract;
        this->done_.removed_tets += step.fresh.empty();
        return;
      case TetStep::Kind::move:
        this->tets_.move(step.vertex, step.place);
        (this->rules_.held[step.vertex] ? this->done_.released_vertices
                                        : this->done_.moved_vertices) += !this->moved_[step.vertex];
        this->moved_[step.vertex] = 1;
        return;
      case TetStep::Kind::insert:
        fill_cavity(this->tets_, step.place, step.cavity);
        this->rules_.held.push_back(0);
        this->rules_.stays.push_back(0);
        this->moved_.push_back(1);
        ++this->done_.inserted_vertices;
        return;
    }
  }

  /// Return the change counter at the last change of a vertex of the tet.
  std::uint64_t newest(Index t) const
  {
    std::uint64_t last = 0;
    for (const Index v : this->tets_.tet(t))
    {
      last = std::max(last, this->tets_.stamp(v));
    }
    return last;
  }

  /// Report whether a vertex of the tet has changed since the last search for the tet.
  bool changed(Index t) const
  {
    return t >= static_cast<Index>(this->tried_.size()) || this->tried_[t] < this->newest(t);
  }

  std::vector<Index> flat_tets(double enough) const
  {
    std::vector<Index> flat;
    for (Index t = 0; t < this->tets_.tet_ids(); ++t)
    {
      if (this->tets_.quality(t) < enough)
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

  /// Remove tets that share no facet with another tet and remain too flat.
  void drop_lone_tets()
  {
    const std::vector<Index> flat =
      this->flat_tets(TetComplex::quality_of_angle(this->options_.least_angle));
    for (const Index t : flat)
    {
      const Tet& tet = this->tets_.tet(t);
      const bool held =
        std::any_of(tet.begin(), tet.end(), [&](Index v) { return this->rules_.held[v]; });
      const bool alone = std::all_of(std::begin(facet_corners), std::end(facet_corners),
        [&](const auto& f) { return this->tets_.beyond(t, tet[f[0]], tet[f[1]], tet[f[2]]) < 0; });
      if (!held && alone)
      {
        this->tets_.remove(t);
        ++this->done_.removed_tets;
      }
    }
  }

  TetMesh& mesh_;
  TetComplex tets_;
  const ImproveOptions& options_;
  TetStepRules rules_;
  Improvement& done_;
  ExecutionContext& context_;
  ExecutionContext quiet_; ///< context of the parallel loops; it reports no progress
  double most_evaluations_ = 0.0;
  Index evaluations_ = 0;
  std::vector<char> moved_;
  /// Per tet: the change counter of the mesh at the last search for the tet.
  std::vector<std::uint64_t> tried_;
  std::vector<Index> claims_; ///< per vertex: the last batch that reserved it
  Index turn_ = 0;
  std::vector<TetStep> steps_; ///< steps found for the tets of the current batch
  PerThread<TetStepSearch> searches_;
};
} // namespace

bool improve_tets(ExecutionContext& context, TetMesh& mesh, std::vector<char> held,
  const OntoSurface& surface, const ImproveOptions& options, Improvement& done)
{
  done = Improvement();
  return Improver(context, mesh, std::move(held), surface, options, done).run();
}

} // namespace bindpose

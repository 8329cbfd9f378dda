// Splitting of long boundary edges and insertion of vertices into a tet mesh, by replacing cavities
// (tet_cavity.h).
#include "tets/tet_insertion.h"

#include "base/parallel.h"
#include "base/per_thread.h"
#include "geometry/point_order.h"
#include "geometry/simplex_locator.h"
#include "geometry/tet_facets.h"
#include "surface/triangle_predicates.h"
#include "tets/tet_cavity.h"
#include "tets/tet_complex.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <queue>
#include <tuple>
#include <utility>

namespace bindpose
{

namespace
{
using Tet = TetComplex::Tet;

/// Number of insertions between two checks for a cancel request.
constexpr Index insertions_per_check = 256;

struct LongEdge
{
  double length;
  Index a, b;

  /// Order by length, longest first, then by ids.
  bool operator<(const LongEdge& other) const
  {
    return std::tie(this->length, other.a, other.b) < std::tie(other.length, this->a, this->b);
  }
};

std::vector<Vec3> as_vectors(const Points& points)
{
  std::vector<Vec3> vectors(static_cast<std::size_t>(points.rows()));
  for (Index i = 0; i < points.rows(); ++i)
  {
    vectors[i] = points.row(i);
  }
  return vectors;
}

constexpr Index first_round = 64; // number of positions in the first round

/// Return the order in which new vertices are inserted, as indices of their positions. The order
/// consists of rounds. Each round is twice as long as the previous one and samples all positions,
/// so that cavities soon become small (Amenta, Choi, Rote, Incremental Constructions con BRIO,
/// 2003). `spatial_order` is an order in which consecutive positions are near each other. Each
/// round is divided into `tracks` pieces of this order and takes one position of each piece in
/// turn. Therefore vertices that are inserted in parallel are far apart. Each vertex is also near a
/// vertex that was inserted shortly before, so that the tets there are still in the processor's
/// caches.
std::vector<Index> order_of_insertion(const std::vector<std::int32_t>& spatial_order, Index tracks)
{
  const auto count = static_cast<Index>(spatial_order.size());
  // The last round contains every second position, the round before contains every second of the
  // remaining positions, and so on.
  std::vector<std::vector<Index>> rounds(1);
  for (Index size = first_round; size < count; size *= 2)
  {
    rounds.emplace_back();
  }
  for (Index rank = 0; rank < count; ++rank)
  {
    std::size_t round = rounds.size() - 1;
    for (Index rest = rank; round > 0 && rest % 2 == 0; rest /= 2)
    {
      --round;
    }
    rounds[round].push_back(spatial_order[rank]);
  }
  std::vector<Index> order;
  order.reserve(spatial_order.size());
  for (const std::vector<Index>& round : rounds)
  {
    const auto size = static_cast<Index>(round.size());
    const Index length = (size + tracks - 1) / tracks;
    for (Index i = 0; i < length; ++i)
    {
      for (Index k = i; k < size; k += length)
      {
        order.push_back(round[k]);
      }
    }
  }
  return order;
}

/// Return the fraction of the total work for the first `done` of `count` positions. About half of
/// the work is spread evenly over the positions. The other half is spread evenly over the rounds,
/// because the few vertices of the first rounds have large cavities.
double insertion_progress(std::size_t done, std::size_t count)
{
  const auto rounds = [](std::size_t positions)
  { return std::log2(1.0 + static_cast<double>(positions) / static_cast<double>(first_round)); };
  return 0.5 *
    (static_cast<double>(done) / static_cast<double>(count) + rounds(done) / rounds(count));
}

/// Finds the tets that contain the positions of new vertices while tets are being replaced. The
/// search starts in a tree over the initial tets, continues with the tets that replaced the tet
/// found there, and then walks from tet to tet.
class TetLocator
{
public:
  explicit TetLocator(const TetComplex& tets) : tets_(tets) {}

  /// Locate all positions in the current tets. Must be called before all other functions.
  /// `spatial_order`: an order in which consecutive positions are usually near each other. @return
  /// false if canceled.
  bool locate_all(ExecutionContext& context, const TetMesh& mesh, const Points& positions,
    const std::vector<std::int32_t>& spatial_order)
  {
    const SimplexLocator locator(mesh.points, mesh.tets);
    this->first_.resize(static_cast<std::size_t>(positions.rows()));
    constexpr Index block = 64;
    return parallel_for(context, positions.rows(), block,
      [&](Index begin, Index end)
      {
        Index t = -1;
        for (Index i = begin; i < end; ++i)
        {
          const Vec3 p = positions.row(spatial_order[i]);
          t = this->walk(t, p, short_walk_steps);
          t = t >= 0 ? t : locator.locate(p).element;
          this->first_[spatial_order[i]] = t;
        }
      });
  }

  /// Return the tet that contains p, or -1 if no tet is found. i: index of the position p.
  /// Thread-safe.
  Index find(Index i, const Vec3& p) const
  {
    Index t = this->first_[i];
    while (t >= 0 && !this->tets_.alive(t))
    {
      const Range& range = this->replaced_[t];
      if (range.end - range.begin > long_walk_steps)
      {
        const Index found = this->walk_from(range, p);
        if (found >= 0)
        {
          return found;
        }
      }
      t = range.begin < range.end ? range.begin : -1;
      for (Index other = range.begin; other < range.end; ++other)
      {
        if (this->separating_side(other, p) < 0)
        {
          t = other;
          break;
        }
      }
    }
    // Because of rounding, p may be in a neighbor of the tet.
    return this->walk(t, p, short_walk_steps);
  }

  /// Locate the pending positions in the current tets. Afterwards this object does not need the
  /// replaced tets, so the caller can remove them and renumber the tets (see renumber). @return
  /// false if canceled.
  bool relocate(
    ExecutionContext& context, const Points& positions, const std::vector<Index>& pending)
  {
    constexpr Index block = 64;
    return parallel_for(context, static_cast<Index>(pending.size()), block,
      [&](Index begin, Index end)
      {
        for (Index i = begin; i < end; ++i)
        {
          this->first_[pending[i]] = this->find(pending[i], positions.row(pending[i]));
        }
      });
  }

  /// Replace each stored tet id t by ids[t], the new id of this tet.
  void renumber(const std::vector<Index>& ids)
  {
    for (Index& t : this->first_)
    {
      t = t >= 0 ? ids[t] : -1;
    }
    this->replaced_.clear();
  }

  /// Record that `tets` have been replaced by the tets with ids from `begin` to the last id.
  void replace(const std::vector<Index>& tets, Index begin)
  {
    this->replaced_.resize(static_cast<std::size_t>(this->tets_.tet_id_limit()));
    for (const Index t : tets)
    {
      this->replaced_[t] = { begin, this->tets_.tet_id_limit() };
    }
  }

private:
  static constexpr int short_walk_steps = 50; // maximum number of tets in a short walk
  static constexpr int long_walk_steps = 500;
  struct Range
  {
    Index begin = 0;
    Index end = 0;
  };

  /// Return the side of tet t that separates the tet from p, as an index into facet_corners, or -1
  /// if p is in the tet.
  int separating_side(Index t, const Vec3& p, int first = 0) const
  {
    const Tet& tet = this->tets_.tet(t);
    for (int k = 0; k < 4; ++k)
    {
      const int side = (first + k) % 4;
      const auto& f = facet_corners[side];
      if (orientation_3d(this->tets_.point(tet[f[0]]), this->tets_.point(tet[f[1]]),
            this->tets_.point(tet[f[2]]), p) > 0)
      {
        return side;
      }
    }
    return -1;
  }

  /// Find the tet that contains p by a walk. The tets of `range` were created when a vertex v was
  /// inserted; the walk starts at one of the current tets of v. The straight line from v to p stays
  /// in the mesh, because it is inside the tets that v replaced.
  Index walk_from(const Range& range, const Vec3& p) const
  {
    const std::vector<Index>& vertex_tets =
      this->tets_.tets_of_vertex(this->tets_.tet(range.begin)[3]);
    return vertex_tets.empty() ? -1 : this->walk(vertex_tets.front(), p, long_walk_steps);
  }

  /// Return the tet that contains p, or -1 if a walk of `longest` steps from t does not find it.
  Index walk(Index t, const Vec3& p, int longest) const
  {
    for (int step = 0; step < longest && t >= 0; ++step)
    {
      // Each step tests the sides in a different order, so that the walk does not cycle.
      const int side = this->separating_side(t, p, step);
      if (side < 0)
      {
        return t;
      }
      t = this->tets_.neighbor_tet(t, side);
    }
    return -1;
  }

  const TetComplex& tets_;
  /// Per position: the tet that contained the position (or the nearest tet) at the last call of
  /// locate_all() or relocate(). -1: none.
  std::vector<Index> first_;
  std::vector<Range> replaced_; ///< per replaced tet: the range of the new tet ids
};

/// Inserts vertices. Cavities for up to 64 positions are searched in parallel while the mesh does
/// not change. Then the cavities are filled in order. A cavity is searched again if one of its tets
/// has been replaced.
class Inserter
{
public:
  Inserter(ExecutionContext& context, TetComplex& tets)
    : tets_(tets), finder_(tets), context_(context),
      silent_context_({}, [&context] { return context.canceled(); })
  {
    this->silent_context_.set_threads(context.threads());
  }

  /// Insert vertices at `positions`. `mesh` contains the current tets.
  bool insert(const TetMesh& mesh, const Points& positions, std::vector<Index>& vertices)
  {
    const std::vector<std::int32_t> spatial_order = spatial_sort(as_vectors(positions));
    // fraction of the total time that is needed for locating the positions
    constexpr double locating_fraction = 0.2;
    {
      const ProgressRange range(this->context_, 0.0, locating_fraction);
      if (!this->finder_.locate_all(this->context_, mesh, positions, spatial_order))
      {
        return false;
      }
    }
    const ProgressRange range(this->context_, locating_fraction, 1.0);
    const std::vector<Index> order = order_of_insertion(spatial_order, maximum_batch);
    std::vector<Index> batch;
    std::vector<Index> deferred;
    // If all vertices are on one sphere, the first cavities are large and overlap. Therefore the
    // number of cavities that are searched in parallel is adapted.
    std::size_t batch_size = 1;
    for (std::size_t next = 0; next < order.size() || !deferred.empty();)
    {
      const auto retry_count = static_cast<std::ptrdiff_t>(std::min(batch_size, deferred.size()));
      batch.assign(deferred.begin(), deferred.begin() + retry_count);
      deferred.erase(deferred.begin(), deferred.begin() + retry_count);
      for (; batch.size() < batch_size && next < order.size(); ++next)
      {
        batch.push_back(order[next]);
      }
      const std::size_t deferred_count_before = deferred.size();
      if (this->tets_.tet_id_limit() > this->maximum_ids_)
      {
        std::vector<Index> pending(order.begin() + static_cast<std::ptrdiff_t>(next), order.end());
        pending.insert(pending.end(), batch.begin(), batch.end());
        pending.insert(pending.end(), deferred.begin(), deferred.end());
        if (!this->drop_replaced(positions, pending))
        {
          return false;
        }
      }
      if (!this->find_sites(positions, batch))
      {
        return false;
      }
      for (std::size_t i = 0; i < batch.size(); ++i)
      {
        const Site& site = this->sites_[i];
        if (std::all_of(site.tets().begin(), site.tets().end(),
              [&](Index t) { return this->tets_.alive(t); }))
        {
          vertices[batch[i]] = this->insert_at(site, positions.row(batch[i]));
        }
        else
        {
          deferred.push_back(batch[i]);
        }
      }
      // The number of cavities that are searched in parallel is reduced if more than one in four
      // cavities must be searched again.
      constexpr std::size_t overlap_divisor = 4;
      const bool overlap =
        overlap_divisor * (deferred.size() - deferred_count_before) > batch.size();
      batch_size = overlap ? std::max<std::size_t>(1, batch_size / 2)
                           : std::min(maximum_batch, 2 * batch_size);
      this->context_.progress(insertion_progress(next, order.size()));
    }
    return true;
  }

private:
  static constexpr std::size_t maximum_batch = 64;
  static constexpr Index per_task = 4;

  /// The tets or the edge that a new vertex would replace.
  struct Site
  {
    enum class Kind
    {
      none,
      cavity,
      edge
    };
    Kind kind = Kind::none;
    TetCavity cavity;
    std::array<Index, 2> edge{};
    TetComplex::Ring ring;

    const std::vector<Index>& tets() const
    {
      return this->kind == Kind::edge ? this->ring.tets : this->cavity.tets;
    }
  };

  /// Remove replaced tets to free memory. pending: the positions at which no vertex has been
  /// inserted yet. @return false if canceled.
  bool drop_replaced(const Points& positions, const std::vector<Index>& pending)
  {
    if (!this->finder_.relocate(this->silent_context_, positions, pending))
    {
      return false;
    }
    this->maximum_ids_ = maximum_ids_for(this->tets_.tet_count());
    this->finder_.renumber(this->tets_.compact(this->maximum_ids_));
    return true;
  }

  /// Return the maximum number of tet ids in a mesh with `tets` tets. Each replaced tet keeps its
  /// id. If there are more ids than the maximum, replaced tets are removed. The maximum allows one
  /// replaced tet per two current tets, plus a constant number.
  static Index maximum_ids_for(Index tets)
  {
    // Number of replaced tets that is always allowed; they take little memory.
    constexpr Index small_id_count = 100000;
    return small_id_count + tets + tets / 2;
  }

  /// For each position of the batch, find the tets or the edge that a new vertex would replace. The
  /// positions are processed in parallel. @return false if canceled.
  bool find_sites(const Points& positions, const std::vector<Index>& batch)
  {
    return parallel_for(this->silent_context_, static_cast<Index>(batch.size()), per_task,
      [&](Index begin, Index end)
      {
        this->searches_.use_object([&] { return std::make_unique<CavitySearch>(this->tets_); },
          [&](CavitySearch& search)
          {
            for (Index i = begin; i < end; ++i)
            {
              this->find_sites(batch[i], positions.row(batch[i]), search, this->sites_[i]);
            }
          });
      });
  }

  /// Find the tets or the edge that a new vertex at p would replace. i: index of the position p.
  /// The first attempt is a cavity whose new tets have dihedral angles of at least 1 degree. The
  /// second attempt splits an edge that contains p up to rounding. Such edges are common along
  /// bones, because the points of a bone are collinear. The last attempt is a cavity whose new tets
  /// have positive volumes.
  void find_sites(Index i, const Vec3& p, CavitySearch& search, Site& site) const
  {
    site.kind = Site::Kind::none;
    site.cavity.tets.clear();
    const Index t = this->finder_.find(i, p);
    if (t < 0)
    {
      return;
    }
    if (search.find(p, t, this->minimum_quality_, site.cavity))
    {
      site.kind = Site::Kind::cavity;
    }
    else if (this->find_edge(p, t, site))
    {
      site.kind = Site::Kind::edge;
    }
    else if (search.find(p, t, 0.0, site.cavity))
    {
      site.kind = Site::Kind::cavity;
    }
    else
    {
      site.cavity.tets.clear();
    }
  }

  bool find_edge(const Vec3& p, Index t, Site& site) const
  {
    const Tet& tet = this->tets_.tet(t);
    // Maximum distance of p from the edge, relative to the length of the edge.
    constexpr double rounding = 1e-9;
    for (int i = 0; i < 4; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        const Vec3& a = this->tets_.point(tet[i]);
        const Vec3 edge = this->tets_.point(tet[j]) - a;
        const double relative_distance = edge.cross(p - a).norm() / edge.squaredNorm();
        if (relative_distance < rounding && this->tets_.find_ring(tet[i], tet[j], site.ring) &&
          site.ring.closed && this->tets_.may_split_edge(tet[i], tet[j], site.ring.tets, p))
        {
          site.edge = { tet[i], tet[j] };
          return true;
        }
      }
    }
    return false;
  }

  /// Insert a vertex at p, which replaces the tets or splits the edge of `site`. @return the new
  /// vertex, or -1 if the site is not valid.
  Index insert_at(const Site& site, const Vec3& p)
  {
    const Index begin = this->tets_.tet_id_limit();
    Index v = -1;
    if (site.kind == Site::Kind::cavity)
    {
      v = fill_cavity(this->tets_, p, site.cavity);
    }
    else if (site.kind == Site::Kind::edge)
    {
      v = this->tets_.split_edge(site.edge[0], site.edge[1], p);
    }
    if (v >= 0)
    {
      this->finder_.replace(site.tets(), begin);
    }
    return v;
  }

  TetComplex& tets_;
  TetLocator finder_;
  ExecutionContext& context_;
  ExecutionContext silent_context_; ///< context of the parallel loops; it reports no progress
  PerThread<CavitySearch> searches_;
  std::array<Site, maximum_batch> sites_;
  const double minimum_quality_ = TetComplex::quality_of_angle(1.0);
  /// Maximum number of tet ids (see maximum_ids_for).
  Index maximum_ids_ = maximum_ids_for(tets_.tet_count());
};
} // namespace

bool split_long_edges(ExecutionContext& context, TetMesh& mesh, double longest, Index most_tets)
{
  TetComplex tets(mesh);
  std::priority_queue<LongEdge> queue;
  const auto push = [&](Index a, Index b)
  {
    const double length = (tets.point(a) - tets.point(b)).norm();
    if (length > longest)
    {
      queue.push({ length, std::min(a, b), std::max(a, b) });
    }
  };
  for (const Edge& edge : mesh_edges(boundary_triangles(mesh.tets)))
  {
    push(edge.a, edge.b);
  }
  bool completed = true;
  for (Index count = 0; completed && !queue.empty() && tets.tet_count() < most_tets; ++count)
  {
    const LongEdge edge = queue.top();
    queue.pop();
    if (!tets.has_edge(edge.a, edge.b))
    {
      continue; // the edge was in the queue twice
    }
    const Index v =
      tets.split_edge(edge.a, edge.b, 0.5 * (tets.point(edge.a) + tets.point(edge.b)));
    if (v >= 0)
    {
      for (const TetComplex::Facet& f : tets.boundary_facets_at(v))
      {
        for (const Index w : f)
        {
          if (w != v)
          {
            push(v, w);
          }
        }
      }
    }
    completed = count % insertions_per_check != 0 || !context.canceled();
  }
  tets.write(mesh);
  return completed;
}

bool insert_vertices(
  ExecutionContext& context, TetMesh& mesh, const Points& positions, std::vector<Index>& vertices)
{
  TetComplex tets(mesh);
  vertices.assign(static_cast<std::size_t>(positions.rows()), -1);
  const bool completed = Inserter(context, tets).insert(mesh, positions, vertices);
  tets.write(mesh);
  return completed;
}

} // namespace bindpose

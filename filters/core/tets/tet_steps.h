#ifndef bindpose_tets_tet_steps_h
#define bindpose_tets_tet_steps_h

#include "geometry/mesh.h"
#include "tets/improve_options.h"
#include "tets/tet_cavity.h"
#include "tets/tet_complex.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace bindpose
{

/// A local modification (step) of a tet mesh, which replaces a few tets and lowers their cost.
struct TetStep
{
  enum class Kind
  {
    none,
    swap, ///< the tets `removed` are replaced by `added`
    contract, ///< a swap after which one vertex is no longer used
    move, ///< `vertex` moves to `position`
    insert ///< a new vertex at `position` replaces the tets of `cavity`
  };
  Kind kind = Kind::none;
  std::vector<Index> removed;
  std::vector<TetComplex::Tet> added;
  Index vertex = -1;
  Vec3 position = Vec3::Zero();
  TetCavity cavity;
  /// The vertices of the tet for which no better position was found.
  std::vector<Index> immovable;
  bool insertion_failed = false; ///< whether no vertex could be inserted near the tet

  void clear();
};

/// Limits that apply to all steps.
struct TetStepRules
{
  TetStepRules(const ImproveOptions& improve_options, const OntoSurface& onto)
    : options(improve_options), surface(onto)
  {
  }

  const ImproveOptions& options;
  const OntoSurface& surface;
  std::vector<char> constrained; ///< #V: 1 for held (constrained) vertices
  /// #V: value of TetComplex::stamp() for each vertex at the last search that found no better
  /// position for the vertex. 0: no such search.
  std::vector<std::uint64_t> immovable_since;
  /// #T: number of searches that could not insert a vertex near the tet.
  std::vector<std::uint8_t> failed_insertions;
  bool may_move_constrained = false; ///< true if held vertices may move
  bool insert = false; ///< true if vertices may be inserted
};

/// Report whether a better position for vertex v may be searched. Held vertices may move only if
/// rules.may_move_constrained is true. Boundary vertices move along rules.surface, so they may move
/// only if a surface is given. The tets at v must have changed since the last search that found no
/// better position.
bool may_move(const TetComplex& tets, const TetStepRules& rules, Index v);

/// Report whether a vertex may be inserted near tet t. After three failed searches, insertion is
/// skipped, because further searches rarely succeed.
bool may_insert(const TetStepRules& rules, Index t);

/// Finds steps that improve a tet. Each thread needs a separate object. The tets and the rules may
/// change between two searches.
class TetStepSearch
{
public:
  TetStepSearch(const TetComplex& tets, const TetStepRules& rules);

  /// Find the first step that improves tet t. If there is no such step, step.kind is `none`.
  void find(Index t, TetStep& step);
  /// Return the number of computed tet qualities.
  Index evaluations() const { return this->evaluations_ + this->cavities_.evaluations(); }

private:
  using Tet = TetComplex::Tet;
  using Facet = TetComplex::Facet;
  using Ring = TetComplex::Ring;
  /// Cost of a set of tets: 0 if all tets are good enough.
  struct Cost
  {
    /// Sum over the tets of log(required sine / sine of the smallest dihedral angle).
    double sum = 0.0;
    double worst = 1.0; ///< smallest tet quality
  };
  /// The boundary triangles around a vertex.
  struct Patch
  {
    bool smooth = true;
    Vec3 normal = Vec3::Zero();
  };
  /// The link of a vertex: the facets, opposite to the vertex, of the tets at the vertex, with
  /// their edges and vertices. The vertices of each simplex are sorted, and so are the lists of
  /// simplices.
  struct Link
  {
    std::vector<Index> vertices;
    std::vector<std::array<Index, 2>> edges;
    std::vector<std::array<Index, 3>> triangles;
  };

  const Vec3& point(Index v) const { return this->tets_.point(v); }
  double quality(const Tet& tet);
  double quality(const Facet& f, const Vec3& p);
  double penalty(double quality) const;
  Cost cost(const std::vector<Index>& tets) const;
  double minimum_quality_after(const Cost& cost) const;

  bool remove_edge(Index a, Index b, TetStep& step);
  bool may_swap_boundary(Index a, Index b, const Ring& ring) const;
  bool remove_facet(Index t, int k, TetStep& step);

  bool move(Index v, TetStep& step);
  template <typename Items, typename QualityOf>
  double total_cost(
    const Items& items, const QualityOf& quality_of, double minimum_quality, double upper_limit);
  double star_cost(Index v, const Vec3& p, double minimum_quality, double upper_limit);
  Patch patch_of(const std::vector<Facet>& boundary_facets, Index moved, const Vec3& p) const;

  bool insert_near(Index t, TetStep& step);
  bool insert(Index t, Vec3 p, TetStep& step);
  void sort_facets(TetCavity& cavity, const Vec3& p);
  double cavity_cost(
    const TetCavity& cavity, const Vec3& p, double minimum_quality, double upper_limit);

  bool contract_short_edge(const Tet& tet, double maximum_ratio, TetStep& step);
  bool contract(Index a, Index b, TetStep& step);
  bool keeps_shape(const std::vector<Facet>& boundary_facets, Index a, Index b) const;
  bool keeps_topology(const std::vector<Facet>& boundary_facets, Index a, Index b) const;
  Link link_of(Index v, const std::vector<Facet>& boundary_facets) const;

  const TetComplex& tets_;
  const TetStepRules& rules_;
  const double good_quality_; ///< tets whose quality is at least this are not improved
  const double
    insertion_quality_; ///< vertices may be inserted near tets whose quality is below this
  CavitySearch cavities_;
  Ring ring_;
  std::vector<Index> star_;
  std::vector<std::pair<double, Facet>> ranked_facets_;
  Index evaluations_ = 0;
};

} // namespace bindpose

#endif

#ifndef bindpose_tets_tet_cavity_h
#define bindpose_tets_tet_cavity_h

// Cavities: sets of tets that a new vertex replaces. All facets that bound a cavity are visible
// from the new vertex.

#include "geometry/mesh.h"
#include "tets/tet_complex.h"

#include <array>
#include <cmath>
#include <vector>

namespace bindpose
{

/// Tets that a new vertex will replace, and the facets that bound these tets. A facet is oriented
/// such that (facet, point) is a positive tet if the point is inside the cavity.
struct TetCavity
{
  std::vector<Index> tets;
  std::vector<TetComplex::Facet> facets;
};

/// Replace the tets of the cavity. @return the new vertex.
Index fill_cavity(TetComplex& tets, const Vec3& p, const TetCavity& cavity);

/// Finds cavities. Each thread needs a separate object. The tets may be edited between two
/// searches.
class CavitySearch
{
public:
  explicit CavitySearch(const TetComplex& tets) : tets_(tets) {}

  /// Find the tets around tet `start`, connected by facets, whose circumspheres contain p. Tets of
  /// the cavity are removed until every new tet, between p and a facet that bounds the cavity, has
  /// at least the quality `minimum_quality`. p must be inside `start`.
  /// @return false if no cavity remains.
  bool find(const Vec3& p, Index start, double minimum_quality, TetCavity& cavity);
  /// Return the work so far: number of computed tet qualities plus number of collected tets.
  Index evaluations() const { return this->evaluations_; }

private:
  using Tet = TetComplex::Tet;
  using Facet = TetComplex::Facet;
  /// Qualities of the new tets on the four facets of a tet of the cavity. NAN: not yet computed.
  using Qualities = std::array<double, 4>;
  bool is_in_sphere(const Tet& tet, const Vec3& p) const;
  void add(Index t);
  bool is_in_cavity(Index t) const { return t >= 0 && this->cavity_[t] == this->searches_; }
  Facet facet_inwards(Index t, int k) const;
  bool facet_fits(const Vec3& p, Index t, int k, double minimum_quality);
  bool collect_sphere(const Vec3& p, Index start, double minimum_quality);
  bool shrink(const Vec3& p, Index start, double minimum_quality);
  void collect_connected(Index start, TetCavity& cavity);
  bool preserves_volume(const Vec3& p, const TetCavity& cavity) const;

  const TetComplex& tets_;
  /// Per tet: the index of the last search whose cavity contained the tet. The index is negative if
  /// the tet is connected to the start.
  std::vector<Index> cavity_;
  std::vector<Qualities> qualities_; ///< per collected tet of the current search
  std::vector<Index> collected_; ///< per tet: its index in qualities_, if it has been collected
  std::vector<Index> queue_; ///< tets that the current search will visit
  Index searches_ = 0;
  Index evaluations_ = 0;
};

} // namespace bindpose

#endif

#ifndef bindpose_scene_tet_cut_h
#define bindpose_scene_tet_cut_h

#include "base/mesh.h"

#include <array>
#include <vector>

namespace bindpose
{

/// Tets that a plane lays open without cutting any ("crinkle cut"): those whose centre is not
/// beyond the plane stay whole. Neighbours and centres are found once, so that a plane can be
/// dragged.
class TetCut
{
public:
  /// Sides of tets, turned outwards, each with the tet that it belongs to.
  struct Sides
  {
    Triangles triangles; ///< #S x 3 vertex ids
    std::vector<Index> tets; ///< #S
  };

  TetCut() = default;
  /// O(#T log #T): 100,000 tets take 0.1 s.
  explicit TetCut(PointsView points, TetsView tets);

  /// Takes the tets away whose centre lies on the side of the plane that the normal points to.
  /// With keep_all() instead none is taken away, which is how it begins. 1 us a thousand tets.
  void keep_behind(const Vec3& origin, const Vec3& normal);
  void keep_all();

  Index kept_count() const { return this->kept_count_; }
  /// #T: 1 for a tet that stays.
  const std::vector<char>& kept() const { return this->kept_; }
  /// Sides of kept tets at the boundary of the whole, and those that the cut lays open.
  const Sides& outside() const { return this->outside_; }
  const Sides& laid_open() const { return this->laid_open_; }
  /// Smallest and largest place of a centre along a direction.
  std::array<double, 2> reach(const Vec3& direction) const;

private:
  /// A side with the one or two tets that it belongs to, turned outwards from the first.
  struct Facet
  {
    std::array<Index, 3> vertices;
    Index tet;
    Index other; ///< -1 for none
  };
  void find_sides();

  std::vector<Facet> facets_; // in the order of the tets
  Points centers_; // #T x 3
  std::vector<char> kept_;
  Index kept_count_ = 0;
  Sides outside_;
  Sides laid_open_;
};

/// Tets apart from each other: four points a tet, moved towards the tet's centre.
struct ShrunkTets
{
  Points points; ///< 4 #kept x 3
  Triangles triangles; ///< 4 #kept x 3, turned outwards
  std::vector<Index> tets; ///< 4 #kept: of each triangle
  std::vector<Index> vertices; ///< 4 #kept: of each point
};

/// @param factor  size of each tet, of its own, in (0, 1]
/// @param kept  #T, 1 for the tets wanted
ShrunkTets shrink_tets(
  PointsView points, TetsView tets, const std::vector<char>& kept, double factor);

} // namespace bindpose

#endif

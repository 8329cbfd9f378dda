#ifndef bindpose_shapes_tet_cut_h
#define bindpose_shapes_tet_cut_h

#include "geometry/mesh.h"

#include <array>
#include <vector>

namespace bindpose
{

/// Tets behind a plane, drawn without cutting them ("crinkle cut"): tets whose center is not beyond
/// the plane are kept whole. Neighbors and centers are computed once, so that a plane can be
/// dragged.
class TetCut
{
public:
  /// Triangular faces of tets, oriented outward, with the tet of each face.
  struct FaceSet
  {
    Triangles triangles; ///< #S x 3 vertex ids
    std::vector<Index> tets; ///< #S: the tet of each face
  };

  TetCut() = default;
  /// Build the faces and match them. The cost is O(#T log #T): 100,000 tets take 0.1 seconds.
  explicit TetCut(PointsView points, TetsView tets);

  /// Keep exactly the tets whose center is not on the side of the plane that the normal points to.
  /// The result does not depend on earlier calls. keep_all() keeps all tets, which is the initial
  /// state. The cost is 1 microsecond per 1000 tets.
  void keep_behind(const Vec3& origin, const Vec3& normal);
  void keep_all();

  Index kept_count() const { return this->kept_count_; }
  /// #T: 1 for a kept tet.
  const std::vector<char>& kept() const { return this->kept_; }
  /// Faces of kept tets on the boundary of the whole mesh, and faces that the cut exposes.
  const FaceSet& boundary_faces() const { return this->boundary_faces_; }
  const FaceSet& exposed_faces() const { return this->exposed_faces_; }
  /// Return the smallest and largest coordinate of the tet centers along a direction.
  std::array<double, 2> center_range(const Vec3& direction) const;

private:
  /// A face with its one or two tets, oriented outward from the first tet.
  struct Facet
  {
    std::array<Index, 3> vertices;
    Index tet;
    Index other; ///< the second tet; -1 if there is none
  };
  void find_faces();

  std::vector<Facet> facets_; // sorted by tet
  Points centers_; // #T x 3
  std::vector<char> kept_;
  Index kept_count_ = 0;
  FaceSet boundary_faces_;
  FaceSet exposed_faces_;
};

/// Tets with gaps between them: each tet has its own four points, moved toward the tet's center.
struct ShrunkTets
{
  Points points; ///< 4 #kept x 3
  Triangles triangles; ///< triangles of the kept tets, 4 #kept x 3, oriented outward
  std::vector<Index> tets; ///< 4 #kept: the tet of each triangle
  std::vector<Index> vertices; ///< 4 #kept: the input vertex of each point
};

/// @param factor  size factor of each tet about its center, in (0, 1]
/// @param kept  #T: 1 for the tets to shrink and return
ShrunkTets shrink_tets(
  PointsView points, TetsView tets, const std::vector<char>& kept, double factor);

} // namespace bindpose

#endif

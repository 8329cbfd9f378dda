#ifndef bindpose_base_mesh_types_h
#define bindpose_base_mesh_types_h

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

namespace bindpose
{

/// Vertex and element ids. 64 bit like vtkIdType, so that connectivity arrays are shared and not
/// copied.
using Index = std::int64_t;

/// One position, direction or displacement.
using Vec3 = Eigen::Vector3d;
/// One position, direction or displacement in a plane.
using Vec2 = Eigen::Vector2d;

/// #V x 3 coordinates, row-major (the layout of vtkPoints).
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// #F x 3 vertex ids, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<Index, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// #T x 4 vertex ids, positive volume (VTK's order: the normal of the first three vertices points
/// to the fourth).
using Tets = Eigen::Matrix<Index, Eigen::Dynamic, 4, Eigen::RowMajor>;
/// #V x #handles, one row per vertex (the layout of a VTK array with #handles components).
using Weights = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Read-only view of one of the matrix types above, or of an Eigen::Map with the same layout on
/// external memory. It never copies. Unlike Eigen::Ref it accepts no other types, so that functions
/// can be overloaded for triangles and tets. Expressions must be evaluated before they are passed.
template <typename Matrix>
class MatrixView : public Eigen::Map<const Matrix>
{
public:
  MatrixView(const Matrix& matrix)
    : Eigen::Map<const Matrix>(matrix.data(), matrix.rows(), matrix.cols())
  {
  }
  MatrixView(const Eigen::Map<const Matrix>& map) : Eigen::Map<const Matrix>(map) {}
  MatrixView(const Eigen::Map<Matrix>& map)
    : Eigen::Map<const Matrix>(map.data(), map.rows(), map.cols())
  {
  }
};
using PointsView = MatrixView<Points>;
using TrianglesView = MatrixView<Triangles>;
using TetsView = MatrixView<Tets>;
using WeightsView = MatrixView<Weights>;

/// Return the signed area of the parallelogram with the sides a and b; positive if the turn from a
/// to b is counter-clockwise.
inline double cross(const Vec2& a, const Vec2& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

struct TriangleMesh
{
  Points points;
  Triangles triangles;
};

struct TetMesh
{
  Points points;
  Tets tets;
};

} // namespace bindpose

#endif

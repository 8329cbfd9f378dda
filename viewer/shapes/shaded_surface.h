#ifndef bindpose_shapes_shaded_surface_h
#define bindpose_shapes_shaded_surface_h

#include "geometry/mesh.h"

#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <vector>

class vtkActor;
class vtkPolyData;

namespace bindpose
{

/// A surface prepared for drawing: triangles, smooth normals within patches, and vertices
/// duplicated along sharp edges so that these edges stay sharp. Sharp edges are determined once, in
/// the initial shape. Moving the vertices then costs one pass over triangles and vertices, so that
/// a shape can be bent while the mouse moves.
///
/// The two sides of a seam, where the input has several points at one position, share normals if
/// the seam is not a sharp edge.
///
/// Polygons are triangulated; vertex and line cells are left out. Triangles are not reoriented:
/// lighting is two-sided, and neighbors with opposite orientation are separated by a sharp edge.
class ShadedSurface
{
public:
  /// @param feature_angle  angle between the normals of two adjacent triangles, in degrees, in (0,
  /// 180]. At or above this angle, the common edge of the two triangles is drawn sharp.
  explicit ShadedSurface(vtkPolyData* surface, double feature_angle = 50.0);

  /// Report whether another surface has the same points and cells as the input. Only then can
  /// set_arrays() be called with this surface.
  bool has_same_mesh(vtkPolyData* surface) const;
  /// Reset the points to those of `surface`, and replace the point and cell arrays by those of
  /// `surface`. has_same_mesh(surface) must be true.
  void set_arrays(vtkPolyData* surface);

  /// The surface to draw: the points that triangles use, normals, and the input's point and cell
  /// arrays.
  vtkPolyData* polydata() const { return this->display_; }
  /// Point of the input for each point of polydata().
  const std::vector<Index>& input_points() const { return this->input_points_; }
  /// Return the triangles; their ids are points of polydata().
  TrianglesView triangles() const { return this->triangles_; }

  /// Set the positions of the input's points, #V x 3, in the input's order. The cost is O(#V + #F).
  /// polydata() is marked as modified.
  void move(PointsView points);

private:
  void find_triangles_of_normals();
  void update_normals();

  vtkSmartPointer<vtkPolyData> input_; ///< the input's points and cells, without its arrays
  vtkSmartPointer<vtkPolyData> display_;
  std::vector<Index> input_points_;
  std::vector<Index> input_cells_; ///< input cell of each triangle
  Triangles triangles_;
  Index normal_count_ = 0;
  /// Index of the normal of each drawn point; empty: normal v belongs to point v. Points on both
  /// sides of a seam share a normal.
  std::vector<Index> normal_ids_;
  /// Index of each normal's first entry in triangles_of_normals_; at the end the total number of
  /// entries.
  std::vector<Index> first_triangle_;
  std::vector<Index> triangles_of_normals_; ///< triangles of each normal, in ascending order
  Points triangle_normals_; ///< temporary
  /// Temporary; not used if normal_ids_ is empty.
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> shared_normals_;
  vtkNew<vtkFloatArray> normals_; ///< normals of the drawn points
};

/// Apply the material of surfaces in Bindpose: mostly diffuse, with a weak specular highlight.
void use_surface_material(vtkActor* actor);

} // namespace bindpose

#endif

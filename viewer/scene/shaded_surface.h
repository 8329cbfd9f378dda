#ifndef bindpose_scene_shaded_surface_h
#define bindpose_scene_shaded_surface_h

#include "base/mesh.h"

#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <vector>

class vtkActor;
class vtkPolyData;

namespace bindpose
{

/// A surface as it is drawn: triangles, smooth normals within patches, vertices doubled along
/// sharp edges so that these stay sharp. Where an edge is sharp is decided once, in the shape
/// given; moving the vertices then costs one pass over triangles and vertices, so that a shape
/// can be bent at mouse rate.
///
/// Polygons are triangulated; vertices and lines are left out. Triangles are not reoriented:
/// lighting is two-sided, and neighbours that face opposite ways are parted by a sharp edge.
class ShadedSurface
{
public:
  /// @param feature_angle  degrees between the normals of two triangles from which on their
  ///   common edge is drawn sharp; in (0, 180]
  explicit ShadedSurface(vtkPolyData* surface, double feature_angle = 50.0);

  /// Whether another surface has the same points and cells, so that this one may carry its arrays.
  bool is_of(vtkPolyData* surface) const;
  /// Goes back to where that surface's points are, with its point and cell arrays in place of those
  /// carried until now. It must be of it.
  void take(vtkPolyData* surface);

  /// What to draw: the points that triangles use, normals, and the input's point and cell arrays
  /// carried along.
  vtkPolyData* polydata() const { return this->display_; }
  /// For each point of polydata() the point of the input.
  const std::vector<Index>& input_points() const { return this->input_points_; }
  /// Of points of polydata().
  TrianglesView triangles() const { return this->triangles_; }

  /// New places for the input's points, #V x 3, in the input's order. O(#V + #F); marks
  /// polydata() modified.
  void move(PointsView points);

private:
  void drop_unused_points();
  void find_triangles_of_points();
  void update_normals();

  vtkSmartPointer<vtkPolyData> input_; ///< its points and cells only
  vtkSmartPointer<vtkPolyData> display_;
  std::vector<Index> input_points_;
  std::vector<Index> input_cells_; ///< of each triangle
  Triangles triangles_;
  std::vector<Index> first_triangle_; ///< of each point in triangles_of_points_, and the end
  std::vector<Index> triangles_of_points_; ///< ascending for each point
  Points triangle_normals_; ///< scratch
  vtkNew<vtkFloatArray> normals_; ///< of the points drawn
};

/// The house's material: soft, with a slight gloss.
void use_surface_material(vtkActor* actor);

} // namespace bindpose

#endif

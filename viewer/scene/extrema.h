#ifndef bindpose_scene_extrema_h
#define bindpose_scene_extrema_h

#include "scene/categories.h"
#include "scene/coloring.h"
#include "scene/picture_options.h"
#include "weights/extrema.h"

#include "vtkActor.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"

#include <array>
#include <vector>

class vtkDataSet;
class vtkRenderer;

namespace bindpose
{

/// Find the local extrema of the displayed array on each tile's mesh. A tile is one dataset of the
/// picture. Two points are neighbors if an edge of a triangle or tet joins them. Extrema with a
/// persistence of at most notable_persistence are left out; see interior_extrema(). Points with a 1
/// in `Weights` or `RawWeights` are handles; extrema at these points are intended and left out.
/// Tiles without the array have no extrema.
///
/// If a surface is shown without its interior, handles inside it are not among its points. The
/// largest weight near such a handle is then counted as an extremum.
///
/// Return invalid_input if no tile has the array at the points of a surface or of tets, or if a
/// value is not finite.
Status find_extrema(const std::vector<Tile>& tiles, const Coloring& coloring,
  std::vector<std::vector<Extremum>>& extrema);

/// Return extremum_categories() with counts over all tiles.
std::vector<Category> count_extrema(const std::vector<std::vector<Extremum>>& extrema);

/// Add picture.extrema[].maxima, .minima and .drawn to a report, one entry per tile.
void report_extrema(const std::vector<std::vector<Extremum>>& extrema,
  const std::vector<std::int64_t>& drawn, Report& report);

/// Draws balls with dark rims at extrema. Maxima and minima differ in color.
class ExtremumBalls
{
public:
  ExtremumBalls();

  struct Marker
  {
    Vec3 position = Vec3::Zero();
    bool maximum = false;
  };
  void set(const std::vector<Marker>& markers, double radius);
  /// Move the balls in front of their extrema, on the line to the eye; otherwise a surface would
  /// cover the rims. Call this after the eye has moved.
  void face_eye(const Vec3& eye);
  const std::vector<vtkSmartPointer<vtkActor>>& actors() const { return this->actors_; }

private:
  std::vector<Marker> markers_;
  double radius_ = 1.0;
  std::array<vtkNew<vtkPolyData>, 2> clouds_; // minima, maxima
  std::array<vtkNew<vtkSphereSource>, 2> spheres_; // the ball and its rim
  std::vector<vtkSmartPointer<vtkActor>> actors_;
};

/// Add a ball with a dark rim at each extremum.
/// @param drawn_points  #V: 1 for points whose extrema are drawn; empty: all extrema are drawn
/// @return number of balls
Index add_extrema(vtkRenderer* renderer, vtkDataSet* data, const std::vector<Extremum>& extrema,
  const std::vector<char>& drawn_points, double radius);

} // namespace bindpose

#endif

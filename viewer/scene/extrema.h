#ifndef bindpose_scene_extrema_h
#define bindpose_scene_extrema_h

#include "scene/categories.h"
#include "scene/colouring.h"
#include "scene/picture.h"
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

/// Local extrema of the shown number on each tile's mesh, along the edges of its triangles or tets,
/// with a persistence above notable_persistence; see interior_extrema(). Points whose `Weights` or
/// `RawWeights` hold a 1 are handles, whose extrema are wanted: they are left out. Tiles without
/// the array have none.
///
/// Handles inside a surface that is shown without its inside are none of its points: the columns'
/// greatest values near them then count.
///
/// invalid_input when no tile has the number at the points of a surface or of tets, or one of them
/// is not finite.
Status find_extrema(const std::vector<Tile>& tiles, const Colouring& colouring,
  std::vector<std::vector<Extremum>>& extrema);

/// extremum_categories() with the numbers of all tiles together.
std::vector<Category> count_extrema(const std::vector<std::vector<Extremum>>& extrema);

/// picture.extrema[].maxima, .minima and .drawn: a tile each.
void report_extrema(const std::vector<std::vector<Extremum>>& extrema,
  const std::vector<std::int64_t>& drawn, Report& report);

/// Balls with dark rims, maxima and minima in their colours.
class ExtremumBalls
{
public:
  ExtremumBalls();

  struct Place
  {
    Vec3 at = Vec3::Zero();
    bool maximum = false;
  };
  void set(const std::vector<Place>& places, double radius);
  /// Balls lie before their places, on the line to the eye, or a surface would cover the rims. To
  /// be called when the eye has moved.
  void face(const Vec3& eye);
  const std::vector<vtkSmartPointer<vtkActor>>& actors() const { return this->actors_; }

private:
  std::vector<Place> places_;
  double radius_ = 1.0;
  std::array<vtkNew<vtkPolyData>, 2> clouds_; // minima, maxima
  std::array<vtkNew<vtkSphereSource>, 2> spheres_; // ball, rim
  std::vector<vtkSmartPointer<vtkActor>> actors_;
};

/// A ball with a dark rim at each extremum.
/// @param seen  #V: 1 for points whose extrema are drawn; empty: all
/// @return how many are drawn
Index add_extrema(vtkRenderer* renderer, vtkDataSet* data, const std::vector<Extremum>& extrema,
  const std::vector<char>& seen, double radius);

} // namespace bindpose

#endif

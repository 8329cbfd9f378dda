#ifndef bindpose_scene_curves_h
#define bindpose_scene_curves_h

#include "vtkSmartPointer.h"

#include <vector>

class vtkActor;
class vtkDataSet;
class vtkPolyData;

namespace bindpose
{

/// Report whether a dataset consists only of curves: it has lines but no faces, and it is not a
/// handle dataset. Lines of two points are bones unless the cell array Multiplicity marks them as
/// the boundary of a surface.
bool is_curve_data(vtkDataSet* data);

/// Return actors that show the lines of a polydata as round tubes, and as faint lines where
/// something hides them. The cell array Multiplicity states how often the boundary of a surface
/// uses a line. It sets the width of a tube: factor 1.5 for multiplicity 2, factor 2 for 3 and
/// more. Lines of multiplicity 0 are left out. The result is empty if there are no lines.
/// @param radius  radius of the tubes, world units
/// @param line_width  width of the faint lines, pixels
std::vector<vtkSmartPointer<vtkActor>> make_curves(
  vtkPolyData* data, double radius, double line_width);

} // namespace bindpose

#endif

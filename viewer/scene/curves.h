#ifndef bindpose_scene_curves_h
#define bindpose_scene_curves_h

#include "vtkSmartPointer.h"

#include <vector>

class vtkActor;
class vtkDataSet;
class vtkPolyData;

namespace bindpose
{

/// Whether a dataset is nothing but curves: lines without faces that are no handles. Two-point
/// lines are bones unless the cell array Multiplicity says that they are a surface's boundary.
bool is_curve_data(vtkDataSet* data);

/// The lines of a polydata as round tubes, and faintly where something stands before them.
/// With the cell array Multiplicity (how often a surface ends there) those that count twice are
/// 1.5 times as wide, three times and more 2 times; those that count 0 times are left out.
/// Empty without lines.
/// @param radius  of the tubes, world units
/// @param line_width  of the faint lines, pixels
std::vector<vtkSmartPointer<vtkActor>> make_curves(
  vtkPolyData* data, double radius, double line_width);

} // namespace bindpose

#endif

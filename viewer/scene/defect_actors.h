#ifndef bindpose_scene_defect_actors_h
#define bindpose_scene_defect_actors_h

#include "vtkSmartPointer.h"

#include <vector>

class vtkActor;
class vtkPolyData;

namespace bindpose
{

/// Return actors for the output of vtkSurfaceDefects, in the colors of defect_categories():
/// triangles as faces slightly in front of the surface, edges as thick lines, vertices as dots.
/// Edges and vertices are faintly visible through surfaces that hide them.
/// @param line_width  width of the edges in pixels; dots are 3 times as wide
std::vector<vtkSmartPointer<vtkActor>> make_defects(vtkPolyData* defects, double line_width);

} // namespace bindpose

#endif

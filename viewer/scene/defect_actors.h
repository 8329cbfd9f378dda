#ifndef bindpose_scene_defect_actors_h
#define bindpose_scene_defect_actors_h

#include "vtkSmartPointer.h"

#include <vector>

class vtkActor;
class vtkPolyData;

namespace bindpose
{

/// Actors for the output of vtkSurfaceDefects, in the colours of defect_categories(): triangles as
/// faces a little before the surface, edges as thick lines, vertices as dots. Edges and vertices
/// shine faintly through what hides them.
/// @param line_width  pixels of the edges' lines; dots are 3 times as wide
std::vector<vtkSmartPointer<vtkActor>> make_defects(vtkPolyData* defects, double line_width);

} // namespace bindpose

#endif

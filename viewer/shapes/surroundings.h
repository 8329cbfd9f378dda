#ifndef bindpose_shapes_surroundings_h
#define bindpose_shapes_surroundings_h

#include "geometry/mesh.h"

class vtkRenderer;

namespace bindpose
{

/// Light the renderer from all directions, as by a gray sky that is brightest at the top. Only
/// physically based materials are lit by it, and metals reflect it. The first picture afterward
/// takes about half a second longer without a graphics card.
/// @param up direction of the brightest part, of any length above 0
void add_surroundings(vtkRenderer* renderer, const Vec3& up);

} // namespace bindpose

#endif

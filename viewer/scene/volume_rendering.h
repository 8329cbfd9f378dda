#ifndef bindpose_scene_volume_rendering_h
#define bindpose_scene_volume_rendering_h

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;
class vtkVolume;

namespace bindpose
{

/// Return the opacity, in [0, 1], that a winding number w adds to a ray between two samples. The
/// opacity is piecewise linear in w:
/// - |w| <= 0.02, the tolerance of winding_color(): 0, so that the outside is clear
/// - w from 0.42 to 0.58, the border of the inside: 0.6
/// - w from 0.75 to 1.02, the inside: 3 % per hundredth of the volume's diagonal
/// - w = -1 and w = 2, and beyond: 24 % per hundredth of the volume's diagonal
/// @param step  distance between samples, in hundredths of the volume's diagonal
double winding_opacity(double winding_number, double step);

/// Return a volume rendering of a winding number, shaded by its gradient, in the colors of
/// winding_color(). The opacity is defined per unit of length where the value changes slowly, and
/// per sample where it jumps from 0 to 1 between two samples. The picture is therefore similar on
/// grids of any resolution. check_volume() must accept the point array.
///
/// Rays are cast on the CPU, so that the picture is the same on every machine. With a software
/// graphics driver, as on servers, CPU ray casting is several times faster than VTK's GPU mapper.
/// @param pixels  distance between neighboring rays in pixels; 0: adapted to the time available for
/// a picture
vtkSmartPointer<vtkVolume> make_winding_volume(
  vtkImageData* image, const std::string& array, double pixels);

} // namespace bindpose

#endif

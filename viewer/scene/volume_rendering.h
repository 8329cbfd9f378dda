#ifndef bindpose_scene_volume_rendering_h
#define bindpose_scene_volume_rendering_h

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;
class vtkVolume;

namespace bindpose
{

/// Return the opacity, in [0, 1], of a winding number for a ray from one sample to the next. It is
/// 0 for |w| <= 0.02, the tolerance of winding_color(), so that the outside is clear. It is 0.6
/// from 0.42 to 0.58, at the border of the inside. It is 3 % per unit of length inside, and
/// increases to 24 % toward -1 and toward 2.
/// @param step  distance of samples, in hundredths of the volume's diagonal
double winding_opacity(double winding_number, double step);

/// Return a volume rendering of a winding number, shaded by its gradient, in the colors of
/// winding_color(). The opacity is per unit of length where a value fills space, and per sample at
/// a jump from 0 to 1 between two samples. So both look the same on every grid. check_volume() must
/// accept the point array.
///
/// Rays are cast on the CPU. With a software graphics driver, as on servers, that is several times
/// faster than VTK's GPU mapper, and it gives the same picture on every machine.
/// @param pixels  distance of neighboring rays in pixels; 0: adapted to the time available for a
///   picture
vtkSmartPointer<vtkVolume> make_winding_volume(
  vtkImageData* image, const std::string& array, double pixels);

} // namespace bindpose

#endif

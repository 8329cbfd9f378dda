#ifndef bindpose_scene_volume_rendering_h
#define bindpose_scene_volume_rendering_h

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;
class vtkVolume;

namespace bindpose
{

/// How opaque a winding number is to a ray from one sample to the next, in [0, 1]: 0 for
/// |w| <= 0.02, the tolerance of winding_colour(), so that the outside is clear; 0.6 from 0.42 to
/// 0.58, where inside and outside part; 3 % a unit of length inside, and growing to 24 % towards
/// -1 and towards 2.
/// @param step  distance of samples in the unit of length, a hundredth of the volume's diagonal
double winding_opacity(double winding_number, double step);

/// A winding number's volume, drawn as a cloud lit by its gradient, in the colours of
/// winding_colour(). What fills space has its opacity by length, and a jump from 0 to 1 between
/// two samples by sample, so that both look the same on every grid. For a point array that
/// check_volume() accepts.
///
/// Rays are cast on the processor: where the graphics driver is software, as on servers, that is
/// several times faster than VTK's mapper for graphics hardware, and it gives the same picture on
/// every machine.
/// @param pixels  distance of neighbouring rays; 0: as the time for a picture allows
vtkSmartPointer<vtkVolume> make_winding_volume(
  vtkImageData* image, const std::string& array, double pixels);

} // namespace bindpose

#endif

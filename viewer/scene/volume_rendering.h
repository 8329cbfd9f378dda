#ifndef bindpose_scene_volume_rendering_h
#define bindpose_scene_volume_rendering_h

#include "vtkSmartPointer.h"

#include <string>

class vtkImageData;
class vtkVolume;

namespace bindpose
{

/// How opaque a winding number is to a ray over one unit of length (see make_winding_volume), in
/// [0, 1]: 0 for |w| <= 0.02, the tolerance of winding_colour(), so that the outside is clear;
/// 0.6 from 0.42 to 0.58, where inside and outside part; faint inside; growing below -0.02 and
/// above 1.02.
/// @param inside  opacity at 1, where a shape counts once
double winding_opacity(double winding_number, double inside);

/// A winding number's volume, drawn as a cloud lit by its gradient, in the colours of
/// winding_colour(). One unit of opacity is one sample's distance, so that a jump from 0 to 1
/// between two samples looks the same on every grid; the inside's opacity is 3 % a hundredth of
/// the diagonal. For a point array that check_volume() accepts.
///
/// Rays are cast on the processor: where the graphics driver is software, as on servers, that is
/// several times faster than VTK's mapper for graphics hardware, and it gives the same picture on
/// every machine.
/// @param pixels  distance of neighbouring rays; 0: as the time for a picture allows
vtkSmartPointer<vtkVolume> make_winding_volume(
  vtkImageData* image, const std::string& array, double pixels);

} // namespace bindpose

#endif

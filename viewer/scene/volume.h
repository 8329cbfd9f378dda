#ifndef bindpose_scene_volume_h
#define bindpose_scene_volume_h

#include "base/status.h"
#include "geometry/mesh.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataSet;
class vtkImageData;
class vtkPolyData;

namespace bindpose
{

// Isosurfaces, slices and values of image volumes.

/// Check whether isosurfaces, slices and volume rendering can be made of this point array. Return
/// invalid_input with one sentence for: no image, an image one sample thick, no such point array
/// (the sentence lists the existing arrays), an array of several components, a value that is not
/// finite. Report: volume.samples, volume.minimum, volume.maximum.
Status check_volume(vtkDataSet* data, const std::string& array);

/// Return the surface where the array's value, interpolated linearly between samples, equals the
/// level. Normals come from the field's gradient. The result is empty if the level is not reached.
/// check_volume() must accept the image.
vtkSmartPointer<vtkPolyData> isosurface(
  vtkImageData* image, const std::string& array, double level);

/// Cut the image by a plane. The array's values are the scalars of the result.
vtkSmartPointer<vtkPolyData> slice(
  vtkImageData* image, const std::string& array, const Vec3& origin, const Vec3& normal);

/// Interpolate the value between samples, linearly in each direction. Return false if the position
/// is outside the image by more than a millionth of its diagonal.
bool value_at(vtkImageData* image, const std::string& array, const Vec3& position, double& value);

/// Return the total area of the polygons.
double surface_area(vtkPolyData* surface);

/// Return the bounding box of all pairs of neighboring samples between which the value crosses one
/// of the levels. With `include_nonzero`, the box also contains all samples whose absolute value is
/// above 0.1. Return the box of the whole image if the result would be empty.
Box occupied_box(vtkImageData* image, const std::string& array, const std::vector<double>& levels,
  bool include_nonzero);

} // namespace bindpose

#endif

#ifndef bindpose_scene_volume_h
#define bindpose_scene_volume_h

#include "base/mesh.h"
#include "base/status.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkDataSet;
class vtkImageData;
class vtkPolyData;

namespace bindpose
{

/// Whether isosurfaces, slices and volume rendering can be made of this point array.
/// invalid_input, one sentence, for: no image, an image one sample thick, no such point array
/// (naming those there are), an array of several components, a value that is not finite.
/// Report: volume.samples, volume.minimum, volume.maximum.
Status check_volume(vtkDataSet* data, const std::string& array);

/// Where the array's value, linear between samples, is the level; with normals from the field's
/// gradient. Empty when the level is not reached. For an image that check_volume() accepts.
vtkSmartPointer<vtkPolyData> isosurface(
  vtkImageData* image, const std::string& array, double level);

/// The cut of a plane with the image, with the array's values as its scalars.
vtkSmartPointer<vtkPolyData> slice(
  vtkImageData* image, const std::string& array, const Vec3& origin, const Vec3& normal);

/// Value between samples, linear in each direction; false outside the image (beyond
/// a millionth of its diagonal).
bool value_at(vtkImageData* image, const std::string& array, const Vec3& place, double& value);

/// Sum of the triangles' areas.
double surface_area(vtkPolyData* surface);

/// The box of all samples beside which a level is crossed and, with `far_from_zero`, of those
/// whose value is more than 0.1 away from 0; the whole image when there is none.
Box occupied_box(vtkImageData* image, const std::string& array, const std::vector<double>& levels,
  bool far_from_zero);

} // namespace bindpose

#endif

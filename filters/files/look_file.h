#ifndef look_file_h
#define look_file_h

#include "BindposeFiltersModule.h" // for export macro
#include "base/execution.h"
#include "look/surface_look.h"

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <string>
#include <vector>

namespace bindpose
{

/// The look of the mesh in a file.
struct FileLook
{
  SurfaceLook surface;
  /// Pixels of SurfaceLook::images, whose bytes are removed; null: not readable.
  std::vector<vtkSmartPointer<vtkImageData>> pictures;
};

/// Read the materials, textures and vertex colors of a file that vtkAssetReader can read. The
/// points of the look are those that vtkMeshFileReader reads from the file, or vtkAssetReader if
/// vtkMeshFileReader does not read the format. The helper bindpose-reader decodes the pictures,
/// because they may be damaged. Pictures that cannot be read are left out, with a warning. The
/// result is plain if the file has only a shape; see SurfaceLook::is_plain().
BINDPOSEFILTERS_EXPORT Status read_look_file(
  ExecutionContext& context, const std::string& path, FileLook& look);

} // namespace bindpose

#endif

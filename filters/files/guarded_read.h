#ifndef guarded_read_h
#define guarded_read_h

#include "BindposeFiltersModule.h" // for export macro
#include "base/execution.h"

#include "vtkSmartPointer.h"

#include <array>
#include <string>

class vtkDataSet;

namespace bindpose
{

/// Read a .vtp, .vtu, .vti or .vtk file, or a picture. VTK's readers crash, hang or take all memory
/// on some damaged files. Therefore the helper executable bindpose-reader reads the file. The time
/// and memory limits of the helper grow linearly with the size of the file.
/// @return invalid_input, naming the file and the reason, if the file cannot be read; canceled if
/// the context was canceled; unavailable if the helper is not found
BINDPOSEFILTERS_EXPORT Status read_guarded(
  ExecutionContext& context, const std::string& path, vtkSmartPointer<vtkDataSet>& data);

/// Decode a picture in the same way.
/// @param name what is read, for messages
/// @param format extension of such files: png, jpg, bmp, tif or tga
Status read_guarded(ExecutionContext& context, const std::string& name, const std::string& bytes,
  const std::string& format, vtkSmartPointer<vtkDataSet>& data);

/// The header of an image file.
struct ImageHeader
{
  std::array<int, 6> extent{};
  std::array<double, 3> origin{};
  std::array<double, 3> spacing{ 1.0, 1.0, 1.0 };
};

/// Read the header of a .vti file without VTK's reader. Return false if it has no valid extent.
bool read_image_header(const std::string& path, ImageHeader& header);

/// Return the class of the dataset in a legacy .vtk file ("vtkPolyData"). Return an empty string if
/// the header of the file does not name a supported class.
std::string legacy_class(const std::string& path);

} // namespace bindpose

#endif

#ifndef document_opened_file_h
#define document_opened_file_h

#include "base/status.h"
#include "handles/handles.h"
#include "pose/pose.h"

#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <QByteArray>

#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

class vtkBindposeAlgorithm;
namespace bindpose
{
struct FileLook;
} // namespace bindpose

// Reading and writing of the files of a document. Nothing is printed to the terminal.

/// The contents of a file.
struct OpenedFile
{
  enum class Kind
  {
    mesh,
    handles, ///< vtkPolyData
    volume, ///< vtkImageData
    curves, ///< vtkPolyData
    picture, ///< vtkImageData with color scalars
    weights
  };
  Kind kind = Kind::mesh;
  vtkSmartPointer<vtkDataSet> data;
  vtkSmartPointer<vtkPolyData> handles; ///< handles of the mesh's skin in its file
  /// Materials, textures and vertex colors of the mesh; null: the file has only a shape.
  std::shared_ptr<const bindpose::FileLook> look;
  bindpose::Weights weights;
  std::vector<std::string> warnings; ///< warnings of the reader, mostly about data that is lost
  /// SHA-256 of the file in hex; empty if the file has disappeared.
  std::shared_future<QByteArray> checksum;
};
/// A function that updates a reader and returns its status.
using RunReader = std::function<bindpose::Status(vtkBindposeAlgorithm*)>;
/// Read a file.
/// @param run  function that updates a reader, for callers that show progress or can be
/// interrupted; not used for images and weights
bindpose::Status read_file(
  const std::string& path, OpenedFile& file, const RunReader& run = nullptr);

/// Read the materials, textures and vertex colors of a mesh file. Return null if the file has none,
/// or if they do not belong to the points of `mesh`. Append one warning for each part that cannot
/// be read.
std::shared_ptr<const bindpose::FileLook> read_look(
  const std::string& path, vtkDataSet* mesh, std::vector<std::string>& warnings);

/// Make a textured shape from an image: triangles with texture coordinates (vtkPlanarShape). The
/// image's alpha determines the shape. If the image is opaque or `is_whole_image` is true, the
/// shape is the whole rectangle.
bindpose::Status make_shape(vtkImageData* picture, bool is_whole_image,
  vtkSmartPointer<vtkPolyData>& shape, bool& is_cut_out);

/// Write the shape. An existing file is replaced, because the file dialog has asked for
/// confirmation.
bindpose::Status write_shape(vtkPolyData* shape, const std::string& path);
/// Write a pose file of one pose or of a sequence. An existing file is replaced. The warnings name
/// data that a pose file cannot represent.
bindpose::Status write_poses(const std::vector<bindpose::Pose>& poses,
  const bindpose::Handles& handles, const std::string& path, double frames_per_second = 24.0);

#endif

#ifndef document_opened_file_h
#define document_opened_file_h

#include "base/status.h"
#include "pose/pose.h"
#include "weights/handles.h"

#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <QByteArray>

#include <functional>
#include <future>
#include <string>
#include <vector>

class vtkBindposeAlgorithm;

// Files that a document reads and writes. Nothing is printed to the terminal.

/// The contents of a file.
struct OpenedFile
{
  enum class Kind
  {
    mesh,
    handles, ///< vtkPolyData
    volume, ///< vtkImageData
    curves, ///< vtkPolyData
    picture, ///< vtkImageData of colors
    weights
  };
  Kind kind = Kind::mesh;
  vtkSmartPointer<vtkDataSet> data;
  vtkSmartPointer<vtkPolyData> handles; ///< handles of the mesh's skin, from a glTF file
  bindpose::Weights weights;
  std::vector<std::string> warnings; ///< warnings of the reader, mostly about data that is lost
  /// SHA-256 of the file in hex; empty if the file has disappeared.
  std::shared_future<QByteArray> checksum;
};
/// A function that updates a reader and returns its status.
using RunReader = std::function<bindpose::Status(vtkBindposeAlgorithm*)>;
/// Read a file.
/// @param run  updates the reader, for callers that show progress or can be interrupted; pictures
/// and weights do not use it
bindpose::Status read_file(
  const std::string& path, OpenedFile& file, const RunReader& run = nullptr);

/// Make a textured shape from a picture: triangles with texture coordinates (vtkPlanarShape). It is
/// cut out by the picture's alpha. It is the whole rectangle if the picture is opaque or `whole` is
/// true.
bindpose::Status make_shape(
  vtkImageData* picture, bool whole, vtkSmartPointer<vtkPolyData>& shape, bool& cut_out);

/// Write the shape. An existing file is replaced, because the dialog has already asked.
bindpose::Status write_shape(vtkPolyData* shape, const std::string& path);
/// Write a pose file of one pose or of a sequence, in place of an existing file. The warnings name
/// data that a pose file cannot represent.
bindpose::Status write_poses(const std::vector<bindpose::Pose>& poses,
  const bindpose::Handles& handles, const std::string& path, double frames_per_second = 24.0);

#endif

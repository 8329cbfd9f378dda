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

// What a document is made of and gives out. Nothing goes to the terminal.

/// What a file holds, by its contents.
struct OpenedFile
{
  enum class Kind
  {
    mesh,
    handles, ///< vtkPolyData
    volume, ///< vtkImageData
    curves, ///< vtkPolyData
    picture, ///< vtkImageData of colours
    weights
  };
  Kind kind = Kind::mesh;
  vtkSmartPointer<vtkDataSet> data;
  vtkSmartPointer<vtkPolyData> handles; ///< of a mesh: those of its skin, in glTF files
  bindpose::Weights weights;
  std::vector<std::string> warnings; ///< of the reader: what the file loses, mostly
  std::shared_future<QByteArray> checksum; ///< SHA-256 of the file in hex; empty: it went away
};
/// Brings a reader up to date; not ok: why it could not.
using RunReader = std::function<bindpose::Status(vtkBindposeAlgorithm*)>;
/// With `run` for those who show progress or can be interrupted; pictures and weights need none.
bindpose::Status read_file(
  const std::string& path, OpenedFile& file, const RunReader& run = nullptr);

/// What a picture shows, as triangles with texture coordinates (vtkPlanarShape): cut out by its
/// alpha, or the whole rectangle where it is opaque or where that is asked for.
bindpose::Status make_shape(
  vtkImageData* picture, bool whole, vtkSmartPointer<vtkPolyData>& shape, bool& cut_out);

/// These replace the file that is there: the dialog has asked.
bindpose::Status write_shape(vtkPolyData* shape, const std::string& path);
/// A pose file of one pose or of a sequence; its warnings name what such a file cannot hold.
bindpose::Status write_poses(const std::vector<bindpose::Pose>& poses,
  const bindpose::Handles& handles, const std::string& path, double frames_per_second = 24.0);

#endif

#ifndef document_opened_file_h
#define document_opened_file_h

#include "base/status.h"
#include "pose/pose.h"
#include "weights/handles.h"

#include "vtkDataSet.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <string>

// What a document is made of and gives out. Nothing goes to the terminal.

/// What a file holds, by its contents.
struct OpenedFile
{
  enum class Kind
  {
    mesh,
    handles, ///< vtkPolyData
    volume, ///< vtkImageData
    curves ///< vtkPolyData
  };
  Kind kind = Kind::mesh;
  vtkSmartPointer<vtkDataSet> data;
  vtkSmartPointer<vtkPolyData> handles; ///< of a mesh: those of its skin, in glTF files
};
bindpose::Status read_file(const std::string& path, OpenedFile& file);

/// These replace the file that is there: the dialog has asked.
bindpose::Status write_shape(vtkPolyData* shape, const std::string& path);
bindpose::Status write_pose(
  const bindpose::Pose& pose, const bindpose::Handles& handles, const std::string& path);

#endif

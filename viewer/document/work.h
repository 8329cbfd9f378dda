#ifndef document_work_h
#define document_work_h

#include "document/options.h"
#include "pose/pose.h"
#include "posing/pose_shelf.h"

#include "vtkImageData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <QByteArray>
#include <QString>

#include <map>
#include <memory>
#include <string>
#include <vector>

/// Where something was read from. Without a path it was made in the program.
struct Source
{
  QString path; ///< absolute
  QByteArray checksum; ///< SHA-256 of the file as it was read, in hex
};

/// Everything that a person has opened and made, as a value: copying it is cheap, because datasets
/// are shared. Whoever holds a Work may not change a dataset in it; another state of the work has
/// another object.
struct Work
{
  QString name; ///< of the mesh, for the title
  vtkSmartPointer<vtkPolyData> surface; ///< at rest, with the array Weights or not
  bool made_here = true; ///< the surface or its weights are not those of the mesh's file
  vtkSmartPointer<vtkUnstructuredGrid> mesh_tets; ///< of which the surface is the skin; or null
  vtkSmartPointer<vtkUnstructuredGrid> weighted_tets; ///< what the weights were solved on; or null
  vtkSmartPointer<vtkPolyData> handles; ///< at rest; what its pose arrays say does not count
  /// The handles that the columns of the weights belong to; null as long as nothing was bound.
  vtkSmartPointer<vtkPolyData> bound_handles;
  bindpose::Pose pose; ///< an entry a handle
  std::shared_ptr<const bindpose::PoseShelf> key_poses;
  vtkSmartPointer<vtkImageData> picture; ///< that the surface was cut out of; or null
  vtkSmartPointer<vtkImageData> volume;
  QString volume_name;
  vtkSmartPointer<vtkPolyData> curves;
  Options options;
  Source mesh_source, handle_source, picture_source, volume_source, curve_source;
};

/// What two states of the work differ in.
enum WorkPart : int
{
  mesh_part = 1, ///< another surface
  weights_part = 2, ///< other weights of the surface, or none any more
  handles_part = 4, ///< handles at rest: any but their pose
  pose_part = 8,
  key_poses_part = 16,
  options_part = 32,
  volume_part = 64,
  curves_part = 128,
  sources_part = 256,
  handle_looks_part = 512 ///< of the handles at rest layers, colours and locks alone: bends nothing
};
int differences(const Work& a, const Work& b);

/// Makes of `work` what an edit from `before` to `after` changes and leaves the rest as it is.
void apply_edit(const Work& before, const Work& after, Work& work);

/// Whether two surfaces are one, but for their weights.
bool same_mesh(vtkPolyData* a, vtkPolyData* b);

/// To the last bit.
bool same_pose(const bindpose::Pose& a, const bindpose::Pose& b);

#endif

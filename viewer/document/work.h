#ifndef document_work_h
#define document_work_h

#include "document/options.h"
#include "pose/pose.h"
#include "poses/stored_poses.h"

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

namespace bindpose
{
struct FileLook;
} // namespace bindpose

/// The file from which data was read. The path is empty if the data was made in the program.
struct Source
{
  QString path; ///< absolute
  QByteArray checksum; ///< SHA-256 of the file in hex, when it was read
};

/// Everything that the user has opened and created, as a value. Copies are cheap, because datasets
/// are shared. Datasets in a Work must not be changed; another state of the work has new dataset
/// objects.
struct Work
{
  QString name; ///< name of the mesh, for the window title
  vtkSmartPointer<vtkPolyData> surface; ///< surface at rest; the array Weights is optional
  /// Materials, textures and vertex colors of the surface; null: it has none.
  std::shared_ptr<const bindpose::FileLook> look;
  bool differs_from_file = true; ///< true if the surface or its weights differ from the mesh's file
  /// The tets whose boundary is the surface; or null.
  vtkSmartPointer<vtkUnstructuredGrid> mesh_tets;
  /// The tets on which the weights were solved; or null.
  vtkSmartPointer<vtkUnstructuredGrid> weighted_tets;
  vtkSmartPointer<vtkPolyData> handles; ///< handles at rest; their pose arrays are not used
  /// The handles for which the weights were computed, one per column; null before a bind.
  vtkSmartPointer<vtkPolyData> bound_handles;
  bindpose::Pose pose; ///< current pose, one entry per handle
  std::shared_ptr<const bindpose::StoredPoses> stored_poses;
  /// The image from which the surface was cut out; or null.
  vtkSmartPointer<vtkImageData> picture;
  vtkSmartPointer<vtkImageData> volume;
  QString volume_name;
  vtkSmartPointer<vtkPolyData> curves;
  Options options;
  Source mesh_source, handle_source, picture_source, volume_source, curve_source;
};

/// Parts of the work, as flags. They state which parts differ between two states.
enum WorkPart : int
{
  mesh_part = 1, ///< the surface (apart from its weights), its tets, picture, look and name
  /// The weights of the surface, the tets on which they were solved, and the bound handles.
  weights_part = 2,
  handles_part = 4, ///< the handles at rest
  pose_part = 8,
  stored_poses_part = 16,
  options_part = 32,
  volume_part = 64,
  curves_part = 128,
  sources_part = 256,
  /// The layers, colors, locks or pose arrays of the handles, if everything else in the handle
  /// datasets is equal (otherwise handles_part). These arrays do not affect the shape.
  handle_looks_part = 512
};
int differences(const Work& a, const Work& b);

/// Apply the changes from `before` to `after` to `work`; all other parts of `work` are kept.
void apply_edit(const Work& before, const Work& after, Work& work);

/// Report whether two surfaces are the same apart from their weights.
bool same_mesh(vtkPolyData* a, vtkPolyData* b);

/// Report whether two poses are equal, bit for bit.
bool same_pose(const bindpose::Pose& a, const bindpose::Pose& b);

#endif

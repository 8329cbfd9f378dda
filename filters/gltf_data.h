#ifndef gltf_data_h
#define gltf_data_h

#include "conversion.h"
#include "io/gltf_skin.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace bindpose
{

/// The joint that stands for a handle: its origin is the pivot, its y axis runs along a bone.
Eigen::Affine3d joint_frame(const Handle& handle);

Eigen::Affine3d to_affine(const Affine& transform);

/// A joint a handle, in the order of the handles, posed as the transforms say, with notes of what
/// glTF does not say of handles.
std::vector<GltfJoint> to_joints(const Handles& handles, const std::vector<Affine>& transforms);

/// What a glTF file holds.
struct GltfData
{
  vtkSmartPointer<vtkPolyData> mesh; ///< with `Weights`, when there is a skin
  vtkSmartPointer<vtkPolyData> handles; ///< without a cell, when there is none
  Handles handle_list;
  std::vector<Pose> poses; ///< the frames of its animation
  double frames_per_second = 24.0;
};

/// Reads a file; see vtkGLTFSkinReader.
Status read_gltf(const std::string& path, GltfData& data);

/// A file for a filter that is asked for frame by frame: read anew when the filter was modified or
/// the file has changed.
class GltfFile
{
public:
  Status read(const std::string& path, vtkMTimeType modified);
  /// What the last read() found; nobody may change it.
  const GltfData& data() const { return this->data_; }

private:
  std::string path_; ///< empty: nothing was read
  vtkMTimeType modified_ = 0;
  std::filesystem::file_time_type written_;
  std::uintmax_t size_ = 0;
  Status status_;
  GltfData data_;
};

} // namespace bindpose

#endif

#ifndef gltf_data_h
#define gltf_data_h

#include "conversion.h"
#include "gltf/gltf_skin.h"

#include <string>

namespace bindpose
{

/// Return the coordinate frame of the joint that represents a handle. The origin of the frame is
/// the handle's pivot. For a bone, the y axis of the frame points along the bone.
Eigen::Affine3d joint_frame(const Handle& handle);

Eigen::Affine3d to_affine(const Affine& transform);

/// Return one joint per handle, in the order of the handles. The posed frame of a joint is its rest
/// frame, moved by the handle's transform. The member `handle_extras` of a joint stores the
/// properties of the handle that glTF cannot express.
std::vector<GltfJoint> to_joints(const Handles& handles, const std::vector<Affine>& transforms);

/// The handles of the joints of a skin.
class JointHandles
{
public:
  /// Make one handle per joint. Return invalid_input if the handles cannot be used.
  /// @param points of the meshes, for tolerances
  /// @param largest_weights largest weight of each joint
  Status make(const Points& points, const std::vector<GltfJoint>& joints,
    const Eigen::RowVectorXd& largest_weights);

  /// The handles. Bones are last, as in handle datasets.
  const Handles& handles() const { return this->handles_; }
  /// The joint of each handle.
  const std::vector<Index>& order() const { return this->order_; }
  /// Return the pose of the handles.
  /// @param posed joint-to-scene transforms like GltfJoint::posed, one per joint
  Pose pose(const std::vector<Eigen::Affine3d>& posed) const;
  /// Return the handles as a dataset, with the pose of the joints' nodes.
  vtkSmartPointer<vtkPolyData> posed_handles() const;

private:
  Handles handles_;
  std::vector<Index> order_;
  std::vector<Eigen::Affine3d> rest_; ///< rest frames of the handles' joints
  std::vector<Eigen::Affine3d> posed_; ///< transforms of the joints' nodes
  double extent_ = 1.0; ///< diagonal of the box of points and joints
};

/// Contents of a glTF file.
struct GltfData
{
  vtkSmartPointer<vtkPolyData> mesh; ///< the mesh; with the array `Weights` if there is a skin
  vtkSmartPointer<vtkPolyData> handles; ///< the joints as handles; no cells if there is no skin
  Handles handle_list;
  std::vector<Pose> poses; ///< the frames of the animation, one pose per frame
  double frames_per_second = 24.0;
  std::vector<std::string> buffer_files; ///< other files from which buffers were read
};

/// Read a file; see vtkGLTFSkinReader.
Status read_gltf(ExecutionContext& context, const std::string& path, GltfData& data);

} // namespace bindpose

#endif

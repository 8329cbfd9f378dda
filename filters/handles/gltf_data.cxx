// Conversion between handles and glTF joints. A glTF joint has a frame and a parent, but no tail
// and no handle type. Bindpose writes these properties of a handle into the extras of its joint
// (`joint.handle_extras`). Files of other programs lack these extras. The tail of a bone is then
// the mean position of the joint's children.
#include "gltf_data.h"

#include "pose/transform_parts.h"
#include "weights_arrays.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <numeric>

namespace bindpose
{

Eigen::Affine3d joint_frame(const Handle& handle)
{
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  frame.translation() = handle.head;
  if (handle.kind == HandleKind::bone)
  {
    // Align the y axis with the bone, because Blender draws bones along y.
    frame.linear() = minimal_rotation(Vec3::UnitY(), handle.tail - handle.head).toRotationMatrix();
  }
  return frame;
}

Eigen::Affine3d to_affine(const Affine& transform)
{
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  map.matrix().topRows<3>() = transform;
  return map;
}

std::vector<GltfJoint> to_joints(const Handles& handles, const std::vector<Affine>& transforms)
{
  std::vector<GltfJoint> joints;
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    const Handle& handle = handles[h];
    GltfJoint joint;
    joint.name = handle.name;
    joint.parent = handle.parent;
    joint.rest = joint_frame(handle);
    joint.posed = to_affine(transforms[h]) * joint.rest;
    joint.handle_extras = GltfHandleExtras{ to_string(handle.kind), handle.head, handle.tail,
      handle.region_id, handle.cage };
    joints.push_back(joint);
  }
  return joints;
}

namespace
{
constexpr double float_error = 2e-6; // relative error of lengths that were stored as floats

bool kind_of(const std::string& word, HandleKind& kind)
{
  for (const HandleKind candidate :
    { HandleKind::point, HandleKind::bone, HandleKind::cage_vertex, HandleKind::region })
  {
    if (word == to_string(candidate))
    {
      kind = candidate;
      return true;
    }
  }
  return false;
}

/// Creates a handle for each joint. If the joint has extras that agree with its inverse bind
/// matrix, the extras contain the properties of the handle. Otherwise the joint becomes a bone that
/// ends at the mean position of the joint's children, or a point if the joint has no children. Two
/// handles cannot be at the same position. Therefore a joint whose handle would equal an earlier
/// handle becomes a short bone along the joint's y axis.
class HandleMaker
{
public:
  HandleMaker(
    const std::vector<GltfJoint>& joints, const Eigen::RowVectorXd& largest_weights, double extent)
    : joints_(joints), largest_weights_(largest_weights), extent_(extent)
  {
    this->children_.resize(joints.size());
    for (std::size_t j = 0; j < joints.size(); ++j)
    {
      if (joints[j].parent >= 0)
      {
        this->children_[joints[j].parent].push_back(static_cast<Index>(j));
      }
    }
  }

  /// Return one handle per joint, in the order of the joints.
  Handles make()
  {
    Handles handles;
    for (std::size_t j = 0; j < this->joints_.size(); ++j)
    {
      Handle handle = this->handle_of(j);
      handle.name = this->joints_[j].name;
      handle.parent = this->joints_[j].parent;
      handle.ownership = this->has_no_influence(j) ? Ownership::none : Ownership::optional;
      for (int k = 1; this->is_duplicate(handles, handle); ++k)
      {
        // The length is such that it changes the coordinates.
        const double length = 0.01 * k * std::max(this->extent_, 1e-6 * handle.head.norm());
        const Vec3 bone_direction = this->joints_[j].rest.linear().col(1).stableNormalized();
        handle.kind = HandleKind::bone;
        handle.tail = handle.head +
          length * (bone_direction.squaredNorm() > 0.5 ? bone_direction : Vec3(Vec3::UnitY()));
      }
      handles.push_back(handle);
    }
    return handles;
  }

private:
  /// Report whether the joint is a control bone, i.e. it has no weights although other joints have.
  /// If one joint has all weights of a skin, the weights are a placeholder and the result is false.
  bool has_no_influence(std::size_t j) const
  {
    return (this->largest_weights_.array() > 0.0).count() > 1 &&
      !(this->largest_weights_[static_cast<Index>(j)] > 0.0);
  }

  Handle handle_of(std::size_t j) const
  {
    const GltfJoint& joint = this->joints_[j];
    Handle handle;
    handle.head = handle.tail = joint.rest.translation();
    if (joint.handle_extras && kind_of(joint.handle_extras->kind, handle.kind))
    {
      Handle noted = handle;
      noted.head = joint.handle_extras->head;
      noted.tail = noted.kind == HandleKind::bone ? joint.handle_extras->tail : noted.head;
      noted.region_id = joint.handle_extras->region;
      noted.cage = joint.handle_extras->cage;
      const bool usable = noted.kind != HandleKind::bone || noted.head != noted.tail;
      const double size = this->extent_ + joint.rest.translation().norm();
      if (usable &&
        (joint_frame(noted).matrix() - joint.rest.matrix()).cwiseAbs().maxCoeff() <=
          float_error * std::max(size, 1.0))
      {
        return noted;
      }
    }
    handle.kind = HandleKind::point;
    Vec3 middle = Vec3::Zero();
    for (const Index child : this->children_[j])
    {
      middle +=
        this->joints_[child].rest.translation() / static_cast<double>(this->children_[j].size());
    }
    if (!this->children_[j].empty() && (middle - handle.head).norm() > 1e-6 * this->extent_)
    {
      handle.kind = HandleKind::bone;
      handle.tail = middle;
    }
    return handle;
  }

  bool is_duplicate(const Handles& others, const Handle& handle) const
  {
    const double coincidence_tolerance = 1e-8 * this->extent_;
    return handle.kind != HandleKind::region &&
      std::any_of(others.begin(), others.end(),
        [&](const Handle& other)
        {
          return other.kind == handle.kind &&
            (((other.head - handle.head).norm() <= coincidence_tolerance &&
               (other.tail - handle.tail).norm() <= coincidence_tolerance) ||
              ((other.head - handle.tail).norm() <= coincidence_tolerance &&
                (other.tail - handle.head).norm() <= coincidence_tolerance));
        });
  }

  const std::vector<GltfJoint>& joints_;
  const Eigen::RowVectorXd& largest_weights_; ///< largest weight of each joint
  double extent_;
  std::vector<std::vector<Index>> children_;
};

/// Sort handles so that bones are last, as in handle datasets. order[i] is the joint of handle i.
void sort_handles(Handles& handles, std::vector<Index>& order)
{
  std::vector<Index> new_index(handles.size());
  for (const bool bones : { false, true })
  {
    for (std::size_t j = 0; j < handles.size(); ++j)
    {
      if ((handles[j].kind == HandleKind::bone) == bones)
      {
        new_index[j] = static_cast<Index>(order.size());
        order.push_back(static_cast<Index>(j));
      }
    }
  }
  Handles sorted;
  for (const Index j : order)
  {
    Handle handle = handles[j];
    handle.parent = handle.parent < 0 ? -1 : new_index[handle.parent];
    for (CageElement& element : handle.cage)
    {
      for (Index& corner : element)
      {
        corner = corner < 0 ? -1 : new_index[corner];
      }
    }
    sorted.push_back(handle);
  }
  handles = std::move(sorted);
}

/// Return the transform from rest to posed. A transform that differs from the identity only by
/// float round-off is replaced by the identity.
Affine transform_of(const Eigen::Affine3d& posed, const Eigen::Affine3d& rest, double extent)
{
  const Eigen::Affine3d map = posed * rest.inverse();
  const double size = extent + rest.translation().norm();
  const Vec3 pivot = rest.translation();
  const bool is_at_rest =
    (map.linear() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < float_error &&
    (map * pivot - pivot).norm() < float_error * size;
  return is_at_rest ? identity_affine() : Affine(map.matrix().topRows<3>());
}

void add_attributes(const GltfSkin& skin, vtkPolyData* mesh)
{
  if (skin.normals.rows() > 0)
  {
    vtkNew<vtkDoubleArray> normals;
    normals->SetName("Normals");
    normals->SetNumberOfComponents(3);
    normals->SetNumberOfTuples(skin.normals.rows());
    std::copy(
      skin.normals.data(), skin.normals.data() + skin.normals.size(), normals->GetPointer(0));
    mesh->GetPointData()->SetNormals(normals);
  }
  if (skin.texture.rows() > 0)
  {
    vtkNew<vtkDoubleArray> texture;
    texture->SetName("TCoords");
    texture->SetNumberOfComponents(2);
    texture->SetNumberOfTuples(skin.texture.rows());
    std::copy(
      skin.texture.data(), skin.texture.data() + skin.texture.size(), texture->GetPointer(0));
    mesh->GetPointData()->SetTCoords(texture);
  }
  if (skin.colors.rows() > 0)
  {
    vtkNew<vtkUnsignedCharArray> colors;
    colors->SetName("Colors");
    colors->SetNumberOfComponents(4);
    colors->SetNumberOfTuples(skin.colors.rows());
    std::copy(skin.colors.data(), skin.colors.data() + skin.colors.size(), colors->GetPointer(0));
    mesh->GetPointData()->SetScalars(colors);
  }
}
} // namespace

Status JointHandles::make(const Points& points, const std::vector<GltfJoint>& joints,
  const Eigen::RowVectorXd& largest_weights)
{
  Box box = bounding_box(points);
  for (const GltfJoint& joint : joints)
  {
    box.add(joint.rest.translation());
  }
  this->extent_ = box.diagonal() > 0.0 ? box.diagonal() : 1.0;
  this->handles_ = HandleMaker(joints, largest_weights, this->extent_).make();
  this->order_.clear();
  sort_handles(this->handles_, this->order_);
  this->rest_.clear();
  this->posed_.clear();
  for (std::size_t h = 0; h < this->handles_.size(); ++h)
  {
    // If the handle's frame equals the joint's frame up to float round-off, use the handle's frame.
    // It is more accurate if the handle was read from the joint's extras, which store all digits.
    const GltfJoint& joint = joints[this->order_[h]];
    const Eigen::Affine3d frame = joint_frame(this->handles_[h]);
    const double size = std::max(this->extent_ + joint.rest.translation().norm(), 1.0);
    const bool is_joint_frame =
      (frame.matrix() - joint.rest.matrix()).cwiseAbs().maxCoeff() <= float_error * size;
    this->rest_.push_back(is_joint_frame ? frame : joint.rest);
  }
  for (const GltfJoint& joint : joints)
  {
    this->posed_.push_back(joint.posed);
  }
  return check_handles(this->handles_);
}

Pose JointHandles::pose(const std::vector<Eigen::Affine3d>& posed) const
{
  Pose pose(this->rest_.size());
  for (std::size_t h = 0; h < pose.size(); ++h)
  {
    pose[h].transform = transform_of(posed[this->order_[h]], this->rest_[h], this->extent_);
  }
  return pose;
}

vtkSmartPointer<vtkPolyData> JointHandles::posed_handles() const
{
  auto data = to_polydata(this->handles_);
  std::vector<Index> cells(this->handles_.size());
  std::iota(cells.begin(), cells.end(), Index(0));
  set_pose(data, cells, this->pose(this->posed_));
  return data;
}

Status read_gltf(ExecutionContext& context, const std::string& path, GltfData& data)
{
  data = GltfData();
  GltfSkin skin;
  Status status = read_gltf_skin(context, path, skin);
  if (!status.ok())
  {
    return status;
  }
  data.mesh = to_polydata(PointsView(skin.points), TrianglesView(skin.triangles));
  add_attributes(skin, data.mesh);
  data.frames_per_second = skin.frames_per_second;
  data.buffer_files = skin.buffer_files;
  data.handles = vtkSmartPointer<vtkPolyData>::New();
  if (skin.joints.empty())
  {
    return status;
  }
  JointHandles joints;
  const Status usable = joints.make(skin.points, skin.joints, skin.weights.colwise().maxCoeff());
  if (!usable.ok())
  {
    return Status::invalid_input(path + ": " + usable.message);
  }
  data.handle_list = joints.handles();
  data.handles = joints.posed_handles();
  Weights weights(skin.weights.rows(), skin.weights.cols());
  for (std::size_t h = 0; h < joints.order().size(); ++h)
  {
    weights.col(static_cast<Index>(h)) = skin.weights.col(joints.order()[h]);
  }
  data.mesh->GetPointData()->AddArray(to_weights_array("Weights", weights, joints.handles()));
  for (const GltfFrame& frame : skin.frames)
  {
    data.poses.push_back(joints.pose(frame.posed));
  }
  return status;
}

} // namespace bindpose

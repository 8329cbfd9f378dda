// Connects the kernels of gltf/gltf_skin.h and gltf_edit/gltf_asset.h to VTK. They write the file.
// This filter converts the mesh to triangles, the handles to joints, and the frames to positions of
// points and joints.
#include "vtkGLTFSkinWriter.h"

#include "asset_file.h"
#include "base/execution.h"
#include "file_kind.h"
#include "gltf_edit/gltf_asset.h"
#include "gltf_data.h"
#include "io/atomic_file.h"
#include "io/text_scanner.h"
#include "motion_data.h"
#include "pose/pose_file.h"
#include "skinning/skinning.h"
#include "weights_input.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

using namespace bindpose;

vtkStandardNewMacro(vtkGLTFSkinWriter);

namespace
{
/// The part of the mesh that is written: its surface.
struct Surface
{
  Triangles triangles; ///< corners of the triangles, as indices into `points`
  std::vector<Index> points; ///< the written points, as ids of points of the mesh

  Points select_rows(PointsView all) const
  {
    Points rows(static_cast<Index>(this->points.size()), 3);
    for (Index v = 0; v < rows.rows(); ++v)
    {
      rows.row(v) = all.row(this->points[v]);
    }
    return rows;
  }
};

/// Return the surface to write. For a surface, all points are kept, in order. For tets, only the
/// points on the boundary are kept.
Status to_written_surface(vtkDataSet* mesh, Surface& surface)
{
  Domain domain;
  std::vector<Index> cells;
  const Status status = to_domain(mesh, domain, cells);
  if (!status.ok())
  {
    return status;
  }
  const Index count = domain.points.rows();
  if (domain.tets.rows() == 0)
  {
    surface.triangles = domain.triangles;
    for (Index v = 0; v < count; ++v)
    {
      surface.points.push_back(v);
    }
    return status;
  }
  surface.triangles = boundary_triangles(domain.tets);
  std::vector<Index> new_index(static_cast<std::size_t>(count), -1);
  for (Index k = 0; k < surface.triangles.size(); ++k)
  {
    new_index[surface.triangles.data()[k]] = 0;
  }
  for (Index v = 0; v < count; ++v)
  {
    if (new_index[v] == 0)
    {
      new_index[v] = static_cast<Index>(surface.points.size());
      surface.points.push_back(v);
    }
  }
  for (Index k = 0; k < surface.triangles.size(); ++k)
  {
    surface.triangles.data()[k] = new_index[surface.triangles.data()[k]];
  }
  return status;
}

/// Read the components of an array at the written points, one row per point. Do not change `rows`
/// if the array is null or has fewer components than `rows` has columns.
template <typename Matrix>
void read_rows(vtkDataArray* array, const Surface& surface, Matrix& rows)
{
  if (!array || array->GetNumberOfComponents() < rows.cols())
  {
    return;
  }
  rows.resize(static_cast<Index>(surface.points.size()), rows.cols());
  for (Index v = 0; v < rows.rows(); ++v)
  {
    for (Index c = 0; c < rows.cols(); ++c)
    {
      rows(v, c) = array->GetComponent(surface.points[v], static_cast<int>(c));
    }
  }
}

Status read_colors(vtkPointData* data, const char* name, const Surface& surface, GltfSkin& skin)
{
  const bool has_name = name && name[0];
  auto* array =
    vtkUnsignedCharArray::SafeDownCast(has_name ? data->GetArray(name) : data->GetScalars());
  const int components = array ? array->GetNumberOfComponents() : 0;
  if (components != 3 && components != 4)
  {
    return has_name ? Status::invalid_input("the mesh has no point array '" + std::string(name) +
                        "' of unsigned chars with 3 or 4 components")
                    : Status();
  }
  skin.colors.setConstant(static_cast<Index>(surface.points.size()), 4, 255);
  for (Index v = 0; v < skin.colors.rows(); ++v)
  {
    for (int c = 0; c < components; ++c)
    {
      skin.colors(v, c) = array->GetTypedComponent(surface.points[v], c);
    }
  }
  return {};
}

/// Return the transforms that a pose filter stored with a posed mesh (field data
/// `HandleTransforms`).
Status read_transforms(vtkDataSet* frame, const Handles& handles, std::vector<Affine>& transforms)
{
  vtkDataArray* array = frame->GetFieldData()->GetArray("HandleTransforms");
  if (!array || array->GetNumberOfComponents() != 12 ||
    array->GetNumberOfTuples() != static_cast<vtkIdType>(handles.size()))
  {
    return Status::invalid_input("a frame has no field data array HandleTransforms for these "
                                 "handles; use morph targets for the animation");
  }
  transforms.resize(handles.size());
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    array->GetTuple(static_cast<vtkIdType>(h), transforms[h].data());
  }
  return {};
}

std::vector<Eigen::Affine3d> posed_joints(
  const Handles& handles, const std::vector<Affine>& transforms)
{
  std::vector<Eigen::Affine3d> posed;
  for (std::size_t h = 0; h < handles.size(); ++h)
  {
    posed.push_back(to_affine(transforms[h]) * joint_frame(handles[h]));
  }
  return posed;
}

void add_warnings(const Status& from, Status& to)
{
  to.warnings.insert(to.warnings.end(), from.warnings.begin(), from.warnings.end());
}

/// Convert weights, handles and pose to the kernel's weights, joints and posed joints.
Status read_skin(vtkPointSet* mesh, const std::string& array_name, vtkPolyData* handle_data,
  const Surface& surface, Handles& handles, Pose& pose, GltfSkin& skin)
{
  WeightsInput input;
  Status status = to_weights_input(mesh, array_name, handle_data, input);
  if (!status.ok())
  {
    return status;
  }
  handles = input.handles;
  status = to_pose(handle_data, handles, input.cells, pose);
  if (!status.ok())
  {
    return status;
  }
  std::vector<Affine> transforms;
  status = skinning_transforms(handles, pose, transforms);
  skin.joints = to_joints(handles, transforms);
  const WeightsView all = input.weights.view();
  skin.weights.resize(static_cast<Index>(surface.points.size()), all.cols());
  for (Index v = 0; v < skin.weights.rows(); ++v)
  {
    skin.weights.row(v) = all.row(surface.points[v]);
  }
  return status;
}

Status read_frames(vtkInformationVector* input, const Surface& surface, vtkIdType points,
  const Handles& handles, bool morph, GltfSkin& skin)
{
  for (int k = 0; k < input->GetNumberOfInformationObjects(); ++k)
  {
    auto* data = vtkPointSet::GetData(input, k);
    if (!data || data->GetNumberOfPoints() != points)
    {
      return Status::invalid_input("frame " + std::to_string(k) + " has " +
        std::to_string(data ? data->GetNumberOfPoints() : 0) + " points, but the mesh has " +
        std::to_string(points));
    }
    GltfFrame frame;
    frame.points = surface.select_rows(to_points(data).view());
    read_rows(data->GetPointData()->GetNormals(), surface, frame.normals);
    if (!morph && !handles.empty())
    {
      std::vector<Affine> transforms;
      const Status status = read_transforms(data, handles, transforms);
      if (!status.ok())
      {
        return status;
      }
      frame.posed = posed_joints(handles, transforms);
    }
    skin.frames.push_back(std::move(frame));
  }
  return {};
}

/// Read a sequence of poses from a pose file.
Status read_pose_file(const std::string& path, const Handles& handles, const Pose& base,
  std::vector<Pose>& poses, double& frames_per_second)
{
  std::string text;
  Status status = read_file(path, text);
  PoseSequence sequence;
  if (status.ok())
  {
    status = parse_pose_file(text, handles, sequence);
    status.message = status.ok() ? "" : path + ": " + status.message;
  }
  for (std::size_t k = 0; k < sequence.frames.size() && status.ok(); ++k)
  {
    poses.push_back(apply_edits(sequence.frames[k], handles, base));
  }
  frames_per_second = sequence.frames_per_second;
  return status;
}

/// Read a sequence of poses from a file with a motion.
Status read_motion_file(ExecutionContext& context, const std::string& path, const Handles& handles,
  const Pose& base, std::vector<Pose>& poses, double& frames_per_second)
{
  MotionFile file;
  HandleMotion motion;
  Status status = file.fit(context, path, handles, motion);
  if (status.ok() && !motion.sequence)
  {
    status = Status::invalid_input(path + " has no animation of joints");
  }
  for (int frame = 0; frame < motion.frames && status.ok(); ++frame)
  {
    poses.emplace_back();
    const Status posed = motion.pose(base, frame, poses.back());
    if (!posed.ok())
    {
      return posed;
    }
  }
  frames_per_second = motion.frames_per_second;
  return status;
}

Status read_poses(ExecutionContext& context, const std::string& path, const Handles& handles,
  const Pose& base, GltfSkin& skin)
{
  std::vector<Pose> poses;
  const bool is_motion = is_listed(file_extension(path), motion_extensions());
  Status status = is_motion
    ? read_motion_file(context, path, handles, base, poses, skin.frames_per_second)
    : read_pose_file(path, handles, base, poses, skin.frames_per_second);
  if (!status.ok())
  {
    return status;
  }
  // Warnings of the last frame. Usually all frames have the same warnings.
  std::vector<std::string> transform_warnings;
  std::string unused;
  for (const Pose& pose : poses)
  {
    std::vector<Affine> transforms;
    const Status transform_status = skinning_transforms(handles, pose, transforms);
    transform_warnings = transform_status.warnings;
    unused = unused.empty() ? unused_stretch(pose, StretchUse::tails) : unused;
    GltfFrame frame;
    frame.posed = posed_joints(handles, transforms);
    skin.frames.push_back(std::move(frame));
  }
  status.warnings.insert(
    status.warnings.end(), transform_warnings.begin(), transform_warnings.end());
  if (!unused.empty())
  {
    status.warnings.push_back(unused);
  }
  return status;
}

/// Return invalid_input if the points are not those of the asset.
Status check_asset_points(const std::string& path, const GltfAsset& asset, const Points& points)
{
  const std::string cause = asset.points().rows() != points.rows() ? "has " +
      std::to_string(points.rows()) + " points, not " + std::to_string(asset.points().rows())
                                                                   : "has other points";
  constexpr double tolerance = 1e-5; // in bounding-box diagonals; files store floats
  const double diagonal = bounding_box(asset.points(), asset.triangles()).diagonal();
  const bool matches = asset.points().rows() == points.rows() &&
    (asset.points() - points).cwiseAbs().maxCoeff() <= tolerance * diagonal;
  return matches ? Status()
                 : Status::invalid_input("the mesh does not belong to the asset " + path + ": it " +
                     cause + "; read the asset by vtkAssetReader");
}

/// Write a copy of the file `asset_path` whose meshes have the skin.
Status write_asset(ExecutionContext& context, const std::string& path,
  const std::string& asset_path, const GltfSkin& skin, const GltfOptions& options)
{
  GltfAsset asset;
  Status status = read_asset_file(context, asset_path, asset);
  const Status checked = status.ok() ? check_asset_points(asset_path, asset, skin.points) : status;
  if (!checked.ok())
  {
    return checked;
  }
  const auto add = [&status](const Status& next)
  {
    add_warnings(next, status);
    status.report.merge(next.report);
    status.code = next.code;
    status.message = next.message;
  };
  add(asset.set_skin(context, skin, options.influences));
  if (status.ok())
  {
    add(context.canceled() ? Status::canceled() : asset.write(path, options.binary));
  }
  return status;
}
} // namespace

vtkGLTFSkinWriter::vtkGLTFSkinWriter()
{
  this->SetNumberOfInputPorts(3);
  this->SetArrayName("Weights");
}

vtkGLTFSkinWriter::~vtkGLTFSkinWriter()
{
  this->SetFileName(nullptr);
  this->SetAssetFileName(nullptr);
  this->SetArrayName(nullptr);
  this->SetColorArrayName(nullptr);
  this->SetPoseFileName(nullptr);
}

int vtkGLTFSkinWriter::Write()
{
  this->Modified();
  this->UpdateWholeExtent();
  return this->GetStatus() <= NOT_CONVERGED ? 1 : 0;
}

int vtkGLTFSkinWriter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(INPUT_REQUIRED_DATA_TYPE(), port == 1 ? "vtkPolyData" : "vtkPointSet");
  info->Set(INPUT_IS_OPTIONAL(), port > 0);
  info->Set(INPUT_IS_REPEATABLE(), port == 2);
  // If composites were not accepted, the executive would call this writer once per block, each time
  // with the same file name.
  AcceptBlocks(info);
  return 1;
}

int vtkGLTFSkinWriter::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkPolyData");
  return 1;
}

Status vtkGLTFSkinWriter::Execute(
  ExecutionContext& context, vtkInformationVector** input, vtkInformationVector* output)
{
  const Phase phase(context, "write");
  const std::string path = this->FileName ? this->FileName : "";
  auto* mesh = vtkPointSet::GetData(input[0]);
  auto* handle_data = vtkPolyData::GetData(input[1]);
  Surface surface;
  Status status = check_extension(path, GetFileExtensions());
  if (status.ok())
  {
    status = to_written_surface(mesh, surface);
  }
  if (!status.ok())
  {
    return status;
  }
  const std::string asset_path = this->AssetFileName ? this->AssetFileName : "";
  GltfSkin skin;
  skin.points = surface.select_rows(to_points(mesh).view());
  skin.triangles = surface.triangles;
  if (asset_path.empty())
  {
    read_rows(mesh->GetPointData()->GetNormals(), surface, skin.normals);
    read_rows(mesh->GetPointData()->GetTCoords(), surface, skin.texture);
    status = read_colors(mesh->GetPointData(), this->ColorArrayName, surface, skin);
  }
  else if (!handle_data || this->Animation == MORPH)
  {
    return Status::invalid_input(!handle_data
        ? "a skin for an asset needs handles, but the input has none"
        : "morph targets cannot be added to an asset; store the frames as joints");
  }
  Handles handles;
  Pose pose;
  Status skin_status;
  if (status.ok() && handle_data)
  {
    skin_status = read_skin(
      mesh, this->ArrayName ? this->ArrayName : "", handle_data, surface, handles, pose, skin);
    status.code = skin_status.code;
    status.message = skin_status.message;
  }
  GltfOptions options;
  options.binary = file_extension(path) == "glb";
  options.influences = this->MaximumInfluences;
  options.animation = this->Animation == MORPH ? GltfAnimation::morph : GltfAnimation::joints;
  skin.frames_per_second = this->FramesPerSecond;
  if (status.ok() && input[2]->GetNumberOfInformationObjects() > 0)
  {
    const bool morph = this->Animation == MORPH;
    status = read_frames(input[2], surface, mesh->GetNumberOfPoints(), handles, morph, skin);
    for (GltfJoint& joint : skin.joints)
    {
      // The morph targets contain the motion already, so the joints are at rest.
      joint.posed = morph ? joint.rest : joint.posed;
    }
  }
  else if (status.ok() && this->PoseFileName && this->PoseFileName[0])
  {
    status = !handle_data
      ? Status::invalid_input("a pose sequence needs handles, but the input has none")
      : this->Animation == MORPH
      ? Status::invalid_input(
          "an animation with morph targets needs input frames instead of a pose file")
      : read_poses(context, this->PoseFileName, handles, pose, skin);
  }
  else if (const std::string unused = unused_stretch(pose, StretchUse::tails); !unused.empty())
  {
    status.warnings.push_back(unused);
  }
  if (!status.usable())
  {
    return status;
  }
  AtomicFile file;
  Status written = file.open(path, this->Overwrite);
  if (written.ok())
  {
    written = asset_path.empty()
      ? write_gltf_skin(context, file.temporary(), skin, options)
      : write_asset(context, file.temporary(), asset_path, skin, options);
    const std::size_t at = written.message.find(file.temporary());
    if (at != std::string::npos)
    {
      written.message.replace(at, file.temporary().size(), path);
    }
  }
  add_warnings(skin_status, written);
  add_warnings(status, written);
  written.report.merge(status.report);
  if (!written.ok())
  {
    return written;
  }
  const Status committed = context.canceled() ? Status::canceled() : file.commit();
  if (!committed.ok())
  {
    return committed;
  }
  vtkPolyData::GetData(output)->ShallowCopy(
    to_polydata(PointsView(skin.points), TrianglesView(skin.triangles)));
  return written;
}

void vtkGLTFSkinWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "AssetFileName: " << (this->AssetFileName ? this->AssetFileName : "(none)")
     << "\n";
  os << indent << "Overwrite: " << (this->Overwrite ? "on" : "off") << "\n";
  os << indent << "ArrayName: " << (this->ArrayName ? this->ArrayName : "(none)") << "\n";
  os << indent << "ColorArrayName: " << (this->ColorArrayName ? this->ColorArrayName : "(none)")
     << "\n";
  os << indent << "MaximumInfluences: " << this->MaximumInfluences << "\n";
  os << indent << "Animation: " << (this->Animation == MORPH ? "morph" : "joints") << "\n";
  os << indent << "PoseFileName: " << (this->PoseFileName ? this->PoseFileName : "(none)") << "\n";
  os << indent << "FramesPerSecond: " << this->FramesPerSecond << "\n";
}

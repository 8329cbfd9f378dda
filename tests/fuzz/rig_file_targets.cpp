#include "fuzz/rig_file_targets.h"

#include "gltf_edit/gltf_asset.h"
#include "gltf/gltf_file.h"
#include "gltf/gltf_motion.h"
#include "gltf/gltf_skin.h"
#include "gltf/gltf_skin_parts.h"
#include "io/dmat.h"
#include "io/expression.h"
#include "io/tgf.h"
#include "look/gltf_look.h"
#include "pose/pose_file.h"
#include "pose/retarget.h"

#include "fuzz/memory_file.h"
#include "fuzz/status_checks.h"
#include "support/handles.h"

#include <algorithm>
#include <cmath>

namespace bindpose::test
{

bool check_tgf(std::string_view input)
{
  Tgf graph;
  const Status status = parse_tgf(input, graph);
  const auto count = static_cast<Index>(graph.nodes.size());
  if (!status.ok())
  {
    expect_refused(status);
    EXPECT_TRUE(graph.nodes.empty() && graph.edges.empty());
    return false;
  }
  EXPECT_GT(count, 0);
  for (const Tgf::Node& node : graph.nodes)
  {
    EXPECT_TRUE(node.position.allFinite());
    EXPECT_EQ(node.text.find('\n'), std::string::npos);
  }
  for (const Tgf::Edge& edge : graph.edges)
  {
    EXPECT_TRUE(edge.from >= 0 && edge.from < count && edge.to >= 0 && edge.to < count);
    EXPECT_NE(edge.from, edge.to);
  }
  Tgf again;
  const Status reread = parse_tgf(format_tgf(graph), again);
  EXPECT_TRUE(reread.ok()) << reread.message;
  EXPECT_EQ(again.nodes.size(), graph.nodes.size());
  EXPECT_EQ(again.edges.size(), graph.edges.size());
  return true;
}

bool check_dmat(std::string_view input)
{
  const MemoryFile file(input);
  Weights matrix;
  const Status status = read_dmat(file.path(), matrix);
  // A matrix without entries may still have rows or columns, but not a huge number of them.
  EXPECT_LE(std::max(matrix.rows(), matrix.cols()), Index(1) << 20);
  EXPECT_LE(matrix.size(), static_cast<Index>(input.size()));
  if (!status.ok())
  {
    expect_refused(status);
    EXPECT_EQ(matrix.size(), 0);
  }
  return status.ok();
}

namespace
{
void expect_consistent_skin(const GltfSkin& skin)
{
  EXPECT_TRUE(check_mesh(skin.points, skin.triangles).ok());
  const auto joints = static_cast<Index>(skin.joints.size());
  EXPECT_EQ(skin.weights.cols(), joints);
  EXPECT_TRUE(skin.weights.allFinite());
  for (const GltfJoint& joint : skin.joints)
  {
    expect_sentence(joint.name);
    EXPECT_TRUE(joint.parent >= -1 && joint.parent < joints);
    EXPECT_TRUE(joint.rest.matrix().allFinite() && joint.posed.matrix().allFinite());
  }
  for (const GltfFrame& frame : skin.frames)
  {
    ASSERT_EQ(static_cast<Index>(frame.posed.size()), joints);
  }
  EXPECT_GT(skin.frames_per_second, 0.0);
}
} // namespace

namespace
{
/// Give the meshes of a file one joint. The result must be a file with the same vertices.
void check_asset(std::string_view input)
{
  GltfAsset asset;
  const Status status = asset.read_bytes("asset.glb", std::string(input));
  if (!status.ok())
  {
    expect_refused(status);
    return;
  }
  expect_valid_messages(status);
  GltfSkin skin;
  skin.joints.resize(1);
  skin.joints[0].name = "root";
  skin.weights = Weights::Ones(asset.points().rows(), 1);
  ExecutionContext context;
  const Status edited = asset.set_skin(context, skin, 4);
  if (!edited.ok())
  {
    expect_refused(edited);
    return;
  }
  std::string bytes;
  const Status written = asset.to_bytes(true, bytes);
  if (!written.ok())
  {
    expect_refused(written); // a text is not UTF-8
    return;
  }
  GltfAsset again;
  const Status read = again.read_bytes("again.glb", bytes);
  EXPECT_TRUE(read.ok()) << read.message;
  EXPECT_EQ(again.points().rows(), asset.points().rows());
}

/// Read the nodes as joints with a motion, and retarget the last frame to handles with their names.
void check_motion(std::string_view input)
{
  const MemoryFile file(input);
  ExecutionContext context;
  GltfMotion motion;
  const Status status = read_gltf_motion(context, file.path(), motion);
  if (!status.ok())
  {
    expect_refused(status);
    return;
  }
  expect_valid_messages(status);
  EXPECT_EQ(motion.animated.size(), motion.joints.size());
  Handles handles;
  std::vector<MotionJoint> joints;
  std::vector<Affine> rest, posed;
  for (std::size_t j = 0; j < motion.joints.size(); ++j)
  {
    const GltfJoint& joint = motion.joints[j];
    const Vec3 head = joint.rest.translation();
    EXPECT_TRUE(joint.rest.inverse().matrix().allFinite());
    joints.push_back({ joint.name, joint.parent, head });
    handles.push_back(bone_handle(joint.name, 0.5 * head, 0.5 * head + Vec3(0, 1, 0)));
    handles.back().parent = joint.parent;
    rest.push_back(identity_affine());
    posed.push_back(rest.back());
    if (!motion.frames.empty())
    {
      ASSERT_EQ(motion.frames.back().posed.size(), motion.joints.size());
      const Eigen::Affine3d map = motion.frames.back().posed[j] * joint.rest.inverse();
      posed.back() = map.matrix().topRows<3>();
    }
    if (!(posed.back().cwiseAbs().maxCoeff() < 1e50 && head.cwiseAbs().maxCoeff() < 1e50))
    {
      return; // products may exceed the range of double; the filter checks the result
    }
  }
  const Pose pose = Retarget(handles, joints).apply(Pose(handles.size()), posed, rest);
  for (const HandlePose& each : pose)
  {
    EXPECT_TRUE(each.transform.allFinite());
  }
}

/// Read the materials, textures and vertex colors.
void check_look(std::string_view input)
{
  SurfaceLook look;
  const Status status = read_gltf_bytes("input.gltf", std::string(input),
    [&](const GltfContent& content, Status& found)
    {
      const GltfAccessors accessors(content.model, content.bytes.size());
      const GltfSkinParts skin = find_skin_parts(content.model, accessors);
      look = read_gltf_look(content, skin.parts, skin.vertices, found.warnings);
    });
  if (!status.ok())
  {
    expect_refused(status);
    return;
  }
  expect_valid_messages(status);
  const auto count = static_cast<Index>(look.points.size());
  EXPECT_TRUE(std::all_of(look.points.begin(), look.points.end(),
    [&](Index point) { return point >= 0 && point < look.point_count; }));
  EXPECT_TRUE((look.triangles.array() >= 0).all() && (look.triangles.array() < count).all());
  EXPECT_TRUE(std::all_of(look.triangle_materials.begin(), look.triangle_materials.end(),
    [&](Index id) { return id >= -1 && id < static_cast<Index>(look.materials.size()); }));
  EXPECT_EQ(look.coordinates.rows(), count);
  EXPECT_TRUE(look.coordinates.allFinite() && look.colors.allFinite());
  EXPECT_TRUE(look.colors.rows() == 0 || look.colors.rows() == count);
}
} // namespace

bool check_gltf(std::string_view input)
{
  check_asset(input);
  check_motion(input);
  check_look(input);
  const MemoryFile file(input);
  ExecutionContext context;
  GltfSkin skin;
  const Status status = read_gltf_skin(context, file.path(), skin);
  if (!status.ok())
  {
    expect_refused(status);
    EXPECT_EQ(skin.points.rows() + static_cast<Index>(skin.joints.size()), 0);
    return false;
  }
  expect_valid_messages(status);
  expect_consistent_skin(skin);
  return true;
}

namespace
{
Handles three_handles()
{
  Handles handles{ point_handle("p", Vec3(1, 2, 3)),
    bone_handle("fore", Vec3(1, 0, 0), Vec3(2, 0, 0)),
    bone_handle("upper", Vec3(0, 0, 0), Vec3(1, 0, 0)) };
  handles[1].parent = 2;
  return handles;
}

/// Report whether the numbers in an edit of a handle are neither huge nor tiny. Otherwise products
/// may exceed the range of double.
bool is_moderate(const HandleEdit& edit)
{
  double largest = std::max({ std::abs(edit.scale.value_or(0)), edit.stretch.value_or(0),
    edit.twist.value_or(Eigen::Vector2d::Zero()).cwiseAbs().maxCoeff() });
  for (const auto& vector : { edit.translate, edit.head, edit.tail })
  {
    largest = std::max(largest, vector.value_or(Vec3::Zero()).cwiseAbs().maxCoeff());
  }
  return largest < 1e50 && edit.scale.value_or(1.0) > 1e-50;
}

/// Expect that poses can be written and read again.
void expect_written_again(
  const std::vector<Pose>& poses, double frames_per_second, const Handles& handles, bool moderate)
{
  std::string text;
  const Status formatted = format_pose_file(poses, frames_per_second, handles, text);
  expect_valid_messages(formatted);
  EXPECT_TRUE(formatted.ok() || !moderate);
  if (formatted.ok())
  {
    PoseSequence back;
    const Status reread = parse_pose_file(text, handles, back);
    ASSERT_TRUE(reread.ok()) << reread.message << "\n" << text;
    ASSERT_EQ(back.frames.size(), poses.size());
  }
}
} // namespace

bool check_pose_file(std::string_view input)
{
  const Handles handles = three_handles();
  const std::string text(input);
  PoseTimes times;
  const bool has_times = read_pose_times(text, times);
  PoseSequence sequence;
  const Status status = parse_pose_file(text, handles, sequence);
  if (!status.ok())
  {
    expect_refused(status);
    EXPECT_TRUE(sequence.frames.empty());
    return false;
  }
  EXPECT_TRUE(has_times);
  EXPECT_EQ(times.frames, static_cast<Index>(sequence.frames.size()));
  EXPECT_GT(sequence.frames_per_second, 0.0);
  EXPECT_FALSE(sequence.frames.empty());
  std::vector<Pose> poses;
  bool moderate = true;
  for (const PoseEdits& frame : sequence.frames)
  {
    for (const HandleEdit& edit : frame.handles)
    {
      EXPECT_TRUE(edit.handle >= 0 && edit.handle < 3);
      moderate = moderate && is_moderate(edit);
    }
    poses.push_back(apply_edits(frame, handles, Pose(3)));
    for (const HandlePose& handle : poses.back())
    {
      EXPECT_TRUE(!moderate || (handle.transform.allFinite() && handle.stretch > 0.0));
    }
  }
  expect_written_again(poses, sequence.frames_per_second, handles, moderate);
  return true;
}

namespace
{
std::string without_surrounding_blanks(const std::string& text)
{
  const std::size_t begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? std::string()
                                    : text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
}

/// Expect that a skeleton has the same names after it is written and read, except for blanks around
/// the names.
void expect_names_of_skeleton(const Handles& handles)
{
  Tgf graph;
  for (const Handle& handle : handles)
  {
    Tgf::Node node;
    node.position = handle.head;
    node.text = handle.name;
    graph.nodes.push_back(node);
  }
  Tgf back;
  const Status status = parse_tgf(format_tgf(graph), back);
  ASSERT_TRUE(status.ok()) << status.message;
  ASSERT_EQ(back.nodes.size(), handles.size());
  for (std::size_t k = 0; k < handles.size(); ++k)
  {
    EXPECT_EQ(back.nodes[k].text, without_surrounding_blanks(handles[k].name));
  }
}
} // namespace

bool check_expression(std::string_view input)
{
  ExpressionParser parser;
  double value = 0.0;
  const Status status = parser.evaluate(std::string(input), 0.5, value);
  if (!status.ok())
  {
    expect_refused(status);
  }
  return status.ok();
}

bool check_names(std::string_view input)
{
  Handles handles = three_handles();
  std::string_view rest = input;
  for (Handle& handle : handles)
  {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    handle.name = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  const Status checked = check_handles(handles);
  if (!checked.ok())
  {
    expect_refused(checked);
    return false;
  }
  std::string text;
  const Status formatted = format_pose_file({ Pose(3) }, 24.0, handles, text);
  EXPECT_TRUE(formatted.ok()) << formatted.message;
  PoseSequence back;
  const Status status = parse_pose_file(text, handles, back);
  EXPECT_TRUE(status.ok()) << status.message << "\n" << text;
  // Unknown names are refused with a message of one line.
  expect_valid_messages(parse_pose_file(text, three_handles(), back));
  expect_names_of_skeleton(handles);
  return true;
}

} // namespace bindpose::test

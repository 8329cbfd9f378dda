#ifndef bindpose_pose_pose_file_h
#define bindpose_pose_pose_file_h

#include "pose/pose.h"
#include "weights/handles.h"

#include <functional>
#include <optional>
#include <string>

namespace bindpose
{

/// The entries of a pose file for one handle. An entry that the file does not have is empty.
struct HandleEdit
{
  Index handle = 0; ///< index in the handle list
  std::optional<HandleMode> mode;
  std::optional<Vec3> translate;
  std::optional<Eigen::Matrix3d> rotation; ///< from "rotate": axis and degrees
  std::optional<double> scale;
  bool with_parent = true; ///< "space": "parent"; false: "world"
  std::optional<Vec3> head, tail; ///< bones: posed ends
  std::optional<double> stretch; ///< bones: posed length / rest length
  std::optional<Eigen::Vector2d> twist; ///< bones: degrees at head and tail
};

/// The edits of one pose in a pose file.
struct PoseEdits
{
  std::vector<HandleEdit> handles;
  /// False for version 1, in which handles do not follow their parents by default.
  bool children_follow = true;
};

/// A pose file as read. Each frame is applied to the base pose.
struct PoseSequence
{
  std::vector<PoseEdits> frames;
  double frames_per_second = 24.0;
  bool sequence = false; ///< whether the file has "frames", even if there is only one
  bool has_expressions = false; ///< whether a number of the file is given as an expression
};

/// Compute the value of an expression in t (seconds). Return invalid_input with one clause about
/// the error if the expression is not valid.
using PoseExpression = std::function<Status(const std::string& text, double t, double& value)>;

/// Read the text of a POSE.json: one pose
///
///     {"version": 2,
///      "handles": {NAME: {"mode": "full|position|free|tail|ends|auto", "translate": [x, y, z],
///                         "rotate": {"axis": [x, y, z], "degrees": d}, "scale": s,
///                         "space": "parent|world",
///                         "head": [x, y, z], "tail": [x, y, z], "stretch": s,
///                         "twist": [deg, deg]}}}
///
/// or a sequence {"version": 2, "frames": [pose, …], "fps": n}. All keys of a handle are optional.
/// The last four are for bones, and head or tail exclude translate, rotate and scale. apply_edits()
/// defines the meaning of a pose.
///
/// A text without "version" has version 1, in which a handle follows its parent only if it has
/// "space": "parent". A warning is returned if version 2 would pose a handle differently.
///
/// Any number in a handle's entry may be a string: an expression in t, for example "sin(2 * t)".
/// With `expression` the string is evaluated. For a single pose t is `time`; for a frame of a
/// sequence t is its number / fps. Without `expression` the string is an error.
///
/// The reader is strict. It returns invalid_input with one sentence that names the error for an
/// empty or malformed text, an unknown handle or key, a duplicate key, a wrong type, a number that
/// is not finite, a rotation axis of length zero, a scale, stretch or fps that is not positive, a
/// bone posed to length zero, an expression that cannot be read or has no finite value, and an
/// unknown version.
Status parse_pose_file(const std::string& text, const Handles& handles, PoseSequence& sequence,
  const PoseExpression& expression = {}, double time = 0.0);

/// The facts about a POSE.json that can be read without handles.
struct PoseTimes
{
  Index frames = 1;
  double frames_per_second = 24.0;
  bool has_expressions = false;
};

/// Return false if the text is not a pose file at all; parse_pose_file() reports the reason.
bool read_pose_times(const std::string& text, PoseTimes& times);

/// Return the pose that a frame describes.
///
/// Version 2: a handle with pivot c (point, bone head, cage vertex, region pivot) is transformed by
/// x -> c + translate + R * scale * (x - c), then by the transform that it inherits from its parent
/// (transform_for_child()), as in glTF. "space": "world" disables the inheritance. The transform
/// replaces that of the base pose. `head` and `tail` are world positions. An end that is not given
/// follows the parent, or is at rest if the space is "world". The bone is rotated by the minimal
/// arc between both directions, and its stretch is the ratio of the lengths unless `stretch` is
/// given. A handle without translate, rotate, scale, head and tail keeps its transform relative to
/// its parent in the base pose. So does a handle that the frame does not mention.
///
/// A handle without "mode" keeps its mode of the base pose. If this mode is automatic and the frame
/// gives more than a translation (rotate, scale, head, tail, stretch, twist), the handle gets mode
/// full. Methods that find rotations choose the constraints of handles that stay automatic
/// (with_found_rotations()).
///
/// Version 1: the default space is "world". With "parent", `head` and `tail` are applied at rest,
/// before the parent's transform. A handle that is not mentioned keeps its base transform.
///
/// `base` must have one entry per handle; `handles` must have passed check_handles().
Pose apply_edits(const PoseEdits& edits, const Handles& handles, const Pose& base);

/// Write poses as the text of a POSE.json of version 2: one pose, or a sequence of several. Reading
/// the text returns the same poses up to rounding, for any base pose.
///
/// Transforms are written relative to the parents, so that children follow if a number is edited.
/// "space": "world" is written for a handle whose relative transform is not a rotation and a
/// uniform scale. A shear, a non-uniform scale or a reflection cannot be written: the nearest
/// rotation and scale are written instead. One warning states the numbers of such handles and poses
/// and the first names. A transform is exempt if its difference from the nearest rotation and scale
/// is at most 1e-5 of the matrix (Frobenius norms): this is the roundoff of single-precision files.
///
/// invalid_input: a number that is not finite, a name that is not UTF-8.
Status format_pose_file(const std::vector<Pose>& poses, double frames_per_second,
  const Handles& handles, std::string& text);

/// Return the rotation by the smaller angle that takes one direction to another. Neither may have
/// length zero. For opposite directions it is half a turn about an axis that depends on `from`
/// only.
Eigen::Matrix3d minimal_arc(const Vec3& from, const Vec3& to);

} // namespace bindpose

#endif

#ifndef bindpose_pose_pose_file_h
#define bindpose_pose_pose_file_h

#include "pose/pose.h"
#include "weights/handles.h"

#include <functional>
#include <optional>
#include <string>

namespace bindpose
{

/// What a pose file says of one handle. What it does not say is empty.
struct HandleEdit
{
  Index handle = 0; ///< index in the handle list
  std::optional<HandleMode> mode;
  std::optional<Vec3> translate;
  std::optional<Eigen::Matrix3d> rotation; ///< of "rotate": axis and degrees
  std::optional<double> scale;
  bool parent_space = false; ///< "space": "parent"
  std::optional<Vec3> head, tail; ///< bones: posed ends
  std::optional<double> stretch; ///< bones: posed length / rest length
  std::optional<Eigen::Vector2d> twist; ///< bones: degrees at head and tail
};

/// A pose file as read: one list of edits a frame; each frame starts from the base pose again.
struct PoseSequence
{
  std::vector<std::vector<HandleEdit>> frames;
  double frames_per_second = 24.0;
  bool sequence = false; ///< the file has "frames", be it one, and is no single pose
  bool has_expressions = false; ///< somewhere stands a text for a number
};

/// Gives the value of an expression in t (seconds); invalid_input says in one clause what is wrong
/// with it.
using PoseExpression = std::function<Status(const std::string& text, double t, double& value)>;

/// Reads the text of a POSE.json: one pose
///
///     {"handles": {NAME: {"mode": "full|position|free|tail|ends", "translate": [x, y, z],
///                         "rotate": {"axis": [x, y, z], "degrees": d}, "scale": s,
///                         "space": "world|parent",
///                         "head": [x, y, z], "tail": [x, y, z], "stretch": s,
///                         "twist": [deg, deg]}}}
///
/// or a sequence {"frames": [pose, …], "fps": n}. All keys of a handle are optional; the last four
/// are for bones, and head or tail exclude translate, rotate and scale.
///
/// Any number of a handle may be a text: an expression in t, for example "sin(2 * t)". With
/// `expression` it is evaluated at t = `time` (single pose) or the frame's own time, its number /
/// fps (sequence); without, it is an error.
///
/// Strict: an empty or broken text, an unknown handle or key, a key given twice, a wrong type, a
/// number that is not finite, a rotation axis of length zero, a scale, stretch or fps that is not
/// positive, a bone posed to length zero, an expression that cannot be read or has no finite value:
/// invalid_input with one sentence that names it.
Status parse_pose_file(const std::string& text, const Handles& handles, PoseSequence& sequence,
  const PoseExpression& expression = {}, double time = 0.0);

/// What can be said of a POSE.json without handles.
struct PoseTimes
{
  Index frames = 1;
  double frames_per_second = 24.0;
  bool has_expressions = false;
};

/// False for a text that is no pose file at all; parse_pose_file() says why.
bool read_pose_times(const std::string& text, PoseTimes& times);

/// The pose that a frame asks for. A handle with pivot c (point, bone head, cage vertex, region
/// pivot) moves x -> c + translate + R * scale * (x - c), absolute, not on top of the base pose.
/// A bone with head or tail given (the other one rests) moves rigidly by the minimal arc from rest
/// to posed direction, and its stretch is the ratio of lengths unless given. "space": "parent"
/// applies the parent's posed transform afterwards. What the frame does not mention keeps the base
/// pose; an entry without any of translate, rotate, scale, head, tail keeps the base transform.
/// base must have one entry a handle; handles must have passed check_handles().
Pose apply_edits(const std::vector<HandleEdit>& edits, const Handles& handles, const Pose& base);

/// Writes poses as the text of a POSE.json: a single one as a pose, several as a sequence. Reading
/// it back gives the same poses to round-off, whatever the base pose. A transform with a shear, an
/// uneven scale or a reflection has no words in the file: its nearest rotation and scale are
/// written and a warning names the handle. invalid_input for a number that is not finite and for a
/// name that is not UTF-8.
Status format_pose_file(const std::vector<Pose>& poses, double frames_per_second,
  const Handles& handles, std::string& text);

/// The rotation by the smaller angle that takes one direction to another, neither of length zero.
/// Opposite directions: half a turn about an axis that depends on `from` only.
Eigen::Matrix3d minimal_arc(const Vec3& from, const Vec3& to);

} // namespace bindpose

#endif

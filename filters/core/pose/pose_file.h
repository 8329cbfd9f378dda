#ifndef bindpose_pose_pose_file_h
#define bindpose_pose_pose_file_h

// Reader and writer of POSE.json files, which contain poses or sequences of poses by handle name.

#include "handles/handles.h"
#include "pose/pose.h"

#include <functional>
#include <optional>
#include <string>

namespace bindpose
{

/// The values of one handle in a pose file. A value is empty if the file does not contain its key.
struct HandleEdit
{
  Index handle = 0; ///< index in the handle list
  std::optional<HandleMode> mode;
  std::optional<Vec3> translate;
  std::optional<Eigen::Matrix3d> rotation; ///< rotation matrix of "rotate" (axis and degrees)
  std::optional<double> scale;
  bool with_parent = true; ///< true if "space" is "parent", false if it is "world"
  std::optional<Vec3> head, tail; ///< bones: posed positions of the ends
  std::optional<double> stretch; ///< bones: posed length / rest length
  std::optional<Eigen::Vector2d> twist; ///< bones: twist at head and tail, degrees
};

/// The values of all handles of one pose in a pose file.
struct PoseEdits
{
  std::vector<HandleEdit> handles;
  /// False for version 1, in which handles do not move with their parents by default.
  bool children_follow = true;
};

/// The content of a pose file. Each frame is applied to the base pose.
struct PoseSequence
{
  std::vector<PoseEdits> frames;
  double frames_per_second = 24.0;
  bool sequence = false; ///< whether the file has "frames", even if there is only one
  bool has_expressions = false; ///< whether any value in the file is an expression
};

/// Function that computes the value of an expression in t (seconds). If the expression is not
/// valid, it returns invalid_input with a short description of the error.
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
/// The last four keys are for bones. `head` and `tail` cannot be combined with `translate`,
/// `rotate` and `scale`. apply_edits() defines the meaning of a pose.
///
/// A text without "version" has version 1, in which a handle moves with its parent only if it has
/// "space": "parent". A warning is returned if version 2 would pose a handle differently.
///
/// Any number in a handle's entry may be a string: an expression in t, for example "sin(2 * t)".
/// The function `expression` evaluates the string. For a single pose, t is `time`; for a frame of a
/// sequence, t is (index of the frame) / fps. If there is no function `expression`, a string is an
/// error.
///
/// The reader is strict. It returns invalid_input with one sentence about the error in these cases:
/// the text is empty or malformed; a handle or key is unknown; a key is duplicate; a value has the
/// wrong type; a number is not finite; a rotation axis has length zero; a scale, stretch or fps is
/// not positive; a posed bone has length zero; an expression cannot be read or has no finite value;
/// or the version is unknown.
Status parse_pose_file(const std::string& text, const Handles& handles, PoseSequence& sequence,
  const PoseExpression& expression = {}, double time = 0.0);

/// Properties of a POSE.json that can be read without handles.
struct PoseTimes
{
  Index frames = 1;
  double frames_per_second = 24.0;
  bool has_expressions = false;
};

/// Fill `times` from the text of a POSE.json. Return false if the text is not a pose file;
/// parse_pose_file() reports the reason.
bool read_pose_times(const std::string& text, PoseTimes& times);

/// Return the pose that a frame describes.
///
/// Version 2: a handle with pivot c (point, bone head, cage vertex, region pivot) is first
/// transformed by x -> c + translate + R * scale * (x - c). Then the transform that the handle
/// inherits from its parent is applied (transform_for_child()), as in glTF. "space": "world"
/// disables the inheritance. The combined transform replaces the transform of the base pose. `head`
/// and `tail` are world positions. An end without a key moves with the parent, or is at rest if the
/// space is "world". The bone is rotated by the minimal arc from its inherited direction to its new
/// direction. Its stretch is the value of `stretch` or, without this key, its new length divided by
/// its inherited length. A handle keeps its parent-relative transform of the base pose if the frame
/// has none of the keys translate, rotate, scale, head and tail for the handle.
///
/// A handle without "mode" keeps its mode of the base pose. If this mode is automatic and the frame
/// has one of the keys rotate, scale, head, tail, stretch and twist for the handle, its mode
/// becomes full. Methods that compute rotations choose the constraints of handles that remain
/// automatic (resolve_automatic_modes()).
///
/// Version 1: the default space is "world". With "parent", `head` and `tail` are applied before the
/// parent's transform. A handle that is not in the frame keeps its transform of the base pose.
///
/// `base` must have one entry per handle; `handles` must have passed check_handles().
Pose apply_edits(const PoseEdits& edits, const Handles& handles, const Pose& base);

/// Write poses as the text of a POSE.json of version 2: one pose, or a sequence of several. Reading
/// the text returns the same poses up to rounding, for any base pose.
///
/// Transforms are written relative to the parents, so that children move with a parent whose values
/// are edited. "space": "world" is written for a handle whose relative transform is not a rotation
/// and a uniform scale. A shear, a non-uniform scale or a reflection cannot be written: the nearest
/// rotation and scale are written instead. One warning contains the numbers of such handles and
/// poses, and the names of the first handles. There is no warning if a matrix differs from its
/// nearest rotation and scale by at most 1e-5 (relative difference in the Frobenius norm). Such
/// differences are round-off of single-precision files.
///
/// Return invalid_input if a value is not finite or a name is not UTF-8.
Status format_pose_file(const std::vector<Pose>& poses, double frames_per_second,
  const Handles& handles, std::string& text);

/// Write one pose like format_pose_file(), but only the handles that differ from `base`, one handle
/// per line. A handle is left out if apply_edits() gives it the same pose without an entry, up to a
/// relative round-off of 1e-12. The text is empty if all handles are left out.
Status format_pose_changes(
  const Pose& base, const Pose& pose, const Handles& handles, std::string& text);

} // namespace bindpose

#endif

/**
 * @class   vtkPoseHandles
 * @brief   applies a pose file to handles
 *
 * Reads a pose (or one frame of a sequence) from JSON and writes it into the cell arrays `Mode`,
 * `Transform`, `Stretch` and `Twist` of the handles:
 * <pre>
 *   {"version": 2,
 *    "handles": {NAME: {"mode": "full|position|free|tail|ends|auto", "translate": [x, y, z],
 *     "rotate": {"axis": [x, y, z], "degrees": d}, "scale": s, "space": "parent|world",
 *     "head": [x, y, z], "tail": [x, y, z], "stretch": s, "twist": [deg, deg]}}}
 *   {"version": 2, "frames": [pose, …], "fps": n}
 * </pre>
 * **Parents.** A handle with pivot c is transformed by x -> c + translation + R S (x - c), where R
 * is its rotation and S its scale. Then the transform that it inherits from its parent (cell array
 * `Parent`) is applied, as in glTF. Handles that the pose does not mention inherit the parent's
 * transform as well. "space": "world" disables the inheritance. A child of a bone that stretches or
 * twists moves with the cross-section of the bone to which it is attached. `head` and `tail` are
 * world positions. The resulting transform replaces that of the input.
 *
 * **Modes.** A handle without "mode" keeps the mode that it has in the input, or gets mode
 * automatic (5) if the input has no array Mode. If the mode is automatic and the pose contains more
 * than a translation, the mode becomes full. As-rigid-as-possible methods therefore compute the
 * rotations of points and of translated bones (see vtkReducedARAP). Skinning applies all transforms
 * unchanged.
 *
 * A text without "version" has version 1: the default space is "world", and handles that are not
 * mentioned keep their transform. A warning is issued once if version 2 would give another pose.
 *
 * **Expressions.** Any number in the entry of a handle may be a string with an expression in `t`,
 * the time in seconds: "translate": ["0.2 * sin(6.28 * t)", 0, 0]. The header io/expression.h of
 * the kernels lists the functions. In a sequence t is the time of the frame: its index / fps.
 *
 * **Time.** The filter provides times to the pipeline. For a sequence or the motion of a file,
 * these are the times of the frames; for expressions, the range from 0 to EndTime. If a time
 * is requested, the output is the frame at that time or the values of the expressions. If no time
 * is requested, Frame and Time are used.
 *
 * Errors: an invalid file, an unknown handle, an expression that cannot be parsed or has no finite
 * value at the requested time. Without FileName and PoseJSON the input is passed on.
 *
 * **Motions.** FileName may also name a .glb, .gltf, .bvh, .fbx or .dae file (the last three are
 * read by the library assimp in a separate process). Its first animation is assigned by the names
 * of joints and handles. If the joints of a skin are at the handles, their transforms are used
 * unchanged; without an animation, those of the nodes. Otherwise the motion is retargeted (see
 * Retarget). Handles without a joint follow their parents. Report: motion (exact, retargeted),
 * handles_without_joint[], joints_without_handle[].
 *
 * FileName may also name a .dmat file of libigl, which poses all handles, points before bones. For
 * m handles in d dimensions (d = 3, or 2 in a plane) the file contains a (d + 1) m x d matrix with
 * one transposed transform per handle. Alternatively, for b bones, it contains a 4 b x 1 matrix
 * with one quaternion (x, y, z, w) per bone. The quaternion is a rotation about the head, applied
 * before the parent's rotation.
 *
 * All other arrays are the input's own objects, so that downstream filters keep their bind.
 */

#ifndef vtkPoseHandles_h
#define vtkPoseHandles_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"
#include <memory> // for std::unique_ptr
#include <vector> // for std::vector

namespace bindpose
{
struct Handle;
struct HandlePose;
} // namespace bindpose

class vtkPolyData;

class BINDPOSEFILTERS_EXPORT vtkPoseHandles : public vtkBindposeAlgorithm
{
public:
  static vtkPoseHandles* New();
  vtkTypeMacro(vtkPoseHandles, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// The pose as text. Default: empty.
  void SetPoseJSON(const std::string& text);
  std::string GetPoseJSON() { return this->PoseJSON; }
  ///@}

  ///@{
  /// Path of the pose file: .json, .dmat, or a file with a motion (.glb, .gltf, .bvh, .fbx, .dae).
  /// At an update, the file is read again if it has changed. If a path is set, PoseJSON is not
  /// used.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /// Frame of a sequence. Default 0; a frame that does not exist is an error.
  vtkSetMacro(Frame, int);
  vtkGetMacro(Frame, int);
  ///@}

  ///@{
  /// Value of `t`, in seconds, in the expressions of a single pose. Used if the pipeline requests
  /// no time. Default 0.
  vtkSetMacro(Time, double);
  vtkGetMacro(Time, double);
  ///@}

  ///@{
  /// End of the time range that a pose with expressions provides to the pipeline, in seconds; at
  /// least 0, default 10.
  vtkSetClampMacro(EndTime, double, 0.0, 1e9);
  vtkGetMacro(EndTime, double);
  ///@}

  /// Report whether the pose of the last Update() has expressions.
  vtkGetMacro(HasExpressions, bool);

  ///@{
  /// Return the number of frames of the last Update(): 1 for a single pose, 0 before the first
  /// Update().
  vtkGetMacro(NumberOfFrames, int);
  /// Report whether the last pose was a sequence; a sequence may have only one frame.
  vtkGetMacro(Sequence, bool);
  vtkGetMacro(FramesPerSecond, double);
  ///@}

protected:
  vtkPoseHandles();
  ~vtkPoseHandles() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkPoseHandles(const vtkPoseHandles&) = delete;
  void operator=(const vtkPoseHandles&) = delete;

  struct Internals;

  bindpose::Status ReadMotion(bindpose::ExecutionContext& context,
    const std::vector<bindpose::Handle>& handles, const double* time,
    std::vector<bindpose::HandlePose>& pose);
  bindpose::Status ReadDMAT(
    const std::vector<bindpose::Handle>& handles, std::vector<bindpose::HandlePose>& pose);
  bool HasExtension(const char* extensions) const;
  bindpose::Status ReadText();
  bindpose::Status ParseText(
    vtkPolyData* input, const std::vector<bindpose::Handle>& handles, double time);

  const std::unique_ptr<Internals> Internal;
  std::string PoseJSON;
  char* FileName = nullptr;
  int Frame = 0;
  double Time = 0.0;
  double EndTime = 10.0;
  bool HasExpressions = false;
  int NumberOfFrames = 0;
  bool Sequence = false;
  double FramesPerSecond = 0.0;
};

#endif

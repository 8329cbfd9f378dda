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
 * **Parents.** A handle with pivot c is transformed by x -> c + translation + R S (x - c), and then
 * by the transform that it inherits from its parent (cell array `Parent`), as in glTF. Handles that
 * the pose does not mention inherit it as well. "space": "world" disables the inheritance. A child
 * of a bone that stretches or twists moves with the cross-section of the bone to which it is
 * attached. `head` and `tail` are world positions. The transform replaces that of the input.
 *
 * **Modes.** A handle without "mode" keeps its mode of the input, automatic (5) if there is no
 * array Mode. If that is automatic and the pose gives more than a translation, the mode becomes
 * full. So as-rigid-as-possible methods find the rotations of points and of translated bones (see
 * vtkReducedARAP), and skinning uses transforms as they are.
 *
 * A text without "version" has version 1: the default space is "world", and handles that are not
 * mentioned keep their transform. A warning is issued once if version 2 would give another pose.
 *
 * **Expressions.** Any number of a handle may be a text, an expression in `t`, the time in seconds:
 * "translate": ["0.2 * sin(6.28 * t)", 0, 0] (vtkExprTkFunctionParser; its functions and
 * constants). In a sequence t is the frame's own time, its number / fps.
 *
 * **Time.** The filter is a source of time: a sequence or the animation of a glTF file offers the
 * times of its frames, expressions the range from 0 to EndTime. Who asks for a time gets the frame
 * that is on then, or the expressions' values; who asks for none, Frame and Time.
 *
 * Errors: a broken file, an unknown handle, an expression that cannot be read or has no finite
 * value at the time. Without FileName and PoseJSON the input is passed on.
 *
 * FileName may also name a .glb or .gltf file: its animation, or without one how its nodes stand,
 * is assigned by the names of joints and handles (see vtkGLTFSkinReader); handles that are not
 * joints follow their parents. Or a .dmat file of libigl,
 * which poses all handles, points before bones: (d + 1) m x d numbers, a transposed transform a
 * handle (d = 3, or 2 in a plane), or 4 b x 1, a rotation (x, y, z, w) a bone about its head,
 * before its parent's.
 *
 * All other arrays are the input's own objects, so that filters behind it keep their bind.
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
  /// The pose as a file (.json, .dmat; .glb and .gltf for their animation), read anew when the
  /// filter is updated; when set, PoseJSON is not used.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /// Frame of a sequence. Default 0; a frame that is not there is an error.
  vtkSetMacro(Frame, int);
  vtkGetMacro(Frame, int);
  ///@}

  ///@{
  /// What `t` is in expressions of a single pose, when the pipeline asks for no time. Default 0.
  vtkSetMacro(Time, double);
  vtkGetMacro(Time, double);
  ///@}

  ///@{
  /// End of the range of times that expressions offer, 0 or more. Default 10.
  vtkSetClampMacro(EndTime, double, 0.0, 1e9);
  vtkGetMacro(EndTime, double);
  ///@}

  /// Whether the pose read by the last Update() has expressions.
  vtkGetMacro(HasExpressions, bool);

  ///@{
  /// Of the sequence read by the last Update(): a single pose is one frame; 0 before.
  vtkGetMacro(NumberOfFrames, int);
  /// Whether it was a sequence, which may have one frame.
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
  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

private:
  vtkPoseHandles(const vtkPoseHandles&) = delete;
  void operator=(const vtkPoseHandles&) = delete;

  struct Internals;

  bindpose::Status TakeGLTF(const std::vector<bindpose::Handle>& handles, const double* time,
    std::vector<bindpose::HandlePose>& pose);
  bindpose::Status TakeDMAT(
    const std::vector<bindpose::Handle>& handles, std::vector<bindpose::HandlePose>& pose);
  bool IsFrom(const char* endings) const;
  bindpose::Status ReadText(std::string& text, std::string& source);

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

/**
 * @class   vtkGLTFSkinWriter
 * @brief   writes a mesh with weights and its handles as a skinned glTF 2.0 file
 *
 * For Blender, game engines and viewers: drop the file in and pose it. A skin of glTF is linear
 * blend skinning, so what moves there is what vtkSkinningDeformation's linear blend computes.
 *
 * **Input 0**: the mesh, any vtkPointSet. Tets are written as their boundary surface, polygons as
 * triangles; normals, texture coordinates and vertex colours (ColorArrayName) go along. **Input 1**
 * (optional): the handles that the point array `Weights` was made for; without, the mesh alone is
 * written. **Input 2** (optional, several): the frames of an animation, which are the mesh as
 * vtkPoseAlgorithm's filters posed it. Or PoseFileName names a sequence of poses. **Output 0**: the
 * surface that was written.
 *
 * **Joints**: each handle is a joint: points, regions and cage vertices where they are, bones at
 * their heads with the y axis along them. Handles hang on their `Parent` (bones that share ends
 * do), so that in other programs a forearm follows its upper arm; transforms here are absolute, so
 * they are converted. Kind, tail, region and cage travel as extras for vtkGLTFSkinReader.
 * `Transform` of the handles is how the nodes stand; the mesh is bound at rest.
 *
 * **Weights**: all that are not zero, in as many sets of four (JOINTS_0, WEIGHTS_0, JOINTS_1, …) as
 * the fullest vertex needs, or MaximumInfluences, the largest. glTF demands rows that sum to one:
 * where one lacks more than 1e-6, a further joint `rest`, which never moves, holds what lacks: that
 * is what our skinning does with such rows, exactly. Negative weights and rows above one have no
 * place in glTF; they are clamped and divided by their sum, with a warning.
 *
 * **Animation**: JOINTS writes translation, rotation and scale of the joints a frame, for linear
 * blend rigs. What they cannot hold (shear, uneven scale off the joint's axes, and of frames posed
 * by other methods what is no blend of the handles' transforms, the field data `HandleTransforms`)
 * is told: animation_error is the largest distance, as a fraction of the diagonal, of a vertex as
 * the file moves it from where it belongs. MORPH writes the frames' points as morph targets: right
 * for every method (reduced and full as-rigid-as-possible, dual quaternions), 12 bytes a vertex and
 * frame. The joints rest then.
 *
 * The file is written beside its target and renamed at the end; a failure or cancel leaves nothing
 * behind. An existing file is an error unless Overwrite is on.
 *
 * Report: counts.{vertices, triangles, joints, frames, dropped_weights}, sets, rest_joint (yes,
 * no), dropped_share (the largest part of a row that MaximumInfluences dropped), pose_error,
 * animation (joints, morph), animation_error, file_bytes.
 *
 * Errors (INVALID_INPUT, one sentence): no triangles or tets, weights that do not fit the handles,
 * numbers that are no finite floats, frames with another number of points or without
 * HandleTransforms, a broken pose file, more than 4 GB, an unwritable place.
 *
 * Call Write(), or Update().
 *
 * @sa vtkGLTFSkinReader vtkSkinningDeformation
 */

#ifndef vtkGLTFSkinWriter_h
#define vtkGLTFSkinWriter_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkGLTFSkinWriter : public vtkBindposeAlgorithm
{
public:
  static vtkGLTFSkinWriter* New();
  vtkTypeMacro(vtkGLTFSkinWriter, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// How frames are written.
  enum AnimationType
  {
    JOINTS = 0,
    MORPH = 1
  };

  ///@{
  /// Path of the file: .glb (binary) or .gltf (text with the numbers in it). Default: none.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /// Replace an existing file? Default: off.
  vtkSetMacro(Overwrite, bool);
  vtkGetMacro(Overwrite, bool);
  vtkBooleanMacro(Overwrite, bool);
  ///@}

  ///@{
  /// Point array of weights. Default: "Weights".
  vtkSetStringMacro(ArrayName);
  vtkGetStringMacro(ArrayName);
  ///@}

  ///@{
  /// Point array of unsigned chars, 3 or 4 a point, for the vertex colours. Default: none, the
  /// active scalars when they are such ones.
  vtkSetStringMacro(ColorArrayName);
  vtkGetStringMacro(ColorArrayName);
  ///@}

  ///@{
  /// Weights of a vertex that are written, the largest, 4 for programs that take no more; 0
  /// (default): all.
  vtkSetClampMacro(MaximumInfluences, int, 0, 65535);
  vtkGetMacro(MaximumInfluences, int);
  ///@}

  ///@{
  /// JOINTS (default) or MORPH.
  vtkSetClampMacro(Animation, int, JOINTS, MORPH);
  vtkGetMacro(Animation, int);
  ///@}

  ///@{
  /// Sequence of poses (.json, see vtkPoseHandles) that becomes an animation of the joints, when
  /// input 2 has no frames. Default: none.
  vtkSetFilePathMacro(PoseFileName);
  vtkGetFilePathMacro(PoseFileName);
  ///@}

  ///@{
  /// Of the frames of input 2, above 0. Default: 24.
  vtkSetMacro(FramesPerSecond, double);
  vtkGetMacro(FramesPerSecond, double);
  ///@}

  ///@{
  /// The handles: SetInputData(1, handles).
  void SetHandlesData(vtkDataObject* handles) { this->SetInputData(1, handles); }
  void SetHandlesConnection(vtkAlgorithmOutput* handles) { this->SetInputConnection(1, handles); }
  ///@}

  ///@{
  /// Frames of the animation, in their order.
  void AddFrameData(vtkDataObject* frame) { this->AddInputDataObject(2, frame); }
  void AddFrameConnection(vtkAlgorithmOutput* frame) { this->AddInputConnection(2, frame); }
  void RemoveFrames() { this->RemoveAllInputConnections(2); }
  ///@}

  /// Executes the pipeline and writes, again even if nothing changed. Returns 1 when the file is
  /// there; otherwise 0, and GetStatusMessage() says why.
  int Write();

  /// The endings that can be written, lower case, without dots, parted by blanks.
  static const char* GetFileExtensions() { return "glb gltf"; }

protected:
  vtkGLTFSkinWriter();
  ~vtkGLTFSkinWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

private:
  vtkGLTFSkinWriter(const vtkGLTFSkinWriter&) = delete;
  void operator=(const vtkGLTFSkinWriter&) = delete;

  char* FileName = nullptr;
  char* ArrayName = nullptr;
  char* ColorArrayName = nullptr;
  char* PoseFileName = nullptr;
  bool Overwrite = false;
  int MaximumInfluences = 0;
  int Animation = JOINTS;
  double FramesPerSecond = 24.0;
};

#endif

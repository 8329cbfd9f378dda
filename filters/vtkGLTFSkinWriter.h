/**
 * @class   vtkGLTFSkinWriter
 * @brief   writes a mesh with weights and its handles as a skinned glTF 2.0 file
 *
 * The file can be posed in Blender, game engines and viewers. A skin of glTF is posed by linear
 * blend skinning, so the motion in these programs is that of vtkSkinningDeformation's linear blend.
 *
 * **Input 0**: the mesh, any vtkPointSet. Tets are written as their boundary surface, polygons as
 * triangles. Normals, texture coordinates and vertex colors (ColorArrayName) are written too.
 * **Input 1** (optional): the handles for which the point array `Weights` was computed; without
 * handles only the mesh is written. **Input 2** (optional, several connections): the frames of an
 * animation. Each connection is one frame: the output of a subclass of vtkPoseAlgorithm.
 * PoseFileName, a sequence of poses, is an alternative to input 2. **Output 0**: the surface that
 * was written.
 *
 * **Joints**: each handle becomes a joint. Points, regions and cage vertices are joints at their
 * positions; bones are joints at their heads with the y axis along the bone. A joint is a child of
 * the joint of its handle's `Parent`; in other programs a forearm therefore follows its upper arm.
 * The absolute transforms of handles are converted to transforms relative to the parent joint.
 * Handle type, tail, region and cage are stored in the extras of the joint for vtkGLTFSkinReader.
 * The skin is bound at rest. The nodes of the joints have the pose of the handles (`Transform`).
 *
 * **Weights**: all nonzero weights are written, or only the MaximumInfluences largest weights of
 * each vertex. glTF stores them in sets of four (JOINTS_0, WEIGHTS_0, JOINTS_1, …); the vertex with
 * the most weights determines the number of sets. glTF requires rows that sum to one. If the sum of
 * a row is below 1 - 1e-6, an additional joint `rest`, which never moves, gets the remainder. This
 * reproduces exactly how Bindpose's skinning handles such rows. glTF does not allow negative
 * weights or row sums above one. In such rows, negative weights are removed and the other weights
 * are divided by their sum, with a warning.
 *
 * **Animation**: JOINTS writes translation, rotation and scale of the joints per frame, for linear
 * blend rigs. Joints cannot represent shear, or non-uniform scale along directions other than the
 * joint's axes. Joints represent only frames of linear blend methods, whose points move by blends
 * of the handles' transforms (field data `HandleTransforms`). animation_error is the largest
 * distance between the position of a vertex in the file's animation and its correct position, as a
 * fraction of the diagonal. MORPH writes the frames' points as morph targets. This is correct for
 * every method (reduced and full as-rigid-as-possible, dual quaternions) and takes 12 bytes per
 * vertex and frame. The joints are then at rest.
 *
 * **Assets**: with AssetFileName, a copy of this file is written as glTF, and the meshes
 * of its default scene get the skin. Input 0 must have the points of vtkAssetReader for this file,
 * with weights. Everything but skins, joints and weights is kept: nodes, materials, textures,
 * vertex attributes, cameras, animations, extras and unknown extensions. If the handles are those
 * of vtkAssetReader, at the same rest positions, the joints of the file are kept, with their poses
 * and animations. A skin replaces the motion of the nodes of its meshes; an animation of the file
 * that moves only some of the meshes by their nodes, or joints that are replaced, is lost, with a
 * warning. Frames are stored as an animation of the joints.
 *
 * The file is written under a temporary name next to its target and renamed at the end; a failure
 * or cancel leaves no file. An existing file is an error unless Overwrite is on.
 *
 * Report: counts.{vertices, triangles, meshes, joints, frames, dropped_weights}, sets, rest_joint
 * (yes or no), dropped_share (the largest fraction of a row that MaximumInfluences dropped),
 * pose_error (like animation_error, for the pose of the handles), animation (joints, morph),
 * animation_error, file_bytes; of an asset also kept_joints (yes or no) and losses[] (one phrase
 * for each lost motion).
 *
 * Errors (INVALID_INPUT, one sentence): no triangles or tets, points that are not those of the
 * asset, weights that do not match the handles, numbers that are not finite floats, frames with a
 * different number of points or without HandleTransforms, an invalid pose file, more than 4 GB, an
 * output path that cannot be written.
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

  /// Representation of frames in the file.
  enum AnimationType
  {
    JOINTS = 0,
    MORPH = 1
  };

  ///@{
  /// Path of the file: .glb (binary) or .gltf (text with embedded numbers). Default: none.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /// Path of the file whose meshes get the skin, see the class documentation. Default: none,
  /// which means that the file contains only the mesh.
  vtkSetFilePathMacro(AssetFileName);
  vtkGetFilePathMacro(AssetFileName);
  ///@}

  ///@{
  /// Replace an existing file. Default: off.
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
  /// Point array of unsigned chars, 3 or 4 components, for the vertex colors. Default: none, which
  /// means the active scalars if they have this type.
  vtkSetStringMacro(ColorArrayName);
  vtkGetStringMacro(ColorArrayName);
  ///@}

  ///@{
  /// Maximum number of weights that are written per vertex; the largest weights are kept. Set it to
  /// 4 for programs that read only one set of weights. 0 (default): no limit.
  vtkSetClampMacro(MaximumInfluences, int, 0, 65535);
  vtkGetMacro(MaximumInfluences, int);
  ///@}

  ///@{
  /// Representation of the frames: JOINTS (default) or MORPH.
  vtkSetClampMacro(Animation, int, JOINTS, MORPH);
  vtkGetMacro(Animation, int);
  ///@}

  ///@{
  /// Sequence of poses that is written as an animation of the joints if input 2 has no frames:
  /// .json, or a file with a motion (.glb, .gltf, .bvh, .fbx, .dae), see vtkPoseHandles. Default:
  /// none.
  vtkSetFilePathMacro(PoseFileName);
  vtkGetFilePathMacro(PoseFileName);
  ///@}

  ///@{
  /// Frames per second of the frames on input 2, above 0. Default: 24.
  vtkSetMacro(FramesPerSecond, double);
  vtkGetMacro(FramesPerSecond, double);
  ///@}

  ///@{
  /// Set the handles, like SetInputData(1, handles).
  void SetHandlesData(vtkDataObject* handles) { this->SetInputData(1, handles); }
  void SetHandlesConnection(vtkAlgorithmOutput* handles) { this->SetInputConnection(1, handles); }
  ///@}

  ///@{
  /// Add a frame to the end of the animation.
  void AddFrameData(vtkDataObject* frame) { this->AddInputDataObject(2, frame); }
  void AddFrameConnection(vtkAlgorithmOutput* frame) { this->AddInputConnection(2, frame); }
  void RemoveFrames() { this->RemoveAllInputConnections(2); }
  ///@}

  /// Execute the pipeline and write the file, even if nothing has changed. Return 1 if the file was
  /// written; otherwise return 0, and GetStatusMessage() returns the reason.
  int Write();

  /// File name extensions that can be written, in lower case, without dots, separated by blanks.
  static const char* GetFileExtensions() { return "glb gltf"; }

protected:
  vtkGLTFSkinWriter();
  ~vtkGLTFSkinWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkGLTFSkinWriter(const vtkGLTFSkinWriter&) = delete;
  void operator=(const vtkGLTFSkinWriter&) = delete;

  char* FileName = nullptr;
  char* AssetFileName = nullptr;
  char* ArrayName = nullptr;
  char* ColorArrayName = nullptr;
  char* PoseFileName = nullptr;
  bool Overwrite = false;
  int MaximumInfluences = 0;
  int Animation = JOINTS;
  double FramesPerSecond = 24.0;
};

#endif

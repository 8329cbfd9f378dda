/**
 * @class   vtkGLTFSkinReader
 * @brief   reads a skinned mesh from a glTF 2.0 file: mesh with weights, handles, poses
 *
 * Reads .glb and .gltf files of vtkGLTFSkinWriter, Blender and other programs: the triangles and
 * the first skin that a mesh uses, with all meshes that use it. A file without a skin gives its
 * meshes, where their nodes put them, and no handle.
 *
 * **Output 0**: the mesh (vtkPolyData), with the point array `Weights`, a component a joint, rows
 * summing to one (what the rest joint of vtkGLTFSkinWriter holds is lacking again), with normals,
 * texture coordinates (`TCoords`) and vertex colours (`Colors`) where the file has them.
 * **Output 1**: the handles (see filters/README.md). A joint that vtkGLTFSkinWriter made of a
 * handle becomes that handle again, unless it was bound anew at another place; of others those with
 * children become bones to the middle of these, those without points. Their
 * `Ownership` is 1, so that a bind skips helper joints that share all vertices with others, and 2
 * for joints without weights in the file (control bones). Their rest places are those
 * of the inverse bind matrices, their `Transform` is how the nodes stand (Frame: how the animation
 * has them): posing the mesh by linear blend skinning gives what a glTF viewer shows.
 *
 * **Animation**: the first that moves a joint, a frame a key where keys are evenly spaced, else 24
 * a second; as GetPoseJSON(), which vtkPoseHandles takes, or frame by frame with Frame. A pose file
 * has no word for uneven scales and shears: one warning counts the handles that have some. Scales
 * that differ by roundoff of the file (1e-5 of the matrix) are even.
 *
 * **Time.** With an animation and Frame -1 the reader is a source of time: it offers the times of
 * the frames, and who asks for a time gets the handles of the frame that is on then. The mesh is
 * the same at all times, so filters behind it keep their bind. The file is read anew when it has
 * changed.
 *
 * Not read: other animations, materials, textures, morph targets, cameras, lights. One warning
 * lists what the file has of these. Compressed meshes are an error.
 *
 * A missing, truncated or broken file gives INVALID_INPUT with one sentence that names it; never a
 * crash, never half a mesh.
 *
 * Report: counts.vertices, counts.triangles, counts.joints, counts.skins, counts.frames,
 * counts.animations, counts.materials, counts.unweighted_vertices, counts.skipped_primitives,
 * counts.morph_targets, not_kept[] (what the warning lists), sets,
 * frames_per_second, handles[].name, handles[].kind.
 *
 * @sa vtkGLTFSkinWriter vtkMeshFileReader vtkHandleFileReader
 */

#ifndef vtkGLTFSkinReader_h
#define vtkGLTFSkinReader_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"
#include <memory> // for std::unique_ptr

class BINDPOSEFILTERS_EXPORT vtkGLTFSkinReader : public vtkBindposeAlgorithm
{
public:
  static vtkGLTFSkinReader* New();
  vtkTypeMacro(vtkGLTFSkinReader, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Path of the file. Default: none.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /// Frame of the animation that the handles stand in, from 0; -1 (default): that of the time which
  /// is asked for, or as the nodes stand. A frame that is not there is an error.
  vtkSetMacro(Frame, int);
  vtkGetMacro(Frame, int);
  ///@}

  ///@{
  /// Of the last Update(): frames of the animation, 0 without one, and the animation as a pose
  /// file, empty without one.
  vtkGetMacro(NumberOfFrames, int);
  vtkGetMacro(FramesPerSecond, double);
  std::string GetPoseJSON() { return this->PoseJSON; }
  ///@}

  /// The endings that can be read, lower case, without dots, parted by blanks.
  static const char* GetFileExtensions() { return "glb gltf"; }

protected:
  vtkGLTFSkinReader();
  ~vtkGLTFSkinReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

private:
  vtkGLTFSkinReader(const vtkGLTFSkinReader&) = delete;
  void operator=(const vtkGLTFSkinReader&) = delete;

  struct Internals;

  const std::unique_ptr<Internals> Internal;
  char* FileName = nullptr;
  int Frame = -1;
  int NumberOfFrames = 0;
  double FramesPerSecond = 0.0;
  std::string PoseJSON;
};

#endif

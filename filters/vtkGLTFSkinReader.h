/**
 * @class   vtkGLTFSkinReader
 * @brief   reads a skinned mesh from a glTF 2.0 file: mesh with weights, handles, poses
 *
 * Reads .glb and .gltf files of vtkGLTFSkinWriter, Blender and other programs. It reads the first
 * skin that a mesh uses, and the triangles of all meshes that use this skin. If the file has no
 * skin, it reads all meshes, at the positions of their nodes, and returns no handles.
 *
 * **Output 0**: the mesh (vtkPolyData) with the point array `Weights`, one component per joint.
 * Rows sum to one, except that the weights of vtkGLTFSkinWriter's rest joint are left out. Normals,
 * texture coordinates (`TCoords`) and vertex colors (`Colors`) are read if the file has them.
 * **Output 1**: the handles (see filters/README.md). A joint that vtkGLTFSkinWriter wrote for a
 * handle becomes that handle again, unless another program has changed its bind position. Other
 * joints with children become bones that end at the mean position of the children. Other joints
 * without children become points. The array `Ownership` is 1 for these bones and points, so that a
 * bind skips a joint if no vertex can be assigned to it alone (helper joints). It is 2 for joints
 * without weights in the file (control bones). The inverse bind matrices give the rest positions.
 * `Transform` contains the transforms of the nodes, or those of the animation at Frame. Posing the
 * mesh by linear blend skinning therefore gives the shape that a glTF viewer shows.
 *
 * **Animation**: the first animation that moves a joint is read. It has one frame per key if keys
 * are evenly spaced, otherwise 24 frames per second. The animation is available as a pose file for
 * vtkPoseHandles (GetPoseJSON()), or frame by frame (Frame). A pose file cannot store non-uniform
 * scales and shears; one warning counts the handles with such transforms. Differences between
 * scales within the round-off of the file (1e-5 of the matrix) are ignored.
 *
 * **Time.** With an animation and Frame -1 the reader provides the time steps of the frames. If a
 * time is requested, the output is the frame at that time. The mesh is the same at all times, so
 * downstream filters keep their bind. The file is read again if it has changed.
 *
 * Not read: other animations, materials, textures, morph targets, cameras, lights. One warning
 * lists the items of this list that the file contains. Meshes that are compressed by Draco or
 * meshopt are decompressed by the program bindpose-importer.
 *
 * A missing, truncated or invalid file gives INVALID_INPUT with one sentence that names it. It
 * never causes a crash or a partial mesh.
 *
 * Report: counts.vertices, counts.triangles, counts.joints, counts.skins, counts.frames,
 * counts.animations, counts.materials, counts.unweighted_vertices, counts.skipped_primitives,
 * counts.morph_targets, not_kept[] (the list in the warning), sets, frames_per_second,
 * handles[].name, handles[].kind.
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
  /// Frame of the animation for the handles, from 0. -1 (default): the frame at the requested time,
  /// or the transforms of the nodes if no time is requested. A frame that does not exist is an
  /// error.
  vtkSetMacro(Frame, int);
  vtkGetMacro(Frame, int);
  ///@}

  ///@{
  /// Results of the last Update(): NumberOfFrames is the number of frames of the animation (0
  /// without an animation), and GetPoseJSON() returns the animation as a pose file (empty without
  /// an animation).
  vtkGetMacro(NumberOfFrames, int);
  vtkGetMacro(FramesPerSecond, double);
  std::string GetPoseJSON() { return this->PoseJSON; }
  ///@}

  /// File name extensions that can be read, in lower case, without dots, separated by blanks.
  static const char* GetFileExtensions() { return "glb gltf"; }

protected:
  vtkGLTFSkinReader();
  ~vtkGLTFSkinReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

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

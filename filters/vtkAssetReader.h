/**
 * @class   vtkAssetReader
 * @brief   reads the triangles of all meshes of a file, for a new rig
 *
 * Weights for the points of this mesh can be written into a copy of the file by vtkGLTFSkinWriter
 * (AssetFileName). The copy keeps materials, textures, cameras, animations and everything else. The
 * copy of another format is a glTF file. It has the texture coordinates, normals and vertex colors
 * of the file. An OBJ file also keeps its groups (one mesh each), and the materials and pictures of
 * its .mtl files; BMP, TIFF and TGA pictures become PNG; a PLY file keeps its picture (comment
 * TextureFile). FBX, Collada, 3DS and 3MF files are converted by assimp, in the helper process
 * bindpose-importer. Materials and pictures that cannot be read are left out, with a warning; those
 * outside of the folder are refused.
 *
 * **Output 0**: the triangles of the default scene (vtkPolyData), in scene coordinates. The
 * vertices of a mesh occur once for each node with the mesh. If a mesh has a skin, its points have
 * the positions of the bind pose. Vertices that the file splits at seams of textures stay split;
 * the weights filters give equal weights to points at the same position.
 * **Output 1**: the joints of the skins of these meshes as handles, in scene coordinates, as in
 * vtkGLTFSkinReader. No cells if no mesh has a skin. New weights for these handles keep the joints
 * of the file and their animations.
 *
 * Use vtkGLTFSkinReader instead to read the weights and the animation of a rig.
 *
 * A missing, truncated or invalid file gives INVALID_INPUT with one sentence that names it. It
 * never causes a crash or a partial mesh.
 *
 * Report: counts.meshes (nodes with triangles), counts.vertices, counts.triangles,
 * counts.skipped_primitives (points and lines), counts.joints.
 *
 * @sa vtkGLTFSkinWriter vtkGLTFSkinReader
 */

#ifndef vtkAssetReader_h
#define vtkAssetReader_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkAssetReader : public vtkBindposeAlgorithm
{
public:
  static vtkAssetReader* New();
  vtkTypeMacro(vtkAssetReader, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Path of the file: .glb, .gltf, .obj, .ply, .fbx, .dae, .3ds or .3mf. Default: none.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /// File name extensions that can be read, in lower case, without dots, separated by blanks.
  static const char* GetFileExtensions();

protected:
  vtkAssetReader();
  ~vtkAssetReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkAssetReader(const vtkAssetReader&) = delete;
  void operator=(const vtkAssetReader&) = delete;

  char* FileName = nullptr;
};

#endif

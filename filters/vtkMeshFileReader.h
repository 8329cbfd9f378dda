/**
 * @class   vtkMeshFileReader
 * @brief   reads mesh files in all formats that Bindpose supports
 *
 * | extension | content | output |
 * |---|---|---|
 * | .off .obj .ply | surface, polygons kept, doubles | vtkPolyData |
 * | .stl | surface, equal vertices merged | vtkPolyData |
 * | .vtp | surface or handles with arrays | vtkPolyData |
 * | .vtu | tets or other cells with arrays | vtkUnstructuredGrid |
 * | .vti | image (volume) with arrays | vtkImageData |
 * | .vtk | VTK's legacy format | as in the file |
 * | .mesh | MEDIT, ASCII: tets, else triangles | vtkUnstructuredGrid, vtkPolyData |
 * | .glb .gltf | triangles, `Weights` of a skin: see vtkGLTFSkinReader | vtkPolyData |
 *
 * Bindpose's own readers read OFF, OBJ, PLY, STL and MEDIT files. Coordinates are doubles. Texture
 * coordinates and normals are not read and do not split vertices. If an OBJ file has no faces, its
 * lines are read.
 *
 * A missing, empty, truncated or invalid file gives INVALID_INPUT with one sentence that names the
 * file and, for text formats, the line. Coordinates that are not finite give the same error in text
 * formats. Such a file never causes a crash or a partial mesh. See vtkBindposeAlgorithm for the
 * propagation of failures.
 *
 * Report: `format`, `counts.vertices`, `counts.cells`, `counts.skipped_cells` (entries with fewer
 * than three corners).
 */

#ifndef vtkMeshFileReader_h
#define vtkMeshFileReader_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkMeshFileReader : public vtkBindposeAlgorithm
{
public:
  static vtkMeshFileReader* New();
  vtkTypeMacro(vtkMeshFileReader, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Path of the file. Default: none.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /// File name extensions that can be read, in lower case, without dots, separated by blanks.
  static const char* GetFileExtensions() { return "obj off ply stl vtp vtu vti vtk mesh glb gltf"; }

protected:
  vtkMeshFileReader();
  ~vtkMeshFileReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkMeshFileReader(const vtkMeshFileReader&) = delete;
  void operator=(const vtkMeshFileReader&) = delete;

  char* FileName = nullptr;
};

#endif

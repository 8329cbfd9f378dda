/**
 * @class   vtkMeshFileReader
 * @brief   reads any mesh file that Bindpose knows, whatever its ending
 *
 * | ending | content | output |
 * |---|---|---|
 * | .off .obj .ply | surface, polygons kept, doubles | vtkPolyData |
 * | .stl | surface, equal vertices merged | vtkPolyData |
 * | .vtp | surface or handles with arrays | vtkPolyData |
 * | .vtu | tets or other cells with arrays | vtkUnstructuredGrid |
 * | .vti | image (volume) with arrays | vtkImageData |
 * | .vtk | VTK's old format | what the file holds |
 * | .mesh | MEDIT, ASCII: tets, else triangles | vtkUnstructuredGrid, vtkPolyData |
 * | .glb .gltf | triangles, `Weights` of a skin: see vtkGLTFSkinReader | vtkPolyData |
 *
 * OFF, OBJ, PLY, STL and MEDIT files are read by Bindpose itself: coordinates are doubles, and
 * vertices stay shared whatever texture coordinates and normals the file carries; those are not
 * read. An OBJ file without a face gives its lines.
 *
 * A missing, empty, truncated or wrong file, and coordinates that are not finite in the text
 * formats, give INVALID_INPUT with one sentence that names the file (and line, where there are
 * lines); never a crash, never half a mesh. See vtkBindposeAlgorithm for how failures travel.
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

  /// The endings that can be read, lower case, without dots, parted by blanks.
  static const char* GetFileExtensions() { return "obj off ply stl vtp vtu vti vtk mesh glb gltf"; }

protected:
  vtkMeshFileReader();
  ~vtkMeshFileReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

private:
  vtkMeshFileReader(const vtkMeshFileReader&) = delete;
  void operator=(const vtkMeshFileReader&) = delete;

  char* FileName = nullptr;
};

#endif

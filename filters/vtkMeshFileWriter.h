/**
 * @class   vtkMeshFileWriter
 * @brief   writes any dataset of Bindpose to a file that is there whole or not at all
 *
 * The ending of FileName decides:
 *
 * | ending | takes | keeps |
 * |---|---|---|
 * | .vtp | vtkPolyData | everything |
 * | .vtu | vtkUnstructuredGrid | everything |
 * | .vti | vtkImageData | everything |
 * | .vtk | any dataset | everything |
 * | .off .obj .ply | surfaces (2D cells) | doubles, polygons |
 * | .stl | surfaces (2D cells) | floats, triangles |
 * | .mesh | tets or surfaces | doubles |
 * | .dmat | any dataset with the point array ArrayName | that array alone, #points x #components |
 *
 * The file is written beside its target and renamed at the end; a failure, a cancel or an exception
 * leaves nothing behind. An existing file is an error unless Overwrite is on. All errors are
 * INVALID_INPUT with one sentence: a dataset that the ending cannot hold, an unwritable place.
 *
 * Call Write(). The filter has no output.
 */

#ifndef vtkMeshFileWriter_h
#define vtkMeshFileWriter_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkMeshFileWriter : public vtkBindposeAlgorithm
{
public:
  static vtkMeshFileWriter* New();
  vtkTypeMacro(vtkMeshFileWriter, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Path of the file. Default: none.
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
  /// Point array that a .dmat file gets. Default: "Weights".
  vtkSetStringMacro(ArrayName);
  vtkGetStringMacro(ArrayName);
  ///@}

  /// Executes the pipeline and writes, again even if nothing changed. Returns 1 when the file is
  /// there; otherwise 0, and GetStatusMessage() says why.
  int Write();

  /// The endings that can be written, lower case, without dots, parted by blanks.
  static const char* GetFileExtensions() { return "vtp vtu vti vtk ply stl obj off mesh dmat"; }

protected:
  vtkMeshFileWriter();
  ~vtkMeshFileWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

private:
  vtkMeshFileWriter(const vtkMeshFileWriter&) = delete;
  void operator=(const vtkMeshFileWriter&) = delete;

  char* FileName = nullptr;
  char* ArrayName = nullptr;
  bool Overwrite = false;
};

#endif

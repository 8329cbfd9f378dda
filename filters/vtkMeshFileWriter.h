/**
 * @class   vtkMeshFileWriter
 * @brief   writes any dataset of Bindpose to a file, either completely or not at all
 *
 * The extension of FileName determines the format:
 *
 * | extension | accepts | keeps |
 * |---|---|---|
 * | .vtp | vtkPolyData | everything |
 * | .vtu | vtkUnstructuredGrid | everything |
 * | .vti | vtkImageData | everything |
 * | .vtk | any dataset | everything |
 * | .off .obj .ply | surfaces (2D cells) | doubles, polygons |
 * | .stl | surfaces (2D cells) | floats, triangles |
 * | .mesh | tets or surfaces | doubles |
 * | .dmat | any dataset with the point array ArrayName | only that array, #points x #components |
 *
 * The file is written under a temporary name next to its target and renamed at the end; a failure,
 * a cancel or an exception leaves no file. An existing file is an error unless Overwrite is on. All
 * errors are INVALID_INPUT with one sentence: a dataset that the format cannot store, an output
 * path that cannot be written.
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
  /// Replace an existing file. Default: off.
  vtkSetMacro(Overwrite, bool);
  vtkGetMacro(Overwrite, bool);
  vtkBooleanMacro(Overwrite, bool);
  ///@}

  ///@{
  /// Point array that is written to a .dmat file. Default: "Weights".
  vtkSetStringMacro(ArrayName);
  vtkGetStringMacro(ArrayName);
  ///@}

  /// Execute the pipeline and write the file, even if nothing has changed. Return 1 if the file was
  /// written; otherwise return 0, and GetStatusMessage() returns the reason.
  int Write();

  /// File name extensions that can be written, in lower case, without dots, separated by blanks.
  static const char* GetFileExtensions() { return "vtp vtu vti vtk ply stl obj off mesh dmat"; }

protected:
  vtkMeshFileWriter();
  ~vtkMeshFileWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkMeshFileWriter(const vtkMeshFileWriter&) = delete;
  void operator=(const vtkMeshFileWriter&) = delete;

  char* FileName = nullptr;
  char* ArrayName = nullptr;
  bool Overwrite = false;
};

#endif

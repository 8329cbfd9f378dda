/**
 * @class   vtkVDBWriter
 * @brief   writes a point array of a volume as an OpenVDB grid of floats (.vdb)
 *
 * Houdini, Blender and other programs can read the file. A typical array is the winding number of a
 * surface: the grid is then a fog volume with the value 0 outside and 1 inside. Voxel centers are
 * the image's points, in the same world coordinates, for any origin, spacing, direction and extent
 * of the vtkImageData.
 *
 * With Band FULL every value that differs from the background is kept. With NARROW only the voxels
 * near the surface (where the values cross Threshold) are kept; all others are replaced by two
 * inactive constants. The file then has a few per cent of the size and the same isosurface. See
 * bindpose::write_vdb for the active voxels and the grid class.
 *
 * The file is written under a temporary name next to its target and renamed at the end; a failure,
 * a cancel or an exception leaves no file. The same values give the same bytes. An existing file is
 * an error unless Overwrite is on.
 *
 * Errors: UNAVAILABLE in a build without OpenVDB (package libopenvdb-dev). INVALID_INPUT, with one
 * sentence: the input is not a vtkImageData, the array is missing, has several components or has a
 * value that is not a finite float, the spacing is not positive, Background equals Threshold, or
 * the output path cannot be written.
 *
 * Call Write(). The filter has no output; its report has counts.samples, counts.active_voxels,
 * counts.leaf_nodes, file_bytes.
 */

#ifndef vtkVDBWriter_h
#define vtkVDBWriter_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkVDBWriter : public vtkBindposeAlgorithm
{
public:
  static vtkVDBWriter* New();
  vtkTypeMacro(vtkVDBWriter, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Determines which voxels are active.
  enum BandType
  {
    FULL = 0,
    NARROW = 1
  };

  ///@{
  /// Path of the file, with the extension .vdb. Default: none.
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
  /// Point array to write, with one component. Default: none, which means the active scalars.
  vtkSetStringMacro(ArrayName);
  vtkGetStringMacro(ArrayName);
  ///@}

  ///@{
  /// Name of the grid in the file. Default: none, which means "winding_number" for the array
  /// WindingNumber and the array's own name otherwise.
  vtkSetStringMacro(GridName);
  vtkGetStringMacro(GridName);
  ///@}

  ///@{
  /// Value outside of the volume. Default: 0.
  vtkSetMacro(Background, double);
  vtkGetMacro(Background, double);
  ///@}

  ///@{
  /// Which voxels are active: FULL (default) or NARROW.
  vtkSetClampMacro(Band, int, FULL, NARROW);
  vtkGetMacro(Band, int);
  ///@}

  ///@{
  /// NARROW: width of the band on each side of the surface, in voxels along each axis. Must be 1 to
  /// 2^30. Default: 3.
  vtkSetClampMacro(BandWidth, int, 1, 1 << 30);
  vtkGetMacro(BandWidth, int);
  ///@}

  ///@{
  /// NARROW: isovalue of the surface. Default: 0.5.
  vtkSetMacro(Threshold, double);
  vtkGetMacro(Threshold, double);
  ///@}

  /// Execute the pipeline and write the file, even if nothing has changed. Return 1 if the file was
  /// written; otherwise return 0, and GetStatusMessage() returns the reason.
  int Write();

  /// File name extensions that can be written, in lower case, without dots, separated by blanks.
  static const char* GetFileExtensions() { return "vdb"; }

protected:
  vtkVDBWriter();
  ~vtkVDBWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkVDBWriter(const vtkVDBWriter&) = delete;
  void operator=(const vtkVDBWriter&) = delete;

  char* FileName = nullptr;
  char* ArrayName = nullptr;
  char* GridName = nullptr;
  bool Overwrite = false;
  double Background = 0.0;
  int Band = FULL;
  int BandWidth = 3;
  double Threshold = 0.5;
};

#endif

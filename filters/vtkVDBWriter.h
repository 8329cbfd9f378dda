/**
 * @class   vtkVDBWriter
 * @brief   writes a point array of a volume as an OpenVDB grid of floats (.vdb)
 *
 * For Houdini, Blender and other programs that read OpenVDB: the winding number of a surface as a
 * fog volume, 0 outside and 1 inside. Voxel centres are the image's points, in the same world
 * coordinates, whatever origin, spacing, direction and extent the vtkImageData has.
 *
 * Band FULL keeps every value that differs from the background; NARROW only the voxels near the
 * surface (where the values cross Threshold), the rest becoming two constants, inactive: a file of
 * a few per cent of the size with the same isosurface. bindpose::write_vdb says which voxels are
 * active and what the grid's class is.
 *
 * The file is written beside its target and renamed at the end; a failure, a cancel or an exception
 * leaves nothing behind. The same values give the same bytes. An existing file is an error unless
 * Overwrite is on.
 *
 * Errors: UNAVAILABLE in a build without OpenVDB (package libopenvdb-dev); INVALID_INPUT with one
 * sentence for anything but a vtkImageData, an array that is missing, has several components or a
 * value that is no finite float, spacing that is not positive, a Background equal to Threshold, an
 * unwritable place.
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

  /// Which voxels are active.
  enum BandType
  {
    FULL = 0,
    NARROW = 1
  };

  ///@{
  /// Path of the file, with the ending .vdb. Default: none.
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
  /// Point array to write, of one component. Default: none, the active scalars.
  vtkSetStringMacro(ArrayName);
  vtkGetStringMacro(ArrayName);
  ///@}

  ///@{
  /// Name of the grid in the file. Default: none, which is "winding_number" for the array
  /// WindingNumber, and the array's own name otherwise.
  vtkSetStringMacro(GridName);
  vtkGetStringMacro(GridName);
  ///@}

  ///@{
  /// Value outside of the volume. Default: 0.
  vtkSetMacro(Background, double);
  vtkGetMacro(Background, double);
  ///@}

  ///@{
  /// FULL (default) or NARROW.
  vtkSetClampMacro(Band, int, FULL, NARROW);
  vtkGetMacro(Band, int);
  ///@}

  ///@{
  /// NARROW: how far the band reaches from the surface, in voxels along each axis, 1 … 2^30.
  /// Default: 3.
  vtkSetClampMacro(BandWidth, int, 1, 1 << 30);
  vtkGetMacro(BandWidth, int);
  ///@}

  ///@{
  /// NARROW: the level of the surface. Default: 0.5.
  vtkSetMacro(Threshold, double);
  vtkGetMacro(Threshold, double);
  ///@}

  /// Executes the pipeline and writes, again even if nothing changed. Returns 1 when the file is
  /// there; otherwise 0, and GetStatusMessage() says why.
  int Write();

  /// The endings that can be written, lower case, without dots, parted by blanks.
  static const char* GetFileExtensions() { return "vdb"; }

protected:
  vtkVDBWriter();
  ~vtkVDBWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

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

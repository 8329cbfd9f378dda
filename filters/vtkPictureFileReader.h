/**
 * @class   vtkPictureFileReader
 * @brief   reads a picture: a .png, .jpg, .jpeg, .tif, .tiff or .bmp file
 *
 * The output is an image in the plane z = 0 whose points are the pixels; the top line of the
 * picture is at the largest y. The pixels are the active point scalars. A PNG file gives red,
 * green, blue and, if the file has it, alpha, as bytes. For other formats, the numbers and their
 * type are those of VTK's readers.
 *
 * The file is read in a separate process (the helper executable bindpose-reader), because VTK's
 * readers crash on some damaged files. A missing or damaged file, or one whose format is not that
 * of its extension, gives INVALID_INPUT with one sentence that names the file. See
 * vtkBindposeAlgorithm for the propagation of failures.
 *
 * Report: `format`, `counts.columns`, `counts.rows`.
 */

#ifndef vtkPictureFileReader_h
#define vtkPictureFileReader_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"

#include <memory> // for the picture

class BINDPOSEFILTERS_EXPORT vtkPictureFileReader : public vtkBindposeAlgorithm
{
public:
  static vtkPictureFileReader* New();
  vtkTypeMacro(vtkPictureFileReader, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Path of the file. Default: none.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /// File name extensions that can be read, in lower case, without dots, separated by blanks.
  static const char* GetFileExtensions() { return "png jpg jpeg tif tiff bmp"; }

protected:
  vtkPictureFileReader();
  ~vtkPictureFileReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkPictureFileReader(const vtkPictureFileReader&) = delete;
  void operator=(const vtkPictureFileReader&) = delete;

  /// The picture of the last read and its status.
  struct Picture;
  /// Read the file unless Last contains it.
  const Picture& Read(bindpose::ExecutionContext& context);

  char* FileName = nullptr;
  std::unique_ptr<Picture> Last;
};

#endif

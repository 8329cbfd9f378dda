// vtkPictureFileReader: pixels of lossless formats are read back unchanged, and those of JPEG up
// to compression errors. A damaged file gives an error message of one sentence.
#include "vtkPictureFileReader.h"

#include "support/files.h"

#include "vtkBMPWriter.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkJPEGWriter.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkTIFFWriter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
vtkSmartPointer<vtkImageData> picture()
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(7, 5, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  for (int y = 0; y < 5; ++y)
  {
    for (int x = 0; x < 7; ++x)
    {
      for (int c = 0; c < 3; ++c)
      {
        image->SetScalarComponentFromDouble(x, y, 0, c, 10 * x + 40 * y + c);
      }
    }
  }
  return image;
}

template <typename Writer>
std::string write(const std::string& path)
{
  vtkNew<Writer> writer;
  writer->SetInputData(picture());
  writer->SetFileName(path.c_str());
  writer->Write();
  return path;
}

class PictureFileReader : public testing::Test
{
protected:
  PictureFileReader() { this->Reader->AddObserver(vtkCommand::ErrorEvent, this->Silent); }

  std::string Read(const std::string& path)
  {
    this->Reader->SetFileName(path.c_str());
    this->Reader->Update();
    return this->Reader->GetStatusMessage();
  }
  vtkImageData* Image() { return vtkImageData::SafeDownCast(this->Reader->GetOutput()); }
  /// Return the largest difference from picture().
  double Difference()
  {
    const auto expected = picture();
    double largest = 0.0;
    for (int k = 0; k < 7 * 5 * 3; ++k)
    {
      const int x = k % 7, y = k / 7 % 5, c = k / 35;
      largest = std::max(largest,
        std::abs(this->Image()->GetScalarComponentAsDouble(x, y, 0, c) -
          expected->GetScalarComponentAsDouble(x, y, 0, c)));
    }
    return largest;
  }

  test::Folder Folder;
  vtkNew<vtkCallbackCommand> Silent;
  vtkNew<vtkPictureFileReader> Reader;
};
} // namespace

TEST_F(PictureFileReader, PixelsOfAllFormatsAreReadBack)
{
  const std::string paths[] = { write<vtkPNGWriter>(this->Folder / "a.png"),
    write<vtkBMPWriter>(this->Folder / "a.bmp"), write<vtkTIFFWriter>(this->Folder / "a.tif"),
    write<vtkJPEGWriter>(this->Folder / "a.JPG") };
  for (const std::string& path : paths)
  {
    ASSERT_EQ(this->Read(path), "") << path;
    ASSERT_EQ(this->Image()->GetDimensions()[0], 7) << path;
    ASSERT_EQ(this->Image()->GetDimensions()[1], 5) << path;
    const bool is_lossless = path.back() != 'G';
    EXPECT_LE(this->Difference(), is_lossless ? 0.0 : 40.0) << path;
  }
}

TEST_F(PictureFileReader, AChangedFileIsReadAgain)
{
  const std::string path = write<vtkPNGWriter>(this->Folder / "a.png");
  ASSERT_EQ(this->Read(path), "");
  vtkNew<vtkPNGWriter> writer;
  vtkNew<vtkImageData> smaller;
  smaller->SetDimensions(2, 3, 1);
  smaller->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  smaller->GetPointData()->GetScalars()->Fill(9.0);
  writer->SetInputData(smaller);
  writer->SetFileName(path.c_str());
  writer->Write();
  this->Reader->Modified();
  ASSERT_EQ(this->Read(path), "");
  EXPECT_EQ(this->Image()->GetDimensions()[0], 2);
  EXPECT_EQ(this->Image()->GetDimensions()[1], 3);
}

TEST_F(PictureFileReader, DamagedFilesGiveOneSentence)
{
  EXPECT_THAT(this->Read(this->Folder / "none.png"), HasSubstr("none.png cannot be read"));
  EXPECT_THAT(this->Read(this->Folder.write("x.gif", "GIF89a")), HasSubstr("gif"));
  const std::string path = write<vtkPNGWriter>(this->Folder / "a.png");
  const std::string bytes = this->Folder.read("a.png");
  for (std::size_t size = 0; size < bytes.size(); size += 11)
  {
    const std::string message = this->Read(this->Folder.write("cut.png", bytes.substr(0, size)));
    EXPECT_THAT(message, HasSubstr("cut.png")) << size;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  for (const char* extension : { "png", "jpg", "tif", "bmp" })
  {
    const std::string wrong = this->Folder.write(std::string("wrong.") + extension, "no picture");
    EXPECT_THAT(this->Read(wrong), HasSubstr("cannot be read")) << extension;
  }
}

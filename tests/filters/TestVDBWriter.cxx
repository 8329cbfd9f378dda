// vtkVDBWriter passes the image, the array and the options to the kernel. The files of the filter
// and of the kernel must be equal byte for byte. tests/core/io/test_vdb.cpp tests the content of
// the files.
#include "TestFilter.h"

#include "conversion.h"
#include "io/vdb.h"
#include "support/files.h"
#include "support/meshes.h"
#include "vtkVDBWriter.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

using namespace bindpose;
using bindpose::test::Listener;
using testing::HasSubstr;

namespace
{
class VDBWriter : public testing::Test
{
protected:
  VDBWriter()
  {
    this->Listener->listen(this->Writer);
    this->Image->SetExtent(-3, 20, 0, 9, 2, 16);
    this->Image->SetOrigin(0.5, 1.0, 2.0);
    this->Image->SetSpacing(0.1, 0.2, 0.3);
    test::Random random(5);
    vtkNew<vtkDoubleArray> values;
    values->SetName("WindingNumber");
    for (vtkIdType i = 0; i < this->Image->GetNumberOfPoints(); ++i)
    {
      this->Values.push_back(random.below(40) ? 0.0 : random.uniform());
      values->InsertNextValue(this->Values.back());
    }
    this->Image->GetPointData()->SetScalars(values);
    this->Grid.origin = Vec3(0.5, 1.0, 2.0);
    this->Grid.spacing = Vec3(0.1, 0.2, 0.3);
    this->Grid.extent = { -3, 20, 0, 9, 2, 16 };
    this->Writer->SetInputData(this->Image);
    this->Writer->SetFileName((this->Folder / "f.vdb").c_str());
    this->Writer->OverwriteOn();
  }
  std::string Expected(const VdbOptions& options)
  {
    ExecutionContext context;
    VdbOptions replacing = options;
    replacing.overwrite = true;
    EXPECT_TRUE(
      write_vdb(context, this->Folder / "expected.vdb", this->Grid, this->Values.data(), replacing)
        .ok());
    return this->Folder.read("expected.vdb");
  }
  std::string Written()
  {
    EXPECT_EQ(this->Writer->Write(), 1) << this->Writer->GetStatusMessage();
    return this->Folder.read("f.vdb");
  }
  void ExpectError(const char* word)
  {
    EXPECT_EQ(this->Writer->Write(), 0);
    EXPECT_EQ(this->Writer->GetStatus(), vtkVDBWriter::INVALID_INPUT) << word;
    EXPECT_THAT(this->Writer->GetStatusMessage(), HasSubstr(word));
    EXPECT_EQ(this->Folder.number_of_files(), 0u);
  }

  test::Folder Folder;
  SampleGrid Grid;
  std::vector<double> Values;
  vtkNew<vtkImageData> Image;
  vtkNew<vtkVDBWriter> Writer;
  vtkNew<test::Listener> Listener;
};
} // namespace

TEST_F(VDBWriter, WritesTheActiveScalarsAsTheKernelDoes)
{
  EXPECT_TRUE(this->Written() == this->Expected(VdbOptions()));
  EXPECT_THAT(this->Writer->GetReportJSON(), HasSubstr("\"active_voxels\""));
  EXPECT_TRUE(this->Listener->errors.empty());
  EXPECT_FALSE(this->Listener->progress.empty());
}

TEST_F(VDBWriter, HandsItsOptionsOn)
{
  VdbOptions options;
  options.band = VdbBand::narrow;
  options.band_width = 2;
  options.background = 1.0;
  options.threshold = 0.25;
  options.grid_name = "density";
  this->Writer->SetBand(vtkVDBWriter::NARROW);
  this->Writer->SetBandWidth(2);
  this->Writer->SetBackground(1.0);
  this->Writer->SetThreshold(0.25);
  this->Writer->SetGridName("density");
  EXPECT_TRUE(this->Written() == this->Expected(options));
  this->Writer->SetBandWidth(-4);
  EXPECT_EQ(this->Writer->GetBandWidth(), 1);
}

TEST_F(VDBWriter, KeepsTheImagesDirections)
{
  this->Image->SetDirectionMatrix(0, -1, 0, 1, 0, 0, 0, 0, 1);
  VdbOptions options;
  options.direction << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_TRUE(this->Written() == this->Expected(options));
}

TEST_F(VDBWriter, TakesArraysOfAnyNumbers)
{
  vtkNew<vtkFloatArray> floats;
  vtkNew<vtkIntArray> integers;
  floats->SetName("Floats");
  integers->SetName("Integers");
  for (double& value : this->Values)
  {
    value = static_cast<double>(static_cast<int>(10.0 * value));
    floats->InsertNextValue(static_cast<float>(value));
    integers->InsertNextValue(static_cast<int>(value));
  }
  this->Image->GetPointData()->AddArray(floats);
  this->Image->GetPointData()->AddArray(integers);
  for (const char* name : { "Floats", "Integers" })
  {
    VdbOptions options;
    // The grid has the name of the array, unless the array is the winding number.
    options.grid_name = name;
    this->Writer->SetArrayName(name);
    EXPECT_TRUE(this->Written() == this->Expected(options)) << name;
  }
}

TEST_F(VDBWriter, WritesAgainOnlyWhenAllowed)
{
  EXPECT_EQ(this->Writer->Write(), 1);
  this->Writer->OverwriteOff();
  EXPECT_EQ(this->Writer->Write(), 0);
  EXPECT_THAT(this->Writer->GetStatusMessage(), HasSubstr("the file exists"));
  EXPECT_EQ(this->Listener->errors.size(), 1u);
}

TEST_F(VDBWriter, WhatCannotBeWrittenIsOneSentence)
{
  this->Writer->SetArrayName("Density");
  this->ExpectError("no point array 'Density'");
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("Density");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(this->Image->GetNumberOfPoints());
  this->Image->GetPointData()->AddArray(vectors);
  this->ExpectError("3 components");
  this->Writer->SetArrayName(nullptr);
  this->Writer->SetFileName((this->Folder / "f.vti").c_str());
  this->ExpectError("unknown file name extension");
  this->Writer->SetFileName(nullptr);
  this->ExpectError("file name is empty");
  this->Writer->SetFileName((this->Folder / "no/f.vdb").c_str());
  this->ExpectError("No such file");
  this->Writer->SetFileName((this->Folder / "f.vdb").c_str());
  this->Image->SetSpacing(0.1, 0.0, 0.1);
  this->ExpectError("spacing");

  vtkNew<vtkImageData> bare;
  bare->SetDimensions(2, 2, 2);
  this->Writer->SetInputData(bare);
  this->ExpectError("no active scalars");
  vtkNew<vtkImageData> empty;
  this->Writer->SetInputData(empty);
  this->ExpectError("nothing to write");
  const TriangleMesh mesh = test::cube();
  this->Writer->SetInputData(to_polydata(mesh.points, mesh.triangles));
  this->ExpectError("vtkPolyData");
}

TEST_F(VDBWriter, AnAbortLeavesNothing)
{
  this->Listener->on_progress = [](vtkAlgorithm* algorithm) { algorithm->SetAbortExecute(1); };
  EXPECT_EQ(this->Writer->Write(), 0);
  EXPECT_EQ(this->Writer->GetStatus(), vtkVDBWriter::CANCELED);
  EXPECT_EQ(this->Folder.number_of_files(), 0u);
  EXPECT_TRUE(this->Listener->errors.empty());
  this->Listener->on_progress = nullptr;
  EXPECT_EQ(this->Writer->Write(), 1);
}

TEST_F(VDBWriter, PrintsAllOfItself)
{
  std::ostringstream text;
  this->Writer->SetGridName("density");
  this->Writer->SetBand(vtkVDBWriter::NARROW);
  this->Writer->Print(text);
  for (const char* word : { "FileName: ", "Overwrite: on", "ArrayName: (none)", "GridName: density",
         "Background: 0", "Band: NARROW", "BandWidth: 3", "Threshold: 0.5" })
  {
    EXPECT_THAT(text.str(), HasSubstr(word));
  }
}

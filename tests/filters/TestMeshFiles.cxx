// vtkMeshFileReader and vtkMeshFileWriter: data that is written and read back is unchanged in every
// format. A file that cannot be read or written gives one error sentence in the status and in the
// report of the empty output. It never causes a crash.
#include "data_of.h"

#include "conversion.h"
#include "report_field_data.h"
#include "vtkMeshFileReader.h"
#include "vtkMeshFileWriter.h"

#include "support/files.h"
#include "support/meshes.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
class MeshFiles : public testing::Test
{
protected:
  MeshFiles()
  {
    this->Reader->AddObserver(vtkCommand::ErrorEvent, this->Silent);
    this->Writer->AddObserver(vtkCommand::ErrorEvent, this->Silent);
  }
  vtkDataSet* Read(const std::string& path)
  {
    this->Reader->SetFileName(path.c_str());
    this->Reader->Update();
    return this->Reader->GetOutput();
  }
  std::string ReadError(const std::string& path)
  {
    this->Read(path);
    return this->Reader->GetStatusMessage();
  }
  std::string Write(vtkDataSet* data, const std::string& path)
  {
    this->Writer->SetInputData(data);
    this->Writer->SetFileName(path.c_str());
    this->Writer->Write();
    return this->Writer->GetStatusMessage();
  }

  test::Folder Folder;
  vtkNew<vtkCallbackCommand> Silent;
  vtkNew<vtkMeshFileReader> Reader;
  vtkNew<vtkMeshFileWriter> Writer;
};

vtkSmartPointer<vtkPolyData> cube_data()
{
  return test::data_of(test::cube(0.0, 1.0 / 3.0));
}

vtkSmartPointer<vtkUnstructuredGrid> tet_data()
{
  return test::data_of(test::tet_box(2, 1, 1));
}

void add_weights(vtkDataSet* data)
{
  vtkNew<vtkDoubleArray> weights;
  weights->SetName("Weights");
  weights->SetNumberOfComponents(2);
  weights->SetComponentName(0, "left hand");
  weights->SetComponentName(1, "p2");
  for (vtkIdType v = 0; v < data->GetNumberOfPoints(); ++v)
  {
    weights->InsertNextTuple2(1.0 / static_cast<double>(v + 3), 0.25);
  }
  data->GetPointData()->AddArray(weights);
}
} // namespace

TEST_F(MeshFiles, SurfacesAreReadBackInEveryFormat)
{
  const auto surface = cube_data();
  for (const std::string extension : { "off", "obj", "ply", "stl", "vtp", "vtk", "mesh", "OFF" })
  {
    SCOPED_TRACE(extension);
    const std::string path = this->Folder / ("cube." + extension);
    ASSERT_EQ(this->Write(surface, path), "");
    auto* back = vtkPolyData::SafeDownCast(this->Read(path));
    ASSERT_NE(back, nullptr);
    ASSERT_EQ(this->Reader->GetStatusMessage(), "");
    SurfaceInput input;
    ASSERT_TRUE(to_surface(back, input).ok());
    EXPECT_EQ(input.triangles.view().rows(), 12);
    EXPECT_EQ(input.points.view().rows(), 8);
    EXPECT_TRUE(count_edges(input.triangles.view()).closed);
    const double exactly = signed_volume(input.points.view(), input.triangles.view());
    EXPECT_NEAR(exactly, 1.0 / 27.0, extension == "stl" ? 1e-8 : 1e-16);
    EXPECT_EQ(read_report(back).number("counts.vertices", 0), 8);
  }
}

TEST_F(MeshFiles, PolygonsStayPolygons)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(3, 2);
  plane->Update();
  for (const std::string extension : { "off", "obj", "ply", "vtp" })
  {
    const std::string path = this->Folder / ("plane." + extension);
    ASSERT_EQ(this->Write(plane->GetOutput(), path), "");
    auto* back = this->Read(path);
    EXPECT_EQ(back->GetNumberOfCells(), 6) << extension;
    EXPECT_EQ(back->GetCellType(0), VTK_QUAD) << extension;
  }
}

TEST_F(MeshFiles, TetsAreReadBackInEveryFormat)
{
  const auto tets = tet_data();
  add_weights(tets);
  for (const std::string extension : { "vtu", "vtk", "mesh" })
  {
    SCOPED_TRACE(extension);
    const std::string path = this->Folder / ("box." + extension);
    ASSERT_EQ(this->Write(tets, path), "");
    auto* back = vtkUnstructuredGrid::SafeDownCast(this->Read(path));
    ASSERT_NE(back, nullptr);
    TetInput input;
    const Status status = to_tets(back, input);
    ASSERT_TRUE(status.ok()) << status.message;
    EXPECT_NEAR(tet_volumes(input.points.view(), input.tets.view()).sum(), 1.0, 1e-15);
    if (extension != "mesh")
    {
      vtkDataArray* weights = back->GetPointData()->GetArray("Weights");
      ASSERT_NE(weights, nullptr);
      EXPECT_STREQ(weights->GetComponentName(0), "left hand");
      EXPECT_EQ(weights->GetComponent(4, 0), 1.0 / 7.0);
    }
  }
}

TEST_F(MeshFiles, ImagesKeepOriginSpacingAndExtent)
{
  vtkNew<vtkImageData> image;
  image->SetExtent(-1, 2, 0, 3, 2, 4);
  image->SetOrigin(0.5, 1, 2);
  image->SetSpacing(0.1, 0.1, 0.1);
  vtkNew<vtkDoubleArray> values;
  values->SetName("WindingNumber");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    values->InsertNextValue(static_cast<double>(i) / 3.0);
  }
  image->GetPointData()->SetScalars(values);
  ASSERT_EQ(this->Write(image, this->Folder / "field.vti"), "");
  auto* back = vtkImageData::SafeDownCast(this->Read(this->Folder / "field.vti"));
  ASSERT_NE(back, nullptr);
  EXPECT_EQ(back->GetNumberOfPoints(), image->GetNumberOfPoints());
  for (int k = 0; k < 6; ++k)
  {
    EXPECT_EQ(back->GetExtent()[k], image->GetExtent()[k]);
  }
  EXPECT_EQ(back->GetOrigin()[0], 0.5);
  EXPECT_EQ(back->GetPointData()->GetArray("WindingNumber")->GetComponent(7, 0), 7.0 / 3.0);
}

TEST_F(MeshFiles, ReportsSurviveFiles)
{
  const auto surface = cube_data();
  Report report;
  report.set("status", "ok");
  report.set("message", "");
  report.set("counts.handles", 2);
  report.set("handles[].name", Report::Value(std::vector<std::string>{ "left hand", "" }));
  report.set("relative_gap", Report::Value(0.125));
  attach_report(surface, report);
  vtkNew<vtkStringArray> names;
  names->SetName("Names");
  for (int i = 0; i < 12; ++i)
  {
    names->InsertNextValue(i % 2 ? "" : std::string(static_cast<std::size_t>(i), 'x'));
  }
  surface->GetCellData()->AddArray(names);
  ASSERT_EQ(this->Write(surface, this->Folder / "c.vtp"), "");
  auto* back = this->Read(this->Folder / "c.vtp");
  ASSERT_EQ(this->Reader->GetStatusMessage(), "");
  auto* texts = vtkStringArray::SafeDownCast(back->GetCellData()->GetAbstractArray("Names"));
  ASSERT_NE(texts, nullptr);
  ASSERT_EQ(texts->GetNumberOfValues(), 12);
  EXPECT_EQ(texts->GetValue(10), std::string(10, 'x'));
  EXPECT_EQ(texts->GetValue(11), "");
}

TEST_F(MeshFiles, DmatHoldsTheWeights)
{
  const auto surface = cube_data();
  EXPECT_THAT(this->Write(surface, this->Folder / "w.dmat"), HasSubstr("no point array 'Weights'"));
  add_weights(surface);
  ASSERT_EQ(this->Write(surface, this->Folder / "w.dmat"), "");
  EXPECT_EQ(this->Folder.read("w.dmat").substr(0, 4), "2 8\n");
}

TEST_F(MeshFiles, TheReaderFollowsItsFileName)
{
  this->Write(cube_data(), this->Folder / "a.off");
  this->Write(tet_data(), this->Folder / "b.vtu");
  EXPECT_EQ(this->Read(this->Folder / "a.off")->GetNumberOfCells(), 12);
  EXPECT_TRUE(this->Read(this->Folder / "b.vtu")->IsA("vtkUnstructuredGrid"));
  EXPECT_EQ(this->Reader->GetStatus(), vtkMeshFileReader::OK);
  EXPECT_NE(this->ReadError(this->Folder / "none.off"), "");
  EXPECT_EQ(this->Reader->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(this->Reader->GetStatus(), vtkMeshFileReader::INVALID_INPUT);
  EXPECT_EQ(this->Read(this->Folder / "a.off")->GetNumberOfCells(), 12);
}

TEST_F(MeshFiles, AFileThatIsMendedIsReadAgain)
{
  EXPECT_THAT(this->ReadError(this->Folder / "late.off"), HasSubstr("No such file"));
  this->Write(cube_data(), this->Folder / "late.off");
  // No parameter has changed. The reader executes again because its last execution failed.
  this->Reader->Update();
  EXPECT_EQ(this->Reader->GetOutput()->GetNumberOfCells(), 12);
}

TEST_F(MeshFiles, UnreadableFilesAreOneSentence)
{
  for (const std::string extension :
    { "off", "obj", "ply", "stl", "vtp", "vtu", "vti", "vtk", "mesh" })
  {
    SCOPED_TRACE(extension);
    EXPECT_THAT(this->ReadError(this->Folder / ("none." + extension)), HasSubstr("No such file"));
    EXPECT_THAT(this->ReadError(this->Folder.write("e." + extension, "")), HasSubstr("is empty"));
    for (const std::string& text : { std::string("this is no mesh at all\nreally\n"),
           std::string(300, '\xff'), std::string("\n") })
    {
      const std::string message = this->ReadError(this->Folder.write("wrong." + extension, text));
      EXPECT_THAT(message, HasSubstr("wrong." + extension)) << text;
      EXPECT_EQ(message.find('\n'), std::string::npos);
      EXPECT_EQ(this->Reader->GetOutput()->GetNumberOfPoints(), 0);
      EXPECT_EQ(read_report(this->Reader->GetOutput()).text("status"), "invalid_input");
    }
  }
  EXPECT_THAT(
    this->ReadError(this->Folder.write("mesh.xyz", "1")), HasSubstr("unknown file name extension"));
  EXPECT_THAT(
    this->ReadError(this->Folder.write("mesh", "1")), HasSubstr("no file name extension"));
  EXPECT_THAT(this->ReadError(""), HasSubstr("file name is empty"));
}

TEST_F(MeshFiles, TruncatedAndGarbledFilesNeverCrash)
{
  const auto surface = cube_data();
  const auto tets = tet_data();
  add_weights(surface);
  add_weights(tets);
  test::Random random(3);
  for (const std::string extension : { "stl", "vtp", "vtu", "vtk" })
  {
    SCOPED_TRACE(extension);
    const std::string name = "whole." + extension;
    vtkDataSet* data = surface;
    if (extension == "vtu")
    {
      data = tets;
    }
    ASSERT_EQ(this->Write(data, this->Folder / name), "");
    const std::string whole = this->Folder.read(name);
    for (int round = 0; round < 120; ++round)
    {
      std::string text = whole;
      if (round % 2)
      {
        text.resize(static_cast<std::size_t>(random.below(static_cast<Index>(whole.size()))));
      }
      else
      {
        text[random.below(static_cast<Index>(text.size()))] = static_cast<char>(random.below(256));
      }
      auto* back = this->Read(this->Folder.write("part." + extension, text));
      if (this->Reader->GetStatus() == vtkMeshFileReader::OK)
      {
        SurfaceInput input;
        EXPECT_TRUE(to_surface(back, input).ok() || back->GetNumberOfPoints() > 0);
      }
      else
      {
        EXPECT_EQ(back->GetNumberOfPoints(), 0);
        EXPECT_THAT(this->Reader->GetStatusMessage(), HasSubstr("part." + extension));
      }
    }
  }
}

TEST_F(MeshFiles, WhatCannotBeWrittenIsOneSentence)
{
  const auto surface = cube_data();
  const std::string path = this->Folder / "x.off";
  EXPECT_THAT(this->Write(surface, ""), HasSubstr("file name is empty"));
  EXPECT_THAT(
    this->Write(surface, this->Folder / "x.abc"), HasSubstr("unknown file name extension"));
  EXPECT_THAT(this->Write(surface, this->Folder / "no/x.vtp"), HasSubstr("No such file"));
  EXPECT_THAT(this->Write(surface, this->Folder / "x.vtu"), HasSubstr("vtkPolyData"));
  EXPECT_THAT(this->Write(surface, this->Folder / "x.vti"), HasSubstr("volumes"));
  EXPECT_THAT(this->Write(tet_data(), this->Folder / "x.vtp"), HasSubstr("vtkUnstructuredGrid"));
  EXPECT_THAT(this->Write(tet_data(), path), HasSubstr("no triangles"));
  vtkNew<vtkPolyData> empty;
  EXPECT_THAT(this->Write(empty, path), HasSubstr("nothing to write"));
  EXPECT_EQ(this->Folder.number_of_files(), 0u);

  ASSERT_EQ(this->Write(surface, path), "");
  EXPECT_THAT(this->Write(surface, path), HasSubstr("the file exists"));
  EXPECT_EQ(this->Writer->Write(), 0);
  this->Writer->OverwriteOn();
  EXPECT_EQ(this->Writer->Write(), 1);
  EXPECT_EQ(this->Folder.number_of_files(), 1u);
}

TEST_F(MeshFiles, PointsThatAreNotFiniteAreNotWritten)
{
  for (const double bad : { std::nan(""), HUGE_VAL })
  {
    const auto surface = cube_data();
    surface->GetPoints()->SetPoint(6, 0.0, bad, 0.0);
    const std::string path = this->Folder / "bad.vtp";
    EXPECT_THAT(this->Write(surface, path), HasSubstr("coordinate y of point 6 is not finite"));
    EXPECT_FALSE(std::filesystem::exists(path));
    // A point that no cell uses may have coordinates that are not finite. Such a point is written.
    const vtkIdType unused = surface->GetPoints()->InsertNextPoint(bad, 0.0, 0.0);
    surface->GetPoints()->SetPoint(6, 0.0, 0.0, 0.0);
    EXPECT_EQ(this->Write(surface, path), "");
    EXPECT_EQ(this->Read(path)->GetNumberOfPoints(), unused + 1);
    std::filesystem::remove(path);
  }
}

TEST_F(MeshFiles, TheWriterRepeatsWhatFailedUpstream)
{
  this->Reader->SetFileName((this->Folder / "none.off").c_str());
  this->Writer->SetInputConnection(this->Reader->GetOutputPort());
  this->Writer->SetFileName((this->Folder / "out.vtp").c_str());
  EXPECT_EQ(this->Writer->Write(), 0);
  EXPECT_THAT(this->Writer->GetStatusMessage(), HasSubstr("none.off"));
  EXPECT_EQ(this->Folder.number_of_files(), 0u);
}

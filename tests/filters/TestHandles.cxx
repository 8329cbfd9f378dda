// Handle datasets: read from files and texts, and placed automatically on a surface.
#include "conversion.h"
#include "handle_tgf.h"
#include "pseudo_edge_cells.h"
#include "report_field_data.h"
#include "vtkFarthestPointHandles.h"
#include "vtkHandleFileReader.h"
#include "vtkMeshFileWriter.h"
#include "vtkPlacedHandles.h"

#include "support/files.h"
#include "support/handles.h"
#include "support/meshes.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

using namespace bindpose;
using testing::HasSubstr;

namespace
{
class HandleFiles : public testing::Test
{
protected:
  HandleFiles() { this->Reader->AddObserver(vtkCommand::ErrorEvent, this->Silent); }
  Handles Read(const std::string& path)
  {
    this->Reader->SetFileName(path.c_str());
    this->Reader->Update();
    Handles handles;
    to_handles(vtkPolyData::SafeDownCast(this->Reader->GetOutput()), handles);
    return handles;
  }
  std::string ReadError(const std::string& text)
  {
    EXPECT_TRUE(this->Read(this->Folder.write("h.tgf", text)).empty());
    return this->Reader->GetStatusMessage();
  }

  test::Folder Folder;
  vtkNew<vtkCallbackCommand> Silent;
  vtkNew<vtkHandleFileReader> Reader;
};

class PlacedHandles : public testing::Test
{
protected:
  PlacedHandles()
  {
    this->source->AddObserver(vtkCommand::ErrorEvent, this->silent);
    this->source->AddObserver(vtkCommand::WarningEvent, this->silent);
  }
  vtkPolyData* place(const std::string& text)
  {
    this->source->SetHandlesText(text);
    this->source->Update();
    return vtkPolyData::SafeDownCast(this->source->GetOutput());
  }

  vtkNew<vtkCallbackCommand> silent;
  vtkNew<vtkPlacedHandles> source;
};
} // namespace

TEST_F(HandleFiles, TgfGivesPointsThenBones)
{
  const Handles handles = this->Read(this->Folder.write(
    "h.tgf", "1 0 0 0\n2 1 0 0\n3 2 0 0\n4 5 5 5 left hand\n5 6 6 6\n6 2 1 0\n#\n2 3\n1 2\n2 6\n"));
  ASSERT_EQ(this->Reader->GetStatusMessage(), "");
  ASSERT_EQ(handles.size(), 5u);
  const char* names[] = { "left hand", "p2", "b1", "b2", "b3" };
  const Index parents[] = { -1, -1, 3, -1, 3 };
  for (int i = 0; i < 5; ++i)
  {
    EXPECT_EQ(handles[i].name, names[i]);
    EXPECT_EQ(handles[i].parent, parents[i]) << names[i];
    EXPECT_EQ(handles[i].kind, i < 2 ? HandleKind::point : HandleKind::bone);
  }
  EXPECT_EQ(handles[2].head, Vec3(1, 0, 0));
  EXPECT_EQ(handles[2].tail, Vec3(2, 0, 0));
  EXPECT_THAT(this->Reader->GetReportJSON(), HasSubstr("\"left hand\""));
}

TEST_F(HandleFiles, TgfPseudoEdgesJoinPoints)
{
  const auto pseudo_edges_of = [this](const std::string& path, PseudoEdges& edges)
  {
    this->Read(path);
    auto* data = vtkPolyData::SafeDownCast(this->Reader->GetOutput());
    Handles handles;
    std::vector<Index> cells;
    EXPECT_TRUE(to_handles(data, handles, &cells).ok());
    EXPECT_EQ(handles.size(), 3u) << "they are no handles";
    return to_pseudo_edges(data, handles, cells, edges);
  };
  PseudoEdges edges;
  const std::string path = this->Folder.write(
    "h.tgf", "1 0 0 0\n2 1 0 0\n3 2 0 0\n4 5 5 5\n#\n1 2 0 1 0\n3 4 1 0 0\n2 1 0 1 0\n");
  EXPECT_TRUE(pseudo_edges_of(path, edges).ok());
  ASSERT_EQ(this->Reader->GetStatusMessage(), "");
  EXPECT_EQ(edges, (PseudoEdges{ { 0, 1 } })) << "each once";
  // The format .vtp stores all kinds of handles and also pseudo-edges.
  vtkNew<vtkPolyData> copy;
  copy->DeepCopy(this->Reader->GetOutput());
  vtkNew<vtkMeshFileWriter> writer;
  writer->SetInputData(copy);
  writer->SetFileName((this->Folder / "h.vtp").c_str());
  ASSERT_EQ(writer->Write(), 1);
  EXPECT_TRUE(pseudo_edges_of(this->Folder / "h.vtp", edges).ok());
  EXPECT_EQ(edges, (PseudoEdges{ { 0, 1 } }));
  // Pseudo-edges must connect point handles, not ends of bones.
  const vtkIdType at_a_bone[2] = { 0, 2 };
  copy->GetLines()->InsertNextCell(2, at_a_bone);
  vtkDataArray* kinds = copy->GetCellData()->GetArray("HandleKind");
  const double kind = pseudo_edge_kind;
  const vtkIdType cell = kinds->InsertNextTuple(&kind);
  vtkNew<vtkPolyData> broken;
  broken->SetPoints(copy->GetPoints());
  broken->SetVerts(copy->GetVerts());
  broken->SetLines(copy->GetLines());
  broken->GetCellData()->AddArray(kinds);
  Handles handles;
  std::vector<Index> cells;
  ASSERT_TRUE(to_handles(broken, handles, &cells).ok());
  EXPECT_THAT(to_pseudo_edges(broken, handles, cells, edges).message,
    HasSubstr("handle cell " + std::to_string(cell) + " is a pseudo-edge"));
}

TEST_F(HandleFiles, VtpKeepsNamesParentsAndPose)
{
  this->Read(this->Folder.write("h.tgf", "1 0 0 0\n2 1 0 0\n3 2 0 0\n4 5 5 5 tip\n#\n1 2\n2 3\n"));
  vtkNew<vtkPolyData> posed;
  posed->ShallowCopy(this->Reader->GetOutput());
  Pose pose(3);
  pose[1].mode = HandleMode::position;
  pose[2].transform(0, 3) = 1.0 / 3.0;
  pose[2].stretch = 2.0;
  set_pose(posed, { 0, 1, 2 }, pose);
  vtkNew<vtkMeshFileWriter> writer;
  writer->SetInputData(posed);
  writer->SetFileName((this->Folder / "h.vtp").c_str());
  ASSERT_EQ(writer->Write(), 1);

  const Handles handles = this->Read(this->Folder / "h.vtp");
  ASSERT_EQ(this->Reader->GetStatusMessage(), "");
  ASSERT_EQ(handles.size(), 3u);
  EXPECT_EQ(handles[0].name, "tip");
  EXPECT_EQ(handles[1].name, "b1");
  EXPECT_EQ(handles[2].name, "b2");
  EXPECT_EQ(handles[2].parent, 1);
  Pose back;
  ASSERT_TRUE(
    to_pose(vtkPolyData::SafeDownCast(this->Reader->GetOutput()), handles, { 0, 1, 2 }, back).ok());
  EXPECT_EQ(back[1].mode, HandleMode::position);
  EXPECT_EQ(back[2].transform(0, 3), 1.0 / 3.0);
  EXPECT_EQ(back[2].stretch, 2.0);
}

TEST_F(HandleFiles, PlainVtpGetsTheMissingArrays)
{
  this->Read(this->Folder.write("h.tgf", "1 0 0 0\n2 1 0 0\n3 5 5 5\n#\n1 2\n"));
  vtkNew<vtkPolyData> plain;
  plain->CopyStructure(this->Reader->GetOutput());
  vtkNew<vtkMeshFileWriter> writer;
  writer->SetInputData(plain);
  writer->SetFileName((this->Folder / "plain.vtp").c_str());
  ASSERT_EQ(writer->Write(), 1);
  const Handles handles = this->Read(this->Folder / "plain.vtp");
  ASSERT_EQ(handles.size(), 2u);
  EXPECT_EQ(handles[1].name, "b1");
  for (const char* name :
    { "HandleName", "HandleKind", "Parent", "RegionId", "Mode", "Transform", "Stretch", "Twist" })
  {
    EXPECT_NE(this->Reader->GetOutput()->GetCellData()->GetAbstractArray(name), nullptr) << name;
  }
}

TEST_F(HandleFiles, UnusableHandlesAreNamed)
{
  EXPECT_THAT(this->ReadError("1 0 0 0\n2 0 0 0\n#\n"), HasSubstr("'p1' and 'p2'"));
  EXPECT_THAT(this->ReadError("1 0 0 0 a\n2 1 0 0 a\n#\n"), HasSubstr("named 'a'"));
  EXPECT_THAT(this->ReadError("1 0 0 0\n2 0 0 0\n#\n1 2\n"), HasSubstr("length zero"));
  EXPECT_THAT(this->ReadError("1 0 0 0\n2 1 0 0\n3 0 1 0\n#\n1 2\n2 3\n3 1\n"),
    HasSubstr("its own ancestor"));
  EXPECT_THAT(this->ReadError("1 0 zero 0\n"), HasSubstr("h.tgf, line 1"));
  EXPECT_TRUE(this->Read(this->Folder / "none.tgf").empty());
  EXPECT_THAT(this->Reader->GetStatusMessage(), HasSubstr("No such file"));
  EXPECT_TRUE(this->Read(this->Folder.write("h.json", "{}")).empty());
  EXPECT_THAT(this->Reader->GetStatusMessage(), HasSubstr("unknown file name extension"));
  EXPECT_TRUE(this->Read(this->Folder.write("broken.vtp", "<VTKFile")).empty());
  EXPECT_THAT(this->Reader->GetStatusMessage(), HasSubstr("broken.vtp"));
  const TriangleMesh mesh = test::cube();
  vtkNew<vtkMeshFileWriter> writer;
  writer->SetInputData(to_polydata(mesh.points, mesh.triangles));
  writer->SetFileName((this->Folder / "cube.vtp").c_str());
  ASSERT_EQ(writer->Write(), 1);
  EXPECT_TRUE(this->Read(this->Folder / "cube.vtp").empty());
  EXPECT_THAT(this->Reader->GetStatusMessage(), HasSubstr("3 points"));
}

TEST_F(PlacedHandles, AreThoseOfAFileWithTheSameText)
{
  const std::string text = "1 0 0 0\n2 1 0 0\n3 2 0 0\n4 5 5 5 left hand\n5 6 6 6\n6 7 6 6\n"
                           "7 7 7 6\n#\n2 3 1 0 0\n1 2 1 0 0\n4 5 0 1 0\n6 7 0 0 1\n";
  vtkPolyData* placed = this->place(text);
  ASSERT_EQ(this->source->GetStatus(), vtkPlacedHandles::OK) << this->source->GetStatusMessage();
  const test::Folder folder;
  vtkNew<vtkHandleFileReader> reader;
  reader->SetFileName(folder.write("h.tgf", text).c_str());
  reader->Update();
  auto* from_file = vtkPolyData::SafeDownCast(reader->GetOutput());
  ASSERT_EQ(placed->GetNumberOfCells(), from_file->GetNumberOfCells());
  Handles handles, expected;
  std::vector<Index> cells;
  ASSERT_TRUE(to_handles(placed, handles, &cells).ok());
  ASSERT_TRUE(to_handles(from_file, expected).ok());
  ASSERT_EQ(handles.size(), 6u);
  ASSERT_EQ(expected.size(), 6u);
  for (std::size_t i = 0; i < handles.size(); ++i)
  {
    EXPECT_EQ(handles[i].name, expected[i].name);
    EXPECT_EQ(handles[i].kind, expected[i].kind);
    EXPECT_EQ(handles[i].parent, expected[i].parent);
    EXPECT_EQ(handles[i].head, expected[i].head);
    EXPECT_EQ(handles[i].tail, expected[i].tail);
    EXPECT_EQ(handles[i].cage, expected[i].cage);
  }
  PseudoEdges edges;
  EXPECT_TRUE(to_pseudo_edges(placed, handles, cells, edges).ok());
  EXPECT_EQ(edges, (PseudoEdges{ { 0, 1 } }));
  EXPECT_EQ(read_report(placed).number("counts.handles", 0), 6);

  // to_tgf() converts the dataset to a text from which vtkPlacedHandles makes the same handles.
  std::string again;
  ASSERT_TRUE(to_tgf(placed, again).ok());
  std::string third;
  ASSERT_TRUE(to_tgf(this->place(again), third).ok());
  EXPECT_EQ(again, third);
  Handles same;
  ASSERT_TRUE(to_handles(vtkPolyData::SafeDownCast(this->source->GetOutput()), same).ok());
  ASSERT_EQ(same.size(), 6u);
  EXPECT_EQ(same[0].name, "left hand");
  EXPECT_EQ(same[5].head, handles[5].head);
  EXPECT_EQ(same[4].parent, handles[4].parent);
}

TEST_F(PlacedHandles, MayBeNone)
{
  for (const char* text : { "", " \r\n\n" })
  {
    EXPECT_EQ(this->place(text)->GetNumberOfCells(), 0);
    EXPECT_EQ(this->source->GetStatus(), vtkPlacedHandles::OK);
    EXPECT_EQ(read_report(this->source->GetOutput()).number("counts.handles", -1), 0);
  }
  std::string text = "not empty";
  EXPECT_TRUE(to_tgf(static_cast<vtkPolyData*>(nullptr), text).ok());
  EXPECT_EQ(text, "");
}

TEST_F(PlacedHandles, MessagesBeginWithTheirText)
{
  EXPECT_EQ(this->place("1 0 0 0\n2 zero 0 0\n")->GetNumberOfCells(), 0);
  EXPECT_EQ(this->source->GetStatus(), vtkPlacedHandles::INVALID_INPUT);
  EXPECT_EQ(this->source->GetStatusMessage(),
    "the text of the handles: line 2: node 2 must have three numbers as coordinates");
  this->place("1 0 0 0 a\n2 1 0 0 a\n");
  EXPECT_THAT(this->source->GetStatusMessage(), testing::StartsWith("the text of the handles: "));
  EXPECT_THAT(this->source->GetStatusMessage(), HasSubstr("named 'a'"));
  EXPECT_EQ(this->place("1 0 0 0\n2 1 0 0\n#\n1 2 0 0 0\n")->GetNumberOfCells(), 2);
  EXPECT_EQ(this->source->GetStatus(), vtkPlacedHandles::OK);
  EXPECT_EQ(this->source->GetNumberOfWarnings(), 1);
  EXPECT_THAT(this->source->GetReportJSON(),
    HasSubstr("the text of the handles: 1 edges are ignored because"));
  std::ostringstream text;
  this->source->Print(text);
  EXPECT_THAT(text.str(), HasSubstr("HandlesText: 1 0 0 0"));
}

TEST(HandlesAsTgfText, OfRegionsAreRefused)
{
  std::string text = "not empty";
  const Status status = to_tgf(to_polydata(Handles{ test::region_handle("hip", 3) }), text);
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_THAT(status.message, HasSubstr("region handle 'hip'"));
  EXPECT_EQ(text, "");
}

TEST(FarthestPointHandles, LieOnTheSurface)
{
  const TriangleMesh mesh = test::cube();
  vtkNew<vtkFarthestPointHandles> filter;
  vtkNew<vtkCallbackCommand> silent;
  filter->AddObserver(vtkCommand::ErrorEvent, silent);
  filter->SetInputData(to_polydata(mesh.points, mesh.triangles));
  filter->SetNumberOfHandles(3);
  filter->Update();
  Handles handles;
  ASSERT_TRUE(to_handles(vtkPolyData::SafeDownCast(filter->GetOutput()), handles).ok());
  ASSERT_EQ(handles.size(), 3u);
  EXPECT_EQ(handles[0].name, "p1");
  EXPECT_EQ(handles[0].head, Vec3(mesh.points.row(0)));
  EXPECT_EQ(handles[1].head, Vec3(mesh.points.row(7)));
  filter->SetNumberOfHandles(9);
  filter->Update();
  EXPECT_EQ(filter->GetStatus(), vtkFarthestPointHandles::INVALID_INPUT);
  EXPECT_THAT(filter->GetStatusMessage(), HasSubstr("only 8"));
  filter->SetNumberOfHandles(8);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 8);
}

TEST(FarthestPointHandles, LieOnTheBoundaryOfTets)
{
  const TetMesh box = test::tet_box(4, 4, 4);
  vtkNew<vtkFarthestPointHandles> filter;
  filter->SetInputData(to_unstructured_grid(box.points, box.tets));
  filter->SetNumberOfHandles(98); // 98 of the 125 vertices are on the boundary
  filter->Update();
  ASSERT_EQ(filter->GetStatus(), vtkFarthestPointHandles::OK);
  Handles handles;
  ASSERT_TRUE(to_handles(vtkPolyData::SafeDownCast(filter->GetOutput()), handles).ok());
  for (const Handle& handle : handles)
  {
    const Eigen::Array3d p = handle.head.array();
    EXPECT_TRUE((p == 0.0).any() || (p == 1.0).any()) << handle.name;
  }
}

// Edits of handle datasets in place. Array values stay with their handles, unchanged arrays cause
// no new bind, and rejected edits change nothing.
#include "conversion.h"
#include "handle_edit_cells.h"
#include "support/meshes.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

using namespace bindpose;
using testing::ElementsAre;

namespace
{
Handle make(const std::string& name, HandleKind kind, const Vec3& head, const Vec3& tail)
{
  Handle handle;
  handle.name = name;
  handle.kind = kind;
  handle.head = head;
  handle.tail = tail;
  return handle;
}

// Return handles. The cells are the points p and q, the bone b, and a pseudo-edge from p to q.
vtkSmartPointer<vtkPolyData> handles()
{
  const Handles list = { make("p", HandleKind::point, Vec3(0, 0, 0), Vec3(0, 0, 0)),
    make("b", HandleKind::bone, Vec3(1, 0, 0), Vec3(2, 0, 0)),
    make("q.L", HandleKind::point, Vec3(3, 1, 0), Vec3(3, 1, 0)) };
  auto data = to_polydata(list);
  for (const auto& [name, first] : { std::pair{ "Stretch", 2.0 }, { "own", 10.0 } })
  {
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    for (int i = 0; i < 3; ++i)
    {
      array->InsertNextValue(first + i);
    }
    data->GetCellData()->AddArray(array);
  }
  return data;
}

double number(vtkPolyData* data, const char* name, vtkIdType cell, int component = 0)
{
  return data->GetCellData()->GetArray(name)->GetComponent(cell, component);
}

std::vector<std::string> names(vtkPolyData* data)
{
  auto* array = vtkStringArray::SafeDownCast(data->GetCellData()->GetAbstractArray("HandleName"));
  std::vector<std::string> list;
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    list.push_back(array->GetValue(i));
  }
  return list;
}
} // namespace

TEST(HandleEditCells, ArraysFollowTheirHandles)
{
  const auto data = handles();
  set_handle_color(data, 2, std::array<double, 3>{ 1.0, 0.5, 0.0 });
  set_handle_locked(data, 1, true);
  set_handle_layer(data, 2, -1.5);
  std::vector<Index> new_cell;
  std::vector<Index> added;
  ASSERT_TRUE(edit_handles(
    data,
    [](const Handles& before, EditedHandles& after) {
      return add_handle(before, make("", HandleKind::point, Vec3(9, 9, 9), Vec3(9, 9, 9)), after);
    },
    &new_cell, &added)
                .ok());
  EXPECT_THAT(names(data), ElementsAre("p", "q.L", "p1", "b")) << "bones come last";
  EXPECT_THAT(new_cell, ElementsAre(0, 1, 3));
  EXPECT_THAT(added, ElementsAre(2));
  EXPECT_EQ(number(data, "Stretch", 0), 2.0);
  EXPECT_EQ(number(data, "Layer", 3), -1.5);
  EXPECT_EQ(number(data, "Layer", 2), 0.0);
  EXPECT_EQ(number(data, "Stretch", 1), 3.0);
  EXPECT_EQ(number(data, "Stretch", 2), 1.0) << "new ones are at rest";
  EXPECT_EQ(number(data, "Stretch", 3), 4.0);
  EXPECT_EQ(number(data, "own", 3), 12.0);
  EXPECT_EQ(number(data, "own", 2), 0.0);
  EXPECT_EQ(number(data, "Color", 3, 1), 0.5);
  EXPECT_TRUE(std::isnan(number(data, "Color", 2, 1))) << "none of its own";
  EXPECT_EQ(number(data, "Locked", 1), 1.0);
  EXPECT_EQ(number(data, "Locked", 2), 0.0);
  set_handle_color(data, 3, std::nullopt);
  EXPECT_TRUE(std::isnan(number(data, "Color", 3, 0)));
}

TEST(HandleEditCells, CopiesAreAtRestButLookAlike)
{
  const auto data = handles();
  set_handle_color(data, 1, std::array<double, 3>{ 0.0, 0.0, 1.0 });
  ASSERT_TRUE(edit_handles(data,
    [](const Handles& before, EditedHandles& after) {
      return mirror_handles(before, { 1 }, Vec3::Zero(), Vec3::UnitX(), after);
    }).ok());
  EXPECT_THAT(names(data), ElementsAre("p", "q.L", "q.R", "b"));
  EXPECT_EQ(number(data, "Color", 2, 2), 1.0);
  EXPECT_EQ(number(data, "own", 2), 11.0);
  EXPECT_EQ(number(data, "Stretch", 2), 1.0);
}

TEST(HandleEditCells, ARefusedEditChangesNothing)
{
  const auto data = handles();
  const std::vector<vtkObject*> before = bind_objects(data);
  const vtkMTimeType time = data->GetMTime();
  const Status status = edit_handles(data,
    [](const Handles& list, EditedHandles& after) { return rename_handle(list, 0, "b", after); });
  EXPECT_EQ(status.code, StatusCode::invalid_input);
  EXPECT_EQ(bind_objects(data), before);
  EXPECT_EQ(data->GetMTime(), time);
}

TEST(HandleEditCells, FromNothingAndBackToNothing)
{
  vtkNew<vtkPolyData> data;
  ASSERT_TRUE(edit_handles(data,
    [](const Handles& before, EditedHandles& after) {
      return add_handle(before, make("a", HandleKind::point, Vec3(1, 2, 3), Vec3::Zero()), after);
    }).ok());
  Handles list;
  ASSERT_TRUE(to_handles(data, list).ok());
  EXPECT_EQ(list[0].head, Vec3(1, 2, 3));
  EXPECT_EQ(list[0].tail, Vec3(1, 2, 3));
  ASSERT_TRUE(edit_handles(data,
    [](const Handles& before, EditedHandles& after) {
      return remove_handles(before, { 0 }, after);
    }).ok());
  EXPECT_EQ(data->GetNumberOfCells(), 0);
  EXPECT_EQ(data->GetNumberOfPoints(), 0);
}

TEST(HandleEditCells, RemovedParentsAndBackAgainIsTheSameDataset)
{
  // Undo restores the old dataset with its array objects, so the filter does not bind again.
  const auto data = handles();
  vtkNew<vtkPolyData> before;
  before->ShallowCopy(data);
  const std::vector<vtkObject*> objects = bind_objects(data);
  ASSERT_TRUE(edit_handles(data,
    [](const Handles& list, EditedHandles& after) {
      return remove_handles(list, { 1 }, after);
    }).ok());
  EXPECT_NE(bind_objects(data), objects);
  data->ShallowCopy(before);
  EXPECT_EQ(bind_objects(data), objects);
}

// The document of the window: undo restores the work bit by bit after any edits, and weights stay
// with their handles.
#include "work_test.h"

#include "document/autosave.h"
#include "save_loop.h"

#include "handle_edit_cells.h"

#include "vtkCellData.h"
#include "vtkIntArray.h"
#include "vtkUnsignedCharArray.h"

#include <QCoreApplication>
#include <QUndoStack>

#include <gtest/gtest.h>

#include <random>

using namespace bindpose;
using test::ball;
using test::fingerprint;
using test::open_bound_document;
using test::three_handles;

namespace
{
class Editing : public testing::Test
{
protected:
  /// Expect that the edit is one undo step. Undo and redo must restore all bits of the states
  /// before and after the edit.
  template <typename Edit>
  void expect_undo_step(const char* name, const Edit& edit)
  {
    SCOPED_TRACE(name);
    QUndoStack* history = this->document.history();
    const int steps = history->index();
    const std::string before = fingerprint(this->document);
    edit();
    const std::string after = fingerprint(this->document);
    EXPECT_NE(after, before);
    ASSERT_EQ(history->index(), steps + 1);
    EXPECT_EQ(history->undoText().toStdString(), name);
    history->undo();
    EXPECT_EQ(fingerprint(this->document), before);
    history->redo();
    EXPECT_EQ(fingerprint(this->document), after);
  }

  vtkStringArray* names()
  {
    return vtkStringArray::SafeDownCast(
      this->document.handle_data()->GetCellData()->GetAbstractArray("HandleName"));
  }

  void rename(int cell, const char* name)
  {
    this->names()->SetValue(cell, name);
    this->names()->DataChanged();
  }

  /// Replace the handles during an edit, as the handle widget does.
  void replace_handles(const Handles& handles)
  {
    this->document.editable_handles()->DeepCopy(to_polydata(handles));
  }

  Document document;
};
} // namespace

TEST_F(Editing, EveryEditIsAStepThatUndoTakesBackBitByBit)
{
  Document& d = this->document;
  this->expect_undo_step("open ball", [&] { ASSERT_TRUE(d.set_mesh(ball(), "ball").ok()); });
  this->expect_undo_step("open handles h.tgf",
    [&] { ASSERT_TRUE(d.set_handles(to_polydata(three_handles()), "h.tgf").ok()); });
  this->expect_undo_step("bind", [&] { test::bind(d, 0.0); });
  EXPECT_TRUE(d.is_bound());
  this->expect_undo_step("bind", [&] { test::bind(d, 1.0); });
  this->expect_undo_step("move top",
    [&]
    {
      // Edit the transforms in place, then commit the edit, as the handle widget does.
      vtkDataArray* transforms = d.handle_data()->GetCellData()->GetArray("Transform");
      transforms->SetComponent(1, 3, 0.1);
      transforms->SetComponent(1, 7, 1.0 / 3.0);
      transforms->Modified();
      d.commit_pose("move top");
    });
  this->expect_undo_step("mode of spine", [&] { d.set_mode(2, 1); });
  this->expect_undo_step("back to rest", [&] { d.reset_to_rest(); });
  this->expect_undo_step("rename",
    [&]
    {
      this->rename(0, "foot");
      ASSERT_TRUE(d.commit_handles("rename").ok());
    });
  this->expect_undo_step("color",
    [&]
    {
      vtkNew<vtkUnsignedCharArray> colors;
      colors->SetName("Color");
      colors->SetNumberOfComponents(3);
      colors->SetNumberOfTuples(3);
      colors->FillValue(200);
      d.handle_data()->GetCellData()->AddArray(colors);
      ASSERT_TRUE(d.commit_handles("color").ok());
    });
  this->expect_undo_step("lock",
    [&]
    {
      vtkNew<vtkIntArray> locked;
      locked->SetName("Locked");
      locked->SetNumberOfTuples(3);
      locked->FillValue(1);
      d.handle_data()->GetCellData()->AddArray(locked);
      ASSERT_TRUE(d.commit_handles("lock").ok());
    });
  this->expect_undo_step("move foot at rest",
    [&]
    {
      d.handle_data()->GetPoints()->SetPoint(0, 0.1, 0.2, -0.7);
      ASSERT_TRUE(d.commit_handles("move foot at rest").ok());
    });
  this->expect_undo_step("add p4",
    [&]
    {
      Handles more = three_handles();
      more.resize(4);
      more[3].name = "p4";
      more[3].head = more[3].tail = Vec3(0.5, 0, 0);
      this->replace_handles(more);
      ASSERT_TRUE(d.commit_handles("add p4").ok());
    });
  this->expect_undo_step("delete top",
    [&]
    {
      Handles fewer = three_handles();
      fewer.erase(fewer.begin() + 1);
      fewer[0].parent = 1;
      this->replace_handles(fewer);
      ASSERT_TRUE(d.commit_handles("delete top").ok());
    });
  this->expect_undo_step("delete all",
    [&]
    {
      d.editable_handles()->Initialize();
      ASSERT_TRUE(d.commit_handles("delete all").ok());
      EXPECT_EQ(d.handle_data(), nullptr);
    });
  this->expect_undo_step("pose method", [&] { d.set_option("pose.method", 2); });
  this->expect_undo_step("type of weights", [&] { d.set_option("bind.method", 1); });
  this->expect_undo_step("displayed weights", [&] { d.set_option("show.column", 1); });
  this->expect_undo_step("bands", [&] { d.set_option("weights.bands", false); });
  this->expect_undo_step("keep a pose",
    [&]
    {
      Pose pose(3);
      pose[0].stretch = 1.1;
      StoredPoses stored_poses;
      stored_poses.library.store("wave", NamedPose(three_handles(), pose));
      stored_poses.keys.set(0.1, NamedPose(three_handles(), pose));
      d.set_stored_poses(stored_poses, "keep a pose");
    });
  this->expect_undo_step("open other", [&] { ASSERT_TRUE(d.set_mesh(ball(), "other").ok()); });
  this->expect_undo_step("open handles again",
    [&] { ASSERT_TRUE(d.set_handles(to_polydata(three_handles()), "again").ok()); });
  this->expect_undo_step("open weights w.dmat",
    [&]
    {
      ASSERT_TRUE(
        d.set_weights(test::some_weights(d.surface()->GetNumberOfPoints(), 3, 2.0), "w.dmat").ok());
      EXPECT_TRUE(d.is_bound());
    });
  // Undo all steps, then redo them.
  const std::string last = fingerprint(d);
  while (d.history()->canUndo())
  {
    d.history()->undo();
  }
  EXPECT_EQ(fingerprint(d), fingerprint(Document()));
  while (d.history()->canRedo())
  {
    d.history()->redo();
  }
  EXPECT_EQ(fingerprint(d), last);
}

TEST_F(Editing, WhatChangesNothingIsNoStep)
{
  open_bound_document(this->document);
  const int steps = this->document.history()->count();
  this->document.set_option("pose.method", 0);
  this->document.commit_pose("move nothing");
  this->document.reset_to_rest();
  this->document.set_mode(0, static_cast<int>(HandleMode::automatic));
  EXPECT_EQ(this->document.history()->count(), steps);
}

TEST_F(Editing, ARenamedHandleKeepsItsPoses)
{
  open_bound_document(this->document);
  Document& d = this->document;
  Pose stored_pose(3);
  stored_pose[0].stretch = 1.1;
  StoredPoses stored_poses;
  stored_poses.library.store("wave", NamedPose(d.handles(), stored_pose));
  stored_poses.keys.set(0.1, NamedPose(d.handles(), stored_pose));
  d.set_stored_poses(stored_poses, "keep a pose");
  const std::string name = d.handles()[0].name;
  const QString step = "rename " + QString::fromStdString(name);
  this->expect_undo_step(step.toUtf8(), [&] { ASSERT_TRUE(d.rename_handle(0, "foot").ok()); });
  EXPECT_EQ(d.handles()[0].name, "foot");
  EXPECT_TRUE(d.is_bound());
  EXPECT_EQ(
    d.work().stored_poses->library.entries()[0].pose.for_handles(d.handles(), Pose(3))[0].stretch,
    1.1);
  EXPECT_EQ(d.work().stored_poses->keys.pose_at(0.1, d.handles(), Pose(3))[0].stretch, 1.1);
  const std::string before = fingerprint(d);
  const int steps = d.history()->count();
  for (const char* bad : { "", "top" })
  {
    EXPECT_FALSE(d.rename_handle(0, bad).ok());
    EXPECT_EQ(fingerprint(d), before);
  }
  EXPECT_TRUE(d.rename_handle(0, "foot").ok());
  EXPECT_EQ(d.history()->count(), steps);
}

TEST_F(Editing, PaintedRegionsAreAStepAndARebindIsOffered)
{
  open_bound_document(this->document);
  Document& d = this->document;
  const vtkIdType count = d.surface()->GetNumberOfPoints();
  vtkNew<vtkIntArray> labels;
  labels->SetNumberOfTuples(count);
  labels->Fill(0);
  labels->SetValue(3, 1);
  const auto with_region = [&]
  {
    Handles more = three_handles();
    more.resize(4);
    more[3].name = "r1";
    more[3].kind = HandleKind::region;
    more[3].region_id = 1;
    more[3].head = more[3].tail = Vec3(0.3, 0.2, 0.1);
    this->replace_handles(more);
  };
  this->expect_undo_step("paint region r1",
    [&]
    {
      with_region();
      ASSERT_TRUE(d.commit_regions(labels, "paint region r1").ok());
    });
  EXPECT_TRUE(d.is_bound());
  EXPECT_FALSE(d.rebind_reason().isEmpty()); // a handle is new
  test::bind(d, 2.0);
  EXPECT_TRUE(d.rebind_reason().isEmpty());
  labels->SetValue(4, 1);
  this->expect_undo_step(
    "paint region r1", [&] { ASSERT_TRUE(d.commit_regions(labels, "paint region r1").ok()); });
  // The labels were painted; the handles have not changed.
  EXPECT_TRUE(d.rebind_reason().contains("painted"));
  d.history()->undo();
  EXPECT_TRUE(d.rebind_reason().isEmpty());
  d.history()->redo();
  test::bind(d, 3.0);
  EXPECT_TRUE(d.rebind_reason().isEmpty());
  // Labels that are painted during a bind are kept. The weights do not include them.
  d.begin_bind();
  const auto bound = test::with_weights(d.work().surface, d.bound_handles(), 4.0);
  labels->SetValue(5, 1);
  ASSERT_TRUE(d.commit_regions(labels, "paint region r1").ok());
  ASSERT_TRUE(d.set_bound(bound, nullptr));
  EXPECT_EQ(d.surface()->GetPointData()->GetArray("RegionId")->GetComponent(5, 0), 1.0);
  EXPECT_TRUE(d.rebind_reason().contains("painted"));
  // Labels are refused if they belong to a mesh with another number of points.
  labels->SetNumberOfTuples(count + 1);
  const std::string before = fingerprint(d);
  EXPECT_FALSE(d.commit_regions(labels, "paint").ok());
  EXPECT_EQ(fingerprint(d), before);
}

TEST_F(Editing, OptionsTakeOnlyWhatTheyCanHave)
{
  const Options before = this->document.work().options;
  this->document.set_option("no.such", 1);
  this->document.set_option("weights.bands", 3);
  this->document.set_option("weights.what", 3);
  this->document.set_option("weights.what", 0.5);
  this->document.set_option("tets.shrink", std::nan(""));
  this->document.set_option("tets.shrink", "wide");
  EXPECT_EQ(this->document.work().options, before);
  EXPECT_EQ(this->document.history()->count(), 0);
}

TEST_F(Editing, AMovedSliderIsOneStep)
{
  QUndoStack* history = this->document.history();
  for (const double size : { 0.9, 0.8, 0.7 })
  {
    this->document.set_option("tets.shrink", size);
  }
  EXPECT_EQ(history->count(), 1);
  this->document.end_merge(); // the user releases the slider and moves it again
  this->document.set_option("tets.shrink", 0.5);
  this->document.set_option("tets.shrink", 0.4);
  EXPECT_EQ(history->count(), 2);
  history->undo();
  EXPECT_EQ(this->document.option("tets.shrink").toDouble(), 0.7);
  history->undo();
  EXPECT_EQ(this->document.option("tets.shrink").toDouble(), 1.0);
  // Changes of an option with a list of choices do not merge into one undo step.
  this->document.set_option("pose.method", 1);
  this->document.set_option("pose.method", 2);
  history->undo();
  EXPECT_EQ(this->document.number("pose.method"), 1);
}

TEST_F(Editing, ASliderMovedBackIsNoStep)
{
  this->document.set_option("tets.shrink", 0.5);
  this->document.set_option("tets.shrink", 1.0);
  EXPECT_EQ(this->document.history()->count(), 0);
}

TEST_F(Editing, WhatTheProgramChoseSurvivesUndo)
{
  this->document.set_option("weights.bands", false);
  this->document.set_option_without_undo("weights.column", 2);
  this->document.history()->undo();
  EXPECT_EQ(this->document.number("weights.column"), 2);
  EXPECT_TRUE(this->document.option("weights.bands").toBool());
}

TEST_F(Editing, WhatIsNotedOfAnEqualNumberLeavesItsBits)
{
  this->document.set_option("weights.place", 0.25);
  const QVariant before = this->document.option("weights.place");
  const double rounded_value = 0.25 + 4e-16; // a panel can return this rounded value
  ASSERT_NE(rounded_value, before.toDouble());
  this->document.set_option("weights.place", rounded_value);
  this->document.set_option_without_undo("weights.place", rounded_value);
  EXPECT_EQ(this->document.history()->count(), 1);
  EXPECT_EQ(this->document.option("weights.place").toDouble(), before.toDouble());
  // a value that really differs is accepted
  this->document.set_option_without_undo("weights.place", 0.26);
  EXPECT_EQ(this->document.option("weights.place").toDouble(), 0.26);
}

TEST_F(Editing, WhatAViewDoesDuringUndoAndRedoIsNoStep)
{
  Document& d = this->document;
  open_bound_document(d);
  d.set_option("tets.shrink", 0.5);
  d.end_merge();
  d.set_mode(0, 1);
  d.set_option("weights.isolines", false);
  const int steps = d.history()->count();
  int calls = 0;
  QObject::connect(&d, &Document::changed, &d,
    [&d, &calls]
    {
      // The listener sets another value, as a widget might.
      d.set_option("pose.method", ++calls % 3);
      d.set_option("tets.shrink", 0.9);
    });
  d.history()->setIndex(0);
  d.history()->setIndex(steps); // a new step during a redo would delete the step that is redone
  d.history()->undo();
  d.history()->redo();
  EXPECT_GT(calls, steps);
  EXPECT_EQ(d.history()->count(), steps);
  EXPECT_EQ(d.history()->index(), steps);
  EXPECT_EQ(d.number("pose.method"), 0);
  EXPECT_EQ(d.option("tets.shrink").toDouble(), 0.5);
}

TEST_F(Editing, LayersColorsAndLocksAreHowHandlesLook)
{
  test::open_bound_document(this->document);
  int parts = 0;
  QObject::connect(&this->document, &Document::changed, [&](int changed) { parts |= changed; });
  const auto expect_looks = [&](const char* when)
  {
    EXPECT_EQ(parts, handle_looks_part) << when;
    parts = 0;
  };
  const Work before = this->document.work();
  set_handle_layer(this->document.handle_data(), this->document.handle_cells()[1], 2.0);
  ASSERT_TRUE(this->document.commit_handles("layer").ok());
  expect_looks("layer");
  set_handle_locked(this->document.handle_data(), this->document.handle_cells()[0], true);
  ASSERT_TRUE(this->document.commit_handles("lock").ok());
  expect_looks("lock");
  this->document.history()->undo();
  expect_looks("undo");
  vtkDataArray* layers = this->document.handle_data()->GetCellData()->GetArray("Layer");
  ASSERT_NE(layers, nullptr);
  EXPECT_EQ(layers->GetComponent(this->document.handle_cells()[1], 0), 2.0);
  this->document.history()->undo();
  expect_looks("undo of all");
  EXPECT_EQ(fingerprint(this->document.work()), fingerprint(before));
  EXPECT_FALSE(this->document.handle_data()->GetCellData()->HasArray("Layer"));
  // A new name or a new position changes a handle itself, not only its appearance.
  this->rename(0, "foot");
  ASSERT_TRUE(this->document.commit_handles("rename").ok());
  EXPECT_TRUE(parts & handles_part);
}

TEST_F(Editing, AnEditThatCannotBeUsedIsTakenBack)
{
  open_bound_document(this->document);
  const std::string before = fingerprint(this->document);
  this->rename(0, "top"); // another handle has this name
  const Status status = this->document.commit_handles("rename");
  EXPECT_FALSE(status.ok());
  EXPECT_NE(status.message.find("top"), std::string::npos) << status.message;
  EXPECT_EQ(fingerprint(this->document), before);
  this->document.handle_data()->GetPoints()->SetPoint(0, 1, 2, 3);
  this->document.revert_handles();
  EXPECT_EQ(fingerprint(this->document), before);
}

TEST_F(Editing, ABadMeshOrBadHandlesLeaveTheWork)
{
  open_bound_document(this->document);
  const std::string before = fingerprint(this->document);
  vtkNew<vtkPolyData> nothing;
  EXPECT_FALSE(this->document.set_mesh(nothing, "nothing").ok());
  EXPECT_FALSE(this->document.set_handles(nothing, "nothing").ok());
  EXPECT_FALSE(this->document.set_weights(Weights::Zero(3, 3), "short.dmat").ok());
  EXPECT_EQ(fingerprint(this->document), before);
}

// ---- Weights and handles that have changed -----------------------------------------------------

TEST_F(Editing, WeightsFollowTheirHandlesByName)
{
  open_bound_document(this->document);
  vtkNew<vtkDoubleArray> bound;
  bound->DeepCopy(this->document.surface()->GetPointData()->GetArray("Weights"));
  EXPECT_EQ(this->document.rebind_reason(), "");
  // Rename the first handle, add a new one, and remove "top".
  const Handles before = three_handles();
  Handles new_handles{ before[0], before[0], before[2] };
  new_handles[0].parent = new_handles[1].parent = new_handles[2].parent = -1;
  new_handles[0].name = "foot";
  new_handles[1].name = "new";
  new_handles[1].head = new_handles[1].tail = Vec3(0.5, 0.5, 0);
  this->replace_handles(new_handles);
  ASSERT_TRUE(this->document.commit_handles("edit").ok());
  ASSERT_TRUE(this->document.is_bound());
  vtkDataArray* weights = this->document.surface()->GetPointData()->GetArray("Weights");
  ASSERT_EQ(weights->GetNumberOfComponents(), 3);
  EXPECT_STREQ(weights->GetComponentName(0), "foot");
  for (vtkIdType v = 0; v < weights->GetNumberOfTuples(); ++v)
  {
    ASSERT_EQ(weights->GetComponent(v, 0), bound->GetComponent(v, 0));
    ASSERT_EQ(weights->GetComponent(v, 1), 0.0);
    ASSERT_EQ(weights->GetComponent(v, 2), bound->GetComponent(v, 2));
  }
  const QString reason = this->document.rebind_reason();
  EXPECT_NE(reason.indexOf("1 handle was added"), -1) << reason.toStdString();
  EXPECT_NE(reason.indexOf("1 handle was removed"), -1) << reason.toStdString();
  test::bind(this->document, 3.0);
  EXPECT_EQ(this->document.rebind_reason(), "");
}

TEST_F(Editing, AMovedHandleKeepsItsWeightsAndARebindIsOffered)
{
  open_bound_document(this->document);
  const std::string weights = fingerprint(this->document.work());
  this->document.handle_data()->GetPoints()->SetPoint(0, 0.1, 0.2, -0.7);
  ASSERT_TRUE(this->document.commit_handles("move").ok());
  EXPECT_TRUE(this->document.is_bound());
  EXPECT_EQ(this->document.rebind_reason(), "Since the last bind, 1 handle was moved.");
  this->document.history()->undo();
  EXPECT_EQ(this->document.rebind_reason(), "");
  // After a change of a pose or of a name, no new bind is required.
  this->rename(0, "foot");
  ASSERT_TRUE(this->document.commit_handles("rename").ok());
  this->document.set_mode(1, 2);
  EXPECT_EQ(this->document.rebind_reason(), "");
  EXPECT_STREQ(
    this->document.surface()->GetPointData()->GetArray("Weights")->GetComponentName(0), "foot");
}

TEST_F(Editing, AnotherMeshHasNoWeightsAndUndoBringsThemBack)
{
  open_bound_document(this->document);
  ASSERT_TRUE(this->document.set_mesh(ball(), "other").ok());
  EXPECT_FALSE(this->document.is_bound());
  EXPECT_NE(this->document.rebind_reason(), "");
  this->document.history()->undo();
  EXPECT_TRUE(this->document.is_bound());
  EXPECT_EQ(this->document.rebind_reason(), "");
}

TEST_F(Editing, WeightsOfAMeshThatIsGoneAreNotTaken)
{
  open_bound_document(this->document);
  this->document.begin_bind();
  const auto late_result = test::with_weights(this->document.surface(), three_handles(), 4.0);
  ASSERT_TRUE(this->document.set_mesh(ball(), "other").ok());
  const std::string before = fingerprint(this->document);
  EXPECT_FALSE(this->document.set_preview(late_result));
  EXPECT_FALSE(this->document.set_bound(late_result, nullptr));
  EXPECT_EQ(fingerprint(this->document), before);
}

TEST_F(Editing, APreviewIsNoStepAndPosesWork)
{
  this->document.set_mesh(ball(), "ball");
  this->document.set_handles(to_polydata(three_handles()), "handles");
  const std::string before = fingerprint(this->document);
  const int steps = this->document.history()->count();
  this->document.begin_bind();
  ASSERT_TRUE(
    this->document.set_preview(test::with_weights(this->document.surface(), three_handles(), 0.0)));
  EXPECT_TRUE(this->document.is_bound());
  EXPECT_EQ(this->document.history()->count(), steps);
  this->document.set_mode(0, 1);
  EXPECT_TRUE(this->document.is_bound());
  this->document.history()->undo();
  this->document.drop_preview();
  EXPECT_EQ(fingerprint(this->document), before);
}

// ---- Random edits ------------------------------------------------------------------------------

TEST(FuzzDocument, UndoOfEverythingIsTheBeginningAndRedoTheEnd)
{
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto pick = [&random](int count) { return static_cast<int>(random() % count); };
    const auto number = [&random] { return std::uniform_real_distribution<>(-1, 1)(random); };
    Document document;
    document.set_mesh(ball(), "ball");
    document.set_handles(to_polydata(three_handles()), "handles");
    document.history()->clear();
    // Fingerprint of the document after each step.
    std::vector<std::string> states{ fingerprint(document) };
    for (int edit = 0; edit < 60; ++edit)
    {
      const int handles = static_cast<int>(document.handles().size());
      switch (pick(12))
      {
        case 0:
          test::bind(document, number());
          break;
        case 1:
          document.set_mesh(ball(), QString("mesh %1").arg(edit));
          break;
        case 2:
          document.set_option("pose.method", pick(3));
          break;
        case 3:
          document.set_option("tets.shrink", 0.1 + 0.1 * pick(10));
          break;
        case 4:
          document.set_option("weights.isolines", pick(2) == 0);
          break;
        case 5:
          document.reset_to_rest();
          break;
        case 6:
          document.set_mode(pick(handles), pick(3));
          break;
        case 7: // drag a handle; the drag ends or is canceled
        {
          const Pose before = document.pose();
          vtkDataArray* transforms = document.handle_data()->GetCellData()->GetArray("Transform");
          transforms->SetComponent(pick(handles), pick(12), number());
          transforms->Modified();
          if (pick(3) == 0)
          {
            set_pose(document.handle_data(), document.handle_cells(), before);
          }
          document.commit_pose("move");
          break;
        }
        case 8: // move a handle at rest
          document.handle_data()->GetPoints()->SetPoint(pick(handles), number(), number(), 9.0);
          document.handle_data()->GetPoints()->Modified();
          document.commit_handles("move at rest");
          break;
        case 9: // add a handle
        {
          Handles more = document.handles();
          more.resize(more.size() + 1);
          more.back().name = "handle " + std::to_string(edit);
          more.back().head = more.back().tail = Vec3(number(), number(), number());
          document.editable_handles()->DeepCopy(to_polydata(more));
          document.commit_handles("add");
          break;
        }
        case 10: // undo some steps, then redo them
          for (int k = pick(4); k > 0 && document.history()->canUndo(); --k)
          {
            document.history()->undo();
            EXPECT_EQ(fingerprint(document), states[document.history()->index()]);
          }
          break;
        default:
        {
          StoredPoses stored_poses;
          stored_poses.keys.set(std::abs(number()), NamedPose(document.handles(), document.pose()));
          document.set_stored_poses(stored_poses, "keep");
          break;
        }
      }
      states.resize(document.history()->count() + 1);
      states[document.history()->index()] = fingerprint(document);
    }
    while (document.history()->canUndo())
    {
      document.history()->undo();
      ASSERT_EQ(fingerprint(document), states[document.history()->index()]);
    }
    while (document.history()->canRedo())
    {
      document.history()->redo();
      ASSERT_EQ(fingerprint(document), states[document.history()->index()]);
    }
  }
}

int main(int argc, char** argv)
{
  QCoreApplication application(argc, argv);
  if (argc == 3 && std::string(argv[1]) == "--save-for-ever")
  {
    return test::save_until_killed(argv[2]);
  }
  if (argc == 3 && std::string(argv[1]) == "--autosave-for-ever")
  {
    return test::autosave_until_killed(argv[2]);
  }
  if (argc == 3 && std::string(argv[1]) == "--change-for-ever")
  {
    return test::change_until_killed(argv[2]);
  }
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

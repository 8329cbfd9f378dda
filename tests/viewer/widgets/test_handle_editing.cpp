// Edit modes of the handle widget: the effect of clicks and drags, and the resulting positions. The
// dataset must be valid after every step.
#include "widget_stage.h"

#include "support/meshes.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkStringArray.h"

using namespace bindpose;
using namespace bindpose::test;

namespace
{
// A stage with a ball of radius 1 around the origin, viewed from +z. By default it has no handles.
class EditStage : public Stage
{
public:
  explicit EditStage(int mode, const Handles& list = {}, bool with_ball = true)
    : Stage(list.empty() ? vtkSmartPointer<vtkPolyData>::New() : to_polydata(list))
  {
    const TriangleMesh ball = sphere(3);
    this->surface = bindpose::to_polydata(ball.points, ball.triangles);
    if (with_ball)
    {
      this->representation()->SetSurface(this->surface);
    }
    this->widget->SetEditMode(mode);
    this->widget->AddObserver(vtkCommand::PlacePointEvent, this->counter);
    this->widget->AddObserver(vtkCommand::WarningEvent, this->counter);
    this->widget->AddObserver(vtkCommand::StateChangedEvent, this->counter);
    this->window->Render();
  }
  void click(const Vec3& at)
  {
    this->press(at);
    this->release(at);
  }
  // Return the handles that the filters read from the dataset.
  Handles list()
  {
    Handles result;
    const Status status = to_handles(this->handles, result);
    EXPECT_TRUE(status.ok()) << status.message;
    return result;
  }
  vtkSmartPointer<vtkPolyData> surface;
};

const double position_tolerance =
  2.5 * pixel_length; // tolerance for one pixel and for the facets of the ball
} // namespace

TEST(HandleEditing, PointsGoToMidThickness)
{
  EditStage stage(Representation::ADD_POINTS);
  stage.click(Vec3(0.3, 0.2, 0));
  Handles handles = stage.list();
  ASSERT_EQ(handles.size(), 1u);
  EXPECT_EQ(handles[0].name, "p1");
  EXPECT_EQ(handles[0].kind, HandleKind::point);
  // The view ray through the mouse intersects the ball in a chord. The new point is the middle of
  // this chord, which is the point of the ray that is nearest to the center.
  const Vec3 sight = (handles[0].head - Vec3(0, 0, 10)).normalized();
  EXPECT_LT(std::abs(handles[0].head.dot(sight)), 0.02) << "in the center plane across the ray";
  EXPECT_LT((stage.display(handles[0].head) - stage.display(Vec3(0.3, 0.2, 0))).norm(), 1.0);
  EXPECT_EQ(stage.representation()->GetSelectedHandle(), 0);
  EXPECT_EQ(stage.representation()->GetInteractionName(), "add point");
  EXPECT_EQ(stage.events[vtkCommand::PlacePointEvent], 1);
  EXPECT_EQ(stage.events[vtkCommand::StartInteractionEvent], 1);
  EXPECT_EQ(stage.events[vtkCommand::InteractionEvent], 1);
  EXPECT_EQ(stage.events[vtkCommand::EndInteractionEvent], 1);
  EXPECT_FALSE(stage.widget->GetCanceled());

  stage.representation()->PlaceInsideOff();
  stage.click(Vec3(-0.3, 0.2, 0));
  handles = stage.list();
  ASSERT_EQ(handles.size(), 2u);
  EXPECT_NEAR(handles[1].head.norm(), 1.0, 0.01) << "on the surface";
  EXPECT_GT(handles[1].head[2], 0.5) << "on the side of the eye";
  EXPECT_EQ(handles[1].name, "p2");
}

TEST(HandleEditing, BesideTheSurfaceTheCameraHasTheMouse)
{
  EditStage stage(Representation::ADD_POINTS);
  const Vec3 before(stage.renderer->GetActiveCamera()->GetPosition());
  stage.drag(Vec3(-1.8, -1.8, 0), Vec3(-1.2, -1.8, 0));
  EXPECT_GT((Vec3(stage.renderer->GetActiveCamera()->GetPosition()) - before).norm(), 0.1);
  EXPECT_EQ(stage.handles->GetNumberOfCells(), 0);
}

TEST(HandleEditing, APointIsWhereTheButtonIsReleasedAndEscapeMakesNone)
{
  EditStage stage(Representation::ADD_POINTS);
  stage.drag(Vec3(-0.5, 0, 0), Vec3(0.5, 0, 0));
  ASSERT_EQ(stage.list().size(), 1u);
  EXPECT_GT(stage.list()[0].head[0], 0.4);
  stage.press(Vec3(0, 0.5, 0));
  stage.move(Vec3(0, 0.4, 0));
  stage.escape();
  EXPECT_TRUE(stage.widget->GetCanceled());
  stage.release(Vec3(0, 0.4, 0));
  EXPECT_EQ(stage.list().size(), 1u);
  EXPECT_EQ(stage.widget->GetEditMode(), Representation::ADD_POINTS)
    << "only the placing is canceled";
  stage.escape();
  EXPECT_EQ(stage.widget->GetEditMode(), Representation::POSE);
  EXPECT_EQ(stage.events[vtkCommand::StateChangedEvent], 1);
}

TEST(HandleEditing, TwoPointsAtOnePlaceAreRefused)
{
  EditStage stage(Representation::ADD_POINTS);
  stage.click(Vec3(0.3, 0.2, 0));
  stage.click(Vec3(0.3, 0.2, 0));
  EXPECT_EQ(stage.list().size(), 1u);
  EXPECT_EQ(stage.events[vtkCommand::WarningEvent], 1);
  EXPECT_NE(stage.representation()->GetEditMessage().find("same position"), std::string::npos);
  EXPECT_TRUE(stage.widget->GetCanceled());
  stage.click(Vec3(-0.3, 0.2, 0));
  EXPECT_EQ(stage.events[vtkCommand::WarningEvent], 1) << "said once";
}

TEST(HandleEditing, CtrlSnapsToVerticesOfTheSurface)
{
  EditStage stage(Representation::ADD_POINTS);
  stage.set_modifiers(false, true);
  stage.click(Vec3(0.31, 0.22, 0));
  const Vec3 head_position = stage.list()[0].head;
  double nearest = 1.0;
  for (vtkIdType v = 0; v < stage.surface->GetNumberOfPoints(); ++v)
  {
    nearest = std::min(nearest, (Vec3(stage.surface->GetPoint(v)) - head_position).norm());
  }
  EXPECT_EQ(nearest, 0.0);
}

TEST(HandleEditing, BonesAreDrawnAndContinueChains)
{
  EditStage stage(Representation::ADD_BONES);
  stage.drag(Vec3(-0.6, 0, 0), Vec3(0, 0.1, 0));
  Handles handles = stage.list();
  ASSERT_EQ(handles.size(), 1u);
  EXPECT_EQ(handles[0].kind, HandleKind::bone);
  EXPECT_EQ(handles[0].name, "b1");
  EXPECT_EQ(handles[0].parent, -1);
  EXPECT_LT((stage.display(handles[0].head) - stage.display(Vec3(-0.6, 0, 0))).norm(), 1.0);
  EXPECT_LT((stage.display(handles[0].tail) - stage.display(Vec3(0, 0.1, 0))).norm(), 1.0);
  // The next drag begins near the tail of the bone and adds a child, whose head snaps to this tail.
  // The drag ends outside of the shape, so the tail of the child gets the depth of its head.
  const Vec3 tail = handles[0].tail;
  stage.drag(tail + Vec3(2 * pixel_length, 0, 0), Vec3(1.6, 0.4, tail[2]));
  handles = stage.list();
  ASSERT_EQ(handles.size(), 2u);
  EXPECT_EQ(handles[1].parent, 0);
  EXPECT_EQ(handles[1].head, tail);
  EXPECT_LT((handles[1].tail - Vec3(1.6, 0.4, tail[2])).norm(), position_tolerance);
  // Add a second child at the joint, and a child at the head of the root.
  stage.drag(tail, Vec3(0, -0.6, 0));
  stage.drag(handles[0].head, Vec3(-0.6, 0.5, 0));
  handles = stage.list();
  ASSERT_EQ(handles.size(), 4u);
  EXPECT_EQ(handles[2].parent, 0);
  EXPECT_EQ(handles[2].head, tail);
  EXPECT_EQ(handles[3].parent, 0);
  EXPECT_EQ(handles[3].head, handles[0].head);
  EXPECT_EQ(stage.representation()->GetInteractionName(), "add bone");
  // A click does not add a bone.
  stage.click(Vec3(0.4, -0.4, 0));
  EXPECT_EQ(stage.list().size(), 4u);
  EXPECT_TRUE(stage.widget->GetCanceled());
}

TEST(HandleEditing, ATailSnapsToOtherEndsWithCtrl)
{
  EditStage stage(Representation::ADD_BONES, { point("p", Vec3(0.4, 0.4, 0.3)) });
  stage.set_modifiers(false, true);
  stage.press(Vec3(-0.4, 0, 0));
  stage.set_modifiers(false, false);
  stage.release(Vec3(-0.4, 0, 0)); // a click does not add a bone
  stage.press(Vec3(-0.4, 0, 0));
  stage.set_modifiers(false, true);
  stage.move(Vec3(0.4, 0.4, 0.3) + Vec3(3 * pixel_length, 0, 0));
  stage.release(Vec3(0.4, 0.4, 0.3) + Vec3(3 * pixel_length, 0, 0));
  ASSERT_EQ(stage.list().size(), 2u);
  EXPECT_EQ(stage.list()[1].tail, Vec3(0.4, 0.4, 0.3));
}

TEST(HandleEditing, PosesColorsAndSelectionFollowTheirHandles)
{
  // A new point precedes the bone in the order of the cells, so the index of the bone changes.
  EditStage stage(Representation::ADD_POINTS, { bone("b", Vec3(-0.5, 0, 0), Vec3(0.2, 0, 0)) });
  const double t[3] = { 0.5, 0.25, 0 };
  stage.representation()->SetHandleTranslation(0, t);
  stage.representation()->SetHandleStretch(0, 1.25);
  vtkNew<vtkDoubleArray> own_array;
  own_array->SetName("Weight of my own");
  own_array->InsertNextValue(42.0);
  stage.handles->GetCellData()->AddArray(own_array);
  stage.handles->GetCellData()->GetArray("Mode")->SetComponent(0, 0, 1);
  stage.representation()->SetSelectedHandle(0);
  stage.click(Vec3(0.3, 0.5, 0));
  ASSERT_EQ(stage.handles->GetNumberOfCells(), 2);
  EXPECT_EQ(stage.representation()->GetHandleName(1), "b");
  EXPECT_EQ(stage.transform(0), identity_affine());
  double translation[3];
  stage.representation()->GetHandleTranslation(1, translation);
  EXPECT_EQ(Vec3(translation), Vec3(t));
  EXPECT_EQ(stage.representation()->GetHandleStretch(1), 1.25);
  EXPECT_EQ(stage.representation()->GetHandleStretch(0), 1.0);
  EXPECT_EQ(stage.representation()->GetHandleMode(1), 1);
  EXPECT_EQ(stage.representation()->GetHandleMode(0), static_cast<int>(HandleMode::automatic));
  EXPECT_EQ(stage.handles->GetCellData()->GetArray("Weight of my own")->GetComponent(1, 0), 42.0);
  EXPECT_EQ(stage.representation()->GetSelectedHandle(), 0) << "the new one";
}

TEST(HandleEditing, CagesAreClickedAndClosed)
{
  EditStage stage(Representation::ADD_CAGE);
  const Vec3 corners[4] = { Vec3(-1.4, -1.4, 0), Vec3(1.4, -1.4, 0), Vec3(1.4, 1.4, 0),
    Vec3(-1.4, 1.4, 0) };
  for (int k = 0; k < 4; ++k)
  {
    stage.click(corners[k]);
    const Handles handles = stage.list();
    ASSERT_EQ(handles.size(), static_cast<std::size_t>(k + 1));
    EXPECT_EQ(handles.back().kind, HandleKind::cage_vertex);
    EXPECT_LT((handles.back().head - corners[k]).norm(), position_tolerance);
    EXPECT_EQ(stage.handles->GetNumberOfLines(), k) << "edges";
  }
  EXPECT_TRUE(stage.representation()->IsMakingCage());
  stage.click(corners[0]);
  EXPECT_FALSE(stage.representation()->IsMakingCage()) << "closed";
  EXPECT_EQ(stage.list().size(), 4u);
  EXPECT_EQ(stage.handles->GetNumberOfLines(), 4);
  EXPECT_EQ(stage.representation()->GetInteractionName(), "close cage");
  vtkDataArray* kinds = stage.handles->GetCellData()->GetArray("HandleKind");
  ASSERT_EQ(kinds->GetNumberOfTuples(), 8);
  for (vtkIdType cell = 0; cell < 8; ++cell)
  {
    EXPECT_EQ(kinds->GetComponent(cell, 0), cell < 4 ? 2 : -1);
  }
  EXPECT_EQ(stage.events[vtkCommand::PlacePointEvent], 5);
}

TEST(HandleEditing, EscapeDropsVerticesAndEnterLeavesACageOpen)
{
  EditStage stage(Representation::ADD_CAGE);
  stage.click(Vec3(-1.4, -1.4, 0));
  stage.click(Vec3(1.4, -1.4, 0));
  stage.click(Vec3(1.4, 1.4, 0));
  stage.escape();
  EXPECT_EQ(stage.list().size(), 2u);
  EXPECT_EQ(stage.handles->GetNumberOfLines(), 1);
  EXPECT_EQ(stage.representation()->GetInteractionName(), "remove cage vertex");
  stage.click(Vec3(0, 1.5, 0));
  stage.key("Return");
  EXPECT_FALSE(stage.representation()->IsMakingCage());
  EXPECT_EQ(stage.list().size(), 3u);
  EXPECT_EQ(stage.handles->GetNumberOfLines(), 2);
  // Continue the cage from any vertex. A double click ends the cage.
  stage.click(Vec3(0, 1.5, 0));
  EXPECT_TRUE(stage.representation()->IsMakingCage());
  stage.click(Vec3(-1.5, 1.0, 0));
  const Eigen::Vector2d at = stage.display(Vec3(-1.5, 1.0, 0));
  stage.interactor->SetEventInformation(
    static_cast<int>(at[0]), static_cast<int>(at[1]), 0, 0, 0, 1);
  stage.interactor->InvokeEvent(vtkCommand::LeftButtonPressEvent);
  EXPECT_FALSE(stage.representation()->IsMakingCage());
  EXPECT_EQ(stage.list().size(), 4u);
  EXPECT_EQ(stage.handles->GetNumberOfLines(), 3);
  stage.escape();
  EXPECT_EQ(stage.widget->GetEditMode(), Representation::POSE);
  EXPECT_EQ(stage.list().size(), 4u);
}

TEST(HandleEditing, ACageGoesOnFromWhatAnUndoHasLeft)
{
  EditStage stage(Representation::ADD_CAGE, {}, false);
  stage.click(Vec3(-1, -1, 0));
  vtkNew<vtkPolyData> one;
  one->ShallowCopy(stage.handles);
  stage.click(Vec3(1, -1, 0));
  stage.handles->ShallowCopy(one);
  stage.click(Vec3(0, 1, 0));
  ASSERT_EQ(stage.list().size(), 2u);
  EXPECT_EQ(stage.handles->GetNumberOfLines(), 1) << "joined to the first";
  vtkNew<vtkPolyData> none;
  stage.handles->ShallowCopy(none);
  stage.click(Vec3(0, 0, 0));
  EXPECT_EQ(stage.list().size(), 1u);
  EXPECT_EQ(stage.handles->GetNumberOfLines(), 0);
}

TEST(HandleEditing, RestPlacesMoveUnderTheMouse)
{
  EditStage stage(Representation::MOVE_REST, { point("p", Vec3(0.5, 0.5, 0.2)) });
  const double t[3] = { 0, -1, 0 };
  // The handle has a translation in the pose, but it is shown and dragged at its rest position.
  stage.representation()->SetHandleTranslation(0, t);
  stage.drag(Vec3(0.5, 0.5, 0.2), Vec3(-0.5, 0.75, 0.2));
  EXPECT_LT((stage.list()[0].head - Vec3(-0.5, 0.75, 0.2)).norm(), position_tolerance);
  EXPECT_NEAR(stage.list()[0].head[2], 0.2, 1e-9);
  double translation[3];
  stage.representation()->GetHandleTranslation(0, translation);
  EXPECT_LT((Vec3(translation) - Vec3(t)).norm(), 1e-12);
  EXPECT_EQ(stage.representation()->GetInteractionName(), "move rest");
  EXPECT_EQ(stage.events[vtkCommand::InteractionEvent], 5) << "four moves and the end";
}

TEST(HandleEditing, JointsMoveTogetherAndBodiesWhole)
{
  const Handles arm = { bone("upper", Vec3(-1, 0, 0), Vec3(0, 0, 0)),
    bone("lower", Vec3(0, 0, 0), Vec3(1, 0, 0), 0), bone("other", Vec3(-1, 1, 0), Vec3(1, 1, 0)) };
  EditStage stage(Representation::MOVE_REST, arm);
  stage.drag(Vec3(0, 0, 0), Vec3(0, 0.5, 0));
  Handles handles = stage.list();
  EXPECT_LT((handles[0].tail - Vec3(0, 0.5, 0)).norm(), position_tolerance);
  EXPECT_EQ(handles[0].tail, handles[1].head);
  EXPECT_EQ(handles[0].head, Vec3(-1, 0, 0));
  EXPECT_EQ(handles[1].tail, Vec3(1, 0, 0));
  stage.drag(Vec3(0, 1, 0), Vec3(0.2, 1.3, 0)); // drag the body of the bone "other"
  handles = stage.list();
  EXPECT_LT((handles[2].head - Vec3(-0.8, 1.3, 0)).norm(), position_tolerance);
  EXPECT_LT((handles[2].tail - Vec3(1.2, 1.3, 0)).norm(), position_tolerance);
  EXPECT_LT((handles[2].tail - handles[2].head - Vec3(2, 0, 0)).norm(), 1e-12);
}

TEST(HandleEditing, CanceledRestMovesKeepEveryBitAndTheBind)
{
  EditStage stage(Representation::MOVE_REST,
    { point("p", Vec3(0.5, 0.5, 0.2)), bone("b", Vec3(-1, 0, 0), Vec3(0, 0, 0)) });
  const std::vector<vtkObject*> before = bind_objects(stage.handles);
  stage.press(Vec3(0.5, 0.5, 0.2));
  stage.move(Vec3(0.7, 0.5, 0.2));
  stage.move(Vec3(0.9, 0.9, 0.2));
  EXPECT_NE(bind_objects(stage.handles), before);
  stage.escape();
  EXPECT_EQ(bind_objects(stage.handles), before) << "the very same arrays";
  EXPECT_EQ(stage.list()[0].head, Vec3(0.5, 0.5, 0.2));
  EXPECT_TRUE(stage.widget->GetCanceled());
  stage.press(Vec3(0.5, 0.5, 0.2)); // a click without a move changes nothing
  stage.release(Vec3(0.5, 0.5, 0.2));
  EXPECT_EQ(bind_objects(stage.handles), before);
  EXPECT_TRUE(stage.widget->GetCanceled());
}

TEST(HandleEditing, RestMovesAreHeldSnappedAndLocked)
{
  EditStage stage(Representation::MOVE_REST,
    { point("p", Vec3(0.5, 0.5, 0.2)), point("q", Vec3(-0.5, -0.5, 0)),
      bone("b", Vec3(-1, 1, 0.3), Vec3(0, 1, 0)) },
    false);
  stage.press(Vec3(0.5, 0.5, 0.2));
  stage.move(Vec3(0.9, 0.8, 0.2));
  stage.key("x");
  stage.move(Vec3(1.0, 0.9, 0.2));
  EXPECT_EQ(stage.list()[0].head.tail<2>(), Eigen::Vector2d(0.5, 0.2));
  EXPECT_NEAR(stage.list()[0].head[0], 1.0, position_tolerance);
  stage.escape();
  // With Ctrl, a handle moves in steps of LengthStep. Near the end of another handle, it snaps to
  // this end instead.
  stage.representation()->SetLengthStep(0.25);
  stage.set_modifiers(false, true);
  stage.drag(Vec3(0.5, 0.5, 0.2), Vec3(0.8, 0.2, 0.2));
  EXPECT_LT((stage.list()[0].head - Vec3(0.75, 0.25, 0.2)).norm(), 1e-12);
  stage.drag(Vec3(0.75, 0.25, 0.2), Vec3(-1, 1, 0.3) + Vec3(3 * pixel_length, 0, 0));
  EXPECT_EQ(stage.list()[0].head, Vec3(-1, 1, 0.3));
  stage.set_modifiers(false, false);
  set_handle_locked(stage.handles, 1, true);
  stage.drag(Vec3(-0.5, -0.5, 0), Vec3(0, 0, 0));
  EXPECT_EQ(stage.list()[1].head, Vec3(-0.5, -0.5, 0));
  // A point cannot move onto another point. It stays at its last valid position.
  set_handle_locked(stage.handles, 1, false);
  stage.set_modifiers(false, true);
  stage.drag(Vec3(-1, 1, 0.3), Vec3(-0.5, -0.5, 0), 2);
  EXPECT_NE(stage.list()[0].head, stage.list()[1].head);
  EXPECT_EQ(stage.events[vtkCommand::WarningEvent], 1);
}

TEST(HandleEditing, SeveralRestPlacesMoveTogether)
{
  EditStage stage(Representation::MOVE_REST,
    { point("p", Vec3(0.5, 0.5, 0)), point("q", Vec3(-0.5, -0.5, 0)),
      point("r", Vec3(-0.5, 0.5, 0)) });
  stage.representation()->SetSelectedHandle(0);
  stage.representation()->ToggleSelected(1);
  stage.drag(Vec3(0.5, 0.5, 0), Vec3(0.7, 0.6, 0));
  const Handles handles = stage.list();
  EXPECT_LT((handles[0].head - Vec3(0.7, 0.6, 0)).norm(), position_tolerance);
  EXPECT_LT((handles[0].head - handles[1].head - Vec3(1, 1, 0)).norm(), 1e-12);
  EXPECT_EQ(handles[2].head, Vec3(-0.5, 0.5, 0));
}

TEST(HandleEditing, WithoutASurfacePlacesAreAtTheFocus)
{
  EditStage stage(Representation::ADD_POINTS, {}, false);
  stage.click(Vec3(1.2, -0.7, 0));
  EXPECT_LT((stage.list()[0].head - Vec3(1.2, -0.7, 0)).norm(), pixel_length);
}

TEST(HandleEditing, APreviewIsDrawnAndChangesNothing)
{
  EditStage stage(Representation::ADD_BONES);
  stage.move(Vec3(0.2, 0.2, 0));
  EXPECT_EQ(stage.representation()->GetInteractionState(), Representation::PLACING);
  stage.press(Vec3(-0.5, 0, 0));
  stage.move(Vec3(0.5, 0.3, 0));
  stage.window->Render();
  EXPECT_EQ(stage.handles->GetNumberOfCells(), 0);
  EXPECT_EQ(stage.events[vtkCommand::InteractionEvent], 0);
  stage.widget->SetEditMode(Representation::POSE); // this cancels the unfinished bone
  EXPECT_FALSE(stage.widget->IsDragging());
  stage.release(Vec3(0.5, 0.3, 0));
  EXPECT_EQ(stage.handles->GetNumberOfCells(), 0);
}

TEST(HandleEditing, UndoByEventsIsExact)
{
  // Store a copy of the handles at the start of each interaction and restore it later, as the
  // application does.
  EditStage stage(Representation::ADD_BONES, { point("p", Vec3(0.4, 0.4, 0)) });
  struct Memory
  {
    vtkPolyData* handles;
    std::vector<vtkSmartPointer<vtkPolyData>> before;
  } memory{ stage.handles, {} };
  vtkNew<vtkCallbackCommand> keep;
  keep->SetClientData(&memory);
  keep->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*)
    {
      auto* self = static_cast<Memory*>(data);
      self->before.push_back(vtkSmartPointer<vtkPolyData>::New());
      self->before.back()->ShallowCopy(self->handles);
    });
  stage.widget->AddObserver(vtkCommand::StartInteractionEvent, keep);
  stage.drag(Vec3(-0.6, 0, 0), Vec3(0, 0.1, 0));
  stage.widget->SetEditMode(Representation::ADD_CAGE);
  stage.click(Vec3(1.2, 1.2, 0));
  stage.widget->SetEditMode(Representation::MOVE_REST);
  stage.drag(Vec3(0.4, 0.4, 0), Vec3(0.6, 0.4, 0));
  ASSERT_EQ(memory.before.size(), 3u);
  const std::size_t sizes[3] = { 1, 2, 3 };
  for (int step = 2; step >= 0; --step)
  {
    stage.handles->ShallowCopy(memory.before[static_cast<std::size_t>(step)]);
    EXPECT_EQ(stage.list().size(), sizes[step]);
    EXPECT_EQ(stage.list()[0].head, Vec3(0.4, 0.4, 0));
  }
}

TEST(HandleEditing, CageVerticesTakeTheirEdgesAlong)
{
  EditStage stage(Representation::ADD_CAGE, {}, false);
  const Vec3 corners[3] = { Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0) };
  for (const int k : { 0, 1, 2, 0 })
  {
    stage.click(corners[k]);
  }
  stage.widget->SetEditMode(Representation::MOVE_REST);
  stage.drag(Vec3(0, 1, 0), Vec3(0.5, 0.5, 0));
  const Handles handles = stage.list();
  EXPECT_LT((handles[2].head - Vec3(0.5, 0.5, 0)).norm(), position_tolerance);
  EXPECT_EQ(stage.handles->GetNumberOfLines(), 3);
  std::size_t elements = 0;
  for (const Handle& handle : handles)
  {
    elements += handle.cage.size();
  }
  EXPECT_EQ(elements, 3u) << "they end at their vertices still";
}

TEST(HandleEditing, RandomEventsLeaveAValidDataset)
{
  // Send random mouse and key events in every mode. The filters can always read the handles, every
  // transform is finite, and no interaction is active at the end.
  EditStage stage(Representation::POSE,
    { point("p", Vec3(0.4, 0.4, 0.3)), bone("b", Vec3(-0.5, 0, 0), Vec3(0.2, 0.1, 0)),
      bone("c", Vec3(0.2, 0.1, 0), Vec3(0.8, 0, 0), 1) });
  test::Random random(11);
  const char* const keys[] = { "g", "r", "s", "x", "Y", "z", "Escape", "Return", "1", "period",
    "minus", "BackSpace", "5", "F1", "q" };
  int maximum_count = 0;
  for (int i = 0; i < 1500; ++i)
  {
    const Eigen::Vector2d at(random.uniform(-10, 410), random.uniform(-10, 410));
    // In 40 % of the rounds, the mouse is at the head of a random handle.
    const vtkIdType count = stage.handles->GetNumberOfCells();
    const bool aimed = count > 0 && random.uniform() < 0.4;
    Vec3 head_position = Vec3::Zero();
    if (aimed)
    {
      stage.representation()->GetPosedHead(random.below(count), head_position.data());
    }
    const Eigen::Vector2d mouse = aimed && head_position.allFinite() && head_position.norm() < 5.0
      ? stage.display(head_position)
      : at;
    stage.set_modifiers(random.uniform() < 0.2, random.uniform() < 0.2, random.uniform() < 0.2);
    switch (random.below(9))
    {
      case 0:
      case 1:
        stage.send(vtkCommand::LeftButtonPressEvent, mouse);
        break;
      case 2:
        stage.send(vtkCommand::LeftButtonReleaseEvent, mouse);
        break;
      case 3:
        stage.key(keys[random.below(15)], random.uniform() < 0.3);
        break;
      case 4:
        if (random.uniform() < 0.3)
        {
          stage.widget->SetEditMode(static_cast<int>(random.below(5)));
          stage.representation()->SetGizmo(static_cast<int>(random.below(5)));
          stage.representation()->SetSpace(static_cast<int>(random.below(2)));
        }
        break;
      default:
        stage.send(vtkCommand::MouseMoveEvent, mouse);
    }
    maximum_count = std::max(maximum_count, static_cast<int>(count));
    if (i % 25 == 0 && count > 0)
    {
      stage.list();
      // Limit the number of handles, so that some space on the screen stays free.
      if (count > 40)
      {
        stage.widget->SetHandles(nullptr);
        stage.handles->Initialize();
        stage.widget->SetHandles(stage.handles);
      }
    }
  }
  stage.escape();
  stage.send(vtkCommand::LeftButtonReleaseEvent, Eigen::Vector2d(1, 1));
  stage.widget->CancelDrag();
  EXPECT_FALSE(stage.widget->IsDragging());
  EXPECT_GT(maximum_count, 10) << "it did make handles";
  vtkDataArray* transforms = stage.handles->GetCellData()->GetArray("Transform");
  for (vtkIdType cell = 0; transforms && cell < transforms->GetNumberOfTuples(); ++cell)
  {
    EXPECT_TRUE(stage.transform(cell).allFinite()) << cell;
  }
}

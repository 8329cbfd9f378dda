// The handle widget with synthetic mouse events: which handles move and by how much, and which
// handles do not move.
#include "widget_stage.h"

#include <sstream>

using namespace bindpose;
using namespace bindpose::test;

TEST(HandleSetWidget, HoverFindsHandlesByPriority)
{
  // A point handle is at the tail of the bone. At this position the point is picked. At the head
  // and along the body of the bone, the bone is picked.
  Stage stage({ point("p", Vec3(1, 0, 0)), bone("b", Vec3(-1, 0, 0), Vec3(1, 0, 0)) });
  stage.move(Vec3(1, 0, 0));
  EXPECT_EQ(stage.representation()->GetInteractionState(), Representation::ON_POINT);
  EXPECT_EQ(stage.representation()->GetHoveredHandle(), 0);
  stage.move(Vec3(-1, 0, 0));
  EXPECT_EQ(stage.representation()->GetInteractionState(), Representation::ON_HEAD);
  EXPECT_EQ(stage.representation()->GetHoveredHandle(), 1);
  stage.move(Vec3(0, 0, 0));
  EXPECT_EQ(stage.representation()->GetInteractionState(), Representation::ON_BODY);
  stage.move(Vec3(0, 1, 0));
  EXPECT_EQ(stage.representation()->GetInteractionState(), Representation::OUTSIDE);
  EXPECT_EQ(stage.representation()->GetHoveredHandle(), -1);
  EXPECT_EQ(stage.events[vtkCommand::HighlightEvent], 3); // highlights of p, of b, and of no handle
  EXPECT_EQ(stage.representation()->GetHandleName(1), "b");
}

TEST(HandleSetWidget, OfTwoPointsTheNearerWins)
{
  // If handles have the same screen position, the front handle is picked. If handles are close to
  // each other, the handle nearest to the mouse is picked.
  Stage stage({ point("back", Vec3(0, 0, 0)), point("front", Vec3(0, 0, 2)),
    point("left", Vec3(1.00, 1, 0)), point("right", Vec3(1.08, 1, 0)) });
  stage.move(Vec3(0, 0, 0));
  EXPECT_EQ(stage.representation()->GetHoveredHandle(), 1);
  stage.move(Vec3(1.01, 1, 0));
  EXPECT_EQ(stage.representation()->GetHoveredHandle(), 2);
  stage.move(Vec3(1.07, 1, 0));
  EXPECT_EQ(stage.representation()->GetHoveredHandle(), 3);
}

TEST(HandleSetWidget, AJointOfTwoBonesGivesTheUpperBonesTail)
{
  Stage stage({ bone("upper", Vec3(-1, 0, 0), Vec3(0, 0, 0)),
    bone("lower", Vec3(0, 0, 0), Vec3(1, 0, 0), 0) });
  stage.move(Vec3(0, 0, 0));
  EXPECT_EQ(stage.representation()->GetHoveredHandle(), 0);
  EXPECT_EQ(stage.representation()->GetInteractionState(), Representation::ON_TAIL);
}

TEST(HandleSetWidget, DragMovesAPointInTheCameraPlane)
{
  Stage stage({ point("a", Vec3(0.5, 0, 1)), point("b", Vec3(-1, 0, 0)) });
  stage.drag(Vec3(0.5, 0, 1), Vec3(1.25, 0.75, 1));
  EXPECT_LT((stage.head(0) - Vec3(1.25, 0.75, 1)).norm(), pixel_length);
  EXPECT_NEAR(stage.head(0)[2], 1.0, 1e-9) << "the plane faces the camera";
  const Affine t = stage.transform(0);
  EXPECT_EQ(Eigen::Matrix3d(t.leftCols<3>()), Eigen::Matrix3d::Identity());
  EXPECT_EQ(stage.transform(1), identity_affine()) << "the other stays";
  EXPECT_EQ(stage.events[vtkCommand::StartInteractionEvent], 1);
  EXPECT_EQ(stage.events[vtkCommand::InteractionEvent], 4);
  EXPECT_EQ(stage.events[vtkCommand::EndInteractionEvent], 1);
  EXPECT_EQ(stage.representation()->GetSelectedHandle(), 0);
  // Transforms are absolute, so a second drag continues from the posed position.
  stage.drag(stage.head(0), Vec3(0.5, 0, 1));
  EXPECT_LT((stage.head(0) - Vec3(0.5, 0, 1)).norm(), 2 * pixel_length);
}

TEST(HandleSetWidget, GrabbingBesideTheMiddleDoesNotJump)
{
  Stage stage({ point("a", Vec3(0, 0, 0)) });
  const Vec3 beside(4 * pixel_length, 3 * pixel_length, 0);
  stage.press(beside);
  stage.move(beside);
  EXPECT_LT(stage.head(0).norm(), 1e-9);
  stage.move(beside + Vec3(1, 0, 0));
  EXPECT_LT((stage.head(0) - Vec3(1, 0, 0)).norm(), 1.5 * pixel_length);
  stage.release(beside + Vec3(1, 0, 0));
}

TEST(HandleSetWidget, DraggingATailTurnsTheBoneAboutItsHead)
{
  Stage stage({ bone("b", Vec3(0.2, 0.1, 0), Vec3(1.2, 0.1, 0)) });
  stage.drag(Vec3(1.2, 0.1, 0), Vec3(0.2, 1.6, 0), 10);
  // The handle has rotated by 90 degrees. The length of the mouse's path has no effect.
  EXPECT_LT((stage.head(0) - Vec3(0.2, 0.1, 0)).norm(), 1e-12);
  EXPECT_NEAR((stage.tail(0) - stage.head(0)).norm(), 1.0, 1e-12);
  EXPECT_LT((stage.tail(0) - Vec3(0.2, 1.1, 0)).norm(), pixel_length);
  const Eigen::Matrix3d r = stage.transform(0).leftCols<3>();
  EXPECT_LT((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(r.determinant(), 1.0, 1e-12);
}

TEST(HandleSetWidget, DraggingBodyOrHeadMovesTheBone)
{
  for (const double fraction : { 0.0, 0.5 })
  {
    Stage stage({ bone("b", Vec3(-0.5, 0, 0), Vec3(0.5, 0, 0)) });
    const Vec3 grabbed(-0.5 + fraction, 0, 0);
    stage.drag(grabbed, grabbed + Vec3(0.3, -0.7, 0));
    EXPECT_LT((stage.head(0) - Vec3(-0.2, -0.7, 0)).norm(), 1.5 * pixel_length);
    EXPECT_LT((stage.tail(0) - Vec3(0.8, -0.7, 0)).norm(), 1.5 * pixel_length);
    EXPECT_EQ(Eigen::Matrix3d(stage.transform(0).leftCols<3>()), Eigen::Matrix3d::Identity());
  }
}

TEST(HandleSetWidget, DescendantsFollowUnlessAskedNotTo)
{
  const Handles arm = { bone("upper", Vec3(-1, 0, 0), Vec3(0, 0, 0)),
    bone("lower", Vec3(0, 0, 0), Vec3(1, 0, 0), 0), bone("hand", Vec3(1, 0, 0), Vec3(1.4, 0, 0), 1),
    bone("other", Vec3(0, -2, 0), Vec3(1, -2, 0)) };
  Stage stage(arm);
  stage.drag(Vec3(0, 0, 0), Vec3(-1, 1, 0)); // this rotates the upper arm by 90 degrees
  EXPECT_LT((stage.tail(2) - Vec3(-1, 2.4, 0)).norm(), 4 * pixel_length);
  EXPECT_LT((stage.tail(0) - stage.head(1)).norm(), 1e-12) << "joints hold";
  EXPECT_LT((stage.tail(1) - stage.head(2)).norm(), 1e-12);
  EXPECT_EQ(stage.transform(3), identity_affine());

  Stage alone(arm);
  alone.representation()->MoveDescendantsOff();
  alone.drag(Vec3(0, 0, 0), Vec3(-1, 1, 0));
  EXPECT_LT((alone.tail(0) - Vec3(-1, 1, 0)).norm(), 2 * pixel_length);
  EXPECT_EQ(alone.transform(1), identity_affine());
}

TEST(HandleSetWidget, EscapeRestoresEveryBit)
{
  Stage stage({ bone("upper", Vec3(-1, 0, 0), Vec3(0, 0, 0)),
    bone("lower", Vec3(0, 0, 0), Vec3(1, 0, 0), 0) });
  stage.drag(Vec3(0, 0, 0), Vec3(-0.3, 0.7, 0));
  const Affine before[2] = { stage.transform(0), stage.transform(1) };
  stage.events.clear();
  const Vec3 tail = stage.tail(0);
  stage.press(tail);
  stage.move(tail + Vec3(0.4, 0.4, 0));
  EXPECT_TRUE(stage.widget->IsDragging());
  EXPECT_NE(stage.transform(1), before[1]);
  stage.interactor->SetKeyEventInformation(0, 0, 'a', 1, "a");
  stage.interactor->InvokeEvent(vtkCommand::KeyPressEvent);
  EXPECT_TRUE(stage.widget->IsDragging()) << "only Escape cancels";
  stage.escape();
  EXPECT_FALSE(stage.widget->IsDragging());
  EXPECT_TRUE(stage.widget->GetCanceled());
  EXPECT_EQ(stage.transform(0), before[0]);
  EXPECT_EQ(stage.transform(1), before[1]);
  EXPECT_EQ(stage.events[vtkCommand::InteractionEvent], 2) << "one move, one restoring";
  EXPECT_EQ(stage.events[vtkCommand::EndInteractionEvent], 1);
  // The mouse button is still down. Further mouse moves and the release have no effect.
  stage.move(tail + Vec3(0.8, 0.8, 0));
  stage.release(tail + Vec3(0.8, 0.8, 0));
  EXPECT_EQ(stage.transform(0), before[0]);
  EXPECT_EQ(stage.events[vtkCommand::EndInteractionEvent], 1);
  // The next drag works as usual.
  stage.drag(tail, tail + Vec3(0.2, 0.2, 0));
  EXPECT_FALSE(stage.widget->GetCanceled());
  EXPECT_NE(stage.transform(0), before[0]);
}

TEST(HandleSetWidget, DisablingOrNewHandlesCancelADrag)
{
  Stage stage({ point("a", Vec3(0, 0, 0)) });
  stage.press(Vec3(0, 0, 0));
  stage.move(Vec3(1, 0, 0));
  stage.widget->Off();
  EXPECT_EQ(stage.transform(0), identity_affine());
  stage.widget->On();
  stage.press(Vec3(0, 0, 0));
  stage.move(Vec3(1, 0, 0));
  const auto others = to_polydata(Handles{ point("c", Vec3(0, 1, 0)) });
  stage.widget->SetHandles(others);
  EXPECT_EQ(stage.transform(0), identity_affine());
  stage.drag(Vec3(0, 1, 0), Vec3(0, 0, 0));
  EXPECT_NEAR(
    others->GetCellData()->GetArray("Transform")->GetComponent(0, 7), -1.0, 2 * pixel_length);
}

TEST(HandleSetWidget, DragsKeepModesAndWhatABindReads)
{
  Stage stage({ point("a", Vec3(0, 0, 0)), point("b", Vec3(1, 0, 0)) });
  stage.handles->GetCellData()->GetArray("Mode")->SetComponent(0, 0, 1);
  const std::vector<vtkObject*> objects = bind_objects(stage.handles);
  std::vector<vtkMTimeType> times;
  for (vtkObject* object : objects)
  {
    times.push_back(object ? object->GetMTime() : 0);
  }
  const vtkMTimeType time = stage.handles->GetMTime();
  stage.drag(Vec3(0, 0, 0), Vec3(0.5, 0.5, 0));
  EXPECT_EQ(stage.handles->GetCellData()->GetArray("Mode")->GetComponent(0, 0), 1.0);
  EXPECT_GT(stage.handles->GetMTime(), time) << "a pipeline must see the change";
  ASSERT_EQ(bind_objects(stage.handles), objects);
  for (std::size_t i = 0; i < objects.size(); ++i)
  {
    EXPECT_EQ(objects[i] ? objects[i]->GetMTime() : 0, times[i]) << "a drag must not bind again";
  }
}

TEST(HandleSetWidget, AFreeHandleIsSelectedButNotDragged)
{
  Stage stage({ point("a", Vec3(0, 0, 0)) });
  stage.handles->GetCellData()->GetArray("Mode")->SetComponent(0, 0, 2);
  const Vec3 camera(stage.renderer->GetActiveCamera()->GetPosition());
  stage.drag(Vec3(0, 0, 0), Vec3(1, 0, 0));
  EXPECT_EQ(stage.transform(0), identity_affine());
  EXPECT_EQ(stage.representation()->GetSelectedHandle(), 0);
  EXPECT_EQ(stage.events[vtkCommand::StartInteractionEvent], 0);
  EXPECT_EQ(stage.events[vtkCommand::SelectionChangedEvent], 1);
  EXPECT_EQ(Vec3(stage.renderer->GetActiveCamera()->GetPosition()), camera);
}

TEST(HandleSetWidget, HandlesShownAtRestAreSelectedThereButNotDragged)
{
  Stage stage({ point("a", Vec3(-1, 0, 0)), point("b", Vec3(1, 0, 0)) });
  stage.drag(Vec3(1, 0, 0), Vec3(1, 0.8, 0));
  const Affine pose = stage.transform(1);
  ASSERT_GT((stage.head(1) - Vec3(1, 0, 0)).norm(), 0.5);
  stage.representation()->ShowRestOn();
  EXPECT_NEAR(stage.representation()->GetBounds()[3], 0.0, 1e-12) << "drawn at rest";
  stage.move(Vec3(1, 0.8, 0));
  EXPECT_EQ(stage.representation()->GetHoveredHandle(), -1) << "nothing where it is posed";
  stage.representation()->SetSelectedHandle(0);
  const int drags = stage.events[vtkCommand::StartInteractionEvent];
  stage.drag(Vec3(1, 0, 0), Vec3(1, -0.8, 0));
  EXPECT_EQ(stage.representation()->GetSelectedHandle(), 1);
  EXPECT_EQ(stage.representation()->GetDragRefusal(1), Representation::IS_AT_REST);
  EXPECT_FALSE(stage.widget->StartDrag(Representation::GIZMO_MOVE));
  EXPECT_EQ(stage.events[vtkCommand::StartInteractionEvent], drags);
  EXPECT_EQ(stage.transform(1), pose);
  stage.representation()->ShowRestOff();
  stage.drag(Vec3(1, 0.8, 0), Vec3(1, 0.2, 0));
  EXPECT_NEAR(stage.head(1)[1], 0.2, 0.05);
}

TEST(HandleSetWidget, TheCameraMovesOnlyAwayFromHandles)
{
  Stage stage({ point("a", Vec3(0, 0, 0)) });
  const Vec3 before(stage.renderer->GetActiveCamera()->GetPosition());
  stage.drag(Vec3(0, 0, 0), Vec3(1, 0, 0));
  EXPECT_EQ(Vec3(stage.renderer->GetActiveCamera()->GetPosition()), before);
  const Affine t = stage.transform(0);
  stage.drag(Vec3(-1, -1, 0), Vec3(0.5, -1, 0));
  EXPECT_GT((Vec3(stage.renderer->GetActiveCamera()->GetPosition()) - before).norm(), 0.5);
  EXPECT_EQ(stage.transform(0), t);
}

TEST(HandleSetWidget, WorksUnderParallelProjectionAndFromTheSide)
{
  Stage stage({ point("a", Vec3(0, 0.3, 0)) });
  vtkCamera* camera = stage.renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(2.0);
  camera->SetPosition(10, 0, 0);
  stage.window->Render();
  stage.drag(Vec3(0, 0.3, 0), Vec3(0, -0.5, 1.1));
  EXPECT_LT((stage.head(0) - Vec3(0, -0.5, 1.1)).norm(), 0.02);
  EXPECT_NEAR(stage.head(0)[0], 0.0, 1e-9);
}

TEST(HandleSetWidget, HundredsOfHandlesAreEachFound)
{
  Handles handles;
  for (int i = 0; i < 300; ++i)
  {
    handles.push_back(
      point("h" + std::to_string(i), Vec3(0.2 * (i % 20) - 1.9, 0.25 * (i / 20) - 1.75, 0)));
  }
  Stage stage(handles);
  for (int i = 0; i < 300; ++i)
  {
    const Eigen::Vector2d at = stage.display(handles[i].head);
    stage.representation()->ComputeInteractionState(
      static_cast<int>(std::lround(at[0])), static_cast<int>(std::lround(at[1])));
    EXPECT_EQ(stage.representation()->GetHoveredHandle(), i);
  }
}

TEST(HandleSetWidget, TakesPlainPolydataAndOddFiles)
{
  // The dataset first has no arrays. Later the dataset has a cage element, and two handles that are
  // parents of each other.
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0);
  points->InsertNextPoint(1, 0, 0);
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  vtkNew<vtkCellArray> verts;
  for (vtkIdType v : { 0, 1 })
  {
    verts->InsertNextCell(1, &v);
  }
  const vtkIdType ends[2] = { 0, 1 };
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(2, ends);
  data->SetVerts(verts);
  data->SetLines(lines);
  vtkNew<vtkIntArray> kinds;
  kinds->SetName("HandleKind");
  vtkNew<vtkIntArray> parents;
  parents->SetName("Parent");
  for (const int kind : { 2, 2, -1 })
  {
    kinds->InsertNextValue(kind);
  }
  for (const int parent : { 1, 0, -1 })
  {
    parents->InsertNextValue(parent);
  }
  data->GetCellData()->AddArray(kinds);
  data->GetCellData()->AddArray(parents);
  Stage stage(data);
  stage.representation()->ShowLabelsOn();
  EXPECT_EQ(stage.representation()->GetHandleName(1), "p2");
  stage.move(Vec3(0.5, 0, 0));
  EXPECT_EQ(stage.representation()->GetHoveredHandle(), -1) << "a cage's edge is no handle";
  stage.drag(Vec3(0, 0, 0), Vec3(0, 1, 0));
  EXPECT_LT((stage.head(0) - Vec3(0, 1, 0)).norm(), pixel_length);
  EXPECT_LT((stage.head(1) - Vec3(1, 1, 0)).norm(), pixel_length) << "each is below the other";

  Stage empty(vtkSmartPointer<vtkPolyData>::New());
  empty.drag(Vec3(0, 0, 0), Vec3(1, 0, 0));
  empty.widget->SetHandles(nullptr);
  empty.drag(Vec3(0, 0, 0), Vec3(1, 0, 0));
  EXPECT_EQ(empty.events[vtkCommand::StartInteractionEvent], 0);
}

TEST(HandleSetWidget, BoundsAreThoseOfThePose)
{
  Stage stage({ point("a", Vec3(0, 0, 0)), bone("b", Vec3(-1, -1, 0), Vec3(-1, 0, 0.5)) });
  stage.drag(Vec3(0, 0, 0), Vec3(2, 0, 0));
  const double* bounds = stage.representation()->GetBounds();
  const double expected[6] = { -1, 2, -1, 0, 0, 0.5 };
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_NEAR(bounds[i], expected[i], pixel_length);
  }
}

TEST(HandleSetWidget, PrintsAllProperties)
{
  vtkNew<vtkHandleSetWidget> widget;
  std::ostringstream text;
  widget->Print(text);
  widget->GetHandleSetRepresentation()->Print(text);
  for (const char* name :
    { "PointSize", "BoneWidth", "PickTolerance", "PixelScale", "ShowLabels", "ShowHoverName",
      "DrawOnTop", "MoveDescendants", "FullColor", "SelectedHandle", "ActiveHandle", "Canceled" })
  {
    EXPECT_NE(text.str().find(name), std::string::npos) << name;
  }
}

// The brush that paints region labels. On surfaces with known distances, the tests check which
// labels a stroke changes and which labels it keeps.
#include "conversion.h"
#include "offscreen_stage.h"
#include "support/meshes.h"
#include "vtkRegionBrushRepresentation.h"
#include "vtkRegionBrushWidget.h"

#include "vtkActor.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <vector>

using namespace bindpose;
using test::pixel_length;

namespace
{
class BrushStage : public test::OffscreenStage
{
public:
  explicit BrushStage(const TriangleMesh& mesh) : surface(to_polydata(mesh.points, mesh.triangles))
  {
    this->widget->SetInteractor(this->interactor);
    this->widget->SetSurface(this->surface);
    this->enable_and_count(this->widget,
      { vtkCommand::StartInteractionEvent, vtkCommand::InteractionEvent,
        vtkCommand::EndInteractionEvent, vtkCommand::StateChangedEvent });
  }
  vtkRegionBrushRepresentation* brush() { return this->widget->GetRegionBrushRepresentation(); }
  double label(vtkIdType v)
  {
    return this->surface->GetPointData()->GetArray("RegionId")->GetComponent(v, 0);
  }
  std::vector<double> labels()
  {
    std::vector<double> all;
    for (vtkIdType v = 0; v < this->surface->GetNumberOfPoints(); ++v)
    {
      all.push_back(this->label(v));
    }
    return all;
  }

  vtkSmartPointer<vtkPolyData> surface;
  vtkNew<vtkRegionBrushWidget> widget;
};

TriangleMesh flat()
{
  return test::translated(test::grid(60, 60, 4.0, 4.0), Vec3(-2, -2, 0));
}
} // namespace

TEST(RegionBrush, ADiscIsWhatLiesWithinTheRadius)
{
  for (const bool geodesic : { true, false })
  {
    BrushStage stage(flat());
    stage.brush()->SetGeodesic(geodesic);
    stage.brush()->SetRadius(0.5);
    stage.brush()->SetRegionId(3);
    const Vec3 middle(0.3, -0.2, 0);
    stage.press(middle);
    stage.release(middle);
    int inside = 0;
    for (vtkIdType v = 0; v < stage.surface->GetNumberOfPoints(); ++v)
    {
      const double distance = (Vec3(stage.surface->GetPoint(v)) - middle).norm();
      if (std::abs(distance - 0.5) > 2 * pixel_length)
      {
        EXPECT_EQ(stage.label(v), distance < 0.5 ? 3.0 : 0.0) << distance;
      }
      inside += stage.label(v) == 3.0;
    }
    EXPECT_EQ(inside, stage.brush()->GetNumberOfChangedPoints());
    EXPECT_EQ(stage.widget->GetInteractionName(), "paint region");
    EXPECT_EQ(stage.events[vtkCommand::StartInteractionEvent], 1);
    EXPECT_EQ(stage.events[vtkCommand::EndInteractionEvent], 1);
    EXPECT_FALSE(stage.widget->GetCanceled());
  }
}

TEST(RegionBrush, AFastStrokeHasNoGaps)
{
  BrushStage stage(flat());
  stage.brush()->SetRadius(0.2);
  stage.drag(Vec3(-1.5, 0.5, 0), Vec3(1.5, 0.5, 0), 1); // the whole path is one event
  for (vtkIdType v = 0; v < stage.surface->GetNumberOfPoints(); ++v)
  {
    const Vec3 p(stage.surface->GetPoint(v));
    const Vec3 foot(std::min(std::max(p[0], -1.5), 1.5), 0.5, 0);
    const double distance = (p - foot).norm();
    if (distance < 0.17)
    {
      EXPECT_EQ(stage.label(v), 1.0) << p.transpose();
    }
    else if (distance > 0.2 + 2 * pixel_length)
    {
      EXPECT_EQ(stage.label(v), 0.0) << p.transpose();
    }
  }
}

TEST(RegionBrush, CtrlErasesAndEscapeGivesEveryLabelBack)
{
  BrushStage stage(flat());
  stage.brush()->SetRadius(0.5);
  stage.drag(Vec3(-1, 0, 0), Vec3(1, 0, 0), 1);
  const std::vector<double> painted = stage.labels();
  stage.brush()->SetRegionId(2);
  stage.press(Vec3(0, 0, 0));
  stage.move(Vec3(0.5, 0.5, 0));
  EXPECT_NE(stage.labels(), painted);
  stage.key("Escape");
  EXPECT_EQ(stage.labels(), painted);
  EXPECT_TRUE(stage.widget->GetCanceled());
  EXPECT_FALSE(stage.widget->IsPainting());
  stage.release(Vec3(0.5, 0.5, 0));
  stage.set_modifiers(false, true);
  stage.drag(Vec3(0, 0, 0), Vec3(0, 0, 0), 1);
  int erased = 0;
  for (std::size_t v = 0; v < painted.size(); ++v)
  {
    const double now = stage.label(static_cast<vtkIdType>(v));
    EXPECT_TRUE(now == painted[v] || now == 0.0);
    erased += now != painted[v];
  }
  EXPECT_EQ(erased, stage.brush()->GetNumberOfChangedPoints());
  EXPECT_GT(erased, 100);
  EXPECT_EQ(stage.widget->GetInteractionName(), "erase region");
  stage.drag(Vec3(0, 0, 0), Vec3(0, 0, 0), 1); // there are no more labels to erase
  EXPECT_TRUE(stage.widget->GetCanceled());
}

TEST(RegionBrush, TheGeodesicBrushDoesNotReachThroughWalls)
{
  // The shape is a thin plate of two sheets that are not connected. Only the sheet toward the
  // camera is painted.
  const TriangleMesh sheet = flat();
  const TriangleMesh both =
    test::join(sheet, test::flipped(test::translated(sheet, Vec3(0, 0, -0.05))));
  BrushStage stage(both);
  stage.brush()->SetRadius(0.5);
  stage.drag(Vec3(0, 0, 0), Vec3(0, 0, 0), 1);
  const vtkIdType half = stage.surface->GetNumberOfPoints() / 2;
  const auto count = [&](bool behind)
  {
    int labeled = 0;
    for (vtkIdType v = behind ? half : 0; v < (behind ? 2 * half : half); ++v)
    {
      labeled += stage.label(v) == 1.0;
    }
    return labeled;
  };
  EXPECT_GT(count(false), 100);
  EXPECT_EQ(count(true), 0);
  stage.brush()->GeodesicOff();
  stage.drag(Vec3(0, 0, 0), Vec3(0, 0, 0), 1);
  EXPECT_GT(count(true), 100) << "a ball does";
}

TEST(RegionBrush, RadiusByKeysAndWheelAndTheCameraElsewhere)
{
  BrushStage stage(test::sphere(3));
  const double start = stage.brush()->GetDiscRadius();
  EXPECT_NEAR(start, std::sqrt(12.0) / 20.0, 0.01);
  stage.move(Vec3(0, 0, 0));
  stage.key("bracketright");
  EXPECT_NEAR(stage.brush()->GetDiscRadius(), 1.15 * start, 1e-12);
  stage.key("bracketleft");
  EXPECT_NEAR(stage.brush()->GetDiscRadius(), start, 1e-12);
  const double distance_before = stage.renderer->GetActiveCamera()->GetDistance();
  stage.set_modifiers(true);
  stage.send(vtkCommand::MouseWheelForwardEvent, stage.display(Vec3(0, 0, 0)));
  stage.set_modifiers(false);
  EXPECT_NEAR(stage.brush()->GetDiscRadius(), 1.15 * start, 1e-12);
  EXPECT_EQ(stage.renderer->GetActiveCamera()->GetDistance(), distance_before);
  stage.send(vtkCommand::MouseWheelForwardEvent, stage.display(Vec3(0, 0, 0)));
  EXPECT_NEAR(stage.brush()->GetDiscRadius(), 1.15 * start, 1e-12);
  EXPECT_LT(stage.renderer->GetActiveCamera()->GetDistance(), distance_before)
    << "the camera's wheel";
  EXPECT_EQ(stage.events[vtkCommand::StateChangedEvent], 3);
  // If the mouse is not on the surface, its events move the camera.
  const Vec3 before(stage.renderer->GetActiveCamera()->GetPosition());
  stage.drag(Vec3(-1.7, 1.7, 0), Vec3(-1.2, 1.7, 0), 3);
  EXPECT_GT((Vec3(stage.renderer->GetActiveCamera()->GetPosition()) - before).norm(), 0.1);
  EXPECT_EQ(stage.events[vtkCommand::StartInteractionEvent], 0);
  EXPECT_EQ(stage.surface->GetPointData()->GetArray("RegionId"), nullptr);
}

TEST(RegionBrush, TakesNoSurfaceAndOddOnes)
{
  BrushStage stage(test::sphere(1));
  vtkNew<vtkPolyData> empty;
  for (vtkPolyData* data : { static_cast<vtkPolyData*>(empty), static_cast<vtkPolyData*>(nullptr) })
  {
    stage.widget->SetSurface(data);
    stage.drag(Vec3(0, 0, 0), Vec3(0.3, 0, 0), 1);
    stage.key("bracketright");
    stage.window->Render();
  }
  EXPECT_EQ(stage.events[vtkCommand::StartInteractionEvent], 0);
  std::ostringstream text;
  stage.widget->Print(text);
  stage.brush()->Print(text);
  for (const char* name : { "RegionId", "Radius", "Geodesic", "Erase", "PaintColor", "Canceled" })
  {
    EXPECT_NE(text.str().find(name), std::string::npos) << name;
  }
  EXPECT_EQ(vtkRegionBrushWidget::GetNumberOfBindings(), 5);
  EXPECT_FALSE(vtkRegionBrushWidget::GetBindingInput(0).empty());
  EXPECT_EQ(vtkRegionBrushWidget::GetBindingText(5), "");
}

TEST(RegionBrush, AHundredThousandTrianglesAtMouseRate)
{
  BrushStage stage(test::torus(400, 125, 1.2, 0.5)); // 100,000 triangles
  ASSERT_EQ(stage.surface->GetNumberOfCells(), 100000);
  const Vec3 ring(0, 1.2, 0.5);
  stage.press(ring); // the first press builds the search tree
  double best = 1e9;
  for (int round = 0; round < 5; ++round)
  {
    const auto start = std::chrono::steady_clock::now();
    double position[2];
    for (int i = 0; i < 20; ++i)
    {
      const double angle = 0.5 * EIGEN_PI + 0.02 * (20 * round + i);
      stage.renderer->SetWorldPoint(1.2 * std::cos(angle), 1.2 * std::sin(angle), 0.5, 1.0);
      stage.renderer->WorldToDisplay();
      std::copy_n(stage.renderer->GetDisplayPoint(), 2, position);
      stage.brush()->WidgetInteraction(position);
    }
    const std::chrono::duration<double, std::milli> spent =
      std::chrono::steady_clock::now() - start;
    best = std::min(best, spent.count() / 20);
  }
  std::printf("a move of the brush on 100,000 triangles: %.2f ms\n", best);
  EXPECT_LT(best, 8.0) << "mouse rate";
  EXPECT_GT(stage.brush()->GetNumberOfChangedPoints(), 1000);
  stage.release(ring);
}

TEST(RegionBrush, TheDiscIsSeen)
{
  BrushStage stage(test::sphere(4));
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(stage.surface);
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectColorArray("RegionId");
  mapper->SetScalarRange(-1, 2);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  stage.renderer->AddActor(actor);
  stage.renderer->SetBackground(0.93, 0.94, 0.95);
  stage.brush()->SetRadius(0.3);
  stage.drag(Vec3(-0.5, -0.2, 0), Vec3(0.4, 0.3, 0), 5);
  const auto picture_with_disc = stage.picture();
  test::save_picture(picture_with_disc, "brush");
  stage.move(Vec3(-2, -2, 0)); // this position is not on the surface
  const auto picture_without_disc = stage.picture();
  int differing_pixels = 0;
  for (int y = 0; y < 400; ++y)
  {
    for (int x = 0; x < 400; ++x)
    {
      differing_pixels += std::abs(picture_with_disc->GetScalarComponentAsDouble(x, y, 0, 0) -
                            picture_without_disc->GetScalarComponentAsDouble(x, y, 0, 0)) > 24.0;
    }
  }
  EXPECT_GT(differing_pixels, 150) << "a circle of 140 pixels around, 2 wide";
  EXPECT_LT(differing_pixels, 1500);
}

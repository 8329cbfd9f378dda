// The picture of the gizmo (arrows, rings and boxes for moving, rotating and scaling a handle).
// Every part has pixels of its color, and the part under the mouse is lighter. Color-blind viewers
// can distinguish the axes. At scale 2, the picture is the same at twice the size.
#include "widget_stage.h"
#include "widgets/gizmo.h"

#include "vtkMath.h"
#include "vtkProperty.h"

#include <chrono>

using namespace bindpose;
using namespace bindpose::test;

namespace
{
Vec3 pixel_of(vtkImageData* image, const Eigen::Vector2d& position)
{
  Vec3 color;
  for (int k = 0; k < 3; ++k)
  {
    color[k] = image->GetScalarComponentAsDouble(
      static_cast<int>(std::lround(position[0])), static_cast<int>(std::lround(position[1])), 0, k);
  }
  return color;
}

// Return the number of pixels that differ from the pixel in the corner of the image.
int drawn_pixels(vtkImageData* image)
{
  const Vec3 ground = pixel_of(image, Eigen::Vector2d(0, 0));
  int count = 0;
  for (int y = 0; y < image->GetDimensions()[1]; ++y)
  {
    for (int x = 0; x < image->GetDimensions()[0]; ++x)
    {
      count += (pixel_of(image, Eigen::Vector2d(x, y)) - ground).norm() > 24.0;
    }
  }
  return count;
}

class PictureStage : public Stage
{
public:
  PictureStage(const Handles& list, int gizmo, int scale = 1) : Stage(list)
  {
    this->window->SetSize(400 * scale, 400 * scale);
    this->renderer->SetBackground(0.93, 0.94, 0.95);
    vtkCamera* camera = this->renderer->GetActiveCamera();
    camera->SetPosition(5, 4, 8);
    this->representation()->SetPixelScale(scale);
    this->representation()->SetGizmo(gizmo);
    this->representation()->SetSelectedHandle(0);
    this->window->Render();
  }
};

const Handles arm = { bone("arm", Vec3(-0.5, -0.3, 0), Vec3(1.1, 0.5, 0.6)) };
const Handles lone = { point("p", Vec3(0, 0, 0)) };
} // namespace

TEST(GizmoPicture, EveryGizmoAtOneAndTwoPixels)
{
  const std::pair<int, const char*> gizmos[4] = { { Representation::GIZMO_MOVE, "move" },
    { Representation::GIZMO_TURN, "turn" }, { Representation::GIZMO_SCALE, "scale" },
    { Representation::GIZMO_ALL, "all" } };
  for (const auto& [gizmo, name] : gizmos)
  {
    for (const bool is_bone : { false, true })
    {
      int pixel_counts[2];
      for (const int scale : { 1, 2 })
      {
        PictureStage stage(is_bone ? arm : lone, gizmo, scale);
        const auto image = stage.picture();
        save_picture(
          image, std::string(name) + (is_bone ? "-bone" : "-point") + "@" + std::to_string(scale));
        pixel_counts[scale - 1] = drawn_pixels(image);
      }
      EXPECT_GT(pixel_counts[0], 2000) << name;
      EXPECT_NEAR(static_cast<double>(pixel_counts[1]) / pixel_counts[0], 4.0, 0.25) << name;
    }
  }
}

TEST(GizmoPicture, WhatTheMouseIsOnIsLighterAndLarger)
{
  PictureStage stage(lone, Representation::GIZMO_MOVE);
  const auto before = stage.picture();
  const Eigen::Vector2d plate = stage.grip(Representation::MOVE_XY);
  stage.send(vtkCommand::MouseMoveEvent, plate);
  const auto after = stage.picture();
  save_picture(after, "hover-plate");
  EXPECT_GT(pixel_of(after, plate).sum(), pixel_of(before, plate).sum() + 60.0);
  EXPECT_GT(drawn_pixels(after), drawn_pixels(before));
}

TEST(GizmoPicture, ADragShowsWhatItIsHeldTo)
{
  PictureStage stage(arm, Representation::GIZMO_TURN);
  const Eigen::Vector2d from = stage.grip(Representation::TURN_Y);
  stage.send(vtkCommand::MouseMoveEvent, from);
  stage.send(vtkCommand::LeftButtonPressEvent, from);
  stage.send(vtkCommand::MouseMoveEvent, from + Eigen::Vector2d(45, 10));
  save_picture(stage.picture(), "drag-turn");
  stage.escape();

  PictureStage moving(lone, Representation::GIZMO_NONE);
  const int ball_pixels = drawn_pixels(moving.picture());
  moving.key("g");
  moving.send(vtkCommand::MouseMoveEvent, Eigen::Vector2d(220, 230));
  moving.key("x");
  const auto constrained_picture = moving.picture();
  save_picture(constrained_picture, "drag-axis");
  EXPECT_GT(drawn_pixels(constrained_picture), ball_pixels + 300)
    << "a line along x through the whole window";
  moving.escape();
  moving.send(vtkCommand::MouseMoveEvent, Eigen::Vector2d(1, 1));
  EXPECT_NEAR(drawn_pixels(moving.picture()), ball_pixels, 5);
}

TEST(GizmoPicture, ManyHandlesAreTwoActors)
{
  Handles handles;
  for (int i = 0; i < 500; ++i)
  {
    handles.push_back(
      point("p" + std::to_string(i), Vec3(0.1 * (i % 25) - 1.2, 0.12 * (i / 25) - 1.1, 0)));
  }
  PictureStage stage(handles, Representation::GIZMO_ALL);
  save_picture(stage.picture(), "many");
  EXPECT_EQ(stage.renderer->GetActors()->GetNumberOfItems(), 0)
    << "the representation draws by itself";
  EXPECT_EQ(stage.renderer->GetViewProps()->GetNumberOfItems(), 1);
}

TEST(GizmoPicture, AxesAreToldApartByAllEyes)
{
  // Test each type of color blindness (Machado, Oliveira and Fernandes 2009, severity 1).
  Eigen::Matrix3d vision_matrices[4];
  vision_matrices[0].setIdentity();
  vision_matrices[1] << 0.152286, 1.052583, -0.204868, 0.114503, 0.786281, 0.099216, -0.003882,
    -0.048116, 1.051998;
  vision_matrices[2] << 0.367322, 0.860646, -0.227968, 0.280085, 0.672501, 0.047413, -0.011820,
    0.042940, 0.968881;
  vision_matrices[3] << 1.255528, -0.076749, -0.178779, -0.078411, 0.930809, 0.147602, 0.004733,
    0.691367, 0.303900;
  const auto perceived_lab = [](const Eigen::Matrix3d& vision_matrix, const Color& color)
  {
    Vec3 light;
    for (int k = 0; k < 3; ++k)
    {
      light[k] = color[k] <= 0.04045 ? color[k] / 12.92 : std::pow((color[k] + 0.055) / 1.055, 2.4);
    }
    light = (vision_matrix * light).cwiseMax(0.0).cwiseMin(1.0);
    for (double& c : light)
    {
      c = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
    }
    Vec3 lab;
    vtkMath::RGBToLab(light.data(), lab.data());
    return lab;
  };
  const GizmoSetup setup;
  for (const Eigen::Matrix3d& vision_matrix : vision_matrices)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 difference = perceived_lab(vision_matrix, setup.axes[k]) -
        perceived_lab(vision_matrix, setup.axes[(k + 1) % 3]);
      EXPECT_GT(difference.norm(), 25.0) << k;
    }
  }
}

TEST(GizmoPicture, EditModesShowWhatAClickWouldMake)
{
  PictureStage stage(arm, Representation::GIZMO_ALL);
  const auto posed = stage.picture();
  stage.widget->SetEditMode(Representation::ADD_BONES);
  const int rest_pixels = drawn_pixels(stage.picture());
  EXPECT_LT(rest_pixels, drawn_pixels(posed)) << "no gizmo";
  stage.press(stage.tail(0));
  stage.move(Vec3(0.3, 1.3, 0));
  const auto drawing = stage.picture();
  save_picture(drawing, "add-bone");
  EXPECT_GT(drawn_pixels(drawing), rest_pixels + 400);
  stage.release(Vec3(0.3, 1.3, 0));
  stage.widget->SetEditMode(Representation::ADD_CAGE);
  for (const Vec3& position : { Vec3(-1.5, -1.2, 0), Vec3(1.3, -1.2, 0), Vec3(1.3, 1.2, 0) })
  {
    stage.press(position);
    stage.release(position);
  }
  stage.set_modifiers(false, true);
  stage.move(Vec3(-1.5, -1.2, 0));
  save_picture(stage.picture(), "add-cage-snapped");
}

TEST(GizmoPicture, FiveHundredHandlesAreBuiltQuickly)
{
  Handles handles;
  for (int i = 0; i < 500; ++i)
  {
    handles.push_back(
      point("p" + std::to_string(i), Vec3(0.1 * (i % 25) - 1.2, 0.12 * (i / 25) - 1.1, 0)));
  }
  PictureStage stage(handles, Representation::GIZMO_MOVE);
  double best = 1e9;
  for (int round = 0; round < 5; ++round)
  {
    stage.representation()->Modified();
    const auto start = std::chrono::steady_clock::now();
    stage.representation()->BuildRepresentation();
    const std::chrono::duration<double, std::milli> spent =
      std::chrono::steady_clock::now() - start;
    best = std::min(best, spent.count());
  }
  std::printf("shapes of 500 handles: %.2f ms\n", best);
  EXPECT_LT(best, 50.0);
}

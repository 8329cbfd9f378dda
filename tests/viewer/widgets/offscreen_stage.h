#ifndef offscreen_stage_h
#define offscreen_stage_h

// An off-screen window for one widget, with functions that send mouse and keyboard events.

#include "geometry/mesh.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkImageData.h"
#include "vtkInteractorObserver.h"
#include "vtkInteractorStyleTrackballCamera.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkWindowToImageFilter.h"

#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <map>
#include <string>

namespace bindpose::test
{

constexpr double pixel_length = 0.0134; // world length of a pixel at z = 0: 2 * 10 * tan(15°) / 400

// A window of 400 x 400 pixels whose camera looks along -z from a distance of 10.
class OffscreenStage
{
public:
  OffscreenStage()
  {
    this->window->SetOffScreenRendering(1);
    this->window->SetMultiSamples(0);
    this->window->SetSize(400, 400);
    this->window->AddRenderer(this->renderer);
    this->interactor->SetRenderWindow(this->window);
    this->interactor->SetInteractorStyle(this->style);
    vtkCamera* camera = this->renderer->GetActiveCamera();
    camera->SetPosition(0, 0, 10);
    camera->SetFocalPoint(0, 0, 0);
    camera->SetViewUp(0, 1, 0);
    camera->SetViewAngle(30);
    camera->SetClippingRange(1, 20);
    this->counter->SetClientData(this);
    this->counter->SetCallback([](vtkObject*, unsigned long event, void* self, void*)
      { ++static_cast<OffscreenStage*>(self)->events[event]; });
  }

  /// Enable the widget and count its events.
  void enable_and_count(
    vtkInteractorObserver* observer, std::initializer_list<unsigned long> counted_events)
  {
    observer->SetEnabled(1);
    this->window->Render();
    for (const unsigned long event : counted_events)
    {
      observer->AddObserver(event, this->counter);
    }
  }

  Eigen::Vector2d display(const Vec3& world)
  {
    this->renderer->SetWorldPoint(world[0], world[1], world[2], 1.0);
    this->renderer->WorldToDisplay();
    return Eigen::Vector2d(this->renderer->GetDisplayPoint());
  }
  void send(unsigned long event, const Eigen::Vector2d& position)
  {
    this->interactor->SetEventInformation(static_cast<int>(std::lround(position[0])),
      static_cast<int>(std::lround(position[1])), this->control, this->shift);
    this->interactor->SetAltKey(this->alt);
    this->interactor->InvokeEvent(event);
  }
  void move(const Vec3& world) { this->send(vtkCommand::MouseMoveEvent, this->display(world)); }
  void press(const Vec3& world)
  {
    this->move(world);
    this->send(vtkCommand::LeftButtonPressEvent, this->display(world));
  }
  void release(const Vec3& world)
  {
    this->send(vtkCommand::LeftButtonReleaseEvent, this->display(world));
  }
  void drag(const Vec3& from, const Vec3& to, int steps = 4)
  {
    this->press(from);
    for (int i = 1; i <= steps; ++i)
    {
      this->move(from + (to - from) * i / steps);
    }
    this->release(to);
  }
  /// Set which modifier keys are held down during the next mouse events.
  void set_modifiers(bool with_shift, bool with_control = false, bool with_alt = false)
  {
    this->shift = with_shift;
    this->control = with_control;
    this->alt = with_alt;
  }
  void key(const std::string& name, bool with_shift = false)
  {
    this->interactor->SetKeyEventInformation(
      0, with_shift, name.size() == 1 ? name[0] : 0, 1, name.c_str());
    this->interactor->InvokeEvent(vtkCommand::KeyPressEvent);
  }
  void escape()
  {
    this->interactor->SetKeyEventInformation(0, 0, 27, 1, "Escape");
    this->interactor->InvokeEvent(vtkCommand::KeyPressEvent);
  }

  vtkSmartPointer<vtkImageData> picture()
  {
    this->window->Render();
    vtkNew<vtkWindowToImageFilter> grab;
    grab->SetInput(this->window);
    grab->ReadFrontBufferOff();
    grab->Update();
    return grab->GetOutput();
  }

  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkNew<vtkInteractorStyleTrackballCamera> style;
  vtkNew<vtkCallbackCommand> counter;
  std::map<unsigned long, int> events;
  bool shift = false;
  bool control = false;
  bool alt = false;
};

/// Save a picture for inspection, if the environment variable BINDPOSE_PICTURES contains a folder.
inline void save_picture(vtkImageData* image, const std::string& name)
{
  if (const char* folder = std::getenv("BINDPOSE_PICTURES"))
  {
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(image);
    writer->SetFileName((std::string(folder) + "/" + name + ".png").c_str());
    writer->Write();
  }
}

} // namespace bindpose::test

#endif

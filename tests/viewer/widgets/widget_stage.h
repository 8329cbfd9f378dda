#ifndef widget_stage_h
#define widget_stage_h

// A window with the handle widget, and a hand that sends it events as a mouse and keyboard would.

#include "conversion.h"
#include "handle_edit_cells.h"
#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkIntArray.h"
#include "vtkInteractorStyleTrackballCamera.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace bindpose::test
{

using Widget = vtkHandleSetRepresentation;
constexpr double pixel = 0.0134; // world length of a pixel at z = 0: 2 * 10 * tan(15°) / 400

inline Handle point(const std::string& name, const Vec3& place)
{
  Handle handle;
  handle.name = name;
  handle.head = handle.tail = place;
  return handle;
}

inline Handle bone(const std::string& name, const Vec3& head, const Vec3& tail, Index parent = -1)
{
  Handle handle;
  handle.name = name;
  handle.kind = HandleKind::bone;
  handle.head = head;
  handle.tail = tail;
  handle.parent = parent;
  return handle;
}

// A window of 400 x 400 whose camera looks along -z from 10 away.
class Stage
{
public:
  explicit Stage(const Handles& list) : Stage(to_polydata(list)) {}
  explicit Stage(vtkSmartPointer<vtkPolyData> data) : handles(data)
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
    this->widget->SetInteractor(this->interactor);
    this->widget->SetHandles(this->handles);
    this->widget->On();
    this->window->Render();
    this->counter->SetClientData(this);
    this->counter->SetCallback([](vtkObject*, unsigned long event, void* self, void*)
      { ++static_cast<Stage*>(self)->events[event]; });
    for (const unsigned long event : { vtkCommand::HighlightEvent,
           vtkCommand::SelectionChangedEvent, vtkCommand::StartInteractionEvent,
           vtkCommand::InteractionEvent, vtkCommand::EndInteractionEvent })
    {
      this->widget->AddObserver(event, this->counter);
    }
  }

  Widget* representation() { return this->widget->GetHandleSetRepresentation(); }

  Eigen::Vector2d display(const Vec3& world)
  {
    this->renderer->SetWorldPoint(world[0], world[1], world[2], 1.0);
    this->renderer->WorldToDisplay();
    return Eigen::Vector2d(this->renderer->GetDisplayPoint());
  }
  void send(unsigned long event, const Eigen::Vector2d& at)
  {
    this->interactor->SetEventInformation(static_cast<int>(std::lround(at[0])),
      static_cast<int>(std::lround(at[1])), this->control, this->shift);
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
  /// Keys that are held at the next mouse events.
  void hold(bool with_shift, bool with_control = false, bool with_alt = false)
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
  /// From where a part of the gizmo is grabbed by pixels.
  Eigen::Vector2d grip(int part)
  {
    Eigen::Vector2d at(-1, -1);
    EXPECT_TRUE(this->representation()->GetGizmoGrip(part, at.data())) << part;
    return at;
  }
  void drag_pixels(const Eigen::Vector2d& from, const Eigen::Vector2d& to, int steps = 4)
  {
    this->send(vtkCommand::MouseMoveEvent, from);
    this->send(vtkCommand::LeftButtonPressEvent, from);
    for (int i = 1; i <= steps; ++i)
    {
      this->send(vtkCommand::MouseMoveEvent, from + (to - from) * i / steps);
    }
    this->send(vtkCommand::LeftButtonReleaseEvent, to);
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
  void escape()
  {
    this->interactor->SetKeyEventInformation(0, 0, 27, 1, "Escape");
    this->interactor->InvokeEvent(vtkCommand::KeyPressEvent);
  }

  Vec3 head(vtkIdType handle)
  {
    Vec3 place;
    this->representation()->GetPosedHead(handle, place.data());
    return place;
  }
  Vec3 tail(vtkIdType handle)
  {
    Vec3 place;
    this->representation()->GetPosedTail(handle, place.data());
    return place;
  }
  Affine transform(vtkIdType handle)
  {
    Affine t = identity_affine();
    this->handles->GetCellData()->GetArray("Transform")->GetTuple(handle, t.data());
    return t;
  }

  vtkSmartPointer<vtkPolyData> handles;
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkNew<vtkInteractorStyleTrackballCamera> style;
  vtkNew<vtkHandleSetWidget> widget;
  vtkNew<vtkCallbackCommand> counter;
  std::map<unsigned long, int> events;
  bool shift = false;
  bool control = false;
  bool alt = false;
};

} // namespace bindpose::test

#endif

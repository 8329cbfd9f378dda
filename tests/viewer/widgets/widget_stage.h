#ifndef widget_stage_h
#define widget_stage_h

// An off-screen window with the handle widget.

#include "conversion.h"
#include "handle_edit_cells.h"
#include "offscreen_stage.h"
#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkIntArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace bindpose::test
{

using Representation = vtkHandleSetRepresentation;

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

class Stage : public OffscreenStage
{
public:
  explicit Stage(const Handles& list) : Stage(to_polydata(list)) {}
  explicit Stage(vtkSmartPointer<vtkPolyData> data) : handles(data)
  {
    this->widget->SetInteractor(this->interactor);
    this->widget->SetHandles(this->handles);
    this->enable_and_count(this->widget,
      { vtkCommand::HighlightEvent, vtkCommand::SelectionChangedEvent,
        vtkCommand::StartInteractionEvent, vtkCommand::InteractionEvent,
        vtkCommand::EndInteractionEvent });
  }

  Representation* representation() { return this->widget->GetHandleSetRepresentation(); }

  /// Return the display position at which the mouse can grab a part of the gizmo.
  Eigen::Vector2d grip(int part)
  {
    Eigen::Vector2d position(-1, -1);
    EXPECT_TRUE(this->representation()->GetGizmoGrip(part, position.data())) << part;
    return position;
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
  vtkNew<vtkHandleSetWidget> widget;
};

} // namespace bindpose::test

#endif

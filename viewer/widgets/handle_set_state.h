#ifndef handle_set_state_h
#define handle_set_state_h

// State of vtkHandleSetRepresentation, used by all files that implement its member functions.

#include "gizmo.h"
#include "handle_data.h"
#include "handle_poses.h"
#include "handle_shapes.h"
#include "pose_drag.h"
#include "rest_editor.h"
#include "screen_labels.h"

#include "vtkActor.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bindpose
{

/// Draws shapes and their outlines, as two actors.
class ShapeActors
{
public:
  ShapeActors()
  {
    const std::pair<vtkActor*, vtkPolyDataMapper*> both[2] = {
      { this->Outline, this->OutlineMapper }, { this->Solid, this->SolidMapper }
    };
    for (const auto& [actor, mapper] : both)
    {
      mapper->SetScalarModeToUsePointData();
      mapper->SetColorModeToDirectScalars();
      actor->SetMapper(mapper);
    }
    vtkProperty* solid = this->Solid->GetProperty();
    solid->SetAmbient(0.25);
    solid->SetDiffuse(0.75);
    solid->SetSpecular(0.25);
    solid->SetSpecularPower(30.0);
    solid->BackfaceCullingOn();
    this->Outline->GetProperty()->LightingOff();
    this->Outline->GetProperty()->FrontfaceCullingOn();
  }
  /// Show colors almost without shading.
  void SetFlat()
  {
    this->Solid->GetProperty()->SetAmbient(0.75);
    this->Solid->GetProperty()->SetDiffuse(0.3);
    this->Solid->GetProperty()->SetSpecular(0.0);
  }
  void Set(const HandleShapes& solid, const HandleShapes& outline)
  {
    this->SolidMapper->SetInputData(solid.polydata());
    this->OutlineMapper->SetInputData(outline.polydata());
  }
  int Render(vtkViewport* viewport)
  {
    return this->Outline->RenderOpaqueGeometry(viewport) +
      this->Solid->RenderOpaqueGeometry(viewport);
  }
  void Release(vtkWindow* window)
  {
    this->Outline->ReleaseGraphicsResources(window);
    this->Solid->ReleaseGraphicsResources(window);
  }

private:
  vtkNew<vtkPolyDataMapper> OutlineMapper;
  vtkNew<vtkPolyDataMapper> SolidMapper;
  vtkNew<vtkActor> Outline;
  vtkNew<vtkActor> Solid;
};

/// Handles, their actors, and the state of the interaction with the mouse.
struct HandleSetState
{
  HandleData Data;
  ShapeActors Handles;
  ShapeActors Gizmo;
  ScreenLabels Labels;
  std::vector<vtkIdType> SelectedHandles;
  int HoveredPart = no_part; // part of the gizmo under the mouse

  std::optional<PoseDrag> CurrentDrag;
  RestEditor Editor{ this->Data };
  std::string Message; // reason why the last edit was refused

  std::string LastDragName; // type of the last drag; see GetInteractionName()
  std::string LastDragText;
};

} // namespace bindpose

#endif

// The drawing functions of vtkHandleSetRepresentation. The shapes are rebuilt whenever the handles,
// the camera or the window change. All bodies are one polydata, all outlines another.
//
// Handles are inside the shape that they bend. To make them visible, they are drawn in the overlay
// pass after the depth buffer has been cleared. They therefore hide each other correctly, but
// nothing else hides them. The gizmo is drawn in the same way afterward.
#include "handle_drawing.h"
#include "handle_set_state.h"
#include "screen_view.h"
#include "vtkHandleSetRepresentation.h"

#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkRenderer.h"
#include "vtkTextProperty.h"

#include <Eigen/Geometry>

#include <algorithm>

using bindpose::HandleRecord;
using bindpose::HandleSetState;
using bindpose::ShapeActors;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace
{
constexpr unsigned int gl_depth_test = 0x0B71;
constexpr unsigned int gl_depth_buffer_bit = 0x00000100;

bindpose::Color to_color(const double rgb[3])
{
  return { rgb[0], rgb[1], rgb[2] };
}
} // namespace

vtkMTimeType vtkHandleSetRepresentation::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  time = std::max(time, this->Internal->Labels.text()->GetMTime());
  if (this->Internal->Data.get())
  {
    time = std::max(time, this->Internal->Data.get()->GetMTime());
  }
  return time;
}

void vtkHandleSetRepresentation::BuildRepresentation()
{
  HandleSetState& self = *this->Internal;
  if (!this->Renderer || !this->Renderer->GetRenderWindow())
  {
    return;
  }
  vtkWindow* window = this->Renderer->GetRenderWindow();
  if (this->BuildTime > this->GetMTime() && this->BuildTime > window->GetMTime() &&
    this->BuildTime > this->Renderer->GetMTime() &&
    this->BuildTime > this->Renderer->GetActiveCamera()->GetMTime())
  {
    return;
  }
  const bindpose::ScreenView view(this->Renderer);
  std::vector<HandleRecord> records = self.Data.records(this->DrawsRest());
  bindpose::HandleData::resolve_modes(records, this->FindsRotations != 0);
  const bool fine = records.size() <= 60;
  bindpose::HandleShapes solid(fine);
  bindpose::HandleShapes outline(fine);
  bindpose::HandleSizes sizes;
  sizes.ball = this->PixelScale * this->PointSize;
  sizes.bone_width = this->BoneWidth;
  const bindpose::HandleAppearance appearance{
    { to_color(this->FullColor), to_color(this->PositionColor), to_color(this->FreeColor) },
    to_color(this->OutlineColor), to_color(this->SelectedColor), this->PixelScale
  };
  const bindpose::HandleMarks marks{ this->HoveredHandle, this->ActiveHandle,
    self.SelectedHandles };
  bindpose::draw_handles(view, records,
    records.empty() ? std::vector<bindpose::HandleData::Bar>() : self.Data.bars(records), sizes,
    appearance, marks, solid, outline);
  const bindpose::RestEditor::Preview& preview = self.Editor.preview();
  const bindpose::Color preview_color = bindpose::lighter(appearance.modes[0]);
  if (preview.bone)
  {
    const auto& [head, tail] = *preview.bone;
    const double pixel = view.pixel_length_at(0.5 * (head + tail));
    const double width = sizes.half_width((tail - head).norm(), pixel);
    solid.add_bone(head, tail, width, preview_color);
    outline.add_bone(head, tail, width, appearance.outline, 1.6 * this->PixelScale * pixel);
    solid.add_ball(head, sizes.end() * view.pixel_length_at(head), preview_color);
  }
  if (preview.bar)
  {
    const auto& [from, to] = *preview.bar;
    solid.add_tube({ from, to }, 1.2 * this->PixelScale * view.pixel_length_at(0.5 * (from + to)),
      preview_color);
  }
  if (preview.ball)
  {
    // A wider outline marks a ball that has snapped to an existing handle or vertex.
    const double pixel = view.pixel_length_at(*preview.ball);
    const double size = this->EditMode == ADD_BONES ? sizes.end() : sizes.ball;
    const double rim = this->PixelScale * (preview.snapped ? 4.5 : 1.6);
    solid.add_ball(*preview.ball, size * pixel, preview_color);
    outline.add_ball(*preview.ball, (size + rim) * pixel,
      preview.snapped ? appearance.selected : appearance.outline);
    outline.add_ball(
      *preview.ball, (size + rim + 1.6 * this->PixelScale) * pixel, appearance.outline);
  }
  self.Labels.clear();
  for (vtkIdType cell = 0; cell < self.Data.count(); ++cell)
  {
    const bool is_highlighted = cell == this->HoveredHandle || cell == this->ActiveHandle;
    const HandleRecord& record = records[static_cast<std::size_t>(cell)];
    const bool dragged = self.CurrentDrag && cell == this->ActiveHandle;
    const bool shows_name =
      this->ShowHoverName && is_highlighted && self.HoveredPart == bindpose::no_part;
    if (record.is_handle() && (this->ShowLabels || shows_name || dragged))
    {
      std::string text = self.Data.name(cell);
      text += record.locked                     ? " (locked)"
        : record.is_free() && is_highlighted    ? " (free)"
        : record.only_moves() && is_highlighted ? " (rotation free)"
                                                : "";
      text += dragged && !self.LastDragText.empty() ? "   " + self.LastDragText : "";
      Vector2d label_position =
        bindpose::label_anchor(view, record, this->PixelScale * this->PointSize);
      if (dragged && self.CurrentDrag->part() != bindpose::no_part)
      {
        // Draw the text below the gizmo, where nothing else is drawn. Near the lower border of the
        // window, draw it above the gizmo.
        const double label_offset = this->PixelScale * (1.45 * this->GizmoSize + 14.0);
        label_position = view.to_display(record.head).head<2>();
        label_position += Vector2d(-0.25 * label_offset,
          label_position[1] > 1.2 * label_offset ? -label_offset : label_offset);
      }
      self.Labels.add(text, label_position, this->PixelScale);
    }
  }
  self.Handles.Set(solid, outline);

  bindpose::HandleShapes gizmo_solid(true);
  bindpose::HandleShapes gizmo_outline(true);
  const vtkIdType gizmo_handle = self.CurrentDrag ? this->ActiveHandle : this->GetSelectedHandle();
  const bool shows_gizmo =
    self.CurrentDrag || (this->EditMode == POSE && this->Gizmo != GIZMO_NONE);
  if (shows_gizmo && this->GetDragRefusal(gizmo_handle) == DRAGGABLE)
  {
    bindpose::GizmoSetup setup = this->MakeGizmo(records[static_cast<std::size_t>(gizmo_handle)]);
    bindpose::GizmoMarks gizmo_marks;
    gizmo_marks.hovered = self.HoveredPart;
    if (self.CurrentDrag)
    {
      // Draw the constraint for any drag, including drags that a key has started.
      gizmo_marks.active = self.CurrentDrag->part();
      setup.kind = bindpose::gizmo_with(gizmo_marks.active, setup.kind);
      setup.frame = self.CurrentDrag->frame();
      const auto spokes = self.CurrentDrag->spokes(
        bindpose::ring_pixels(setup, gizmo_marks.active) * view.pixel_length_at(setup.origin));
      std::copy(spokes.begin(), spokes.end(), gizmo_marks.spokes);
    }
    if (!self.CurrentDrag || gizmo_marks.active != bindpose::no_part)
    {
      const bindpose::Gizmo gizmo(view, setup, gizmo_marks);
      gizmo.draw(gizmo_solid, gizmo_outline);
      for (const bindpose::Gizmo::Label& label : gizmo.labels())
      {
        self.Labels.add(label.text, label.display, this->PixelScale, label.color.data());
      }
    }
  }
  self.Gizmo.Set(gizmo_solid, gizmo_outline);
  this->BuildTime.Modified();
}

double* vtkHandleSetRepresentation::GetBounds()
{
  Eigen::AlignedBox3d box;
  for (const HandleRecord& record : this->Internal->Data.records(this->DrawsRest()))
  {
    box.extend(record.head).extend(record.tail);
  }
  vtkMath::UninitializeBounds(this->Bounds);
  for (int axis = 0; axis < 3 && !box.isEmpty(); ++axis)
  {
    this->Bounds[2 * axis] = box.min()[axis];
    this->Bounds[2 * axis + 1] = box.max()[axis];
  }
  return this->Bounds;
}

int vtkHandleSetRepresentation::RenderOpaqueGeometry(vtkViewport* viewport)
{
  if (this->DrawOnTop)
  {
    return 0;
  }
  this->BuildRepresentation();
  return this->Internal->Handles.Render(viewport);
}

int vtkHandleSetRepresentation::RenderOverlay(vtkViewport* viewport)
{
  this->BuildRepresentation();
  int rendered = 0;
  auto* window = vtkOpenGLRenderWindow::SafeDownCast(viewport->GetVTKWindow());
  const auto draw_on_top = [&](ShapeActors& actors)
  {
    vtkOpenGLState* state = window->GetState();
    state->vtkglEnable(gl_depth_test);
    state->vtkglDepthMask(1);
    state->vtkglClear(gl_depth_buffer_bit);
    rendered += actors.Render(viewport);
  };
  if (window && this->DrawOnTop)
  {
    draw_on_top(this->Internal->Handles);
  }
  if (window)
  {
    draw_on_top(this->Internal->Gizmo);
  }
  return rendered + this->Internal->Labels.render(viewport);
}

void vtkHandleSetRepresentation::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internal->Handles.Release(window);
  this->Internal->Gizmo.Release(window);
  this->Internal->Labels.release(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

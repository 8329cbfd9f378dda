#include "viewport.h"

#include "scene/camera.h"
#include "scene/colours.h"
#include "scene/legend.h"
#include "scene/shaded_surface.h"
#include "scene/tile_actors.h"

#include "conversion.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkGenericOpenGLRenderWindow.h"
#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"
#include "vtkInteractorStyleTrackballCamera.h"
#include "vtkObjectFactory.h"
#include "vtkPNGWriter.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkWindowToImageFilter.h"

#include <QTimer>

namespace
{
/// Trackball camera without VTK's letter keys: 'e' would end the program, 'w' draw wires.
class CameraStyle : public vtkInteractorStyleTrackballCamera
{
public:
  static CameraStyle* New();
  vtkTypeMacro(CameraStyle, vtkInteractorStyleTrackballCamera);
  void OnChar() override {}
};
vtkStandardNewMacro(CameraStyle);
} // namespace

Viewport::Viewport(QWidget* parent) : QVTKOpenGLNativeWidget(parent)
{
  this->setRenderWindow(this->window_.Get());
  this->window_->AddRenderer(this->renderer_);
  this->window_->SetMultiSamples(4);
  this->setMinimumSize(320, 240);
  vtkNew<CameraStyle> style;
  this->interactor()->SetInteractorStyle(style);

  this->actor_->SetMapper(this->mapper_);
  this->actor_->VisibilityOff();
  this->renderer_->AddActor(this->actor_);
  this->mapper_->ScalarVisibilityOff();
  this->mapper_->SetScalarModeToUsePointFieldData();
  this->mapper_->SetColorModeToMapScalars();
  this->mapper_->InterpolateScalarsBeforeMappingOn(); // crisp bands, whatever the triangles
  this->mapper_->UseLookupTableScalarRangeOn();
  const bindpose::ColourMap map = bindpose::weight_map();
  this->mapper_->SetLookupTable(map.table);
  bindpose::use_surface_material(this->actor_);
  bindpose::add_lights(this->renderer_);
  this->renderer_->GradientBackgroundOn();
  this->renderer_->SetBackground(bindpose::palette::gradient_bottom[0],
    bindpose::palette::gradient_bottom[1], bindpose::palette::gradient_bottom[2]);
  this->renderer_->SetBackground2(bindpose::palette::gradient_top[0],
    bindpose::palette::gradient_top[1], bindpose::palette::gradient_top[2]);
  this->window_->SetNumberOfLayers(2);
  this->legend_->SetLayer(1);
  this->legend_->InteractiveOff();
  this->window_->AddRenderer(this->legend_);
  this->handles_->SetInteractor(this->interactor());
  this->handles_->CreateDefaultRepresentation();
}

Viewport::~Viewport()
{
  // The widget observes the interactor, which the base class is about to delete.
  this->handles_->SetInteractor(nullptr);
}

void Viewport::set_surface(vtkPolyData* surface)
{
  this->shaded_ = surface ? std::make_unique<bindpose::ShadedSurface>(surface) : nullptr;
  this->mapper_->SetInputData(surface ? this->shaded_->polydata() : nullptr);
  this->actor_->SetVisibility(surface != nullptr);
}

void Viewport::move_surface(vtkPolyData* posed)
{
  if (this->shaded_)
  {
    this->shaded_->move(bindpose::to_points(posed).view());
  }
}

void Viewport::show_column(int column, const QString& name)
{
  this->column_name_ = column < 0 ? QString() : name;
  this->mapper_->SetScalarVisibility(column >= 0);
  if (column >= 0)
  {
    this->mapper_->SelectColorArray("Weights");
    this->mapper_->SetArrayComponent(column);
    // The mapper's component counts only when it maps through the table's component mode.
    this->mapper_->GetLookupTable()->SetVectorModeToComponent();
    this->mapper_->GetLookupTable()->SetVectorComponent(column);
  }
  this->draw_legend();
  this->refresh();
}

void Viewport::draw_legend()
{
  this->legend_->RemoveAllViewProps();
  if (this->column_name_.isEmpty())
  {
    return;
  }
  const double scale = this->devicePixelRatioF();
  const int font = static_cast<int>(13 * scale);
  const bindpose::ColourMap map = bindpose::weight_map();
  const std::string name = this->column_name_.toStdString();
  bindpose::PixelBox box;
  box.x = static_cast<int>(20 * scale);
  box.width = bindpose::legend_width(map, name, font);
  box.height = static_cast<int>(240 * scale);
  box.y = static_cast<int>(24 * scale);
  bindpose::add_legend(this->legend_, map, name, box, font);
}

void Viewport::resizeEvent(QResizeEvent* event)
{
  QVTKOpenGLNativeWidget::resizeEvent(event);
  this->handles_->GetHandleSetRepresentation()->SetPixelScale(this->devicePixelRatioF());
  this->draw_legend();
}

void Viewport::reset_view()
{
  vtkPolyData* shown = this->shaded_ ? this->shaded_->polydata() : nullptr;
  if (!shown || shown->GetNumberOfPoints() == 0)
  {
    shown = this->handles_->GetHandles();
  }
  if (!shown || shown->GetNumberOfPoints() == 0)
  {
    return;
  }
  const bindpose::SharedMatrix<bindpose::Points> points = bindpose::to_points(shown);
  const bindpose::View view;
  const bindpose::Frame frame =
    bindpose::choose_frame(bindpose::bounding_box(points.view()), view.up);
  bindpose::fit_camera(this->renderer_->GetActiveCamera(), points.view(), frame, view,
    static_cast<double>(this->width()) / this->height(), 0.12);
  this->renderer_->ResetCameraClippingRange();
}

void Viewport::set_handles(vtkPolyData* handles)
{
  this->handles_->SetHandles(handles);
  this->handles_->SetEnabled(handles != nullptr);
}

void Viewport::refresh()
{
  if (this->refresh_pending_)
  {
    return;
  }
  this->refresh_pending_ = true;
  QTimer::singleShot(0, this,
    [this]
    {
      this->refresh_pending_ = false;
      this->window_->Render();
    });
}

bool Viewport::save_picture(const QString& path)
{
  this->window_->Render();
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(this->window_);
  grab->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(grab->GetOutputPort());
  writer->SetFileName(path.toStdString().c_str());
  writer->Write();
  return writer->GetErrorCode() == 0;
}

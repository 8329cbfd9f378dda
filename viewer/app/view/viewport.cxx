#include "app/view/viewport.h"

#include "app/parts/style.h"

#include "pictures/legend.h"
#include "pictures/tile_actors.h"
#include "pictures/window_picture.h"
#include "scene/camera.h"
#include "scene/categories.h"
#include "scene/coloring.h"
#include "scene/colors.h"
#include "scene/curves.h"
#include "shapes/moved_surface_mapper.h"
#include "shapes/outline.h"
#include "shapes/shaded_surface.h"
#include "shapes/surroundings.h"
#include "shapes/textured_surface.h"

#include "conversion.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkGenericOpenGLRenderWindow.h"
#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"
#include "vtkImageData.h"
#include "vtkInteractorStyleTrackballCamera.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRegionBrushRepresentation.h"
#include "vtkRegionBrushWidget.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkTexture.h"

#include <QApplication>
#include <QEvent>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QResizeEvent>

#include <algorithm>
#include <cmath>
#include <utility>

namespace app::view
{

namespace
{
constexpr int smooth_samples = 4; // samples per pixel

bool same_view(vtkCamera* a, vtkCamera* b)
{
  const auto same = [](const double* x, const double* y) { return std::equal(x, x + 3, y); };
  return same(a->GetPosition(), b->GetPosition()) && same(a->GetFocalPoint(), b->GetFocalPoint()) &&
    same(a->GetViewUp(), b->GetViewUp()) && a->GetParallelScale() == b->GetParallelScale() &&
    a->GetViewAngle() == b->GetViewAngle() &&
    a->GetParallelProjection() == b->GetParallelProjection();
}

/// Trackball camera without VTK's letter keys, because 'e' ends the program and 'w' draws
/// wireframes.
class CameraStyle : public vtkInteractorStyleTrackballCamera
{
public:
  static CameraStyle* New();
  vtkTypeMacro(CameraStyle, vtkInteractorStyleTrackballCamera);
  void OnChar() override {}
  void OnLeftButtonDown() override
  {
    if (!this->Is2D)
    {
      this->vtkInteractorStyleTrackballCamera::OnLeftButtonDown();
      return;
    }
    const int* event_position = this->Interactor->GetEventPosition();
    this->FindPokedRenderer(event_position[0], event_position[1]);
    this->StartPan();
  }

  bool Is2D = false; ///< true: 2D mode, in which dragging pans the view
};
vtkStandardNewMacro(CameraStyle);
} // namespace

Viewport::Viewport(QWidget* parent) : QVTKOpenGLNativeWidget(parent)
{
  this->setRenderWindow(this->window_.Get());
  this->window_->AddRenderer(this->renderer_);
  this->window_->SetMultiSamples(smooth_samples);
  this->setMinimumSize(320, 240);
  this->settle_timer_.setSingleShot(true);
  this->settle_timer_.setInterval(250);
  QObject::connect(&this->settle_timer_, &QTimer::timeout, this, &Viewport::refresh);
  vtkNew<CameraStyle> style;
  this->interactor()->SetInteractorStyle(style);

  this->actor_->SetMapper(this->mapper_);
  this->actor_->VisibilityOff();
  this->renderer_->AddActor(this->actor_);
  this->outline_ = std::make_unique<bindpose::Outline>(this->renderer_);
  const bindpose::ColorMap map = bindpose::weight_map();
  for (vtkPolyDataMapper* mapper :
    { static_cast<vtkPolyDataMapper*>(this->mapper_), this->tint_mapper_.Get() })
  {
    mapper->ScalarVisibilityOff();
    mapper->SetScalarModeToUsePointFieldData();
    mapper->SetColorModeToMapScalars();
    // Look up colors per pixel, so that color bands have sharp borders inside of triangles.
    mapper->InterpolateScalarsBeforeMappingOn();
    mapper->UseLookupTableScalarRangeOn();
    mapper->SetLookupTable(map.table);
  }
  this->tint_actor_->SetMapper(this->tint_mapper_);
  this->tint_actor_->VisibilityOff();
  this->tint_actor_->PickableOff();
  this->tint_actor_->GetProperty()->LightingOff();
  // The tint (the colors of values over a texture) has the same depth as the textured surface. Draw
  // the tint in front of the surface, and isolines in front of both.
  this->tint_mapper_->SetRelativeCoincidentTopologyPolygonOffsetParameters(-1.0, -1.0);
  this->renderer_->AddActor(this->tint_actor_);
  bindpose::use_surface_material(this->actor_);
  bindpose::add_lights(this->renderer_);
  this->renderer_->GradientBackgroundOn();
  this->window_->SetNumberOfLayers(2);
  this->legend_->SetLayer(1);
  this->legend_->InteractiveOff();
  this->legend_->PreserveDepthBufferOn(); // keep the depths of the scene, which is layer 0
  this->window_->AddRenderer(this->legend_);
  this->handles_->SetInteractor(this->interactor());
  this->handles_->CreateDefaultRepresentation();
  this->use_appearance();
  // Assign the widgets to this renderer. Otherwise they would use the renderer under the mouse when
  // they are enabled.
  this->handles_->SetDefaultRenderer(this->renderer_);
  this->brush_->SetDefaultRenderer(this->renderer_);
  this->brush_->SetInteractor(this->interactor());
  this->brush_->CreateDefaultRepresentation();
  // Disable direct rendering, so that all requests of widgets and camera during one event result in
  // one rendering after the event.
  this->interactor()->EnableRenderOff();
  this->interactor()->AddObserver(vtkCommand::RenderEvent, this, &Viewport::render_requested);
  this->since_start_.start();
  this->renderer_->AddObserver(vtkCommand::EndEvent, this, &Viewport::frame_drawn);
}

Viewport::~Viewport()
{
  // Detach the widgets, because they observe the interactor, which the base class deletes.
  this->handles_->SetInteractor(nullptr);
  this->brush_->SetInteractor(nullptr);
}

void Viewport::set_surface(vtkPolyData* surface)
{
  if (surface && this->shaded_ && this->shaded_->has_same_mesh(surface))
  {
    this->shaded_->set_arrays(surface);
  }
  else
  {
    this->shaded_ = surface ? std::make_unique<bindpose::ShadedSurface>(surface) : nullptr;
    for (vtkPolyDataMapper* mapper :
      { static_cast<vtkPolyDataMapper*>(this->mapper_), this->tint_mapper_.Get() })
    {
      mapper->SetInputData(surface ? this->shaded_->polydata() : nullptr);
    }
    this->outline_->set_shape(this->shaded_.get());
    this->set_look(nullptr, nullptr);
  }
  this->depths_.resize(0);
  this->first_picture_ = true;
  this->show_values(nullptr, true);
  this->set_surface_appearance(this->surface_appearance_);
}

void Viewport::set_surface_appearance(int appearance)
{
  this->surface_appearance_ = appearance;
  this->move_colors();
  vtkProperty* property = this->actor_->GetProperty();
  const bool draws_look = this->draws_look();
  this->actor_->SetVisibility(this->shaded_ && appearance != hidden && !draws_look);
  if (this->textured_)
  {
    for (const auto& actor : this->textured_->actors())
    {
      actor->SetVisibility(draws_look);
    }
  }
  property->SetOpacity(appearance == see_through ? 0.25 : 1.0);
  property->SetRepresentation(appearance == edges_only ? VTK_WIREFRAME : VTK_SURFACE);
  property->SetLighting(appearance != edges_only && !this->picture_);
  constexpr bindpose::Rgb white{ 1.0, 1.0, 1.0 };
  const bindpose::Rgb& color = appearance == edges_only ? bindpose::palette::edges
    : this->picture_                                    ? white
                                                        : bindpose::palette::surface;
  bindpose::set_color(property, color);
  this->outline_->show(this->outlines_ && !this->picture_ && !draws_look &&
      (appearance == solid || appearance == see_through),
    bindpose::outline_width * this->devicePixelRatioF());
  this->show_tint();
  // Sorting translucent triangles by depth requires one sample per pixel.
  const bool sorts_by_depth = this->shaded_ &&
    (appearance == see_through || this->ghosted_ ||
      (draws_look && this->look_->surface.is_translucent()));
  this->renderer_->SetUseDepthPeeling(sorts_by_depth);
  this->renderer_->SetMaximumNumberOfPeels(6);
  this->renderer_->SetUseFXAA(sorts_by_depth);
  this->window_->SetMultiSamples(sorts_by_depth ? 0 : smooth_samples);
  this->refresh();
}

void Viewport::show_outlines(bool shown)
{
  this->outlines_ = shown;
  this->set_surface_appearance(this->surface_appearance_);
}

void Viewport::set_picture(vtkImageData* picture)
{
  this->picture_ = picture;
  vtkSmartPointer<vtkTexture> texture;
  if (picture)
  {
    texture = vtkSmartPointer<vtkTexture>::New();
    texture->SetInputData(picture);
    texture->InterpolateOn();
    texture->MipmapOn();
    texture->SetColorModeToDirectScalars();
  }
  this->actor_->SetTexture(texture);
  // Textured surfaces cover only the opaque part of the image. Force VTK to draw them as opaque. If
  // the image has alpha, VTK would otherwise sort their triangles by depth.
  this->actor_->SetForceOpaque(picture != nullptr);
  this->mapper_->ScalarVisibilityOff();
  this->tint_mapper_->ScalarVisibilityOff();
  if (!this->has_values_)
  {
    this->use_column();
  }
  this->set_surface_appearance(this->surface_appearance_);
}

void Viewport::set_look(std::shared_ptr<const bindpose::FileLook> look, vtkPolyData* rest)
{
  if (look == this->look_)
  {
    return;
  }
  if (this->textured_)
  {
    for (const auto& actor : this->textured_->actors())
    {
      this->renderer_->RemoveActor(actor);
    }
  }
  this->textured_.reset();
  this->look_ = std::move(look);
  if (this->look_)
  {
    this->textured_ =
      std::make_unique<bindpose::TexturedSurface>(*this->look_, bindpose::to_points(rest).view());
    for (const auto& actor : this->textured_->actors())
    {
      this->renderer_->AddActor(actor);
    }
    if (!this->renderer_->GetEnvironmentTexture())
    {
      bindpose::add_surroundings(this->renderer_, bindpose::Vec3::UnitY());
    }
  }
  this->set_surface_appearance(this->surface_appearance_);
}

void Viewport::show_look(bool shown)
{
  this->look_shown_ = shown;
  this->set_surface_appearance(this->surface_appearance_);
}

bool Viewport::draws_look() const
{
  return this->textured_ && this->look_shown_ && this->surface_appearance_ == solid &&
    !this->right_renderer_;
}

/// If the other mapper shows colors of values, move them to value_mapper().
void Viewport::move_colors()
{
  vtkPolyDataMapper* mapper = this->value_mapper();
  vtkPolyDataMapper* other = mapper == this->tint_mapper_
    ? static_cast<vtkPolyDataMapper*>(this->mapper_)
    : this->tint_mapper_.Get();
  if (other->GetScalarVisibility())
  {
    mapper->SetScalarMode(other->GetScalarMode());
    mapper->SetInterpolateScalarsBeforeMapping(other->GetInterpolateScalarsBeforeMapping());
    mapper->SetLookupTable(other->GetLookupTable());
    mapper->SelectColorArray(other->GetArrayName());
    mapper->SetArrayComponent(other->GetArrayComponent());
    mapper->ScalarVisibilityOn();
    other->ScalarVisibilityOff();
  }
}

void Viewport::set_tint(double opacity)
{
  this->tint_ = opacity;
  this->show_tint();
  this->refresh();
}

/// Return the mapper that shows values as colors. If the surface has a texture, this is
/// tint_mapper_, which draws the colors over the texture.
vtkPolyDataMapper* Viewport::value_mapper() const
{
  return this->has_texture() ? this->tint_mapper_.Get()
                             : static_cast<vtkPolyDataMapper*>(this->mapper_.Get());
}

void Viewport::show_tint()
{
  this->tint_actor_->SetVisibility(this->has_texture() && this->shaded_ &&
    this->surface_appearance_ == solid && this->tint_ > 0.0 &&
    this->tint_mapper_->GetScalarVisibility());
  // The translucent tint needs no sorting by depth, because the textured surface, if it is opaque,
  // hides all parts of the tint behind it.
  this->tint_actor_->GetProperty()->SetOpacity(this->tint_);
}

void Viewport::set_plane(const std::optional<bindpose::Vec3>& normal)
{
  this->plane_ = normal;
  CameraStyle::SafeDownCast(this->interactor()->GetInteractorStyle())->Is2D = normal.has_value();
  this->renderer_->GetActiveCamera()->SetParallelProjection(normal.has_value());
}

void Viewport::set_curves(vtkPolyData* curves)
{
  for (const auto& actor : this->curves_)
  {
    this->renderer_->RemoveActor(actor);
  }
  this->curves_.clear();
  this->curve_data_ = curves;
  if (curves)
  {
    double bounds[6];
    curves->GetBounds(bounds);
    bindpose::Box box = this->extra_bounds_;
    box.add(bindpose::Vec3(bounds[0], bounds[2], bounds[4]));
    box.add(bindpose::Vec3(bounds[1], bounds[3], bounds[5]));
    this->curves_ =
      bindpose::make_curves(curves, 0.0025 * box.diagonal(), 1.5 * this->devicePixelRatioF());
    for (const auto& actor : this->curves_)
    {
      this->renderer_->AddActor(actor);
    }
  }
  this->refresh();
}

void Viewport::show_curves(bool shown)
{
  for (const auto& actor : this->curves_)
  {
    actor->SetVisibility(shown);
  }
}

void Viewport::show_legend(
  LegendPosition position, const QString& name, const bindpose::ColorMap& map)
{
  this->legends_.erase(position);
  if (!name.isEmpty())
  {
    this->legends_[position] = { name, map };
  }
  this->draw_legend();
  this->refresh();
}

QString Viewport::legend(LegendPosition position) const
{
  const auto found = this->legends_.find(position);
  return found == this->legends_.end() ? QString() : found->second.first;
}

void Viewport::set_extra_bounds(const bindpose::Box& box)
{
  this->extra_bounds_ = box;
}

template <typename Shape>
void Viewport::move_shape(Shape& shape, bindpose::PointsView points) const
{
  if (this->depths_.size() != points.rows())
  {
    shape.move(points);
    return;
  }
  bindpose::Points drawn = points;
  drawn += this->depths_ * this->eye_direction_.transpose();
  shape.move(drawn);
}
template void Viewport::move_shape(
  bindpose::ShadedSurface& shape, bindpose::PointsView points) const;

void Viewport::move_surface(vtkPolyData* posed)
{
  this->move_surface(bindpose::to_points(posed).view());
}

void Viewport::move_surface(bindpose::PointsView points)
{
  if (!this->shaded_)
  {
    return;
  }
  this->move_shape(*this->shaded_, points);
  if (this->textured_)
  {
    this->move_shape(*this->textured_, points);
  }
}

void Viewport::set_ghosted(bool ghosted)
{
  this->ghosted_ = ghosted;
  this->set_surface_appearance(this->surface_appearance_);
}

void Viewport::set_split(vtkRenderer* right_renderer, vtkPolyData* shape)
{
  const double before = this->aspect_of(this->size());
  this->right_shape_ = shape;
  if (right_renderer != this->right_renderer_)
  {
    this->right_renderer_ = right_renderer;
    this->set_surface_appearance(this->surface_appearance_);
    this->renderer_->SetViewport(0.0, 0.0, right_renderer ? 0.5 : 1.0, 1.0);
    this->use_appearance();
    this->draw_legend();
    // If the user has not moved the camera, restore the camera from before the split.
    vtkCamera* camera = this->renderer_->GetActiveCamera();
    if (!right_renderer && same_view(camera, this->camera_after_split_))
    {
      camera->DeepCopy(this->camera_before_split_);
      this->renderer_->ResetCameraClippingRange();
    }
    else
    {
      this->camera_before_split_->DeepCopy(camera);
      this->keep_in_view(before);
      this->camera_after_split_->DeepCopy(camera);
    }
  }
  this->refresh();
}

void Viewport::set_half_names(const QString& left, const QString& right)
{
  if (left != this->left_name_ || right != this->right_name_)
  {
    this->left_name_ = left;
    this->right_name_ = right;
    this->draw_legend();
    this->refresh();
  }
}

void Viewport::set_state_name(const QString& state)
{
  if (state != this->state_name_)
  {
    this->state_name_ = state;
    this->draw_legend();
    this->refresh();
  }
}

/// Return the aspect ratio of the half that shows the surface, or of the whole view if it is not
/// split.
double Viewport::aspect_of(const QSize& size) const
{
  return (this->right_renderer_ ? 0.5 : 1.0) * size.width() / std::max(size.height(), 1);
}

void Viewport::keep_in_view(double aspect_before)
{
  const std::vector<bindpose::Vec3> positions = this->points_to_show();
  if (!positions.empty())
  {
    const Eigen::Map<const bindpose::Points> points(
      positions.front().data(), static_cast<bindpose::Index>(positions.size()), 3);
    bindpose::keep_in_view(
      this->renderer_->GetActiveCamera(), points, aspect_before, this->aspect_of(this->size()));
    this->renderer_->ResetCameraClippingRange();
  }
}

double Viewport::upload_microseconds() const
{
  return this->mapper_->upload_microseconds();
}

void Viewport::frame_drawn()
{
  const double now = 1e-9 * static_cast<double>(this->since_start_.nsecsElapsed());
  const double seconds = now - this->last_drawn_;
  this->frame_seconds_ = seconds > 0.5 ? 0.0
    : this->frame_seconds_ > 0.0       ? 0.8 * this->frame_seconds_ + 0.2 * seconds
                                       : seconds;
  this->last_drawn_ = now;
}

double Viewport::frames_per_second() const
{
  return this->frame_seconds_ > 0.0 ? 1.0 / this->frame_seconds_ : 0.0;
}

void Viewport::show_column(int column, const QString& name)
{
  this->column_ = column;
  this->column_name_ = column < 0 ? QString() : name;
  if (!this->has_values_)
  {
    this->use_column();
  }
  this->draw_legend();
  this->refresh();
}

void Viewport::use_column()
{
  vtkPolyDataMapper* mapper = this->value_mapper();
  mapper->SetScalarVisibility(this->column_ >= 0);
  if (this->column_ >= 0)
  {
    mapper->SetScalarModeToUsePointFieldData();
    mapper->InterpolateScalarsBeforeMappingOn();
    mapper->SetLookupTable(bindpose::weight_map().table);
    mapper->SelectColorArray("Weights");
    mapper->SetArrayComponent(this->column_);
    // The mapper uses its array component only if the lookup table is in component mode.
    mapper->GetLookupTable()->SetVectorModeToComponent();
    mapper->GetLookupTable()->SetVectorComponent(this->column_);
  }
  this->show_tint();
}

vtkPolyData* Viewport::drawn() const
{
  return this->shaded_ ? this->shaded_->polydata() : nullptr;
}

const std::vector<bindpose::Index>& Viewport::drawn_points() const
{
  static const std::vector<bindpose::Index> none;
  return this->shaded_ ? this->shaded_->input_points() : none;
}

void Viewport::show_values(
  vtkDoubleArray* values, bool on_points, const QString& name, const bindpose::ColorMap& map)
{
  vtkPolyDataMapper* mapper = this->value_mapper();
  this->has_values_ = this->shaded_ && !name.isEmpty();
  if (this->has_values_ && !values)
  {
    mapper->ScalarVisibilityOff();
  }
  else if (this->has_values_)
  {
    vtkPolyData* drawn = this->drawn();
    drawn->GetPointData()->RemoveArray(bindpose::color_array_name);
    drawn->GetCellData()->RemoveArray(bindpose::color_array_name);
    values->SetName(bindpose::color_array_name);
    if (on_points)
    {
      drawn->GetPointData()->AddArray(values);
      mapper->SetScalarModeToUsePointFieldData();
    }
    else
    {
      drawn->GetCellData()->AddArray(values);
      mapper->SetScalarModeToUseCellFieldData();
    }
    mapper->SetInterpolateScalarsBeforeMapping(on_points);
    mapper->SetLookupTable(map.table);
    mapper->SelectColorArray(bindpose::color_array_name);
    mapper->SetArrayComponent(0);
    mapper->ScalarVisibilityOn();
  }
  else
  {
    this->use_column();
  }
  this->show_tint();
  this->show_legend(weight_legend, this->has_values_ ? name : QString(), map);
}

bool Viewport::shows_values(vtkDoubleArray* values) const
{
  vtkPolyData* drawn = this->drawn();
  return values && drawn && this->has_values_ &&
    (drawn->GetPointData()->GetArray(bindpose::color_array_name) == values ||
      drawn->GetCellData()->GetArray(bindpose::color_array_name) == values);
}

void Viewport::use_appearance()
{
  using namespace bindpose::palette;
  const bindpose::Rgb& bottom_color = parts::is_dark() ? dark_gradient_bottom : gradient_bottom;
  const bindpose::Rgb& top_color = parts::is_dark() ? dark_gradient_top : gradient_top;
  for (vtkRenderer* renderer : { this->renderer_.Get(), this->right_renderer_ })
  {
    if (renderer)
    {
      renderer->SetBackground(bottom_color[0], bottom_color[1], bottom_color[2]);
      renderer->SetBackground2(top_color[0], top_color[1], top_color[2]);
    }
  }
  const bindpose::Rgb& text_color = parts::is_dark() ? dark_text : text;
  const bindpose::Rgb& label_background = parts::is_dark() ? dark_gradient_bottom : white;
  vtkTextProperty* name = this->handles_->GetHandleSetRepresentation()->GetLabelTextProperty();
  name->SetColor(text_color[0], text_color[1], text_color[2]);
  name->SetBackgroundColor(label_background[0], label_background[1], label_background[2]);
}

void Viewport::changeEvent(QEvent* event)
{
  QVTKOpenGLNativeWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange)
  {
    this->use_appearance();
    this->draw_legend();
    this->refresh();
  }
}

void Viewport::draw_legend()
{
  this->legend_->RemoveAllViewProps();
  const double scale = this->pixel_scale();
  const int font = static_cast<int>(13 * scale);
  bindpose::PixelBox box;
  box.x = static_cast<int>(20 * scale);
  box.y = static_cast<int>(24 * scale);
  // The number of lines determines the height of a legend with texts. If there are too many lines,
  // the last line states how many are omitted. `line_height` is the height of a line and `margin`
  // the total margin, both in units of the font size.
  constexpr double line_height = 1.7, margin = 2.5;
  const double available_height = scale * this->height() - 2 * box.y;
  const int maximum_lines =
    std::max(2, static_cast<int>((available_height / font - margin) / line_height));
  const auto add = [&](const bindpose::ColorMap& all, const QString& name)
  {
    const bindpose::ColorMap map = bindpose::shorten_legend(all, maximum_lines);
    box.height = map.texts.empty() && !map.ticks.empty()
      ? static_cast<int>(240 * scale)
      : static_cast<int>((margin + line_height * static_cast<double>(map.texts.size())) * font);
    box.width = bindpose::legend_width(map, name.toStdString(), font);
    bindpose::add_legend(this->legend_, map, name.toStdString(), box, font,
      parts::is_dark() ? bindpose::palette::dark_text : bindpose::palette::text);
    box.x += box.width + 2 * font;
  };
  if (!this->column_name_.isEmpty() && !this->has_values_)
  {
    add(bindpose::weight_map(), this->column_name_);
  }
  for (const auto& [position, legend] : this->legends_)
  {
    add(legend.second, legend.first);
  }
  if (this->right_renderer_)
  {
    // draw the names at the lower edge, where they do not cover a shape
    this->add_name(0.25, 14.0, this->left_name_);
    this->add_name(0.75, 14.0, this->right_name_);
  }
  if (!this->state_name_.isEmpty())
  {
    // distance from the top in Qt pixels, so that a bar fits above the text
    constexpr double below_a_bar = 64.0;
    this->add_name(0.5, this->height() - below_a_bar, this->state_name_);
  }
}

/// Add a centered text at a fraction of the width, and `bottom_margin` Qt pixels above the lower
/// edge.
void Viewport::add_name(double center_fraction, double bottom_margin, const QString& name)
{
  const double scale = this->pixel_scale();
  vtkNew<vtkTextActor> text;
  text->SetInput(name.toUtf8().constData());
  vtkTextProperty* font = text->GetTextProperty();
  font->SetFontSize(static_cast<int>(14 * scale));
  font->SetJustificationToCentered();
  const bindpose::Rgb& color =
    parts::is_dark() ? bindpose::palette::dark_text : bindpose::palette::text;
  font->SetColor(color[0], color[1], color[2]);
  text->SetPosition(
    std::round(center_fraction * scale * this->width()), std::round(bottom_margin * scale));
  this->legend_->AddViewProp(text);
}

void Viewport::resizeEvent(QResizeEvent* event)
{
  // Set a fixed resolution, because VTK would otherwise also scale texts by the screen's dots per
  // inch. All sizes here are in Qt pixels.
  constexpr double text_dpi = 72.0;
  this->setUnscaledDPI(static_cast<int>(std::lround(text_dpi / this->devicePixelRatioF())));
  this->resizing_ = true;
  QVTKOpenGLNativeWidget::resizeEvent(event);
  this->resizing_ = false;
  this->update();
  if (this->right_renderer_ && event->oldSize().isValid())
  {
    this->keep_in_view(this->aspect_of(event->oldSize()));
  }
  this->set_pixel_scale();
}

void Viewport::initializeGL()
{
  QVTKOpenGLNativeWidget::initializeGL();
  const auto* name =
    reinterpret_cast<const char*>(this->context()->functions()->glGetString(GL_RENDERER));
  const QString renderer = QString::fromLatin1(name ? name : "");
  this->uses_software_rendering_ = renderer.contains("llvmpipe") || renderer.contains("softpipe") ||
    renderer.contains("Software") || renderer.contains("SWR");
}

/// Paint only if the view is not being resized. Qt paints during every resize, and the layout of a
/// new window resizes the view several times. The last size is painted together with the window.
void Viewport::paintGL()
{
  if (!this->resizing_)
  {
    this->interactor()->EnableRenderOn();
    QVTKOpenGLNativeWidget::paintGL();
    this->interactor()->EnableRenderOff();
  }
}

void Viewport::render_requested()
{
  // rendering is enabled only in paintGL()
  if (!this->interactor()->GetEnableRender())
  {
    this->refresh();
  }
}

/// Return points of everything that the view must contain.
std::vector<bindpose::Vec3> Viewport::points_to_show() const
{
  // Include the handles only if there is no other data.
  std::vector<vtkPolyData*> shown;
  for (vtkPolyData* candidate : { this->shaded_ ? this->shaded_->polydata() : nullptr,
         this->curve_data_.Get(), this->right_renderer_ ? this->right_shape_.Get() : nullptr })
  {
    if (candidate && candidate->GetNumberOfPoints() > 0)
    {
      shown.push_back(candidate);
    }
  }
  vtkPolyData* handles = this->handles_->GetHandles();
  if (shown.empty() && this->extra_bounds_.empty() && handles && handles->GetNumberOfPoints() > 0)
  {
    shown.push_back(handles);
  }
  std::vector<bindpose::Vec3> positions;
  for (vtkPolyData* polydata : shown)
  {
    const bindpose::SharedMatrix<bindpose::Points> points = bindpose::to_points(polydata);
    for (bindpose::Index v = 0; v < points.view().rows(); ++v)
    {
      positions.emplace_back(points.view().row(v).transpose());
    }
  }
  if (!this->extra_bounds_.empty())
  {
    const bindpose::Vec3 ends[2] = { this->extra_bounds_.lower, this->extra_bounds_.upper };
    for (int corner = 0; corner < 8; ++corner)
    {
      positions.emplace_back(
        ends[corner & 1].x(), ends[corner >> 1 & 1].y(), ends[corner >> 2 & 1].z());
    }
  }
  return positions;
}

void Viewport::reset_view()
{
  const std::vector<bindpose::Vec3> positions = this->points_to_show();
  if (positions.empty())
  {
    return;
  }
  const Eigen::Map<const bindpose::Points> points(
    positions.front().data(), static_cast<bindpose::Index>(positions.size()), 3);
  vtkCamera* camera = this->renderer_->GetActiveCamera();
  const double aspect = this->aspect_of(this->size());
  if (this->plane_)
  {
    bindpose::fit_parallel_camera(camera, points, *this->plane_, aspect, 0.12);
    this->renderer_->ResetCameraClippingRange();
    return;
  }
  const bindpose::View view;
  const bindpose::Frame frame = bindpose::choose_frame(bindpose::bounding_box(points), view.up);
  bindpose::fit_camera(camera, points, frame, view, aspect, 0.12);
  this->renderer_->ResetCameraClippingRange();
}

QPoint Viewport::to_vtk(const QPoint& position) const
{
  const double scale = this->devicePixelRatioF();
  return { static_cast<int>(scale * position.x()),
    static_cast<int>(scale * (this->height() - 1 - position.y())) };
}

void Viewport::ray_at(int x, int y, bindpose::Vec3& ray_origin, bindpose::Vec3& ray_direction) const
{
  const auto world = [&](double depth)
  {
    this->renderer_->SetDisplayPoint(x + 0.5, y + 0.5, depth);
    this->renderer_->DisplayToWorld();
    return bindpose::Vec3(
      Eigen::Map<const Eigen::Vector4d>(this->renderer_->GetWorldPoint()).hnormalized());
  };
  ray_origin = world(0.0);
  ray_direction = (world(1.0) - ray_origin).normalized();
}

void Viewport::set_handles(vtkPolyData* handles, bool used)
{
  this->handles_->SetHandles(handles);
  this->handles_->SetEnabled(used);
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
      // During a drag, for example of a slider, a cloud (volume rendering) is drawn coarsely. It is
      // drawn again when the drag ends.
      const bool dragging = QApplication::mouseButtons() != Qt::NoButton;
      this->window_->SetDesiredUpdateRate(dragging ? this->interactor()->GetDesiredUpdateRate()
                                                   : this->interactor()->GetStillUpdateRate());
      const int samples = this->window_->GetMultiSamples();
      const bool coarse = this->uses_software_rendering_ && samples > 0 &&
        (dragging || std::exchange(this->first_picture_, false));
      this->window_->SetMultiSamples(coarse ? 0 : samples);
      this->window_->Render();
      // restore antialiasing for code that renders without refresh()
      this->window_->SetMultiSamples(samples);
      if (dragging || coarse)
      {
        this->settle_timer_.start();
      }
    });
}

// ---- Pictures ----------------------------------------------------------------------------------

QSize Viewport::picture_size(int scale) const
{
  const int* size = this->window_->GetSize();
  return scale * QSize(size[0], size[1]);
}

/// Return the number of rendered pixels per Qt pixel.
double Viewport::pixel_scale() const
{
  return this->picture_scale_ * this->devicePixelRatioF();
}

void Viewport::set_pixel_scale()
{
  this->handles_->GetHandleSetRepresentation()->SetPixelScale(this->pixel_scale());
  this->brush_->GetRegionBrushRepresentation()->SetPixelScale(this->pixel_scale());
  this->draw_legend();
}

bindpose::Status Viewport::take_picture(
  int scale, bool transparent, vtkSmartPointer<vtkImageData>& picture)
{
  const QSize size = this->picture_size(scale);
  bindpose::WindowPicture request;
  request.width = size.width();
  request.height = size.height();
  request.transparent = transparent;
  this->window_->Render(); // apply all changes since the last rendering
  const bool used_fxaa = this->renderer_->GetUseFXAA();
  // Disable FXAA (antialiasing by filtering), because draw_in_tiles() averages several samples.
  this->renderer_->UseFXAAOff();
  this->picture_scale_ = scale * request.samples;
  this->set_pixel_scale();
  bindpose::Status status;
  {
    const bindpose::ScaledLines lines(this->window_, this->picture_scale_);
    status = bindpose::draw_in_tiles(this->window_, request, picture);
  }
  this->picture_scale_ = 1.0;
  this->set_pixel_scale();
  this->renderer_->SetUseFXAA(used_fxaa);
  this->window_->Render();
  return status;
}

} // namespace app::view

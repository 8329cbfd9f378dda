#include "app/tour/tour_values.h"

#include "app/handles/side_panel.h"
#include "app/parts/notice_bar.h"
#include "app/posing/body_motion.h"
#include "app/posing/key_strip.h"
#include "app/posing/pose_ghost.h"
#include "app/posing/pose_panel.h"
#include "app/posing/posing.h"
#include "app/tets/tet_inspection.h"
#include "app/tour/simulated_user.h"
#include "app/view/viewport.h"
#include "app/volume/volume_view.h"
#include "app/weights/binding.h"
#include "app/weights/weight_inspection.h"
#include "app/window/main_window.h"
#include "app/window/panel_column.h"
#include "document/dataset_json.h"
#include "document/document.h"

#include "conversion.h"
#include "pose/transform_parts.h"
#include "scene/volume.h"

#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"
#include "vtkPointData.h"
#include "vtkRenderer.h"

#include <QApplication>
#include <QUndoStack>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <limits>
#include <string>

#include <unistd.h>

namespace app::tour
{

using namespace bindpose;

namespace
{
using Json = nlohmann::ordered_json;

Json to_json(const Vec3& position)
{
  return { position.x(), position.y(), position.z() };
}

/// Add entries about the distances between two shapes with the same points.
void add_distance(Json& values, const std::string& name, PointsView a, PointsView b)
{
  if (a.rows() == b.rows() && a.rows() > 0)
  {
    const Eigen::VectorXd distances = (a - b).rowwise().norm();
    values[name + ".largest"] = distances.maxCoeff();
    values[name + ".rms"] =
      std::sqrt(distances.squaredNorm() / static_cast<double>(distances.size()));
  }
}

void add_work(Json& values, window::MainWindow* window)
{
  const Document* document = window->document();
  const Work& work = document->work();
  values["name"] = work.name.toStdString();
  values["triangles"] = work.surface ? work.surface->GetNumberOfPolys() : 0;
  values["points"] = work.surface ? work.surface->GetNumberOfPoints() : 0;
  values["handles"] = static_cast<int>(document->handles().size());
  values["bound"] = window->is_bound();
  values["binding"] = window->findChild<weights::Binding*>()->is_running();
  values["idle"] = is_idle(window);
  values["panel"] = SimulatedUser::panel_names()
                      .value(window->findChild<window::PanelColumn*>()->shown_panel())
                      .toStdString();
  values["steps"] = window->document()->history()->index();
  values["undo"] = window->document()->history()->undoText().toStdString();
  values["redo"] = window->document()->history()->redoText().toStdString();
  values["error"] = window->error().toStdString();
  values["note"] = window->findChild<parts::NoticeBar*>("note_bar")->message().toStdString();
  values["rebind"] = window->findChild<parts::NoticeBar*>("rebind_bar")->message().toStdString();
  values["dialog"] = QApplication::activeModalWidget() != nullptr;
  values["reading"] = window->reading().toStdString();
  values["state"] = window->findChild<view::Viewport*>()->state_name().toStdString();
  values["title"] = window->windowTitle().toStdString();
}

void add_options(Json& values, const Document* document)
{
  const nlohmann::json options = options_to_json(document->work().options);
  for (const auto& [key, value] : options.items())
  {
    values["option." + key] = value;
  }
}

void add_handles(Json& values, window::MainWindow* window)
{
  const Document* document = window->document();
  auto* representation =
    window->findChild<view::Viewport*>()->handle_widget()->GetHandleSetRepresentation();
  const int selected = window->findChild<handles::SidePanel*>()->selected_handle();
  const Handles& handles = document->handles();
  values["selected"] =
    selected >= 0 && selected < static_cast<int>(handles.size()) ? handles[selected].name : "";
  values["selected.count"] =
    static_cast<int>(window->findChild<handles::SidePanel*>()->selected_handles().size());
  const Pose pose = document->pose();
  for (std::size_t k = 0; k < handles.size(); ++k)
  {
    const Handle& handle = handles[k];
    Vec3 head, tail;
    representation->GetPosedHead(document->handle_cells()[k], head.data());
    representation->GetPosedTail(document->handle_cells()[k], tail.data());
    values["handle." + handle.name] = to_json(head);
    if (handle.kind == HandleKind::bone)
    {
      values["tail." + handle.name] = to_json(tail);
    }
    values["mode." + handle.name] = to_string(pose[k].mode);
  }
}

void add_shape(Json& values, window::MainWindow* window)
{
  vtkPolyData* rest = window->document()->surface();
  vtkPolyData* shown = window->shown();
  if (!rest || !shown)
  {
    return;
  }
  const SharedMatrix<Points> at_rest = to_points(rest);
  const SharedMatrix<Points> posed = to_points(shown);
  values["shape.finite"] = posed.view().allFinite();
  values["shape.lower"] = to_json(posed.view().colwise().minCoeff().transpose());
  values["shape.upper"] = to_json(posed.view().colwise().maxCoeff().transpose());
  add_distance(values, "moved", at_rest.view(), posed.view());
  posing::PoseController* posing = window->findChild<posing::PoseController*>();
  if (!posing->can_pose())
  {
    return;
  }
  values["method"] = to_string(posing->deformation()->options().method);
  const Status& status = posing->deformation()->status();
  values["converged"] = status.ok();
  for (const char* key : { "energy", "iterations" })
  {
    if (status.report.find(key))
    {
      values[key] = status.report.number(key, 0.0);
    }
  }
  if (const PoseRotations* found = posing->rotations())
  {
    double largest = 0.0;
    for (const Eigen::Matrix3d& rotation : found->rotations)
    {
      largest = std::max(largest, rotation_vector(rotation).norm());
    }
    values["rotations"] = static_cast<int>(found->rotations.size());
    values["rotations.largest"] = largest;
  }
  if (posing->ghost()->display_mode() != posing::PoseGhost::hidden)
  {
    values["compared"] = to_string(posing->compared_deformation()->options().method);
    add_distance(values, "difference", posed.view(), posing->compared_deformation()->points());
  }
  if (posing->motion()->has_started())
  {
    values["body.seconds"] = posing->motion()->body()->time();
  }
}

void add_weights(Json& values, window::MainWindow* window)
{
  vtkPolyData* surface = window->document()->surface();
  vtkDataArray* weights = surface ? surface->GetPointData()->GetArray("Weights") : nullptr;
  if (!weights)
  {
    return;
  }
  const auto matrix = to_matrix(weights);
  if (matrix.view().size() > 0)
  {
    values["weights.minimum"] = matrix.view().minCoeff();
    values["weights.maximum"] = matrix.view().maxCoeff();
    // The largest deviation of a row's sum from one.
    values["weights.row_sum_error"] =
      (matrix.view().rowwise().sum().array() - 1.0).abs().maxCoeff();
  }
  for (const auto& [name, key] : { std::pair("WeightsRelativeGap", "weights.relative_gap"),
         std::pair("WeightsKKTResidual", "weights.kkt_residual") })
  {
    if (vtkDataArray* certificate = surface->GetFieldData()->GetArray(name))
    {
      values[key] = certificate->GetRange()[1]; // the value of the worst column
    }
  }
  const weights::WeightView* view = window->findChild<weights::WeightInspection*>()->view();
  if (view->is_shown())
  {
    values["weights.extrema"] = static_cast<int>(view->extrema().size());
    values["weights.isolines"] = view->isolines()->GetNumberOfCells();
    if (view->is_sliced())
    {
      values["weights.slice_position"] = view->plane()->position();
      values["weights.slice_area"] = view->slice() ? surface_area(view->slice()) : 0.0;
    }
  }
}

void add_volume(Json& values, window::MainWindow* window)
{
  volume::VolumeView* view = window->findChild<volume::VolumeView*>();
  if (!view->volume())
  {
    return;
  }
  const Status status = check_volume(view->volume(), "WindingNumber");
  values["winding.minimum"] = status.report.number("volume.minimum", 0.0);
  values["winding.maximum"] = status.report.number("volume.maximum", 0.0);
  values["slice.position"] = view->position();
  values["slice.normal"] = to_json(view->slice_normal());
  values["isosurface.level"] = view->level();
  values["isosurface.area"] = surface_area(view->isosurface());
}

void add_tets(Json& values, window::MainWindow* window)
{
  const tets::TetView* view = window->findChild<tets::TetInspection*>()->tet_view();
  if (view->tets())
  {
    values["tets"] = view->tets()->GetNumberOfCells();
    values["tets.shown"] = view->shown_count();
    values["tets.position"] = view->plane()->position();
  }
}

void add_keys(Json& values, window::MainWindow* window)
{
  const StoredPoses& stored_poses = window->findChild<posing::PoseController*>()->stored_poses();
  values["keys"] = static_cast<int>(stored_poses.keys.keys().size());
  values["keys.seconds"] = stored_poses.keys.duration();
  values["keys.time"] = window->findChild<posing::KeyStrip*>()->time();
  values["keys.playing"] =
    window->findChild<posing::PoseController*>()->pose_manager()->is_playing();
  values["poses"] = static_cast<int>(stored_poses.library.entries().size());
}

void add_view(Json& values, window::MainWindow* window)
{
  vtkCamera* camera = window->findChild<view::Viewport*>()->renderer()->GetActiveCamera();
  values["camera.position"] = to_json(Vec3(Eigen::Map<const Vec3>(camera->GetPosition())));
  values["camera.focus"] = to_json(Vec3(Eigen::Map<const Vec3>(camera->GetFocalPoint())));
  values["camera.distance"] = camera->GetDistance();
  values["window.size"] = { window->width(), window->height() };
}
} // namespace

Json tour_values(window::MainWindow* window)
{
  Json values = Json::object();
  add_work(values, window);
  add_handles(values, window);
  add_shape(values, window);
  add_weights(values, window);
  add_volume(values, window);
  add_tets(values, window);
  add_keys(values, window);
  add_view(values, window);
  add_options(values, window->document());
  return values;
}

double distance(const Json& a, const Json& b)
{
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (a.is_number() && b.is_number())
  {
    const double difference = std::abs(a.get<double>() - b.get<double>());
    return std::isfinite(difference) ? difference : infinite;
  }
  if (a.is_array() && b.is_array() && a.size() == b.size())
  {
    double largest = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k)
    {
      largest = std::max(largest, distance(a[k], b[k]));
    }
    return largest;
  }
  return a == b ? 0.0 : infinite;
}

/// Linux reports the start of a process in clock ticks since the system was booted.
double seconds_since_start()
{
  std::ifstream file("/proc/self/stat");
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  // find the last parenthesis, because the process name in parentheses may contain any characters
  const std::size_t name_end = text.rfind(')');
  timespec now{};
  if (name_end == std::string::npos || clock_gettime(CLOCK_BOOTTIME, &now) != 0)
  {
    return -1.0;
  }
  std::istringstream fields(text.substr(name_end + 1));
  // Number of fields between the process name and the start time: from field 3 to field 21.
  constexpr int skipped_field_count = 19;
  std::string skipped;
  for (int k = 0; k < skipped_field_count; ++k)
  {
    fields >> skipped;
  }
  double ticks = -1.0;
  fields >> ticks;
  return ticks < 0.0 ? -1.0
                     : static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec) -
      ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

namespace
{
double seconds_of(clockid_t clock)
{
  timespec used{};
  clock_gettime(clock, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}
} // namespace

double cpu_seconds()
{
  return seconds_of(CLOCK_PROCESS_CPUTIME_ID);
}

double thread_cpu_seconds()
{
  return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}

} // namespace app::tour

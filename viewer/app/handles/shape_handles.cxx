#include "app/handles/shape_handles.h"

#include "app/parts/notice_bar.h"
#include "app/parts/tool_icons.h"
#include "app/parts/window_keys.h"
#include "conversion.h"
#include "document/document.h"

#include "vtkPolyData.h"

#include <QAction>
#include <QInputDialog>
#include <QMenu>

namespace app::handles
{

using namespace bindpose;

namespace
{
/// Approximate number of triangles after remeshing, for auto_rig(). Compared with the default of
/// CurveSkeletonOptions, auto_rig() takes half the time, but may miss thin parts such as fingers.
constexpr Index auto_rig_triangles = 5000;
} // namespace

ShapeHandles::ShapeHandles(Document* document, parts::NoticeBar* bar, QWidget* window)
  : QObject(window), document_(document), bar_(bar), window_(window),
    auto_rig_(new QAction(parts::tool_icon("auto_rig"), tr("Auto-&rig"), this))
{
  this->auto_rig_->setObjectName("auto_rig");
  const QString keys = QString::fromStdString(parts::keys_of("auto_rig"));
  this->auto_rig_->setShortcut(QKeySequence(keys));
  this->auto_rig_->setToolTip(tr("Create bones along the shape and bind it (%1)").arg(keys));
  QObject::connect(this->auto_rig_, &QAction::triggered, this, &ShapeHandles::auto_rig);
  QObject::connect(bar, &parts::NoticeBar::closed, this, &ShapeHandles::cancel);
  QObject::connect(&this->job_, &parts::KernelJob::finished, this, &ShapeHandles::finish);
}

void ShapeHandles::fill_menu(QMenu* menu)
{
  menu->addAction(this->auto_rig_);
  this->menu_ = menu->addMenu(tr("From the &shape"));
  QAction* bones = this->menu_->addAction(tr("&Bones along the shape"));
  bones->setObjectName("handles.bones_along_it");
  QObject::connect(
    bones, &QAction::triggered, this, [this] { this->start(AutomaticMethod::skeleton, 0); });
  QAction* points = this->menu_->addAction(tr("&Points spread over the shape…"));
  points->setObjectName("handles.points_spread_over_it");
  QObject::connect(points, &QAction::triggered, this, &ShapeHandles::ask_for_count);
}

void ShapeHandles::update()
{
  const bool can_start = this->document_->surface() && !this->is_running();
  if (this->menu_)
  {
    this->menu_->setEnabled(can_start);
  }
  this->auto_rig_->setEnabled(can_start);
}

void ShapeHandles::ask_for_count()
{
  auto* dialog = new QInputDialog(this->window_);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(tr("Points spread over the shape"));
  dialog->setLabelText(tr("Number of points"));
  dialog->setInputMode(QInputDialog::IntInput);
  dialog->setIntRange(1, 500);
  dialog->setIntValue(static_cast<int>(SpreadPointsOptions().count));
  QObject::connect(dialog, &QInputDialog::intValueSelected, this,
    [this](int count) { this->start(AutomaticMethod::points, count); });
  dialog->open();
}

void ShapeHandles::auto_rig()
{
  if (!this->is_running())
  {
    this->rigging_ = true;
    AutomaticHandlesOptions options;
    options.skeleton.triangles = auto_rig_triangles;
    this->start_job(options);
  }
}

void ShapeHandles::start(AutomaticMethod method, Index count)
{
  if (!this->is_running())
  {
    this->rigging_ = false;
    AutomaticHandlesOptions options;
    options.method = method;
    options.bones.maximum_bones = count;
    options.points.count = count;
    this->start_job(options);
  }
}

void ShapeHandles::start_job(AutomaticHandlesOptions options)
{
  if (!this->document_->surface())
  {
    return;
  }
  auto surface = std::make_shared<SurfaceInput>();
  const Status status = to_surface(this->document_->surface(), *surface);
  if (!status.ok())
  {
    Q_EMIT this->failed(QString::fromStdString(status.message));
    return;
  }
  this->method_ = options.method;
  this->surface_ = this->document_->surface();
  this->new_handles_ = std::make_shared<Handles>();
  this->bar_->offer(options.method == AutomaticMethod::points
      ? tr("Spreading points over the shape …")
      : tr("Finding bones along the shape …"),
    {}, tr("Cancel"));
  this->job_.start(
    [surface, options, new_handles = this->new_handles_](ExecutionContext& context)
    {
      return automatic_handles(
        context, surface->points.view(), surface->triangles.view(), options, *new_handles);
    });
  this->update();
}

void ShapeHandles::finish()
{
  const Status& status = this->job_.status();
  this->bar_->hide();
  this->update();
  if (status.code == StatusCode::canceled || this->surface_ != this->document_->surface())
  {
    return; // canceled, or another shape was opened meanwhile
  }
  const bool points = this->method_ == AutomaticMethod::points;
  if (this->rigging_ && !points && !(status.usable() && has_bones(*this->new_handles_)))
  {
    AutomaticHandlesOptions instead;
    instead.method = AutomaticMethod::points;
    this->start_job(instead);
    return;
  }
  Status committed = status;
  if (status.usable())
  {
    this->document_->editable_handles()->ShallowCopy(to_polydata(*this->new_handles_));
    committed = this->document_->commit_handles(
      points ? tr("points spread over the shape") : tr("bones along the shape"));
  }
  if (!committed.usable())
  {
    Q_EMIT this->failed(
      tr("Cannot create handles: %1.").arg(QString::fromStdString(committed.message)));
    return;
  }
  if (this->rigging_)
  {
    Q_EMIT this->rigged();
  }
  else if (!status.warnings.empty())
  {
    this->bar_->offer(QString::fromStdString(status.warnings.front()) + '.', {}, tr("Close"));
  }
}

} // namespace app::handles

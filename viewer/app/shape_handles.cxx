#include "shape_handles.h"

#include "conversion.h"
#include "document/document.h"
#include "notice_bar.h"

#include "vtkPolyData.h"

#include <QAction>
#include <QInputDialog>
#include <QMenu>

using namespace bindpose;

ShapeHandles::ShapeHandles(Document* document, NoticeBar* bar, QWidget* window)
  : QObject(window), document_(document), bar_(bar), window_(window)
{
  QObject::connect(bar, &NoticeBar::closed, this, &ShapeHandles::cancel);
  QObject::connect(&this->job_, &KernelJob::finished, this, &ShapeHandles::finish);
}

void ShapeHandles::fill_menu(QMenu* menu)
{
  this->menu_ = menu->addMenu(tr("From the &shape"));
  QAction* bones = this->menu_->addAction(tr("&Bones along it"));
  bones->setObjectName("handles.bones_along_it");
  QObject::connect(
    bones, &QAction::triggered, this, [this] { this->start(AutomaticMethod::skeleton, 0); });
  QAction* points = this->menu_->addAction(tr("&Points spread over it…"));
  points->setObjectName("handles.points_spread_over_it");
  QObject::connect(points, &QAction::triggered, this, &ShapeHandles::ask_for_count);
}

void ShapeHandles::update()
{
  this->menu_->setEnabled(this->document_->surface() && !this->is_running());
}

void ShapeHandles::ask_for_count()
{
  auto* dialog = new QInputDialog(this->window_);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle(tr("Points spread over the shape"));
  dialog->setLabelText(tr("How many"));
  dialog->setInputMode(QInputDialog::IntInput);
  dialog->setIntRange(1, 500);
  dialog->setIntValue(static_cast<int>(SpreadPointsOptions().count));
  QObject::connect(dialog, &QInputDialog::intValueSelected, this,
    [this](int count) { this->start(AutomaticMethod::points, count); });
  dialog->open();
}

void ShapeHandles::start(AutomaticMethod method, Index count)
{
  if (this->is_running() || !this->document_->surface())
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
  AutomaticHandlesOptions options;
  options.method = method;
  options.bones.most_bones = count;
  options.points.count = count;
  this->step_ =
    method == AutomaticMethod::points ? tr("points spread over it") : tr("bones along the shape");
  this->surface_ = this->document_->surface();
  this->made_ = std::make_shared<Handles>();
  this->bar_->offer(method == AutomaticMethod::points ? tr("Spreading points over the shape …")
                                                      : tr("Finding bones along the shape …"),
    {}, tr("Cancel"));
  this->job_.start(
    [surface, options, made = this->made_](ExecutionContext& context)
    {
      return automatic_handles(
        surface->points.view(), surface->triangles.view(), options, *made, context);
    });
  this->update();
}

void ShapeHandles::finish()
{
  const Status& status = this->job_.status();
  this->bar_->hide();
  this->update();
  if (status.code == StatusCode::cancelled || this->surface_ != this->document_->surface())
  {
    return; // another shape has come meanwhile
  }
  Status told = status;
  if (status.usable())
  {
    this->document_->editable_handles()->ShallowCopy(to_polydata(*this->made_));
    told = this->document_->commit_handles(this->step_);
  }
  if (!told.usable())
  {
    Q_EMIT this->failed(tr("No handles: %1.").arg(QString::fromStdString(told.message)));
  }
  else if (!status.warnings.empty())
  {
    this->bar_->offer(QString::fromStdString(status.warnings.front()) + '.', {}, tr("Close"));
  }
}

#include "app/posing/pose_list_widget.h"

#include "app/parts/panel_parts.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QVBoxLayout>

namespace app::posing
{

PoseListWidget::PoseListWidget(QWidget* parent) : QWidget(parent)
{
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(6);
  auto* buttons = new QHBoxLayout;
  this->store_ = parts::button(tr("Store"), this);
  this->store_->setToolTip(tr("Store the current pose"));
  this->apply_ = parts::button(tr("Apply"), this);
  this->apply_->setToolTip(tr("Apply the selected pose to all handles"));
  this->remove_ = parts::button(tr("Delete"), this);
  this->remove_->setToolTip(tr("Delete the selected pose from the list"));
  for (QPushButton* each : { this->store_, this->apply_, this->remove_ })
  {
    buttons->addWidget(each, 1);
  }
  rows->addLayout(buttons);
  this->list_ = new QListWidget(this);
  this->list_->setObjectName("poses");
  this->list_->setToolTip(tr("Double-click a pose to rename it"));
  this->list_->setFixedHeight(5 * this->list_->fontMetrics().lineSpacing());
  rows->addWidget(this->list_);
  auto* blend = new QHBoxLayout;
  blend->addWidget(new QLabel(tr("Blend"), this));
  this->slider_ = new QSlider(Qt::Horizontal, this);
  this->slider_->setRange(0, 100);
  this->slider_->setToolTip(tr("Blend from the current pose toward the selected pose"));
  blend->addWidget(this->slider_, 1);
  rows->addLayout(blend);

  QObject::connect(this->store_, &QPushButton::clicked, this, &PoseListWidget::store_requested);
  QObject::connect(this->apply_, &QPushButton::clicked, this,
    [this] { Q_EMIT this->apply_requested(this->selected_entry()); });
  QObject::connect(this->remove_, &QPushButton::clicked, this,
    [this] { Q_EMIT this->remove_requested(this->selected_entry()); });
  QObject::connect(this->list_, &QListWidget::itemChanged, this,
    [this](QListWidgetItem* item)
    { Q_EMIT this->renamed(this->list_->row(item), item->text().trimmed()); });
  QObject::connect(this->list_, &QListWidget::currentRowChanged, this, [this] { this->enable(); });
  QObject::connect(this->slider_, &QSlider::valueChanged, this,
    [this](int value) { Q_EMIT this->blended(this->selected_entry(), 0.01 * value); });
  QObject::connect(this->slider_, &QSlider::sliderReleased, this,
    [this]
    {
      const QSignalBlocker blocker(this->slider_);
      // the next blend starts at the current pose, which is 0 on the slider
      this->slider_->setValue(0);
      Q_EMIT this->blend_ended();
    });
  this->enable();
}

void PoseListWidget::set_names(const QStringList& names)
{
  const QSignalBlocker blocker(this->list_);
  const int row = this->selected_entry();
  this->list_->clear();
  for (const QString& name : names)
  {
    auto* item = new QListWidgetItem(name, this->list_);
    item->setFlags(item->flags() | Qt::ItemIsEditable);
  }
  this->list_->setCurrentRow(std::min(row, static_cast<int>(names.size()) - 1));
  this->enable();
}

int PoseListWidget::selected_entry() const
{
  return this->list_->currentRow();
}

void PoseListWidget::select_entry(int entry)
{
  this->list_->setCurrentRow(entry);
}

void PoseListWidget::set_ready(bool ready)
{
  this->ready_ = ready;
  this->enable();
}

void PoseListWidget::enable()
{
  const bool has_selection = this->ready_ && this->selected_entry() >= 0;
  this->store_->setEnabled(this->ready_);
  this->apply_->setEnabled(has_selection);
  this->remove_->setEnabled(this->selected_entry() >= 0);
  this->slider_->setEnabled(has_selection);
}

} // namespace app::posing

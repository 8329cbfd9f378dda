#include "side_panel.h"

#include "handle_fields.h"
#include "panel_parts.h"
#include "pose_list.h"
#include "pose_panel.h"
#include "section.h"

#include "pose/pose.h"

#include <QApplication>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QStandardItemModel>
#include <QVBoxLayout>

#include <algorithm>

namespace
{
/// A combo box that does not grow with its items: they may be handles of any name.
QComboBox* combo(QWidget* parent)
{
  auto* box = new QComboBox(parent);
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(8);
  return box;
}
} // namespace

SidePanel::SidePanel(QWidget* parent) : QFrame(parent)
{
  this->setObjectName("panel");
  this->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Preferred);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(16, 14, 16, 14);
  column->setSpacing(7);

  column->addWidget(heading(tr("Bind"), this));
  this->kind_ = combo(this);
  this->kind_->setObjectName("bind.method");
  this->kind_->addItem(tr("Bounded biharmonic weights"));
  this->kind_->addItem(tr("Monotone weights"));
  // The panel is as wide as this line, in any font.
  this->kind_->setMinimumContentsLength(0);
  this->kind_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  this->kind_->setToolTip(tr("Bounded: smooth functions between 0 and 1.\n"
                             "Monotone: besides, no hill or hollow away from the handles."));
  QObject::connect(this->kind_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    &SidePanel::bind_method_changed);
  column->addWidget(this->kind_);
  auto* buttons = new QHBoxLayout;
  this->bind_ = button(tr("Bind"), this);
  this->bind_->setObjectName("primary");
  this->bind_->setToolTip(tr("Computes the weights of all handles (Ctrl+B)"));
  this->cancel_ = button(tr("Cancel"), this);
  this->cancel_->setToolTip(tr("Stops the bind; the weights stay as they were"));
  buttons->addWidget(this->bind_, 1);
  buttons->addWidget(this->cancel_);
  column->addLayout(buttons);
  this->bar_ = new QProgressBar(this);
  this->bar_->setRange(0, 1000);
  this->bar_->setTextVisible(false);
  column->addWidget(this->bar_);
  this->note_ = new QLabel(this);
  this->note_->setObjectName("note");
  this->note_->setWordWrap(true);
  this->note_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  // What comes and goes keeps its place, so that nothing below it jumps.
  this->note_->setFixedHeight(2 * this->note_->fontMetrics().lineSpacing() + 2);
  QSizePolicy keeps_place = this->bar_->sizePolicy();
  keeps_place.setRetainSizeWhenHidden(true);
  this->bar_->setSizePolicy(keeps_place);
  column->addWidget(this->note_);

  column->addSpacing(10);
  column->addWidget(heading(tr("Show"), this));
  this->shown_ = combo(this);
  this->shown_->setObjectName("show.column");
  this->shown_->setToolTip(tr("The shaded surface, or one handle's weights on it"));
  column->addWidget(this->shown_);

  // What poses has more to choose from than a small window has room for.
  column->addSpacing(6);
  auto* scroll = new QScrollArea(this);
  scroll->setObjectName("scroll");
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFocusPolicy(Qt::NoFocus);
  auto* content = new QWidget(scroll);
  content->setObjectName("scrolled");
  auto* parts = new QVBoxLayout(content);
  parts->setContentsMargins(0, 0, scroll->verticalScrollBar()->sizeHint().width() + 2, 0);
  parts->setSpacing(6);
  this->pose_ = new PosePanel(content);
  auto* poses =
    new Section(tr("Poses"), tr("Poses that are kept, to come back to"), false, content);
  this->poses_ = new PoseList(content);
  poses->column()->addWidget(this->poses_);

  auto* handles = new QWidget(content);
  auto* list = new QVBoxLayout(handles);
  list->setContentsMargins(0, 4, 0, 0);
  list->setSpacing(6);
  list->addWidget(heading(tr("Handles"), handles));
  this->handles_ = new QListWidget(handles);
  this->handles_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  this->handles_->setTextElideMode(Qt::ElideMiddle);
  this->handles_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  this->handles_->setFixedHeight(6 * this->handles_->fontMetrics().lineSpacing());
  list->addWidget(this->handles_);
  auto* mode_row = new QHBoxLayout;
  this->mode_label_ = new QLabel(tr("Fixes"), handles);
  mode_row->addWidget(this->mode_label_);
  this->mode_ = combo(handles);
  this->mode_->addItem(tr("full transform"));
  this->mode_->addItem(tr("position only"));
  this->mode_->addItem(tr("nothing (free)"));
  this->mode_->addItem(tr("a bone's tail"));
  this->mode_->addItem(tr("a bone's ends"));
  this->mode_->setToolTip(
    tr("What the selected handle fixes; as-rigid-as-possible (ARAP) finds the rest"));
  mode_row->addWidget(this->mode_, 1);
  list->addLayout(mode_row);
  this->fields_ = new HandleFields(handles);
  list->addWidget(this->fields_);
  this->rest_ = button(tr("Back to rest"), handles);
  this->rest_->setToolTip(tr("All handles back to where they were bound (Ctrl+R)"));
  list->addWidget(this->rest_);

  this->pose_->insert(handles);
  parts->addWidget(this->pose_);
  parts->addWidget(poses);
  parts->addStretch(1);
  scroll->setWidget(content);
  // As wide as it must be, not as wide as its sentences would like to be.
  scroll->setMinimumWidth(
    std::max(content->minimumSizeHint().width(), 36 * this->fontMetrics().horizontalAdvance('0')));
  scroll->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Expanding);
  column->addWidget(scroll, 1);

  QObject::connect(this->bind_, &QPushButton::clicked, this, &SidePanel::bind_wanted);
  QObject::connect(this->cancel_, &QPushButton::clicked, this,
    [this]
    {
      this->stopping_ = true;
      this->set_note(tr("Stopping …"));
      Q_EMIT this->cancel_wanted();
    });
  QObject::connect(this->rest_, &QPushButton::clicked, this, &SidePanel::rest_wanted);
  QObject::connect(this->pose_, &PosePanel::method_chosen, this, &SidePanel::method_chosen);
  QObject::connect(this->shown_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    [this](int index) { Q_EMIT this->column_chosen(index - 1); });
  QObject::connect(this->handles_, &QListWidget::currentRowChanged, this,
    [this](int handle)
    {
      if (handle >= 0 && this->handles_->selectedItems().isEmpty() &&
        QApplication::mouseButtons() == Qt::NoButton)
      {
        this->handles_->item(handle)->setSelected(true); // the keyboard's first step does not
      }
    });
  QObject::connect(
    this->handles_, &QListWidget::itemSelectionChanged, this, &SidePanel::list_changed);
  QObject::connect(this->mode_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    [this](int mode)
    {
      if (!this->selected_.empty())
      {
        Q_EMIT this->mode_chosen(mode);
      }
    });
  this->set_handles({}, {}, {});
  this->set_state(false, false, false);
}

void SidePanel::set_handles(
  const QStringList& names, const QList<int>& modes, const QList<bool>& bones)
{
  const QSignalBlocker quiet(this->handles_);
  const QSignalBlocker quiet_too(this->shown_);
  const QString shown = this->shown_column() >= 0 && this->shown_column() < this->names_.size()
    ? this->names_[this->shown_column()]
    : QString();
  this->names_ = names;
  this->modes_ = modes;
  this->bones_ = bones;
  this->handles_->clear();
  this->selected_.clear();
  this->shown_->clear();
  this->shown_->addItem(tr("Shaded surface"));
  for (int handle = 0; handle < names.size(); ++handle)
  {
    this->handles_->addItem(names[handle]);
    this->handles_->item(handle)->setToolTip(names[handle]);
    this->shown_->addItem(tr("Weights of %1")
                            .arg(this->fontMetrics().elidedText(
                              names[handle], Qt::ElideMiddle, this->room_for_names())));
    this->shown_->setItemData(handle + 1, names[handle], Qt::ToolTipRole);
    this->set_mode(handle, modes[handle]);
  }
  this->shown_->setCurrentIndex(shown.isEmpty() ? 0 : names.indexOf(shown) + 1);
  this->show_mode();
}

/// Pixels that a handle's name may take in the combo box, after the words before it.
int SidePanel::room_for_names() const
{
  const int field = this->kind_->sizeHint().width() - 50; // frame, arrow, padding
  return field - this->fontMetrics().horizontalAdvance(tr("Weights of %1").arg(QString()));
}

/// Of the first one selected; what can be chosen is what all of them can fix.
void SidePanel::show_mode()
{
  const QSignalBlocker quiet(this->mode_);
  const int handle = this->selected_handle();
  const bool bones = std::all_of(
    this->selected_.begin(), this->selected_.end(), [this](int k) { return this->bones_[k]; });
  this->mode_label_->setEnabled(handle >= 0);
  this->mode_->setEnabled(handle >= 0);
  this->mode_->setCurrentIndex(handle >= 0 ? this->modes_[handle] : 0);
  auto* items = qobject_cast<QStandardItemModel*>(this->mode_->model());
  for (int mode = 0; mode < this->mode_->count(); ++mode)
  {
    const bool of_bones = bindpose::holds_tail(static_cast<bindpose::HandleMode>(mode));
    items->item(mode)->setEnabled(!of_bones || (handle >= 0 && bones));
  }
}

void SidePanel::set_mode(int handle, int mode)
{
  this->modes_[handle] = mode;
  QListWidgetItem* item = this->handles_->item(handle);
  item->setText(mode == 0
      ? this->names_[handle]
      : QString("%1   (%2)").arg(this->names_[handle], tr(bindpose::handle_mode_words[mode])));
  if (handle == this->selected_handle())
  {
    this->show_mode();
  }
}

void SidePanel::select_handle(int handle)
{
  this->select_handles(handle < 0 ? std::vector<int>() : std::vector<int>{ handle });
}

void SidePanel::select_handles(const std::vector<int>& handles)
{
  if (handles == this->selected_)
  {
    return;
  }
  const QSignalBlocker quiet(this->handles_);
  this->handles_->setCurrentRow(
    handles.empty() ? -1 : handles.back(), QItemSelectionModel::NoUpdate);
  this->handles_->clearSelection();
  for (const int handle : handles)
  {
    this->handles_->item(handle)->setSelected(true);
  }
  this->selected_ = handles;
  this->show_mode();
  Q_EMIT this->handles_chosen();
}

/// The list tells which are selected, not in which order.
void SidePanel::list_changed()
{
  const auto is_gone = [this](int k) { return !this->handles_->item(k)->isSelected(); };
  this->selected_.erase(
    std::remove_if(this->selected_.begin(), this->selected_.end(), is_gone), this->selected_.end());
  for (int k = 0; k < this->handles_->count(); ++k)
  {
    const bool known =
      std::find(this->selected_.begin(), this->selected_.end(), k) != this->selected_.end();
    if (!known && !is_gone(k))
    {
      this->selected_.push_back(k);
    }
  }
  this->show_mode();
  Q_EMIT this->handles_chosen();
}

void SidePanel::set_state(bool ready, bool binding, bool bound)
{
  this->stopping_ = false;
  // Who presses Bind by key finds Cancel there, and then Bind again. Whatever else is disabled
  // gives the keyboard up first: it would go on to the list and choose a handle there.
  const bool keyboard = this->bind_->hasFocus() || this->cancel_->hasFocus();
  const auto enable = [](QWidget* widget, bool on)
  {
    if (!on)
    {
      widget->clearFocus();
    }
    widget->setEnabled(on);
  };
  this->bind_->setText(bound ? tr("Bind again") : tr("Bind"));
  enable(this->bind_, ready && !binding);
  enable(this->cancel_, binding);
  this->cancel_->setVisible(binding);
  if (keyboard)
  {
    (binding ? this->cancel_ : this->bind_)->setFocus();
  }
  enable(this->kind_, ready && !binding);
  this->bar_->setValue(0);
  this->bar_->setVisible(binding);
  enable(this->shown_, bound);
  enable(this->rest_, bound);
}

void SidePanel::set_progress(double fraction, const QString& phase)
{
  this->bar_->setValue(static_cast<int>(1000.0 * fraction));
  if (!this->stopping_)
  {
    this->set_note(tr("%1, %2 %").arg(sentence_of(phase)).arg(static_cast<int>(100.0 * fraction)));
  }
}

void SidePanel::set_note(const QString& text)
{
  this->note_->setText(text);
}

void SidePanel::set_method(int method)
{
  this->pose_->set_method(method);
}

bool SidePanel::monotone() const
{
  return this->kind_->currentIndex() == 1;
}

int SidePanel::shown_column() const
{
  return this->shown_->currentIndex() - 1;
}

void SidePanel::show_column(int column)
{
  this->shown_->setCurrentIndex(column + 1);
}

#include "side_panel.h"

#include <QButtonGroup>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>

namespace
{
QLabel* heading(const QString& text, QWidget* parent)
{
  auto* label = new QLabel(text, parent);
  label->setObjectName("heading");
  return label;
}

const char* const mode_names[] = { "full", "position", "free" };
} // namespace

SidePanel::SidePanel(QWidget* parent) : QFrame(parent)
{
  this->setObjectName("panel");
  this->setFixedWidth(268);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(16, 14, 16, 14);
  column->setSpacing(7);

  column->addWidget(heading(tr("Bind"), this));
  this->kind_ = new QComboBox(this);
  this->kind_->addItem(tr("Bounded biharmonic weights"));
  this->kind_->addItem(tr("Monotone weights"));
  this->kind_->setToolTip(tr("Bounded: smooth functions between 0 and 1.\n"
                             "Monotone: besides, no hill or hollow away from the handles."));
  column->addWidget(this->kind_);
  auto* buttons = new QHBoxLayout;
  this->bind_ = new QPushButton(tr("Bind"), this);
  this->bind_->setObjectName("primary");
  this->bind_->setToolTip(tr("Computes the weights of all handles (Ctrl+B)"));
  this->cancel_ = new QPushButton(tr("Cancel"), this);
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
  column->addWidget(this->note_);

  column->addSpacing(10);
  column->addWidget(heading(tr("Show"), this));
  this->shown_ = new QComboBox(this);
  this->shown_->setToolTip(tr("The shaded surface, or one handle's weights on it"));
  column->addWidget(this->shown_);

  column->addSpacing(10);
  column->addWidget(heading(tr("Pose"), this));
  auto* row = new QHBoxLayout;
  row->setSpacing(0);
  this->methods_ = new QButtonGroup(this);
  const char* const names[] = { QT_TR_NOOP("Linear"), QT_TR_NOOP("Dual quat."),
    QT_TR_NOOP("ARAP") };
  const char* const tips[] = { QT_TR_NOOP("Linear blend skinning (1)"),
    QT_TR_NOOP("Dual quaternion skinning (2): twists keep their volume"),
    QT_TR_NOOP("Reduced as-rigid-as-possible (3): finds what handles leave open") };
  for (int k = 0; k < 3; ++k)
  {
    auto* button = new QPushButton(tr(names[k]), this);
    button->setObjectName("segment");
    button->setCheckable(true);
    button->setToolTip(tr(tips[k]));
    this->methods_->addButton(button, k);
    row->addWidget(button, 1);
  }
  this->methods_->button(0)->setChecked(true);
  column->addLayout(row);
  this->rest_ = new QPushButton(tr("Back to rest"), this);
  this->rest_->setToolTip(tr("All handles back to where they were bound (can be undone)"));
  column->addWidget(this->rest_);

  column->addSpacing(10);
  column->addWidget(heading(tr("Handles"), this));
  this->handles_ = new QListWidget(this);
  column->addWidget(this->handles_, 1);
  auto* mode_row = new QHBoxLayout;
  mode_row->addWidget(new QLabel(tr("Fixes"), this));
  this->mode_ = new QComboBox(this);
  this->mode_->addItem(tr("full transform"));
  this->mode_->addItem(tr("position only"));
  this->mode_->addItem(tr("nothing (free)"));
  this->mode_->setToolTip(tr("What the selected handle fixes; ARAP finds the rest"));
  mode_row->addWidget(this->mode_, 1);
  column->addLayout(mode_row);

  QObject::connect(this->bind_, &QPushButton::clicked, this, &SidePanel::bind_wanted);
  QObject::connect(this->cancel_, &QPushButton::clicked, this, &SidePanel::cancel_wanted);
  QObject::connect(this->rest_, &QPushButton::clicked, this, &SidePanel::rest_wanted);
  QObject::connect(this->methods_, &QButtonGroup::idClicked, this, &SidePanel::method_chosen);
  QObject::connect(this->shown_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    [this](int index) { Q_EMIT this->column_chosen(index - 1); });
  QObject::connect(this->handles_, &QListWidget::currentRowChanged, this,
    [this](int handle)
    {
      const QSignalBlocker quiet(this->mode_);
      this->mode_->setEnabled(handle >= 0);
      this->mode_->setCurrentIndex(handle >= 0 ? this->modes_[handle] : 0);
      Q_EMIT this->handle_chosen(handle);
    });
  QObject::connect(this->mode_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    [this](int mode)
    {
      if (this->selected_handle() >= 0)
      {
        Q_EMIT this->mode_chosen(this->selected_handle(), mode);
      }
    });
  this->set_handles({}, {});
  this->set_state(false, false, false);
}

void SidePanel::set_handles(const QStringList& names, const QList<int>& modes)
{
  const QSignalBlocker quiet(this->handles_);
  const QSignalBlocker quiet_too(this->shown_);
  this->names_ = names;
  this->modes_ = modes;
  this->handles_->clear();
  this->shown_->clear();
  this->shown_->addItem(tr("Shaded surface"));
  for (int handle = 0; handle < names.size(); ++handle)
  {
    this->handles_->addItem(names[handle]);
    this->shown_->addItem(tr("Weights of %1").arg(names[handle]));
    this->set_mode(handle, modes[handle]);
  }
  this->mode_->setEnabled(false);
}

void SidePanel::set_mode(int handle, int mode)
{
  this->modes_[handle] = mode;
  QListWidgetItem* item = this->handles_->item(handle);
  item->setText(mode == 0 ? this->names_[handle]
                          : QString("%1   (%2)").arg(this->names_[handle], mode_names[mode]));
  if (handle == this->selected_handle())
  {
    const QSignalBlocker quiet(this->mode_);
    this->mode_->setCurrentIndex(mode);
  }
}

void SidePanel::select_handle(int handle)
{
  this->handles_->setCurrentRow(handle);
}

int SidePanel::selected_handle() const
{
  return this->handles_->currentRow();
}

void SidePanel::set_state(bool ready, bool binding, bool bound)
{
  this->bind_->setText(bound ? tr("Bind again") : tr("Bind"));
  this->bind_->setEnabled(ready && !binding);
  this->kind_->setEnabled(ready && !binding);
  this->cancel_->setVisible(binding);
  this->bar_->setVisible(binding);
  this->shown_->setEnabled(bound);
  this->rest_->setEnabled(bound);
  for (QAbstractButton* button : this->methods_->buttons())
  {
    button->setEnabled(bound);
  }
}

void SidePanel::set_progress(double fraction, const QString& phase)
{
  this->bar_->setValue(static_cast<int>(1000.0 * fraction));
  this->set_note(tr("%1 … %2 %").arg(phase).arg(static_cast<int>(100.0 * fraction)));
}

void SidePanel::set_note(const QString& text)
{
  this->note_->setText(text);
  this->note_->setVisible(!text.isEmpty());
}

void SidePanel::set_method(int method)
{
  this->methods_->button(method)->setChecked(true);
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

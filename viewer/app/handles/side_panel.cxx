#include "app/handles/side_panel.h"

#include "app/parts/option_widgets.h"
#include "app/parts/panel_parts.h"
#include "app/posing/handle_fields.h"
#include "app/posing/pose_list_widget.h"
#include "app/posing/pose_panel.h"
#include "app/view/section.h"
#include "document/options.h"

#include "pose/pose.h"

#include <QComboBox>
#include <QCoreApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QStandardItemModel>
#include <QVBoxLayout>

#include <algorithm>

namespace app::handles
{

namespace
{
/// Make the width of a combo box independent of its items, because names of handles may be long.
QComboBox* of_any_width(QComboBox* box)
{
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(8);
  return box;
}
} // namespace

SidePanel::SidePanel(HandleTree* handle_tree, QWidget* parent)
  : QFrame(parent), handles_(handle_tree)
{
  this->setObjectName("panel");
  this->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Preferred);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(16, 14, 16, 14);
  column->setSpacing(7);

  column->addWidget(parts::heading(tr("Bind"), this));
  this->method_box_ = parts::option_box("bind.method", this);
  for (int k = 0; k < this->method_box_->count(); ++k)
  {
    this->method_box_->setItemText(k, tr("%1 weights").arg(this->method_box_->itemText(k)));
  }
  // Make this combo box as wide as its longest item in any font. Its width determines the width of
  // the panel.
  this->method_box_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  this->method_box_->setToolTip(
    tr("Bounded: smooth functions between 0 and 1.\n"
       "Monotone: in addition, no local maxima or minima away from the handles."));
  QObject::connect(this->method_box_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    &SidePanel::bind_method_changed);
  column->addWidget(this->method_box_);
  auto* domain_row = new QHBoxLayout;
  domain_row->addWidget(new QLabel(tr("Domain"), this));
  this->domain_ = of_any_width(parts::option_box("bind.domain", this));
  this->domain_->setToolTip(
    tr("Mesh on which the weights are solved.\n"
       "Automatic: the surface of flat shapes; tets of the inside of closed and clean shapes if\n"
       "that is fast; a lattice for all others.\n"
       "Tets of the inside: keep the triangles of the surface.\n"
       "Embedding lattice: cubes that contain the surface, even if it has defects.\n"
       "Cage of the handles: the inside of the handles' closed cage.\n"
       "Surface: the triangles; near but unconnected parts do not influence each other."));
  domain_row->addWidget(this->domain_, 1);
  column->addLayout(domain_row);
  auto* buttons = new QHBoxLayout;
  this->bind_ = parts::button(tr("Bind"), this);
  this->bind_->setObjectName("primary");
  this->bind_->setToolTip(tr("Compute the weights of all handles (Ctrl+B)"));
  this->cancel_ = parts::button(tr("Cancel"), this);
  this->cancel_->setToolTip(tr("Cancel the bind; the weights are unchanged"));
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
  // Reserve two lines even if the text is empty, so that the widgets below do not move.
  this->note_->setFixedHeight(2 * this->note_->fontMetrics().lineSpacing() + 2);
  QSizePolicy size_policy = this->bar_->sizePolicy();
  size_policy.setRetainSizeWhenHidden(true);
  this->bar_->setSizePolicy(size_policy);
  column->addWidget(this->note_);

  auto* shown_row = new QHBoxLayout;
  this->shown_label_ = new QLabel(tr("Show"), this);
  shown_row->addWidget(this->shown_label_);
  this->column_box_ = of_any_width(new QComboBox(this));
  this->column_box_->setObjectName("show.column");
  this->column_box_->setToolTip(tr("Show the shaded surface, or the weights of one handle on it"));
  shown_row->addWidget(this->column_box_, 1);
  column->addLayout(shown_row);

  // Put the widgets for posing into a scroll area, because a small window cannot show all of them.
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
  this->pose_ = new posing::PosePanel(content);
  auto* poses =
    new view::Section(tr("Poses"), tr("Stored poses, which can be applied again"), false, content);
  this->poses_ = new posing::PoseListWidget(content);
  poses->column()->addWidget(this->poses_);

  auto* handles = new QWidget(content);
  auto* list = new QVBoxLayout(handles);
  list->setContentsMargins(0, 4, 0, 0);
  list->setSpacing(6);
  list->addWidget(parts::heading(tr("Selected handle"), handles));
  auto* mode_row = new QHBoxLayout;
  this->mode_label_ = new QLabel(tr("Fixes"), handles);
  mode_row->addWidget(this->mode_label_);
  this->mode_ = of_any_width(new QComboBox(handles));
  using bindpose::HandleMode;
  const std::pair<HandleMode, QString> modes[] = { { HandleMode::automatic, tr("automatic") },
    { HandleMode::full, tr("position and rotation") },
    { HandleMode::position, tr("position only") }, { HandleMode::free, tr("nothing") },
    { HandleMode::tail, tr("a bone's tail") }, { HandleMode::ends, tr("a bone's ends") } };
  for (const auto& [mode, text] : modes)
  {
    this->mode_->addItem(text, static_cast<int>(mode));
  }
  this->mode_->setToolTip(
    tr("Constraints of the selected handle; as-rigid-as-possible (ARAP) methods compute the rest.\n"
       "Automatic: its position if it was only moved; rotation and scale as well\n"
       "if it was rotated, scaled, stretched or twisted, or is a bone at rest."));
  mode_row->addWidget(this->mode_, 1);
  list->addLayout(mode_row);
  this->fields_ = new posing::HandleFields(handles);
  list->addWidget(this->fields_);
  this->rest_ = parts::button(tr("Back to rest"), handles);
  this->rest_->setToolTip(tr("Move all handles back to their rest positions (Ctrl+R)"));
  list->addWidget(this->rest_);

  this->pose_->insert(handles);
  parts->addWidget(this->pose_);
  parts->addWidget(poses);
  parts->addStretch(1);
  scroll->setWidget(content);
  // Use the minimum width of the contents, because long texts have a large preferred width.
  scroll->setMinimumWidth(
    std::max(content->minimumSizeHint().width(), 36 * this->fontMetrics().horizontalAdvance('0')));
  scroll->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Expanding);
  column->addWidget(scroll, 1);

  QObject::connect(this->bind_, &QPushButton::clicked, this, &SidePanel::bind_requested);
  QObject::connect(this->cancel_, &QPushButton::clicked, this,
    [this]
    {
      this->stopping_ = true;
      this->set_note(tr("Stopping …"));
      Q_EMIT this->cancel_requested();
    });
  QObject::connect(this->rest_, &QPushButton::clicked, this, &SidePanel::rest_requested);
  QObject::connect(this->pose_, &posing::PosePanel::method_chosen, this, &SidePanel::method_chosen);
  QObject::connect(this->column_box_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    [this](int index) { Q_EMIT this->column_chosen(index - 1); });
  QObject::connect(this->handles_, &HandleTree::selection_changed, this,
    [this]
    {
      this->show_mode();
      Q_EMIT this->handles_chosen();
    });
  QObject::connect(this->mode_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    [this](int entry)
    {
      if (!this->selected_handles().empty())
      {
        Q_EMIT this->mode_chosen(this->mode_->itemData(entry).toInt());
      }
    });
  this->set_handles({});
  this->set_state(false, false, false);
}

void SidePanel::set_handles(const std::vector<HandleTree::Row>& handles)
{
  const QSignalBlocker blocker(this->column_box_);
  const QString shown = this->column_box_->currentIndex() > 0
    ? this->column_box_->currentData(Qt::ToolTipRole).toString()
    : QString();
  this->handles_->set_rows(handles);
  this->column_box_->clear();
  this->column_box_->addItem(tr("Shaded surface"));
  int index = 0;
  for (const HandleTree::Row& handle : handles)
  {
    this->column_box_->addItem(tr("Weights of %1")
                                 .arg(this->fontMetrics().elidedText(
                                   handle.name, Qt::ElideMiddle, this->available_name_width())));
    const int item = this->column_box_->count() - 1;
    this->column_box_->setItemData(item, handle.name, Qt::ToolTipRole);
    index = !shown.isEmpty() && handle.name == shown ? item : index;
  }
  this->column_box_->setCurrentIndex(index);
  this->show_mode();
}

/// Return the width in pixels that is available for the name of a handle in the combo box, whose
/// items have the form "Weights of NAME".
int SidePanel::available_name_width() const
{
  const int field = this->method_box_->sizeHint().width() - this->shown_label_->sizeHint().width() -
    60; // width of frame, arrow, padding and spacing
  return field - this->fontMetrics().horizontalAdvance(tr("Weights of %1").arg(QString()));
}

/// Show the mode of the first selected handle. A mode can be chosen only if all selected handles
/// support it.
void SidePanel::show_mode()
{
  const QSignalBlocker blocker(this->mode_);
  const int handle = this->selected_handle();
  const std::vector<HandleTree::Row>& rows = this->handles_->rows();
  const auto is_bone = [&rows](int k)
  { return rows[static_cast<std::size_t>(k)].kind == bindpose::HandleKind::bone; };
  const bool bones =
    std::all_of(this->selected_handles().begin(), this->selected_handles().end(), is_bone);
  this->mode_label_->setEnabled(handle >= 0);
  this->mode_->setEnabled(handle >= 0);
  const int mode = handle >= 0 ? rows[static_cast<std::size_t>(handle)].mode : -1;
  this->mode_->setCurrentIndex(handle >= 0 ? this->mode_->findData(mode) : 0);
  auto* items = qobject_cast<QStandardItemModel*>(this->mode_->model());
  for (int entry = 0; entry < this->mode_->count(); ++entry)
  {
    const auto entry_mode = static_cast<bindpose::HandleMode>(this->mode_->itemData(entry).toInt());
    const bool requires_bone = bindpose::constrains_tail(entry_mode);
    items->item(entry)->setEnabled(!requires_bone || (handle >= 0 && bones));
  }
}

void SidePanel::set_mode(int handle, int mode)
{
  this->handles_->set_mode(handle, mode);
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
  this->handles_->select(handles);
}

void SidePanel::set_state(bool ready, bool binding, bool bound)
{
  this->stopping_ = false;
  // If the button Bind has the keyboard focus, move the focus to Cancel when a bind begins, and
  // back to Bind when the bind ends. Clear the focus of every widget before disabling the widget.
  // Otherwise Qt would move the focus to the list of handles, and the list would select a handle.
  const bool had_focus = this->bind_->hasFocus() || this->cancel_->hasFocus();
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
  if (had_focus)
  {
    (binding ? this->cancel_ : this->bind_)->setFocus();
  }
  enable(this->method_box_, ready && !binding);
  enable(this->domain_, ready && !binding);
  this->bar_->setValue(0);
  this->bar_->setVisible(binding);
  enable(this->column_box_, bound);
  enable(this->rest_, bound);
}

void SidePanel::set_progress(double fraction, const QString& phase)
{
  this->bar_->setValue(static_cast<int>(1000.0 * fraction));
  if (!this->stopping_)
  {
    this->set_note(parts::progress_note(fraction, phase));
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

const bindpose::WeightMethod& SidePanel::method() const
{
  // The constrained methods come first in the registry, in the order of the combo box.
  return bindpose::weight_methods()[static_cast<std::size_t>(this->method_box_->currentIndex())];
}

bindpose::WeightsDomain SidePanel::domain() const
{
  const auto index = static_cast<std::size_t>(this->domain_->currentIndex());
  return static_cast<bindpose::WeightsDomain>(find_option("bind.domain")->choices[index].value);
}

int SidePanel::shown_column() const
{
  return this->column_box_->currentIndex() - 1;
}

void SidePanel::show_column(int column)
{
  this->column_box_->setCurrentIndex(column + 1);
}

} // namespace app::handles

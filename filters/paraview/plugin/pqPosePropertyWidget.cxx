#include "pqPosePropertyWidget.h"

#include "vtkHandleSetWidget.h"
#include "vtkPVHandleSetRepresentation.h"

#include "pqCoreUtilities.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkPolyData.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

#include <QAbstractButton>
#include <QButtonGroup>
#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <iterator>

namespace
{
/// The values of the cell array Mode, in the order of the entries of the combo box.
constexpr int modes[] = { 5, 0, 1, 2, 3, 4 };
} // namespace

pqPosePropertyWidget::pqPosePropertyWidget(
  vtkSMProxy* smproxy, vtkSMPropertyGroup* smgroup, QWidget* parent)
  : Superclass("PoseHandlesWidgetRepresentation", "PoseJSON", smproxy, smgroup, parent),
    gizmos_(new QButtonGroup(this))
{
  this->add_tools();
  this->add_selection_row();
  this->add_message_and_text(tr("The pose as JSON. The text changes with every drag."));

  if (vtkSMProperty* input = smproxy->GetProperty("Input"))
  {
    pqCoreUtilities::connect(input, vtkCommand::ModifiedEvent, this, SLOT(watch_input()));
  }
  if (vtkSMProperty* file = smproxy->GetProperty("FileName"))
  {
    pqCoreUtilities::connect(file, vtkCommand::ModifiedEvent, this, SLOT(read_output()));
  }
  pqCoreUtilities::connect(smproxy, vtkCommand::UpdateDataEvent, this, SLOT(read_output()));
  this->watch_input();
}

pqPosePropertyWidget::~pqPosePropertyWidget()
{
  if (this->input_)
  {
    this->input_->RemoveObserver(this->input_observer_);
  }
}

vtkPVHandleSetRepresentation* pqPosePropertyWidget::representation() const
{
  return vtkPVHandleSetRepresentation::SafeDownCast(this->handles());
}

// ---- Widgets of the panel ----------------------------------------------------------------------

void pqPosePropertyWidget::add_tools()
{
  struct Gizmo
  {
    int value;
    QString text, tip;
  };
  const Gizmo gizmos[] = { { vtkHandleSetRepresentation::GIZMO_NONE, tr("Drag"),
                             tr("Drag handles directly, without a gizmo") },
    { vtkHandleSetRepresentation::GIZMO_MOVE, tr("Move"),
      tr("Show arrows that move the selected handles (G: move with the mouse)") },
    { vtkHandleSetRepresentation::GIZMO_TURN, tr("Turn"),
      tr("Show rings that turn the selected handles (R: turn with the mouse)") },
    { vtkHandleSetRepresentation::GIZMO_SCALE, tr("Scale"),
      tr("Show boxes that scale the selected handles (S: scale with the mouse)") },
    { vtkHandleSetRepresentation::GIZMO_ALL, tr("All"), tr("Show arrows, rings and boxes") } };
  auto* row = new QHBoxLayout;
  row->setSpacing(2);
  for (const Gizmo& gizmo : gizmos)
  {
    QToolButton* button = this->add_button(row, gizmo.text, gizmo.tip);
    button->setCheckable(true);
    button->setChecked(gizmo.value == vtkHandleSetRepresentation::GIZMO_NONE);
    this->gizmos_->addButton(button, gizmo.value);
  }
  row->addStretch(1);
  this->column()->addLayout(row);
  auto* local = new QCheckBox(tr("Local axes"), this);
  local->setToolTip(tr("Use the axes of the handle; off: those of the world"));
  this->column()->addWidget(local);
  const auto set_gizmo = [this](int gizmo)
  {
    if (vtkHandleSetRepresentation* handles = this->handles())
    {
      handles->SetGizmo(gizmo);
      this->focus_view();
      this->render();
    }
  };
  for (QAbstractButton* button : this->gizmos_->buttons())
  {
    QObject::connect(button, &QAbstractButton::clicked, this,
      [this, button, set_gizmo] { set_gizmo(this->gizmos_->id(button)); });
  }
  QObject::connect(local, &QCheckBox::toggled, this,
    [this](bool on)
    {
      if (vtkHandleSetRepresentation* handles = this->handles())
      {
        handles->SetSpace(
          on ? vtkHandleSetRepresentation::LOCAL : vtkHandleSetRepresentation::WORLD);
        this->focus_view();
        this->render();
      }
    });
}

void pqPosePropertyWidget::add_selection_row()
{
  auto* row = new QHBoxLayout;
  row->setSpacing(2);
  this->mode_ = new QComboBox(this);
  this->mode_->addItems(
    { tr("Automatic"), tr("Full"), tr("Position"), tr("Free"), tr("Tail"), tr("Ends") });
  this->mode_->setToolTip(tr(
    "Constraint of the selected handles. Full: the whole transform. Position: only the position.\n"
    "Free: nothing. Tail, Ends: the positions of a bone's tail or of both its ends.\n"
    "Automatic: like Full, but methods that compute rotations choose one of these."));
  row->addWidget(this->mode_);
  this->reset_ = this->add_button(row, tr("Reset"), tr("Return the selected handles to rest"));
  this->reset_all_ =
    this->add_button(row, tr("Reset all"), tr("Return all handles to the input's pose"));
  this->take_pose_ = this->add_button(row, tr("Make pose editable"),
    tr(
      "Replace the file, the sequence or the expressions by the pose that is shown, so that it can "
      "be dragged"));
  row->addStretch(1);
  this->column()->addLayout(row);
  QObject::connect(this->mode_, QOverload<int>::of(&QComboBox::activated), this,
    [this](int index)
    {
      vtkPVHandleSetRepresentation* representation = this->representation();
      if (representation && representation->SetSelectedModes(modes[index]))
      {
        this->apply_edit(tr("Mode of %1").arg(this->selection_text()), this->drawn_text());
      }
      this->show_state();
    });
  QObject::connect(this->reset_, &QToolButton::clicked, this,
    [this]
    {
      vtkPVHandleSetRepresentation* representation = this->representation();
      if (representation && representation->ResetSelectedHandles())
      {
        this->apply_edit(tr("Reset %1").arg(this->selection_text()), this->drawn_text());
      }
    });
  QObject::connect(this->reset_all_, &QToolButton::clicked, this,
    [this] { this->apply_edit(tr("Reset all"), ""); });
  QObject::connect(
    this->take_pose_, &QToolButton::clicked, this, &pqPosePropertyWidget::take_shown_pose);
}

void pqPosePropertyWidget::show_state()
{
  this->Superclass::show_state();
  vtkPVHandleSetRepresentation* representation = this->representation();
  if (!representation || !this->take_pose_)
  {
    return;
  }
  const bool fixed = representation->IsPoseFixed();
  const vtkIdType selected = representation->GetSelectedHandle();
  this->take_pose_->setVisible(fixed);
  this->reset_all_->setVisible(!fixed);
  this->reset_->setEnabled(!fixed && selected >= 0);
  this->mode_->setEnabled(!fixed && selected >= 0);
  if (selected >= 0)
  {
    const QSignalBlocker blocker(this->mode_);
    const int* found =
      std::find(std::begin(modes), std::end(modes), representation->GetHandleMode(selected));
    this->mode_->setCurrentIndex(found == std::end(modes) ? -1 : static_cast<int>(found - modes));
  }
}

QString pqPosePropertyWidget::message() const
{
  vtkPVHandleSetRepresentation* representation = this->representation();
  if (!representation)
  {
    return tr("The handle widget is not available.");
  }
  const std::string reason = representation->GetPoseMessage();
  if (!reason.empty())
  {
    return QString::fromStdString(reason);
  }
  return representation->IsPoseFixed()
    ? tr("This pose comes from a file, is a sequence or has expressions, so it cannot be dragged.")
    : QString();
}

std::string pqPosePropertyWidget::drawn_text() const
{
  vtkPVHandleSetRepresentation* representation = this->representation();
  return representation ? representation->GetPoseJSON() : "";
}

QString pqPosePropertyWidget::step_name() const
{
  const std::string interaction =
    this->handle_widget() ? this->handle_widget()->GetInteractionName() : "";
  return tr("Pose: %1 %2").arg(QString::fromStdString(interaction), this->selection_text());
}

// ---- Edits -------------------------------------------------------------------------------------

void pqPosePropertyWidget::take_shown_pose()
{
  if (vtkPVHandleSetRepresentation* representation = this->representation())
  {
    const std::string text = representation->GetDrawnPoseJSON();
    this->clears_file_ = true;
    this->apply_edit(tr("Make pose editable"), text);
    this->clears_file_ = false;
  }
}

void pqPosePropertyWidget::set_properties(const std::string& text)
{
  if (this->clears_file_)
  {
    vtkSMPropertyHelper(this->proxy(), "FileName").Set("");
  }
  this->Superclass::set_properties(text);
}

// ---- Data --------------------------------------------------------------------------------------

/// Observe the current input of the filter. The user may connect another input.
void pqPosePropertyWidget::watch_input()
{
  const vtkSMPropertyHelper helper(this->proxy(), "Input");
  vtkSMProxy* input = helper.GetNumberOfElements() > 0 ? helper.GetAsProxy() : nullptr;
  if (input != this->input_.GetPointer())
  {
    if (this->input_)
    {
      this->input_->RemoveObserver(this->input_observer_);
    }
    this->input_ = input;
    if (input)
    {
      this->input_observer_ =
        pqCoreUtilities::connect(input, vtkCommand::UpdateDataEvent, this, SLOT(read_input()));
    }
  }
  this->read_input();
}

void pqPosePropertyWidget::read_input()
{
  if (vtkPVHandleSetRepresentation* representation = this->representation())
  {
    const vtkSMPropertyHelper helper(this->proxy(), "Input");
    const vtkSmartPointer<vtkDataObject> data = this->input_
      ? this->fetch(this->input_, static_cast<int>(helper.GetOutputPort()))
      : vtkSmartPointer<vtkDataObject>();
    representation->SetInputHandles(vtkPolyData::SafeDownCast(data));
    this->read_output();
    this->render();
  }
}

/// If the pose is fixed, i.e. its handles cannot be dragged, read the posed handles from the output
/// of the filter.
void pqPosePropertyWidget::read_output()
{
  if (vtkPVHandleSetRepresentation* representation = this->representation())
  {
    const char* file = vtkSMPropertyHelper(this->proxy(), "FileName").GetAsString();
    representation->SetPoseFromFile(file && *file);
    if (representation->IsPoseFixed())
    {
      representation->SetOutputHandles(vtkPolyData::SafeDownCast(this->fetch(this->proxy(), 0)));
    }
    this->show_state();
  }
}

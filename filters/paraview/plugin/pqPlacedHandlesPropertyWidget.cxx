#include "pqPlacedHandlesPropertyWidget.h"

#include "vtkHandleSetWidget.h"
#include "vtkPVPlacedHandlesRepresentation.h"

#include "pqCoreUtilities.h"
#include "pqDataRepresentation.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqView.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkPVDataInformation.h"
#include "vtkSMProxy.h"
#include "vtkSMSourceProxy.h"

#include <QAbstractButton>
#include <QButtonGroup>
#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>

namespace
{
/// Report whether handles can be placed on the data of a port: a surface or tets.
bool is_shape(pqOutputPort* port)
{
  vtkPVDataInformation* data = port ? port->getDataInformation() : nullptr;
  return data && !data->IsCompositeDataSet() && data->GetNumberOfCells() > 0 &&
    (data->DataSetTypeIsA("vtkPolyData") || data->DataSetTypeIsA("vtkUnstructuredGrid"));
}
} // namespace

pqPlacedHandlesPropertyWidget::pqPlacedHandlesPropertyWidget(
  vtkSMProxy* smproxy, vtkSMPropertyGroup* smgroup, QWidget* parent)
  : Superclass("PlacedHandlesWidgetRepresentation", "HandlesText", smproxy, smgroup, parent),
    shapes_(new QComboBox(this)), modes_(new QButtonGroup(this))
{
  this->add_shapes();
  this->add_modes();
  this->add_edits();
  this->add_message_and_text(
    tr("The handles as the text of a .tgf file: lines \"id x y z name\" for nodes, a line \"#\", "
       "lines \"id id is_bone is_pseudo is_cage\" for edges."));
  if (vtkHandleSetWidget* widget = this->handle_widget())
  {
    pqCoreUtilities::connect(widget, vtkCommand::StateChangedEvent, this, SLOT(leave_mode()));
  }
  this->list_shapes();
  this->show_state();
}

pqPlacedHandlesPropertyWidget::~pqPlacedHandlesPropertyWidget() = default;

vtkPVPlacedHandlesRepresentation* pqPlacedHandlesPropertyWidget::representation() const
{
  return vtkPVPlacedHandlesRepresentation::SafeDownCast(this->handles());
}

// ---- The shape ---------------------------------------------------------------------------------

void pqPlacedHandlesPropertyWidget::add_shapes()
{
  auto* row = new QHBoxLayout;
  row->addWidget(new QLabel(tr("Shape"), this));
  this->shapes_->setObjectName("Shape");
  this->shapes_->setToolTip(
    tr("The visible surface or tets on which handles are placed. None: handles are placed in the "
       "plane through the center of rotation that faces the camera."));
  row->addWidget(this->shapes_, 1);
  auto* inside = new QCheckBox(tr("Inside"), this);
  inside->setToolTip(
    tr("Place points and bones in the middle of the shape instead of on its surface"));
  inside->setChecked(true);
  row->addWidget(inside);
  this->column()->addLayout(row);
  QObject::connect(this->shapes_, QOverload<int>::of(&QComboBox::activated), this,
    &pqPlacedHandlesPropertyWidget::read_shape);
  QObject::connect(inside, &QCheckBox::toggled, this,
    [this](bool on)
    {
      if (vtkHandleSetRepresentation* handles = this->handles())
      {
        handles->SetPlaceInside(on);
        this->focus_view();
      }
    });
}

void pqPlacedHandlesPropertyWidget::setView(pqView* view)
{
  if (this->view())
  {
    QObject::disconnect(this->view(), nullptr, this, nullptr);
  }
  this->Superclass::setView(view);
  if (this->view())
  {
    QObject::connect(this->view(), &pqView::representationVisibilityChanged, this,
      &pqPlacedHandlesPropertyWidget::list_shapes);
    QObject::connect(this->view(), &pqView::representationRemoved, this,
      &pqPlacedHandlesPropertyWidget::list_shapes);
  }
  this->list_shapes();
}

pqOutputPort* pqPlacedHandlesPropertyWidget::chosen_shape() const
{
  const int entry = this->shapes_->currentIndex() - 1;
  return entry >= 0 && entry < this->ports_.size() ? this->ports_[entry].data() : nullptr;
}

/// List the visible shapes of the view. If the chosen shape is still visible, it stays chosen. If
/// the user has chosen "None", "None" stays chosen. Otherwise the first shape is chosen.
void pqPlacedHandlesPropertyWidget::list_shapes()
{
  pqOutputPort* chosen = this->chosen_shape();
  const bool chose_none = this->shapes_->currentIndex() == 0 && !this->ports_.isEmpty();
  for (const QPointer<pqOutputPort>& port : this->ports_)
  {
    if (port)
    {
      QObject::disconnect(port->getSource(), nullptr, this, nullptr);
    }
  }
  this->ports_.clear();
  const QSignalBlocker blocker(this->shapes_);
  this->shapes_->clear();
  this->shapes_->addItem(tr("None"));
  const auto representations =
    this->view() ? this->view()->getRepresentations() : QList<pqRepresentation*>();
  for (pqRepresentation* representation : representations)
  {
    auto* drawn = qobject_cast<pqDataRepresentation*>(representation);
    pqOutputPort* port = drawn && drawn->isVisible() ? drawn->getOutputPortFromInput() : nullptr;
    if (is_shape(port) && port->getSource() != this->source())
    {
      this->ports_.append(port);
      this->shapes_->addItem(port->prettyName());
      QObject::connect(port->getSource(),
        QOverload<pqPipelineSource*>::of(&pqPipelineSource::dataUpdated), this,
        &pqPlacedHandlesPropertyWidget::read_shape, Qt::UniqueConnection);
    }
  }
  const int kept = this->ports_.indexOf(chosen);
  this->shapes_->setCurrentIndex(kept >= 0   ? kept + 1
      : this->ports_.isEmpty() || chose_none ? 0
                                             : 1);
  this->read_shape();
}

void pqPlacedHandlesPropertyWidget::showEvent(QShowEvent* event)
{
  this->Superclass::showEvent(event);
  if (this->is_shape_outdated_)
  {
    this->read_shape();
  }
}

void pqPlacedHandlesPropertyWidget::read_shape()
{
  // Do not read the shape while the panel is hidden. ParaView keeps the panels of all sources, and
  // a drag in another panel may change the shape with every mouse motion.
  vtkPVPlacedHandlesRepresentation* representation = this->representation();
  this->is_shape_outdated_ = !this->isVisible();
  if (!representation || this->is_shape_outdated_)
  {
    return;
  }
  pqOutputPort* port = this->chosen_shape();
  const vtkSmartPointer<vtkDataObject> data = port
    ? this->fetch(port->getSourceProxy(), port->getPortNumber())
    : vtkSmartPointer<vtkDataObject>();
  if (!representation->SetShape(vtkDataSet::SafeDownCast(data)))
  {
    this->show_warning(tr("%1 has neither triangles nor tets; handles are placed without a shape.")
                         .arg(port->prettyName()));
  }
}

// ---- Modes and edits ---------------------------------------------------------------------------

void pqPlacedHandlesPropertyWidget::add_modes()
{
  struct Mode
  {
    int value;
    QString text, tip;
  };
  const Mode modes[] = { { vtkHandleSetRepresentation::MOVE_REST, tr("Move"),
                           tr(
                             "Drag points, bones and their joints. Shift-click selects several.") },
    { vtkHandleSetRepresentation::ADD_POINTS, tr("Points"), tr("Click to place points") },
    { vtkHandleSetRepresentation::ADD_BONES, tr("Bones"),
      tr("Drag to draw a bone from head to tail. A bone that begins at the end of another bone is "
         "its child.") },
    { vtkHandleSetRepresentation::ADD_CAGE, tr("Cage"),
      tr("Click to place the vertices of a cage. A click on the first vertex closes it.") } };
  auto* row = new QHBoxLayout;
  row->setSpacing(2);
  for (const Mode& mode : modes)
  {
    QToolButton* button = this->add_button(row, mode.text, mode.tip);
    button->setCheckable(true);
    this->modes_->addButton(button, mode.value);
    const int value = mode.value;
    QObject::connect(button, &QToolButton::clicked, this, [this, value] { this->set_mode(value); });
  }
  row->addStretch(1);
  this->column()->addLayout(row);
}

void pqPlacedHandlesPropertyWidget::add_edits()
{
  auto* row = new QHBoxLayout;
  row->setSpacing(2);
  this->connect_ = this->add_button(row, tr("Connect"),
    tr("Make a bone of the two selected points, or an edge of two selected cage vertices"));
  this->delete_ = this->add_button(row, tr("Delete"), tr("Delete the selected handles"));
  this->end_cage_ = this->add_button(
    row, tr("Leave cage open"), tr("End the cage without closing it (Enter or double click)"));
  row->addStretch(1);
  this->column()->addLayout(row);
  QObject::connect(this->connect_, &QToolButton::clicked, this,
    [this]
    {
      vtkPVPlacedHandlesRepresentation* representation = this->representation();
      if (representation && representation->ConnectSelectedHandles())
      {
        this->apply_edit(tr("Connect handles"), this->drawn_text());
      }
      this->show_state();
    });
  QObject::connect(this->delete_, &QToolButton::clicked, this,
    [this]
    {
      vtkPVPlacedHandlesRepresentation* representation = this->representation();
      const QString name = this->selection_text();
      if (representation && representation->DeleteSelectedHandles())
      {
        this->apply_edit(tr("Delete %1").arg(name), this->drawn_text());
      }
      this->show_state();
    });
  QObject::connect(this->end_cage_, &QToolButton::clicked, this,
    [this]
    {
      if (vtkHandleSetRepresentation* handles = this->handles())
      {
        handles->FinishCage();
        this->focus_view();
        this->render();
        this->show_state();
      }
    });
}

void pqPlacedHandlesPropertyWidget::set_mode(int mode)
{
  if (vtkHandleSetWidget* widget = this->handle_widget())
  {
    widget->SetEditMode(mode);
    this->show_warning(QString());
    this->focus_view();
    this->render();
  }
}

/// The Escape key sets vtkHandleSetWidget to the mode POSE. A .tgf file stores no pose, so this
/// panel sets the mode MOVE_REST instead.
void pqPlacedHandlesPropertyWidget::leave_mode()
{
  this->set_mode(vtkHandleSetRepresentation::MOVE_REST);
}

void pqPlacedHandlesPropertyWidget::show_state()
{
  this->Superclass::show_state();
  vtkHandleSetRepresentation* handles = this->handles();
  if (!handles || !this->end_cage_)
  {
    return;
  }
  if (QAbstractButton* button = this->modes_->button(handles->GetEditMode()))
  {
    button->setChecked(true);
  }
  this->connect_->setEnabled(handles->GetNumberOfSelectedHandles() >= 2);
  this->delete_->setEnabled(handles->GetNumberOfSelectedHandles() >= 1);
  this->end_cage_->setEnabled(handles->IsMakingCage());
}

std::string pqPlacedHandlesPropertyWidget::drawn_text() const
{
  vtkPVPlacedHandlesRepresentation* representation = this->representation();
  return representation ? representation->GetHandlesText() : "";
}

QString pqPlacedHandlesPropertyWidget::message() const
{
  vtkPVPlacedHandlesRepresentation* representation = this->representation();
  return representation ? QString::fromStdString(representation->GetTextMessage())
                        : tr("The handle widget is not available.");
}

QString pqPlacedHandlesPropertyWidget::step_name() const
{
  // The name of an interaction is, for example, "add point", "move rest" or "close cage".
  const std::string interaction =
    this->handle_widget() ? this->handle_widget()->GetInteractionName() : "";
  return tr("Handles: %1").arg(QString::fromStdString(interaction));
}

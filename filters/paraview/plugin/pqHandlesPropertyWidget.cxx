// ParaView links the text property of the filter to the representation, through the widget's proxy.
// If the unchecked value of the property changes, ParaView sends it to the representation. If the
// user edits the handles, ParaView writes the new text to the unchecked value. When the edit is
// applied, this file copies the unchecked value to the checked value.
#include "pqHandlesPropertyWidget.h"

#include "vtkHandleSetRepresentation.h"
#include "vtkHandleSetWidget.h"

#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqPipelineSource.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"
#include "pqView.h"

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkPVDataInformation.h"
#include "vtkSMNewWidgetRepresentationProxy.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyGroup.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"
#include "vtkSMUncheckedPropertyHelper.h"
#include "vtkSMViewProxy.h"
#include "vtkTimerLog.h"

#include <QCheckBox>
#include <QLabel>
#include <QPlainTextEdit>
#include <QToolButton>
#include <QVBoxLayout>

namespace
{
/// While an object of this class exists, the undo stack does not record changes of proxies.
class NonUndoableChanges
{
public:
  NonUndoableChanges() : stack_(pqApplicationCore::instance()->getUndoStack())
  {
    if (this->stack_)
    {
      this->stack_->beginNonUndoableChanges();
    }
  }
  ~NonUndoableChanges()
  {
    if (this->stack_)
    {
      this->stack_->endNonUndoableChanges();
    }
  }
  NonUndoableChanges(const NonUndoableChanges&) = delete;
  NonUndoableChanges& operator=(const NonUndoableChanges&) = delete;

private:
  pqUndoStack* stack_;
};

/// Name of an event in ParaView's Timer Log. The event measures the time to apply one mouse motion,
/// without the time to draw the view of the widget.
constexpr const char* drag_event = "Bindpose: apply a drag";

std::string text_of(const vtkSMPropertyHelper& helper)
{
  const char* text = helper.GetAsString();
  return text ? text : "";
}
} // namespace

pqHandlesPropertyWidget::pqHandlesPropertyWidget(const char* representation, const char* function,
  vtkSMProxy* smproxy, vtkSMPropertyGroup* smgroup, QWidget* parent)
  : Superclass("representations", representation, smproxy, smgroup, parent),
    property_(smgroup->GetProperty(function)), column_(new QVBoxLayout(this)),
    shown_(new QCheckBox(tr("Show the handles in the view"), this))
{
  // Emit changeFinished() only at the end of a drag, not with each changeAvailable().
  this->setChangeAvailableAsChangeFinished(false);
  this->column_->setContentsMargins(0, 0, 0, 0);
  this->column_->addWidget(this->shown_);
  this->shown_->setChecked(true);
  QObject::connect(this->shown_, &QCheckBox::clicked, this,
    [this](bool shown)
    {
      this->shows_handles_ = shown;
      this->setWidgetVisible(shown);
    });
  QObject::connect(
    this, &pqHandlesPropertyWidget::widgetVisibilityToggled, this->shown_, &QCheckBox::setChecked);
  this->setWidgetVisible(true);

  // The observers of the superclass change the state of the panel. begin_drag() must store the
  // state before this change, so it has a higher priority than these observers.
  vtkSMProxy* widget = this->widgetProxy();
  this->start_observer_ = widget->AddObserver(
    vtkCommand::StartInteractionEvent, this, &pqHandlesPropertyWidget::begin_drag, 1.0f);
  pqCoreUtilities::connect(widget, vtkCommand::InteractionEvent, this, SLOT(continue_drag()));
  pqCoreUtilities::connect(widget, vtkCommand::EndInteractionEvent, this, SLOT(finish_drag()));
  if (vtkHandleSetWidget* handle_widget = this->handle_widget())
  {
    pqCoreUtilities::connect(
      handle_widget, vtkCommand::SelectionChangedEvent, this, SLOT(show_state()));
    pqCoreUtilities::connect(
      handle_widget, vtkCommand::WarningEvent, this, SLOT(warn(vtkObject*, unsigned long, void*)));
  }
}

pqHandlesPropertyWidget::~pqHandlesPropertyWidget()
{
  if (this->widgetProxy())
  {
    this->widgetProxy()->RemoveObserver(this->start_observer_);
  }
}

void pqHandlesPropertyWidget::hideEvent(QHideEvent* event)
{
  this->QWidget::hideEvent(event);
  this->setWidgetVisible(false);
}

void pqHandlesPropertyWidget::showEvent(QShowEvent* event)
{
  this->QWidget::showEvent(event);
  this->setWidgetVisible(this->shows_handles_);
}

vtkHandleSetWidget* pqHandlesPropertyWidget::handle_widget() const
{
  return vtkHandleSetWidget::SafeDownCast(this->widgetProxy()->GetWidget());
}

vtkHandleSetRepresentation* pqHandlesPropertyWidget::handles() const
{
  vtkSMProxy* representation = this->widgetProxy()->GetRepresentationProxy();
  return representation
    ? vtkHandleSetRepresentation::SafeDownCast(representation->GetClientSideObject())
    : nullptr;
}

pqPipelineSource* pqHandlesPropertyWidget::source() const
{
  return pqApplicationCore::instance()->getServerManagerModel()->findItem<pqPipelineSource*>(
    this->proxy());
}

bool pqHandlesPropertyWidget::is_applied() const
{
  const pqPipelineSource* source = this->source();
  return source && source->modifiedState() != pqProxy::UNINITIALIZED;
}

// ---- Widgets of the panel ----------------------------------------------------------------------

QToolButton* pqHandlesPropertyWidget::add_button(
  QBoxLayout* row, const QString& text, const QString& tip)
{
  auto* button = new QToolButton(this);
  button->setText(text);
  button->setToolTip(tip);
  row->addWidget(button);
  return button;
}

void pqHandlesPropertyWidget::add_message_and_text(const QString& tip)
{
  this->message_ = new QLabel(this);
  this->message_->setWordWrap(true);
  this->message_->setObjectName("Message");
  this->column_->addWidget(this->message_);
  this->text_button_ = new QToolButton(this);
  this->text_button_->setText(tr("Text"));
  this->text_button_->setToolTip(tip);
  this->text_button_->setCheckable(true);
  this->text_button_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  this->text_button_->setArrowType(Qt::RightArrow);
  this->text_button_->setAutoRaise(true);
  this->column_->addWidget(this->text_button_);
  this->text_ = new QPlainTextEdit(this);
  this->text_->setObjectName("Text");
  this->text_->setToolTip(tip);
  this->text_->setVisible(false);
  this->column_->addWidget(this->text_);
  QObject::connect(this->text_button_, &QToolButton::toggled, this,
    [this](bool open)
    {
      this->text_button_->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
      this->text_->setVisible(open);
    });
  this->addPropertyLink(this->text_, "plainText", SIGNAL(textChanged()), this->property_);
  // The text also changes when the property changes, for example during drags. Only typing is an
  // edit of the user, for which changeFinished() may trigger ParaView's automatic apply.
  QObject::connect(
    this->text_, &QPlainTextEdit::textChanged, this,
    [this]
    {
      this->show_state();
      if (this->text_->hasFocus())
      {
        Q_EMIT this->changeFinished();
      }
    },
    Qt::QueuedConnection);
}

QString pqHandlesPropertyWidget::selection_text() const
{
  vtkHandleSetRepresentation* handles = this->handles();
  const int count = handles ? handles->GetNumberOfSelectedHandles() : 0;
  return count == 1 ? QString::fromStdString(handles->GetHandleName(handles->GetSelectedHandle()))
                    : tr("%1 handles").arg(count);
}

void pqHandlesPropertyWidget::show_state()
{
  if (this->message_)
  {
    const QString text = this->warning_.isEmpty() ? this->message() : this->warning_;
    this->message_->setText(text);
    this->message_->setVisible(!text.isEmpty());
  }
}

void pqHandlesPropertyWidget::show_warning(const QString& sentence)
{
  this->warning_ = sentence;
  this->show_state();
}

void pqHandlesPropertyWidget::warn(vtkObject*, unsigned long, void* sentence)
{
  this->show_warning(QString::fromUtf8(static_cast<const char*>(sentence)));
}

void pqHandlesPropertyWidget::focus_view()
{
  if (this->view() && this->view()->widget())
  {
    this->view()->widget()->setFocus();
  }
}

// ---- Edits -------------------------------------------------------------------------------------

void pqHandlesPropertyWidget::begin_drag()
{
  this->warning_.clear();
  this->start_text_ = text_of(vtkSMPropertyHelper(this->property_));
  this->start_unchecked_text_ = text_of(vtkSMUncheckedPropertyHelper(this->property_));
  this->start_state_ = this->source() ? this->source()->modifiedState() : pqProxy::UNMODIFIED;
}

void pqHandlesPropertyWidget::continue_drag()
{
  if (this->is_applied() && this->applies_during_drag())
  {
    vtkTimerLog::MarkStartEvent(drag_event);
    this->apply_silently(this->drawn_text());
    this->update_views();
    vtkTimerLog::MarkEndEvent(drag_event);
  }
}

void pqHandlesPropertyWidget::finish_drag()
{
  const std::string text = this->drawn_text();
  // Applying the text poses the handles again, which clears the message.
  const QString message = this->message();
  const bool canceled = this->handle_widget() && this->handle_widget()->GetCanceled();
  if (this->is_applied())
  {
    // The undo step must restore the value before the drag, not the value of the last mouse motion.
    this->apply_silently(this->start_text_);
    if (!canceled && text != this->start_text_)
    {
      this->commit(this->step_name(), text);
    }
    this->update_views();
  }
  if (canceled)
  {
    vtkSMUncheckedPropertyHelper(this->property_).Set(this->start_unchecked_text_.c_str());
  }
  // The drag has marked the source as modified. Restore the previous state, because the drag itself
  // needs no Apply.
  if (this->source())
  {
    this->source()->setModifiedState(this->start_state_);
  }
  if (this->warning_.isEmpty())
  {
    this->warning_ = message;
  }
  this->show_state();
}

void pqHandlesPropertyWidget::apply_edit(const QString& step, const std::string& text)
{
  this->warning_.clear();
  if (this->is_applied())
  {
    const QString message = this->message();
    this->commit(step, text);
    this->update_views();
    this->render();
    this->warning_ = message;
  }
  else
  {
    vtkSMUncheckedPropertyHelper(this->property_).Set(text.c_str());
    Q_EMIT this->changeAvailable();
    Q_EMIT this->changeFinished();
    this->render();
  }
  this->show_state();
}

void pqHandlesPropertyWidget::apply_silently(const std::string& text)
{
  if (text != text_of(vtkSMPropertyHelper(this->property_)))
  {
    const NonUndoableChanges changes;
    vtkSMPropertyHelper(this->property_).Set(text.c_str());
    this->proxy()->UpdateVTKObjects();
  }
}

void pqHandlesPropertyWidget::commit(const QString& step, const std::string& text)
{
  BEGIN_UNDO_SET(step);
  {
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", this->proxy());
    this->set_properties(text);
    this->proxy()->UpdateVTKObjects();
  }
  END_UNDO_SET();
}

void pqHandlesPropertyWidget::set_properties(const std::string& text)
{
  vtkSMPropertyHelper(this->property_).Set(text.c_str());
}

void pqHandlesPropertyWidget::update_views()
{
  // An update changes information properties of proxies. These changes are not edits.
  const NonUndoableChanges changes;
  const auto views = pqApplicationCore::instance()->getServerManagerModel()->findItems<pqView*>();
  for (pqView* view : views)
  {
    if (view->getViewProxy()->GetNeedsUpdate())
    {
      view->getViewProxy()->Update();
      if (view != this->view()) // the handle widget renders its own view
      {
        view->render();
      }
    }
  }
}

// ---- Data --------------------------------------------------------------------------------------

vtkSmartPointer<vtkDataObject> pqHandlesPropertyWidget::fetch(vtkSMProxy* producer, int port)
{
  auto* source = vtkSMSourceProxy::SafeDownCast(producer);
  if (!source || port >= static_cast<int>(source->GetNumberOfOutputPorts()))
  {
    return nullptr;
  }
  if (auto* algorithm = vtkAlgorithm::SafeDownCast(source->GetClientSideObject()))
  {
    return port < algorithm->GetNumberOfOutputPorts() ? algorithm->GetOutputDataObject(port)
                                                      : nullptr;
  }
  // The data is on a server. The first process of the server has all handles; move the handles to
  // the client.
  const NonUndoableChanges changes;
  vtkSmartPointer<vtkSMSourceProxy> mover;
  mover.TakeReference(vtkSMSourceProxy::SafeDownCast(
    source->GetSessionProxyManager()->NewProxy("filters", "ClientServerMoveData")));
  if (!mover)
  {
    return nullptr;
  }
  vtkSMPropertyHelper(mover, "Input").Set(source, static_cast<unsigned int>(port));
  vtkSMPropertyHelper(mover, "OutputDataType", true)
    .Set(source->GetDataInformation(static_cast<unsigned int>(port))->GetDataSetType());
  mover->UpdateVTKObjects();
  mover->UpdatePipeline();
  auto* algorithm = vtkAlgorithm::SafeDownCast(mover->GetClientSideObject());
  return algorithm ? algorithm->GetOutputDataObject(0) : nullptr;
}

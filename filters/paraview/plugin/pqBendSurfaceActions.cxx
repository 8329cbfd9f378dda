#include "pqBendSurfaceActions.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqObjectBuilder.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqProxyModifiedStateUndoElement.h"
#include "pqServer.h"
#include "pqUndoStack.h"
#include "pqView.h"

#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"
#include "vtkSMViewProxy.h"

#include <QAction>
#include <QApplication>
#include <QCursor>
#include <QIcon>
#include <QList>
#include <QMap>
#include <QMessageBox>
#include <QObject>
#include <QString>

namespace
{
/// AutomaticHandles::Points, the method that needs no helper program.
constexpr int points_method = 1;

using Inputs = QMap<QString, QList<pqOutputPort*>>;

pqPipelineSource* add_filter(const QString& name, const Inputs& inputs, pqServer* server)
{
  return pqApplicationCore::instance()->getObjectBuilder()->createFilter(
    "filters", name, inputs, server);
}

/// Update a new filter and mark it as applied, so that the user need not press Apply. Undo and redo
/// also restore this mark.
void apply(pqPipelineSource* filter)
{
  filter->getSourceProxy()->UpdatePipeline();
  pqProxyModifiedStateUndoElement* element = pqProxyModifiedStateUndoElement::New();
  element->SetSession(filter->getServer()->session());
  element->MadeUnmodified(filter);
  ADD_UNDO_ELEM(element);
  element->Delete();
  filter->setModifiedState(pqProxy::UNMODIFIED);
}

bool has_cells(pqPipelineSource* filter)
{
  return filter->getSourceProxy()->GetDataInformation(0)->GetNumberOfCells() > 0;
}

/// Change a property of an applied filter and record it in a trace.
void set_method(pqPipelineSource* filter, int method)
{
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", filter->getProxy());
  vtkSMPropertyHelper(filter->getProxy(), "Method").Set(method);
  filter->getProxy()->UpdateVTKObjects();
}

/// Return the message of a failed filter, from its report.
QString message_of(pqPipelineSource* filter)
{
  vtkPVArrayInformation* array =
    filter->getSourceProxy()->GetDataInformation(0)->GetArrayInformation(
      "Report.message", vtkDataObject::FIELD);
  const bool has_message = array && array->GetNumberOfStringValues() > 0;
  return has_message ? QString::fromUtf8(array->GetStringValue(0))
                     : QObject::tr("%1 has no result. View > Output Messages shows the reason.")
                         .arg(filter->getSMName());
}

/// Build a chain of filters whose input is the surface. If a filter fails, return its message. The
/// failed filter and the filters upstream of it remain, so that the user can change their
/// properties.
QString build_chain(pqOutputPort* surface)
{
  pqServer* server = surface->getServer();
  pqPipelineSource* handles = add_filter("AutomaticHandles", { { "Input", { surface } } }, server);
  apply(handles);
  if (!has_cells(handles))
  {
    set_method(handles, points_method);
    handles->getSourceProxy()->UpdatePipeline();
  }
  if (!has_cells(handles))
  {
    return message_of(handles);
  }
  pqOutputPort* handle_port = handles->getOutputPort(0);
  pqPipelineSource* weights = add_filter("BoundedBiharmonicWeights",
    { { "Input", { surface } }, { "Handles", { handle_port } } }, server);
  apply(weights);
  if (!has_cells(weights))
  {
    return message_of(weights);
  }
  pqPipelineSource* pose = add_filter("PoseHandles", { { "Input", { handle_port } } }, server);
  apply(pose);
  pqPipelineSource* bent = add_filter("ReducedARAP",
    { { "Input", { weights->getOutputPort(0) } }, { "Handles", { pose->getOutputPort(0) } } },
    server);
  apply(bent);

  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  pqView* view = pqActiveObjects::instance().activeView();
  vtkSMViewProxy* view_proxy = view ? view->getViewProxy() : nullptr;
  if (view_proxy)
  {
    controller->Hide(surface->getSourceProxy(), surface->getPortNumber(), view_proxy);
  }
  controller->ShowInPreferredView(bent->getSourceProxy(), 0, view_proxy);
  pqActiveObjects::instance().setActiveSource(pose);
  return has_cells(bent) ? QString() : message_of(bent);
}
} // namespace

pqBendSurfaceActions::pqBendSurfaceActions(QObject* parent) : QActionGroup(parent)
{
  auto* action = new QAction(QIcon(":/Bindpose/bend.svg"), tr("&Bend This Surface"), this);
  action->setObjectName("actionBendThisSurface");
  action->setToolTip(
    tr("Make handles and weights for the active surface, and drag the handles in the view"));
  action->setStatusTip(action->toolTip());
  this->addAction(action);
  QObject::connect(action, &QAction::triggered, this, &pqBendSurfaceActions::bend);
}

/// Return one sentence with the reason why the output cannot be bent; empty if no reason was found.
QString pqBendSurfaceActions::refusal(pqOutputPort* port)
{
  if (!port)
  {
    return tr("No source is active. Select a surface in the Pipeline Browser.");
  }
  if (port->getSource()->modifiedState() == pqProxy::UNINITIALIZED)
  {
    return tr("%1 has no data yet. Press Apply first.").arg(port->getSource()->getSMName());
  }
  const vtkPVDataInformation* data = port->getDataInformation();
  if (data->IsCompositeDataSet())
  {
    return tr(
      "%1 consists of several blocks. Extract one of them with Extract Block, or merge them "
      "with Merge Blocks.")
      .arg(port->prettyName());
  }
  const bool is_mesh =
    data->DataSetTypeIsA("vtkPolyData") || data->DataSetTypeIsA("vtkUnstructuredGrid");
  if (!is_mesh || data->GetNumberOfCells() == 0)
  {
    return tr(
      "%1 is not a surface. Extract Surface makes a surface of a volume, and Contour one of "
      "an image.")
      .arg(port->prettyName());
  }
  return {};
}

void pqBendSurfaceActions::bend()
{
  pqOutputPort* surface = pqActiveObjects::instance().activePort();
  QString problem = refusal(surface);
  if (problem.isEmpty())
  {
    QApplication::setOverrideCursor(Qt::WaitCursor);
    BEGIN_UNDO_SET(tr("Bend This Surface"));
    problem = build_chain(surface);
    END_UNDO_SET();
    QApplication::restoreOverrideCursor();
    if (pqView* view = pqActiveObjects::instance().activeView())
    {
      view->render();
    }
  }
  if (!problem.isEmpty())
  {
    QMessageBox::warning(pqCoreUtilities::mainWidget(), tr("Bend This Surface"), problem);
  }
}

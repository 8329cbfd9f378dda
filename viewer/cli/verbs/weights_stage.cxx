#include "cli/verbs/weights_stage.h"

#include "cli/session.h"
#include "cli/set_options.h"

#include "report_field_data.h"
#include "vtkBoundedBiharmonicWeights.h"
#include "vtkMonotoneWeights.h"
#include "vtkTransferWeights.h"
#include "vtkUnconstrainedWeights.h"

#include "vtkNew.h"
#include "vtkPointData.h"

namespace bindpose::cli
{

namespace
{
vtkSmartPointer<vtkWeightsAlgorithm> make_method(const Arguments& arguments)
{
  const std::string method = arguments.text("method");
  if (method == "bounded-biharmonic")
  {
    const auto weights = vtkSmartPointer<vtkBoundedBiharmonicWeights>::New();
    set_bounded_weights_options(arguments, weights.Get());
    return weights;
  }
  if (method == "monotone")
  {
    const auto weights = vtkSmartPointer<vtkMonotoneWeights>::New();
    set_bounded_weights_options(arguments, weights.Get());
    return weights;
  }
  const auto weights = vtkSmartPointer<vtkUnconstrainedWeights>::New();
  weights->SetMethod(method);
  return weights;
}

/// Set the terms of the weights filter: additional constraints and energies.
/// @param mesh  the input, before it is filled with tets
bool set_terms(Session& session, vtkDataSet* mesh, vtkWeightsAlgorithm* weights)
{
  const Arguments& arguments = session.arguments();
  for (const char* option : { "rigidity", "rigid-set", "lower", "upper", "pinned" })
  {
    if (arguments.is_typed(option) &&
      !mesh->GetPointData()->GetArray(arguments.text(option).c_str()))
    {
      return session.invalid("--" + std::string(option) + ": the mesh has no point array '" +
        arguments.text(option) + "'");
    }
  }
  const std::string axis = arguments.text("mirror");
  if (axis != "none")
  {
    double box[6];
    mesh->GetBounds(box);
    weights->SetMirrorNormal(axis == "x", axis == "y", axis == "z");
    weights->SetMirrorOrigin(
      0.5 * (box[0] + box[1]), 0.5 * (box[2] + box[3]), 0.5 * (box[4] + box[5]));
  }
  set_weight_terms_options(arguments, weights);
  return true;
}
} // namespace

vtkSmartPointer<vtkDataSet> shallow_copy(vtkDataSet* data)
{
  auto copy = vtk::TakeSmartPointer(data->NewInstance());
  copy->ShallowCopy(data);
  return copy;
}

vtkSmartPointer<vtkWeightsAlgorithm> make_weights(Session& session, vtkDataSet* mesh)
{
  vtkSmartPointer<vtkWeightsAlgorithm> weights = make_method(session.arguments());
  set_weights_options(session.arguments(), weights.Get());
  if (!set_terms(session, mesh, weights))
  {
    return nullptr;
  }
  return weights;
}

vtkSmartPointer<vtkDataSet> transfer_to_points(
  Session& session, vtkDataSet* mesh, vtkDataSet* weights)
{
  vtkNew<vtkTransferWeights> transfer;
  transfer->SetInputData(0, mesh);
  transfer->SetInputData(1, weights);
  const Report weights_report = session.report();
  if (!session.run(transfer, "transfer", 0.98, 1.0, Merge::numbers))
  {
    return nullptr;
  }
  // If both filters report the same entry, keep that of the weights filter.
  session.report().merge(weights_report);
  auto result = shallow_copy(transfer->GetOutput());
  vtkNew<vtkTransferWeights> raw_transfer;
  if (session.arguments().has("keep-raw"))
  {
    raw_transfer->SetArrayName("RawWeights");
    raw_transfer->SetInputData(0, result);
    raw_transfer->SetInputData(1, weights);
    if (!session.run(raw_transfer, "transfer_raw", 0.98, 1.0, Merge::nothing))
    {
      return nullptr;
    }
    result = shallow_copy(raw_transfer->GetOutput());
  }
  Report stored_report = read_report(transfer->GetOutput());
  stored_report.merge(read_report(weights));
  attach_report(result, stored_report);
  return result;
}

} // namespace bindpose::cli

#ifndef arap_input_h
#define arap_input_h

#include "conversion.h"
#include "pose/arap_energy.h"
#include "pose/reduced_space.h"

namespace bindpose
{

/// A mesh as the energies see it: tets if it has cells of volume, else triangles.
struct ArapElements
{
  bool volume = false;
  TetInput tets;
  SurfaceInput surface;
};

/// @param energy of vtkReducedARAP::EnergyType. invalid_input for cells that are no such mesh, and
/// for an energy of tets on a surface or of triangles on tets.
Status to_arap(vtkPointSet* mesh, int energy, ArapElements& elements, ArapEnergy& result);

/// Binds a kernel of reduced as-rigid-as-possible deformation with the filter's energy, clusters
/// and extra weights.
/// @param input the filter's PoseInput, from pose_input.h.
/// @param options what the filter says beyond these.
template <typename Filter, typename Kernel, typename Input>
Status bind_reduced(Filter& filter, Kernel& kernel, const Input& input, ExecutionContext& context,
  ReducedArapOptions options = {})
{
  options.clusters = filter.GetNumberOfClusters();
  options.extra_weights = filter.GetNumberOfExtraWeights();
  options.extra_kind = static_cast<ExtraWeights>(filter.GetExtraWeightsKind());
  ArapElements elements;
  const Status status = to_arap(input.mesh, filter.GetEnergy(), elements, options.energy);
  if (!status.ok())
  {
    return status;
  }
  return elements.volume ? kernel.bind(context, input.points, elements.tets.tets.view(),
                             input.weights, input.handles, options)
                         : kernel.bind(context, input.points, elements.surface.triangles.view(),
                             input.weights, input.handles, options);
}

/// "auto", "spokes and rims", …
const char* arap_energy_name(int energy);

} // namespace bindpose

#endif

#ifndef arap_input_h
#define arap_input_h

#include "arap/arap_energy.h"
#include "arap/reduced_space.h"
#include "conversion.h"

namespace bindpose
{

/// A mesh in the form that the as-rigid-as-possible (ARAP) energies use: tets if the mesh has
/// volume cells, otherwise triangles.
struct ArapElements
{
  bool volume = false;
  TetInput tets;
  SurfaceInput surface;
};

/// Convert a mesh and an energy type to the kernel's types. Return invalid_input if the cells are
/// neither tets nor triangles, or if the energy is defined only for the other type of mesh
/// (TETRAHEDRA on a surface, TRIANGLES on tets).
/// @param energy  a value of vtkArapEnergy::EnergyType
Status to_arap(vtkPointSet* mesh, int energy, ArapElements& elements, ArapEnergy& result);

/// Bind a kernel of reduced as-rigid-as-possible deformation to the mesh. The filter provides the
/// energy, the number of clusters and the extra weights.
/// @param input  the input of vtkBindAlgorithm::Bind()
/// @param options  all other options of the kernel
template <typename Filter, typename Kernel, typename Input>
Status bind_reduced(ExecutionContext& context, Filter& filter, Kernel& kernel, const Input& input,
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

/// Return the name of an energy: "auto", "spokes and rims", …
const char* arap_energy_name(int energy);

} // namespace bindpose

#endif

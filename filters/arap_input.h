#ifndef arap_input_h
#define arap_input_h

#include "conversion.h"
#include "pose/arap_energy.h"

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

/// "auto", "spokes and rims", …
const char* arap_energy_name(int energy);

} // namespace bindpose

#endif

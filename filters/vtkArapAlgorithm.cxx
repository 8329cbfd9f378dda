#include "vtkArapAlgorithm.h"

#include "arap_input.h"

#include <algorithm>

using namespace bindpose;

void vtkArapAlgorithm::SetEnergy(int energy)
{
  energy = std::clamp<int>(energy, AUTO, SPOKES);
  this->SetBindParameter(this->Energy, energy);
}

void vtkArapAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Energy: " << arap_energy_name(this->Energy) << "\n";
  os << indent << "RotationArrays: " << (this->RotationArrays ? "on" : "off") << "\n";
}

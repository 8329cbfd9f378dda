#include "vtkReducedPoseAlgorithm.h"

#include <algorithm>

using namespace bindpose;

void vtkReducedPoseAlgorithm::SetNumberOfClusters(int clusters)
{
  clusters = std::max(clusters, 0);
  this->SetBindParameter(this->NumberOfClusters, clusters);
}

void vtkReducedPoseAlgorithm::SetNumberOfExtraWeights(int extra)
{
  extra = std::max(extra, 0);
  this->SetBindParameter(this->NumberOfExtraWeights, extra);
}

void vtkReducedPoseAlgorithm::SetExtraWeightsKind(int kind)
{
  kind = std::clamp<int>(kind, BUMPS, EIGENMODES);
  this->SetBindParameter(this->ExtraWeightsKind, kind);
}

void vtkReducedPoseAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfClusters: " << this->NumberOfClusters << "\n";
  os << indent << "NumberOfExtraWeights: " << this->NumberOfExtraWeights << "\n";
  os << indent
     << "ExtraWeightsKind: " << (this->ExtraWeightsKind == EIGENMODES ? "eigenmodes" : "bumps")
     << "\n";
}

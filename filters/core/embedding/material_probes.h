#ifndef bindpose_embedding_material_probes_h
#define bindpose_embedding_material_probes_h

#include "embedding/lattice_cover.h"
#include "winding/winding_number.h"

#include <utility>
#include <vector>

namespace bindpose
{

/// Straight probes through a surface and its inside, where no line between samples may lie: a slice
/// of material in a few tets.
class MaterialProbes
{
public:
  using Id = LatticeCover::Id;

  /// Both must outlive the probes.
  MaterialProbes(const LatticeCover& cover, const WindingNumber& winding, double threshold)
    : cover_(cover), winding_(winding), threshold_(threshold)
  {
  }

  struct Side
  {
    Id root; ///< its name
    std::vector<Vec3> places; ///< of its material, in cubes
  };
  /// Adds the pairs of names of sides that a probe connects. `triangles`: all those around; they
  /// may be named more than once.
  /// Cost: up to 12 probes for every pair of sides, each as many winding numbers as it is cut.
  void connect(std::vector<Side> sides, std::vector<Id> triangles,
    std::vector<std::pair<Id, Id>>& joined) const;

private:
  /// True when the line from a to b, crossed by these triangles only, stays in the material.
  bool stays_inside(const Vec3& a, const Vec3& b, const std::vector<Id>& triangles,
    std::vector<double>& cuts) const;
  /// True when one of the shortest lines does.
  bool connects(const std::vector<Vec3>& from, const std::vector<Vec3>& to,
    const std::vector<Id>& triangles, std::vector<double>& cuts) const;

  const LatticeCover& cover_;
  const WindingNumber& winding_;
  double threshold_;
};

} // namespace bindpose

#endif

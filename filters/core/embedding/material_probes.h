#ifndef bindpose_embedding_material_probes_h
#define bindpose_embedding_material_probes_h

#include "embedding/lattice_cover.h"
#include "winding/winding_number.h"

#include <utility>
#include <vector>

namespace bindpose
{

/// Straight probes through the material (a surface and its inside). They find connections that the
/// lines between samples miss, for example in a thin slice of material in a few tets.
class MaterialProbes
{
public:
  using Id = LatticeCover::Id;

  /// Both arguments must outlive the probes.
  MaterialProbes(const LatticeCover& cover, const WindingNumber& winding, double threshold)
    : cover_(cover), winding_(winding), threshold_(threshold)
  {
  }

  struct Side
  {
    Id root; ///< identifies the side
    std::vector<Vec3> places; ///< positions in its material, in cubes
  };
  /// Append the pairs of roots of sides that a probe connects.
  /// @param triangles all triangles nearby; duplicates are allowed.
  /// Cost: up to 12 probes per pair of sides; each takes one winding number per piece into which
  /// triangles cut it.
  void connect(std::vector<Side> sides, std::vector<Id> triangles,
    std::vector<std::pair<Id, Id>>& joined) const;

private:
  /// Report whether the segment from a to b, which only these triangles can cross, stays in the
  /// material.
  bool stays_inside(const Vec3& a, const Vec3& b, const std::vector<Id>& triangles,
    std::vector<double>& cuts) const;
  /// Report whether one of the shortest segments between two sets of positions stays in the
  /// material.
  bool connects(const std::vector<Vec3>& from, const std::vector<Vec3>& to,
    const std::vector<Id>& triangles, std::vector<double>& cuts) const;

  const LatticeCover& cover_;
  const WindingNumber& winding_;
  double threshold_;
};

} // namespace bindpose

#endif

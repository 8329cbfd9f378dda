#ifndef bindpose_embedding_material_probes_h
#define bindpose_embedding_material_probes_h

#include "embedding/lattice_cover.h"
#include "winding/winding_number.h"

#include <utility>
#include <vector>

namespace bindpose
{

/// Straight segments (probes) through the material, which is a surface and its inside. They find
/// connections that the lines between samples miss, for example in a thin slice of material in a
/// few tets.
class MaterialProbes
{
public:
  using Id = LatticeCover::Id;

  /// Both arguments must outlive the probes.
  MaterialProbes(const LatticeCover& cover, const WindingNumber& winding, double threshold)
    : cover_(cover), winding_(winding), threshold_(threshold)
  {
  }

  /// A position at which probes may end.
  struct End
  {
    Vec3 position; ///< unit: edge length of a cube
    /// Unit normal of the triangle that contains the position; zero if the position is a sample of
    /// the inside, or if the triangle has no area.
    Vec3 normal;
  };
  /// The atoms of one copy of a lattice node. The embedding makes a copy of a node for each
  /// connected part of the material around the node.
  struct Side
  {
    Id root; ///< identifies this copy of the node (root of its union-find class)
    std::vector<End> ends; ///< one end per atom
  };
  /// Find the copies of one node that probes connect. For each connection, append the roots of the
  /// two copies to `joined`.
  /// @param sides all copies of the node.
  /// @param triangles all triangles in the tets around the node; duplicates are allowed.
  /// Cost: up to 12 probes per pair of copies, or 24 if the probes are in the plane of a triangle.
  /// Most probes fail after one winding number. A probe that is completely in the material takes at
  /// least one winding number per interval between triangles. It also takes at least 12 winding
  /// numbers per unit of length, where the unit is the edge of a cube.
  void connect(std::vector<Side> sides, std::vector<Id> triangles,
    std::vector<std::pair<Id, Id>>& joined) const;

private:
  /// Report whether the segment from a to b is completely in the material. `triangles` contains all
  /// triangles that can cross the segment.
  bool stays_inside(const Vec3& a, const Vec3& b, const std::vector<Id>& triangles,
    std::vector<double>& cuts) const;
  /// Report whether the segment between two ends is completely in the material. On a triangle, the
  /// winding number is the mean of the values on both sides, so rounding errors would decide the
  /// test. Therefore, if the segment lies in the plane of the triangle at an end, test two other
  /// segments instead: the same segment shifted by 1e-6 cube edges to either side of the plane.
  /// Report whether at least one of them is completely in the material.
  bool connects(const End& from, const End& to, const std::vector<Id>& triangles,
    std::vector<double>& cuts) const;
  /// Test the 12 shortest segments between two sets of ends. Report whether one of them is
  /// completely in the material.
  bool connects(const std::vector<End>& from, const std::vector<End>& to,
    const std::vector<Id>& triangles, std::vector<double>& cuts) const;

  const LatticeCover& cover_;
  const WindingNumber& winding_;
  double threshold_;
};

} // namespace bindpose

#endif

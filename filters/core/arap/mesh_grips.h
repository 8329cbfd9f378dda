#ifndef bindpose_arap_mesh_grips_h
#define bindpose_arap_mesh_grips_h

#include "arap/constrained_stiffness.h"
#include "handles/handles.h"
#include "pose/pose.h"

namespace bindpose
{

/// The points of a mesh that its handles constrain, and their target positions in a pose.
/// Constraints at vertices are called "prescribed", constraints at other points of the mesh
/// "constrained". Used by deformations in which every vertex is an unknown.
///
/// Constraints by the mode of a handle:
/// - `full`: the transform moves the handle's vertices: the vertex at the position of a point or
///   cage vertex, the vertices along a bone, or the vertices with the label of a region.
/// - `position`: the pivot is constrained to its transformed position. The pivot of a region is the
///   mean of its vertices.
/// - `tail`: the tail of a bone is constrained to its transformed position.
/// - `ends`: both ends of a bone are constrained to their transformed positions.
/// - `free`: no constraint.
///
/// If there is no vertex at the position of a handle, but an element contains this position, the
/// point inside the element is constrained exactly. If the handle is not on the mesh, the nearest
/// point of the mesh is constrained. A vertex that several handles in mode `full` constrain moves
/// to the mean of their targets.
class MeshGrips
{
public:
  using Rows = ConstrainedStiffness::Rows;

  /// One point that a handle constrains in the chosen modes.
  struct Constraint
  {
    Index handle;
    MeshPoint point;
    Index prescribed = -1; ///< index in prescribed(), or -1
    Index constrained = -1; ///< index in constrained(), or -1
    bool tail = false; ///< whether the point is the tail of a bone in mode tail or ends
  };

  /// Find the points of the mesh at each handle.
  /// @param elements elements that have an energy.
  /// @param parts connected parts of the elements.
  /// @return ok, with a warning that contains the names of handles that are not on the mesh;
  /// invalid_input if a region has no label or no vertices.
  Status find(PointsView points, TrianglesView elements, const Components& parts,
    const Handles& handles, const std::vector<Index>& region_ids);
  Status find(PointsView points, TetsView elements, const Components& parts, const Handles& handles,
    const std::vector<Index>& region_ids);

  /// Select the constraints that the modes of a pose require.
  /// @param fixed_vertices additional constrained vertices. They stay at rest unless a handle
  /// constrains them.
  void choose(const Pose& pose, const std::vector<Index>& fixed_vertices = {});

  /// prescribed() returns the ids of constrained vertices, ascending. constrained() returns the
  /// constrained points that are not vertices.
  const std::vector<Index>& prescribed() const { return this->prescribed_; }
  const std::vector<MeshPoint>& constrained() const { return this->constrained_; }
  const std::vector<Constraint>& constraints() const { return this->constraints_; }

  /// Compute the target displacements for a pose with the chosen modes, one row per entry of
  /// prescribed() and constrained().
  void targets(const Pose& pose, Rows& prescribed, Rows& constrained) const;
  /// Return a list with one warning that names the redundant position handles. Return an empty list
  /// if no position handle is redundant.
  /// @param points the redundant points that ConstrainedStiffness found, as indices in
  /// constrained().
  std::vector<std::string> redundancy(const Pose& pose, const std::vector<Index>& points) const;
  /// Return the largest violation of a constraint by the displacements (#V x 3), in bounding-box
  /// diagonals. If handles contradict each other, append a warning.
  double residual(
    const Pose& pose, const Rows& displacements, std::vector<std::string>& warnings) const;

  /// Return the diagonal of the bounding box of the vertices that elements use.
  double diagonal() const { return this->diagonal_; }

private:
  struct Grip
  {
    std::vector<MeshPoint> points; ///< mesh points that are constrained in mode `full`
    MeshPoint pivot; ///< pivot, which is constrained in the modes `position` and `ends`
    MeshPoint tail; ///< tail of a bone, which is constrained in the modes `tail` and `ends`
  };
  template <typename Elements>
  Status find_any(PointsView points, const Elements& elements, const Components& parts,
    const Handles& handles, const std::vector<Index>& region_ids);
  Vec3 rest_position(const MeshPoint& point) const;
  Vec3 target_displacement(const Constraint& constraint, const HandlePose& pose) const;

  Handles handles_;
  Points rest_;
  double diagonal_ = 0.0;
  std::vector<Grip> grips_;
  std::vector<Constraint> constraints_;
  std::vector<Index> prescribed_;
  std::vector<MeshPoint> constrained_;
  std::vector<Index> handle_of_constrained_; ///< per entry of constrained(): index of its handle
  /// Indices of the position handles that are redundant because another handle constrains their
  /// vertex.
  std::vector<Index> redundant_handles_;
};

} // namespace bindpose

#endif

#ifndef bindpose_pose_mesh_grips_h
#define bindpose_pose_mesh_grips_h

#include "pose/constrained_stiffness.h"
#include "pose/pose.h"
#include "weights/handles.h"

namespace bindpose
{

/// What of a mesh its handles hold, and where a pose wants it. For deformations in which every
/// vertex is an unknown.
///
/// A handle in mode `full` takes its vertices with it: a point or cage vertex the vertex at its
/// place, a bone those along it, a region those of its label. In mode `position` its pivot goes
/// where the transform takes it (of a region the middle of its vertices), in mode `free` nothing is
/// asked; in the modes of bones' ends these are held as pivots are. Where no vertex is, the point
/// of the element there is held, exactly; beside the mesh, the mesh's nearest point. A vertex of
/// several full handles goes to the mean of where they want it.
class MeshGrips
{
public:
  using Rows = ConstrainedStiffness::Rows;

  /// One point that a handle holds in the modes chosen.
  struct Hold
  {
    Index handle;
    MeshPoint point;
    Index given = -1; ///< place among the given vertices, else
    Index held = -1; ///< among the held points
    bool tail = false; ///< of a bone, in the modes of ends
  };

  /// @param elements those that count; parts: their connected parts.
  /// A warning names handles beside the mesh. invalid_input for a region without label or vertices.
  Status find(PointsView points, TrianglesView elements, const Components& parts,
    const Handles& handles, const std::vector<Index>& region_ids);
  Status find(PointsView points, TetsView elements, const Components& parts, const Handles& handles,
    const std::vector<Index>& region_ids);

  /// Takes a pose's modes.
  /// @param staying vertices that are given as well, at rest unless a handle holds them.
  void choose(const Pose& pose, const std::vector<Index>& staying = {});

  /// Vertices, ascending, and points that are none, whose displacements are given.
  const std::vector<Index>& given() const { return this->given_; }
  const std::vector<MeshPoint>& held() const { return this->held_; }
  const std::vector<Hold>& holds() const { return this->holds_; }

  /// The displacements that a pose of these modes wants: rows of given() and of held().
  void targets(const Pose& pose, Rows& given, Rows& held) const;
  /// A warning about position handles that others determine, or none.
  /// @param points of held(), as ConstrainedStiffness found them.
  std::vector<std::string> redundancy(const Pose& pose, const std::vector<Index>& points) const;
  /// How far displacements (#V x 3) miss a pose, in diagonals, at most; handles that contradict
  /// each other get a warning.
  double residual(
    const Pose& pose, const Rows& displacements, std::vector<std::string>& warnings) const;

  /// Of the box of the vertices that elements use.
  double diagonal() const { return this->diagonal_; }

private:
  struct Grip
  {
    std::vector<MeshPoint> points; ///< in mode full
    MeshPoint pivot; ///< in modes position and ends
    MeshPoint tail; ///< bones: in modes tail and ends
  };
  template <typename Elements>
  Status find_any(PointsView points, const Elements& elements, const Components& parts,
    const Handles& handles, const std::vector<Index>& region_ids);
  Vec3 at_rest(const MeshPoint& point) const;
  Vec3 wanted(const Hold& hold, const HandlePose& pose) const;

  Handles handles_;
  Points rest_;
  double diagonal_ = 0.0;
  std::vector<Grip> grips_;
  std::vector<Hold> holds_;
  std::vector<Index> given_;
  std::vector<MeshPoint> held_;
  std::vector<Index> holder_; ///< handle of each held point
  std::vector<Index> doubled_; ///< position handles at a vertex that another one holds
};

} // namespace bindpose

#endif

#ifndef bindpose_pose_full_arap_h
#define bindpose_pose_full_arap_h

#include "base/execution.h"
#include "pose/arap_energy.h"
#include "pose/constrained_stiffness.h"
#include "pose/mesh_grips.h"

namespace bindpose
{

struct FullArapOptions
{
  ArapEnergy energy = ArapEnergy::automatic;
  /// #V labels of the vertices (Handle::region_id; 0: none). Needed when a handle is a region.
  std::vector<Index> region_ids;
};

/// As-rigid-as-possible deformation of every vertex: no weights, no reduction. Sorkine and Alexa
/// 2007, As-rigid-as-possible surface modeling; Liu et al. 2008; Chao et al. 2010.
///
///     FullArap arap;
///     arap.bind(context, points, tets, handles, options);  // once
///     arap.solve(context, pose);                           // a factorisation when modes change
///     arap.posed();
///
/// The energy is ReducedArap's, 1/2 sum_k sum c |e' - R_k e|^2, with a rotation for every vertex
/// (spokes, spokes and rims) or element. A solve alternates between the best rotations (local step)
/// and the best positions (global step, one sparse solve); neither can raise the energy. Between
/// them Anderson acceleration extrapolates from the last iterates; where that would raise the
/// energy, the plain iterate is taken (Peng et al. 2018, Anderson acceleration for geometry
/// optimization and physics simulation).
///
/// A handle in mode `full` takes its vertices with it: a point or cage vertex the vertex at its
/// place, a bone those along it, a region those of its label. In mode `position` its pivot goes
/// where the transform takes it (of a region the middle of its vertices), in mode `free` nothing is
/// asked. Where no vertex is, the point of the element there is held, exactly; beside the mesh, the
/// mesh's nearest point. A vertex of several full handles goes to the mean of where they want it.
///
/// Unknowns are displacements from rest, so that rest is exact. A connected part that no handle
/// holds stays where it is, vertices that nothing uses as well; those in elements without area
/// only move as a neighbour does.
///
/// Cost: bind O(#V); a solve after a change of modes one sparse factorisation, and 8 bytes a vertex
/// for each point held that is no vertex; an iteration a solve with the factor for three right
/// sides and a rotation fit for each vertex or element. The same bits for any number of threads.
class FullArap
{
public:
  /// Report: counts.vertices, counts.triangles or counts.tets, counts.handles, counts.rotations,
  /// method (the energy). Warnings: handles beside the mesh, elements too thin to count, edges that
  /// spokes leave out, parts without a handle. invalid_input for numbers that are not finite, no
  /// element with an area, a region without label or vertices.
  Status bind(ExecutionContext& context, PointsView points, TrianglesView triangles,
    const Handles& handles, const FullArapOptions& options = {});
  Status bind(ExecutionContext& context, PointsView points, TetsView tets, const Handles& handles,
    const FullArapOptions& options = {});

  /// The rotations that a solve begins with.
  enum class Start
  {
    last, ///< those of the last solve (a guess in the first): few iterations, twists add up
    guess, ///< those of full handles, spread over the mesh by a Laplace equation: depends on the
           ///< pose only
    rest ///< none
  };
  struct SolveOptions
  {
    /// Ends when an iteration lowers the energy by no more than this share of it (or of 1e-6 of
    /// the rest energy, a strain of a few 1e-6). 0: runs all iterations, cannot fail to converge.
    double tolerance = 1e-6;
    Index max_iterations = 500;
    Start start = Start::last;
    /// Iterates that acceleration looks back on; 0: none.
    Index anderson_window = 5;
  };

  /// Finds the vertices of a pose, one entry a handle. not_converged when max_iterations were not
  /// enough, or when an iteration raised the energy by more than the tolerance (what holds the
  /// handles nearly depends on each other; the points before it are kept, a warning says so); the
  /// result is usable. Report: energy, iterations, microseconds_per_iteration,
  /// constraint_residual (largest miss of what handles hold, in diagonals), counts.constrained
  /// (vertices and points held). Warnings name position handles that are redundant and handles that
  /// contradict each other.
  Status solve(ExecutionContext& context, const Pose& pose, const SolveOptions& options);
  Status solve(ExecutionContext& context, const Pose& pose)
  {
    return this->solve(context, pose, SolveOptions());
  }

  /// The next solve starts from a guess.
  void forget() { this->warm_ = false; }

  /// The vertices in the last solved pose.
  const Points& posed() const { return this->posed_; }
  /// Rotations of the last solve, one a group.
  std::vector<Eigen::Matrix3d> rotations() const;
  const RotationGroups& groups() const { return this->groups_; }
  /// Energy after each half-step of the last solve: start, local, global, local, global, …
  const std::vector<double>& energies() const { return this->energies_; }
  /// 1/2 tr(V^T L V): the unit of round-off in an energy.
  double rest_energy() const { return this->rest_energy_; }
  /// How often a system was factored: once for each choice of modes.
  Index factorisations() const { return this->factorisations_; }

private:
  using Rows = ConstrainedStiffness::Rows;

  /// Sums b d^T over (item, b): what vertices give to a group's covariance, and what groups give to
  /// a vertex' force.
  struct Terms
  {
    std::vector<Index> begin; ///< offsets
    std::vector<int> item;
    std::vector<double> b; ///< three a term
  };

  template <typename Elements>
  Status bind_any(ExecutionContext& context, PointsView points, const Elements& elements,
    const Handles& handles, const FullArapOptions& options);
  void take_covariance(const SparseMatrix& covariance);
  Status prepare(const Pose& pose);
  void start_rotations(const Pose& pose);
  bool local_step(ExecutionContext& context, const Rows& d);
  bool global_step(ExecutionContext& context, Rows& d);
  double quadratic(ExecutionContext& context, const Rows& d) const;

  // ---- bind time
  Handles handles_;
  Points rest_;
  RotationGroups groups_;
  std::vector<std::array<int, 4>> group_vertices_; ///< whose mean guess a group starts with
  SparseMatrix stiffness_;
  Terms of_group_, of_vertex_;
  Components parts_; ///< by elements that count
  std::vector<Index> leader_; ///< #V: whom a vertex of flat elements follows, or -1
  MeshGrips grips_;
  double radius_ = 0.0; ///< root mean square distance of the vertices from their middle
  double rest_energy_ = 0.0;

  // ---- per choice of modes
  std::vector<HandleMode> modes_;
  ConstrainedStiffness system_;
  Index factorisations_ = 0;

  // ---- per pose
  Rows given_, held_; ///< displacements wanted

  // ---- state; planes (3 i + j) * stride_ + k hold entry (i, j) of matrix k
  Index stride_ = 0;
  std::vector<double> rest_covariance_, covariance_, rotations_;
  std::vector<double> turn_; ///< R - I, nine a group, row by row
  Rows force_; ///< sums of turns, of the last global step
  double turned_ = 0.0; ///< <R - I, S> of the last local step
  double rest_turned_ = 0.0; ///< <R - I, S at rest>
  bool warm_ = false;
  Points posed_;
  std::vector<double> energies_;
};

} // namespace bindpose

#endif

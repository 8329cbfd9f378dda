#ifndef bindpose_arap_full_arap_h
#define bindpose_arap_full_arap_h

#include "arap/arap_energy.h"
#include "arap/constrained_stiffness.h"
#include "arap/mesh_grips.h"
#include "base/execution.h"

namespace bindpose
{

/// Options of FullArap::bind().
struct FullArapOptions
{
  ArapEnergy energy = ArapEnergy::automatic;
  /// #V labels of the vertices (Handle::region_id; 0: none). Required if a handle is a region.
  std::vector<Index> region_ids;
};

/// As-rigid-as-possible deformation in which every vertex is an unknown, without weights. Methods:
/// Sorkine and Alexa 2007, As-rigid-as-possible surface modeling; Liu et al. 2008; Chao et al.
/// 2010.
///
///     FullArap arap;
///     arap.bind(context, points, tets, handles, options);  // once
///     arap.solve(context, pose);                           // a factorization if modes change
///     arap.posed();
///
/// The energy is that of ReducedArap, 1/2 sum_k sum c |e' - R_k e|^2, with one rotation for every
/// vertex (energies `spokes` and `spokes_and_rims`) or every element (energy `elements`). A solve
/// alternates between the best rotations (local step) and the best positions (global step, one
/// sparse solve). Neither step can raise the energy. Between the steps, Anderson acceleration
/// extrapolates from the last iterates. If the extrapolated iterate would raise the energy, the
/// plain iterate is used (Peng et al. 2018, Anderson acceleration for geometry optimization and
/// physics simulation).
///
/// Constraints by the mode of a handle:
/// - `full`: the transform moves the handle's vertices: the vertex at the position of a point or
///   cage vertex, the vertices along a bone, or the vertices with the label of a region.
/// - `position`: the pivot is constrained to its transformed position. The pivot of a region is the
///   mean of its vertices.
/// - `free`: no constraint.
///
/// If there is no vertex at the position of a handle, but an element contains this position, the
/// point inside the element is constrained exactly. If the handle is not on the mesh, the nearest
/// point of the mesh is constrained. A vertex that several handles in mode `full` constrain moves
/// to the mean of their targets.
///
/// The unknowns are displacements from rest, so the rest pose is reproduced exactly. A connected
/// part without constraints does not move, and neither do unused vertices. A vertex whose elements
/// all have no area moves with a neighboring vertex.
///
/// Cost: bind O(#V). A solve after a change of modes needs one sparse factorization, and 8 bytes
/// per vertex for each constrained point that is not a vertex. An iteration needs one solve with
/// the factor for three right-hand sides and one rotation fit per vertex or element. The result has
/// the same bits for any number of threads.
class FullArap
{
public:
  /// Bind a mesh and its handles. The report contains counts.vertices, counts.triangles or
  /// counts.tets, counts.handles, counts.rotations and method (the energy). Warnings report handles
  /// that are not on the mesh, elements that are too thin to have an energy, edges that the energy
  /// `spokes` omits, and parts without a handle. Return invalid_input if a value is not finite, no
  /// element has an area, or a region has no label or no vertices.
  Status bind(ExecutionContext& context, PointsView points, TrianglesView triangles,
    const Handles& handles, const FullArapOptions& options = {});
  Status bind(ExecutionContext& context, PointsView points, TetsView tets, const Handles& handles,
    const FullArapOptions& options = {});

  /// Initial rotations of a solve.
  enum class Start
  {
    /// Rotations of the last solve (`guess` in the first solve). Few iterations are needed, and
    /// twists of more than half a turn can accumulate.
    last,
    /// Linear parts of the transforms of handles in mode full, extended over the mesh by Laplace's
    /// equation and projected to rotations. These initial rotations depend only on the pose.
    guess,
    rest ///< identity matrices
  };
  struct SolveOptions
  {
    /// The solve ends if an iteration lowers the energy by at most this fraction of the energy.
    /// If the energy is below 1e-6 * rest_energy() (a strain of about 1e-3), this bound replaces
    /// the energy in the test. If the tolerance is 0, there is no test, and the solve cannot return
    /// not_converged.
    double tolerance = 1e-6;
    Index max_iterations = 500;
    Start start = Start::last;
    /// Number of previous iterates that Anderson acceleration combines; 0: no acceleration.
    Index anderson_window = 5;
  };

  /// Compute the vertices for a pose, which has one entry per handle. Return not_converged if
  /// max_iterations were not enough, or if an iteration raised the energy by more than the
  /// tolerance. Round-off can raise the energy if the handles' constraints are nearly dependent. If
  /// the energy rises, the points of the previous iteration are kept and a warning is added. After
  /// not_converged the vertices are usable. The report contains energy, iterations,
  /// microseconds_per_iteration, constraint_residual (largest violation of a constraint, in
  /// bounding-box diagonals) and counts.constrained (number of constrained vertices and points).
  /// Warnings contain the names of redundant position handles and of contradictory handles.
  Status solve(ExecutionContext& context, const Pose& pose, const SolveOptions& options);
  Status solve(ExecutionContext& context, const Pose& pose)
  {
    return this->solve(context, pose, SolveOptions());
  }

  /// Discard the last rotations, so that the next solve starts with `guess`.
  void discard_rotations() { this->has_rotations_ = false; }

  /// The vertices in the last solved pose.
  const Points& posed() const { return this->posed_; }
  /// Rotations of the last solve, one per group.
  std::vector<Eigen::Matrix3d> rotations() const;
  const RotationGroups& groups() const { return this->groups_; }
  /// Energy after each local and global step of the last solve: start, local, global, local,
  /// global, … For a mesh with extreme coordinates, energies are computed in the coordinates of its
  /// WorkingFrame.
  const std::vector<double>& energies() const { return this->energies_; }
  /// Quadratic form 1/2 tr(V^T L V) of the rest positions V. The round-off of energies is
  /// proportional to this value.
  double rest_energy() const { return this->rest_energy_; }
  /// Number of factorizations: one for each choice of modes.
  Index factorizations() const { return this->factorizations_; }

private:
  using Rows = ConstrainedStiffness::Rows;

  /// A sparse matrix whose entries are vectors b with three coordinates. One matrix maps vertices
  /// to the covariance of a group, another maps groups to the force on a vertex.
  struct Terms
  {
    std::vector<Index> begin; ///< index of each row's first entry
    std::vector<int> item;
    std::vector<double> b; ///< the vector b of each entry, three coordinates
  };

  Status solve_in_frame(ExecutionContext& context, const Pose& pose, const SolveOptions& options);
  template <typename Elements>
  Status bind_elements(ExecutionContext& context, PointsView points, const Elements& elements,
    const Handles& handles, const FullArapOptions& options);
  void set_covariance(const SparseMatrix& covariance);
  Status prepare(const Pose& pose);
  void start_rotations(const Pose& pose);
  bool local_step(ExecutionContext& context, const Rows& d);
  bool global_step(ExecutionContext& context, Rows& d);
  double quadratic(ExecutionContext& context, const Rows& d) const;

  // ---- bind time
  WorkingFrame frame_; ///< all other data is in this frame, except posed_ after a solve
  Handles handles_;
  Points rest_;
  RotationGroups groups_;
  /// Per group: ids of its vertices, padded with -1. The initial rotation of a group is the
  /// rotation nearest to the mean of the initial matrices at these vertices.
  std::vector<std::array<int, 4>> group_vertices_;
  SparseMatrix stiffness_;
  Terms group_terms_, vertex_terms_;
  Components parts_; ///< connected parts; elements without energy connect no vertices
  /// #V: for a vertex that only flat elements use, the neighbor that it moves with; else -1.
  std::vector<Index> leader_;
  MeshGrips grips_;
  double radius_ = 0.0; ///< root mean square distance of the vertices from their centroid
  double rest_energy_ = 0.0;

  // ---- per choice of modes
  std::vector<HandleMode> modes_;
  ConstrainedStiffness system_;
  Index factorizations_ = 0;

  // ---- per pose
  /// Target displacements of constrained vertices (prescribed_) and of constrained points that are
  /// not vertices (constrained_).
  Rows prescribed_, constrained_;

  // ---- state; entry (i, j) of matrix k is at (3 i + j) * stride_ + k
  Index stride_ = 0;
  std::vector<double> rest_covariance_, covariance_, rotations_;
  std::vector<double> rotation_deltas_; ///< R - I, nine per group, row by row
  Rows force_; ///< K^T Q of the last global step, #V x 3
  double rotation_term_ = 0.0; ///< sum over groups of <R - I, S> with the posed covariances S
  double rest_rotation_term_ = 0.0; ///< sum over groups of <R - I, S> with the rest covariances S
  bool has_rotations_ = false;
  Points posed_;
  std::vector<double> energies_;
};

} // namespace bindpose

#endif

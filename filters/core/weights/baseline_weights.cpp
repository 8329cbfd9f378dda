// The methods of baseline_weights.h. Distances are straight-line distances from vertices to the
// geometry of the handles: points, segments of bones, labeled vertices of regions. The unknowns are
// the weights of the vertices that are not fixed. K is the cotangent stiffness and M the mass
// matrix of the mesh scaled to diagonal 1, so that the results do not depend on units.
//
// Smoothed harmonic weights solve (M + length^4 Q) w = M h. Here h are the harmonic weights (K h =
// 0), and Q = K M^-1 K is the biharmonic form. For length 0, w is h. For a large length, w
// approaches the biharmonic weights.
//
// Bone heat weights solve (K + M H) w_j = M H p_j. A handle is visible from a vertex if nothing
// blocks the straight line between them. If the nearest handle j is visible at the distance d, then
// H = heat / d^2 and p_j = 1. If n visible handles are equally near, p_j = 1 / n for each of them.
// All other p_j are 0. If no nearest handle is visible, H = 0.
#include "weights/baseline_weights.h"

#include "base/parallel.h"
#include "geometry/simplex_locator.h"
#include "qp/free_system.h"
#include "surface/triangle_predicates.h"
#include "surface/triangle_tree.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

namespace bindpose
{

namespace
{
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Compute the nearest points on the handles and the distances to them.
class HandleDistances
{
public:
  explicit HandleDistances(const WeightsProblem& problem) : problem_(problem)
  {
    const HandleConstraints& constraints = problem.constraints;
    this->region_points_.resize(problem.handles.size());
    this->region_triangles_.resize(problem.handles.size());
    this->regions_.resize(problem.handles.size());
    for (std::size_t j = 0; j < problem.handles.size(); ++j)
    {
      if (problem.handles[j].kind != HandleKind::region)
      {
        continue;
      }
      // SimplexLocator needs triangles, so each vertex of the region becomes a degenerate triangle.
      std::vector<Index> members;
      for (std::size_t i = 0; i < constraints.vertices.size(); ++i)
      {
        if (constraints.values(static_cast<Index>(i), static_cast<Index>(j)) > 0.0)
        {
          members.push_back(constraints.vertices[i]);
        }
      }
      Points& points = this->region_points_[j];
      Triangles& triangles = this->region_triangles_[j];
      points.resize(static_cast<Index>(members.size()), 3);
      triangles.resize(points.rows(), 3);
      for (Index i = 0; i < points.rows(); ++i)
      {
        points.row(i) = problem.mesh.domain.points.row(members[i]);
        triangles.row(i).setConstant(i);
      }
      this->regions_[j] = std::make_unique<SimplexLocator>(points, triangles);
    }
  }

  /// Return the distance of handle j from p; infinite for a handle without vertices. Thread-safe.
  double from(Index j, const Vec3& p) const
  {
    return this->problem_.constraints.counts[j] == 0
      ? std::numeric_limits<double>::infinity()
      : (this->nearest(static_cast<std::size_t>(j), p) - p).norm();
  }

  /// Return the point of handle j nearest to p. Thread-safe.
  Vec3 nearest(std::size_t j, const Vec3& p) const
  {
    const Handle& handle = this->problem_.handles[j];
    if (handle.kind == HandleKind::region)
    {
      const SimplexLocation location = this->regions_[j]->locate(p);
      return location.element < 0 ? handle.head
                                  : Vec3(this->region_points_[j].row(location.element));
    }
    return closest_point(p, handle.head, handle.tail, handle.tail);
  }

private:
  const WeightsProblem& problem_;
  std::vector<Points> region_points_;
  std::vector<Triangles> region_triangles_;
  std::vector<std::unique_ptr<SimplexLocator>> regions_;
};

bool solved(const WeightsProblem& problem, Index v)
{
  return problem.constraints.roles[v] == VertexRole::solved;
}

MatrixXd with_fixed_rows(const WeightsProblem& problem)
{
  MatrixXd w = MatrixXd::Zero(problem.vertex_count(), problem.handle_count());
  for (std::size_t i = 0; i < problem.fixed.size(); ++i)
  {
    w.row(problem.fixed[i]) = problem.fixed_values.row(static_cast<Index>(i));
  }
  return w;
}

Status inverse_distances(
  ExecutionContext& context, const WeightsProblem& problem, double power, MatrixXd& w)
{
  const HandleDistances distances(problem);
  const Index m = problem.handle_count();
  const bool completed = parallel_for(context, problem.vertex_count(), 256,
    [&](Index begin, Index end)
    {
      VectorXd d(m);
      for (Index v = begin; v < end; ++v)
      {
        if (!solved(problem, v))
        {
          continue;
        }
        const Vec3 p = problem.mesh.domain.points.row(v);
        for (Index j = 0; j < m; ++j)
        {
          d[j] = distances.from(j, p);
        }
        // Divide all distances by the smallest distance, so that the powers do not overflow.
        const double smallest_distance = d.minCoeff();
        for (Index j = 0; j < m; ++j)
        {
          w(v, j) = smallest_distance > 0.0 ? std::pow(smallest_distance / d[j], power)
                                            : double(d[j] == 0.0);
        }
        w.row(v) /= w.row(v).sum();
      }
    });
  return completed ? Status() : Status::canceled();
}

SparseMatrix with_diagonal(const SparseMatrix& matrix, double factor, const VectorXd& diagonal)
{
  SparseMatrix sum = factor * matrix;
  SparseMatrix d(matrix.rows(), matrix.cols());
  d.reserve(Eigen::VectorXi::Constant(matrix.cols(), 1));
  for (int v = 0; v < matrix.cols(); ++v)
  {
    d.insert(v, v) = diagonal[v];
  }
  return SparseMatrix(sum + d);
}

Status smoothed_harmonic(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, MatrixXd& w, VectorXd& residuals)
{
  const MatrixXd zero = MatrixXd::Zero(w.rows(), w.cols());
  FreeSystem harmonic(problem.stiffness, problem.fixed);
  Status status = harmonic.factor(context, options.solver);
  if (!status.ok())
  {
    return status;
  }
  residuals = harmonic.solve(zero, w);
  if (options.smoothing == 0.0)
  {
    return {};
  }
  const VectorXd mass = problem.mass_unit * problem.mass;
  const SparseMatrix matrix = with_diagonal(
    harmonic_energy(problem.stiffness, mass, 2), std::pow(options.smoothing, 4.0), mass);
  FreeSystem system(matrix, problem.fixed);
  status = system.factor(context, options.solver);
  if (!status.ok())
  {
    return status;
  }
  const MatrixXd rhs = mass.asDiagonal() * w;
  residuals = residuals.cwiseMax(system.solve(rhs, w));
  return {};
}

/// Triangles that can block the line of sight from a vertex to a handle: the boundary of a volume,
/// or a surface itself. For a flat shape, the triangles are perpendicular to the shape and contain
/// the edges of its outline.
struct Occluders
{
  Points points;
  Triangles triangles;
  /// For each triangle, the ids of the domain vertices on it. The triangle does not block the view
  /// from these vertices.
  std::vector<std::array<Index, 3>> vertices;
};

Occluders make_occluders(const WeightsProblem& problem)
{
  const Domain& domain = problem.mesh.domain;
  Occluders occluders;
  Vec3 normal;
  if (domain.is_volume() || !is_flat(domain.points, problem.diagonal, normal))
  {
    occluders.points = domain.points;
    occluders.triangles = domain.is_volume() ? boundary_triangles(domain.tets) : domain.triangles;
    for (Index f = 0; f < occluders.triangles.rows(); ++f)
    {
      occluders.vertices.push_back(
        { occluders.triangles(f, 0), occluders.triangles(f, 1), occluders.triangles(f, 2) });
    }
    return occluders;
  }
  const Index n = domain.points.rows();
  const Vec3 up = problem.diagonal * normal;
  occluders.points.resize(2 * n, 3);
  occluders.points << domain.points.rowwise() - up.transpose(),
    domain.points.rowwise() + up.transpose();
  std::vector<std::array<Index, 3>> triangles;
  for (const Edge& edge : mesh_edges(domain.triangles))
  {
    if (edge.triangle_count == 1)
    {
      triangles.push_back({ edge.a, edge.b, n + edge.b });
      triangles.push_back({ edge.a, n + edge.b, n + edge.a });
      occluders.vertices.insert(occluders.vertices.end(), 2, { edge.a, edge.b, edge.b });
    }
  }
  occluders.triangles.resize(static_cast<Index>(triangles.size()), 3);
  for (Index f = 0; f < occluders.triangles.rows(); ++f)
  {
    occluders.triangles.row(f) << triangles[f][0], triangles[f][1], triangles[f][2];
  }
  return occluders;
}

/// Compute H and p (see the top of this file) for every vertex. H is 0 if none of the nearest
/// handles is visible.
Status heat_sources(ExecutionContext& context, const WeightsProblem& problem, double heat,
  VectorXd& h, MatrixXd& p, Index& heated_count)
{
  const Occluders occluders = make_occluders(problem);
  const TriangleTree tree(occluders.points, occluders.triangles);
  const HandleDistances distances(problem);
  const Index m = problem.handle_count();
  h = VectorXd::Zero(problem.vertex_count());
  p = MatrixXd::Zero(problem.vertex_count(), m);
  const bool completed = parallel_for(context, problem.vertex_count(), 64,
    [&](Index begin, Index end)
    {
      VectorXd d(m);
      for (Index v = begin; v < end; ++v)
      {
        if (!solved(problem, v))
        {
          continue;
        }
        const Vec3 position = problem.mesh.domain.points.row(v);
        for (Index j = 0; j < m; ++j)
        {
          d[j] = distances.from(j, position);
        }
        constexpr double tie_factor = 1.0001;
        const double smallest_distance = std::max(d.minCoeff(), 1e-6 * problem.diagonal);
        for (Index j = 0; j < m; ++j)
        {
          if (d[j] > tie_factor * smallest_distance)
          {
            continue;
          }
          const Vec3 to = distances.nearest(static_cast<std::size_t>(j), position);
          // Shorten the line of sight at both ends, because an end on the surface would count as
          // blocked.
          constexpr double end_gap = 1e-3;
          const Vec3 from = position + end_gap * (to - position);
          const Vec3 segment_end = to + end_gap * (position - to);
          const bool hidden = tree.segment_meets(from, segment_end,
            [&](Index f)
            {
              const auto& occluder_vertices = occluders.vertices[f];
              return std::find(occluder_vertices.begin(), occluder_vertices.end(), v) ==
                occluder_vertices.end();
            });
          p(v, j) = hidden ? 0.0 : 1.0;
        }
        const double sum = p.row(v).sum();
        if (sum > 0.0)
        {
          p.row(v) /= sum;
          const double distance = smallest_distance / problem.diagonal;
          h[v] = heat / (distance * distance);
        }
      }
    });
  heated_count = (h.array() > 0.0).count();
  return completed ? Status() : Status::canceled();
}

Status bone_heat(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, MatrixXd& w, VectorXd& residuals, Index& heated_count)
{
  VectorXd h;
  MatrixXd p;
  Status status = heat_sources(context, problem, options.heat, h, p, heated_count);
  if (!status.ok())
  {
    return status;
  }
  const VectorXd sources = (problem.mass_unit * problem.mass).cwiseProduct(h);
  const SparseMatrix matrix = with_diagonal(problem.stiffness, 1.0, sources);
  const MatrixXd rhs = sources.asDiagonal() * p;
  FreeSystem system(matrix, problem.fixed);
  status = system.factor(context, options.solver);
  if (!status.ok())
  {
    return status;
  }
  residuals = system.solve(rhs, w);
  return {};
}

/// Check the options, and initialize the rows of the fixed vertices.
Status begin(
  const WeightsProblem& problem, const WeightsOptions& options, WeightsResult& result, MatrixXd& w)
{
  result = {};
  if (Status status = check_no_terms(problem); !status.ok())
  {
    return status;
  }
  const auto positive = [](double x) { return x > 0.0 && std::isfinite(x); };
  if (!positive(options.power) || !positive(options.heat))
  {
    return Status::invalid_input("power and heat must be positive");
  }
  if (!(options.smoothing >= 0.0 && std::isfinite(options.smoothing)))
  {
    return Status::invalid_input("smoothing must be at least 0");
  }
  w = with_fixed_rows(problem);
  return {};
}

Status finish(ExecutionContext& context, const WeightsProblem& problem, const char* method,
  const WeightsOptions& options, const MatrixXd& w, const VectorXd& residuals,
  WeightsResult& result)
{
  std::vector<BoxQpSolution> solutions(static_cast<std::size_t>(w.cols()));
  for (Index j = 0; j < w.cols(); ++j)
  {
    solutions[j].w = w.col(j);
    solutions[j].certificate.kkt_residual = residuals[j];
  }
  return finish_weights(context, problem, method, options.tolerance, solutions, w, result);
}
} // namespace

Status inverse_distance_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result)
{
  MatrixXd w;
  Status status = begin(problem, options, result, w);
  if (status.ok())
  {
    const Phase phase(context, "weights", 0.1, 0.95);
    status = inverse_distances(context, problem, options.power, w);
  }
  return status.ok() ? finish(context, problem, "inverse-distance", options, w,
                         VectorXd::Zero(problem.handle_count()), result)
                     : status;
}

Status smoothed_harmonic_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result)
{
  MatrixXd w;
  VectorXd residuals = VectorXd::Zero(problem.handle_count());
  Status status = begin(problem, options, result, w);
  if (status.ok())
  {
    const Phase phase(context, "weights", 0.1, 0.95);
    status = smoothed_harmonic(context, problem, options, w, residuals);
  }
  return status.ok() ? finish(context, problem, "smoothed-harmonic", options, w, residuals, result)
                     : status;
}

Status bone_heat_weights(ExecutionContext& context, const WeightsProblem& problem,
  const WeightsOptions& options, WeightsResult& result)
{
  MatrixXd w;
  VectorXd residuals = VectorXd::Zero(problem.handle_count());
  Index heated_count = -1;
  Status status = begin(problem, options, result, w);
  if (status.ok())
  {
    const Phase phase(context, "weights", 0.1, 0.95);
    status = bone_heat(context, problem, options, w, residuals, heated_count);
  }
  if (status.ok())
  {
    status = finish(context, problem, "bone-heat", options, w, residuals, result);
  }
  if (heated_count >= 0 && status.usable())
  {
    status.report.set("counts.heated_vertices", Report::Value(heated_count));
  }
  return status;
}

} // namespace bindpose

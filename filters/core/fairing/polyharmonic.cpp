// Polyharmonic equations on triangle meshes by mixed finite elements (Jacobson, Tosun, Sorkine,
// Zorin 2010).
//
// With v = -Laplacian u and w = -Laplacian v, the equations of order 3 contain only first
// derivatives, so piecewise linear elements are sufficient:
//
//     M v = K u - f,    M w = K v,    K_i w = M_i load  at free vertices i,
//
// where f is the flux through the boundary of the patch. For order 2, the last equation is K_i v =
// M_i load; for order 1 it is K_i u = M_i load.
//
// The mass M is lumped, so v and w can be eliminated: K M^-1 K M^-1 K u = M load + K M^-1 K M^-1 f.
// This condensed matrix is symmetric and positive definite and needs one Cholesky factorization.
// Let h be the edge length and k the order. The rounding errors of the condensed matrix grow as
// h^(-2 k). The rounding errors of the mixed system grow only as h^-2 per equation, but the mixed
// system is indefinite, three times as large, and needs an LU factorization with pivoting.
// Therefore the two systems are combined: the condensed matrix is factored, and a few steps of
// iterative refinement use the residual of the mixed equations. The result has the accuracy of the
// mixed system.
//
// The boundary conditions determine the triangles that are used and the vertices with an unknown v.
// - Region: u is given in a band of k one-ring layers; v is also unknown at the vertices of the
//   band that have all of their triangles in use.
// - Curve: v (and w) are defined only at free vertices and are zero at given vertices.
// - Tangent: only triangles of the patch are used, v is also defined on the edge of the patch, and
//   f is given.
#include "fairing/polyharmonic.h"

#include "geometry/side_flux.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace bindpose
{

namespace
{
/// A triangle counts as degenerate if one of its cotangents exceeds this value.
constexpr double maximum_cotangent = 1e7;
/// Maximum number of refinement steps. Refinement ends earlier if a correction is at most the
/// fraction `correction_tolerance` of the solution, or is not smaller than the previous correction.
/// Each step multiplies the error by about the relative size of the first correction.
constexpr int maximum_refinements = 8;
constexpr double correction_tolerance = 1e-9;
/// Number of power iterations for the estimate of the condition number.
constexpr int power_steps = 12;

/// Return the one-ring layer of each vertex, counted from the free vertices, up to `maximum_layer`;
/// -1: the vertex is farther away.
std::vector<int> layers_from_free(
  const Triangles& triangles, const std::vector<char>& is_free, int maximum_layer)
{
  std::vector<int> layer(is_free.size(), -1);
  for (std::size_t v = 0; v < is_free.size(); ++v)
  {
    layer[v] = is_free[v] ? 0 : -1;
  }
  for (int next = 1; next <= maximum_layer; ++next)
  {
    for (Index t = 0; t < triangles.rows(); ++t)
    {
      const auto vertex_layer = [&](int k) -> int& { return layer[triangles(t, k)]; };
      if (vertex_layer(0) == next - 1 || vertex_layer(1) == next - 1 || vertex_layer(2) == next - 1)
      {
        for (int k = 0; k < 3; ++k)
        {
          vertex_layer(k) = vertex_layer(k) < 0 ? next : vertex_layer(k);
        }
      }
    }
  }
  return layer;
}

double norm(const Polyharmonic::Rows& rows)
{
  return rows.size() > 0 ? rows.cwiseAbs().maxCoeff() : 0.0;
}
} // namespace

const char* to_string(PatchBoundary boundary)
{
  switch (boundary)
  {
    case PatchBoundary::region:
      return "region";
    case PatchBoundary::curve:
      return "curve";
    case PatchBoundary::tangent:
      return "tangent";
  }
  return "";
}

void Polyharmonic::bind(
  PointsView parameters, TrianglesView triangles, int order, PatchBoundary boundary)
{
  *this = Polyharmonic();
  this->parameters_ = parameters;
  this->triangles_ = triangles;
  this->order_ = order;
  this->boundary_ = boundary;
}

Status Polyharmonic::prepare(ExecutionContext& context, const Components& parts,
  const std::vector<Index>& prescribed, const std::vector<MeshPoint>& constrained)
{
  const Index n = this->parameters_.rows();
  this->prescribed_count_ = static_cast<Index>(prescribed.size());
  this->constrained_count_ = static_cast<Index>(constrained.size());
  this->is_free_.assign(static_cast<std::size_t>(n), 0);
  for (Index v = 0; v < n; ++v)
  {
    this->is_free_[v] = parts.component_of_vertex[v] >= 0;
  }
  for (const Index v : prescribed)
  {
    this->is_free_[v] = 0;
  }

  // Select the triangles that the boundary condition uses.
  const bool region = this->boundary_ == PatchBoundary::region;
  const std::vector<int> layer =
    layers_from_free(this->triangles_, this->is_free_, region ? this->order_ : 1);
  const int deepest = region ? this->order_ - 1 : 0;
  std::vector<char> in_patch(static_cast<std::size_t>(this->triangles_.rows()), 0);
  for (Index t = 0; t < this->triangles_.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int vertex_layer = layer[this->triangles_(t, k)];
      in_patch[t] = in_patch[t] || (vertex_layer >= 0 && vertex_layer <= deepest);
    }
  }
  // Add the ears of a patch, such as the triangles at the corners of a square. They have no free
  // vertex, but all their neighboring triangles belong to the patch.
  const std::vector<TriangleSide> sides = sides_by_edge(this->triangles_);
  if (this->boundary_ == PatchBoundary::tangent)
  {
    std::vector<int> inner(in_patch.size(), 0), outer(in_patch.size(), 0);
    for (std::size_t i = 0, j = 0; i < sides.size(); i = j)
    {
      j = end_of_edge(sides, i);
      for (std::size_t s = i; s < j; ++s)
      {
        for (std::size_t o = i; o < j; ++o)
        {
          if (o != s)
          {
            (in_patch[sides[o].triangle] ? inner : outer)[sides[s].triangle] += 1;
          }
        }
      }
    }
    for (std::size_t t = 0; t < in_patch.size(); ++t)
    {
      in_patch[t] = in_patch[t] || (inner[t] > 0 && outer[t] == 0);
    }
  }

  // Reject invalid patches, and collect the triangle sides along the patch's edge.
  std::vector<TriangleSide> patch_sides, opposite_sides;
  this->layers_ = this->order_;
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j)
  {
    j = end_of_edge(sides, i);
    std::vector<TriangleSide> in, out;
    for (std::size_t s = i; s < j; ++s)
    {
      (in_patch[sides[s].triangle] ? in : out).push_back(sides[s]);
    }
    if (!in.empty() && j - i > 2)
    {
      return Status::invalid_input("the patch must be a manifold surface, but the edge of points " +
        std::to_string(sides[i].a) + " and " + std::to_string(sides[i].b) + " has " +
        std::to_string(j - i) + " triangles");
    }
    if (j == i + 1)
    {
      for (const Index v : { sides[i].a, sides[i].b })
      {
        this->layers_ = layer[v] >= 0 ? std::min(this->layers_, layer[v]) : this->layers_;
      }
    }
    if (in.size() == 1)
    {
      patch_sides.push_back(in[0]);
      opposite_sides.insert(opposite_sides.end(), out.begin(), out.end());
    }
  }
  const auto cotangents = cotangent_weights(this->parameters_, this->triangles_);
  Index count = 0;
  Triangles patch(this->triangles_.rows(), 3);
  for (Index t = 0; t < this->triangles_.rows(); ++t)
  {
    if (!in_patch[t])
    {
      continue;
    }
    const double largest = cotangents.row(t).cwiseAbs().maxCoeff();
    if (!(largest > 0.0 && largest <= maximum_cotangent))
    {
      return Status::invalid_input("triangle " + std::to_string(t) +
        " of the patch must have an area in the parameter domain");
    }
    patch.row(count++) = this->triangles_.row(t);
  }
  patch.conservativeResize(count, Eigen::NoChange);
  if (context.canceled())
  {
    return Status::canceled();
  }

  this->stiffness_ = stiffness_matrix(this->parameters_, patch);
  this->mass_ = lumped_mass(this->parameters_, patch);
  this->unit_ =
    count > 0 ? this->mass_.sum() / static_cast<double>((this->mass_.array() > 0.0).count()) : 1.0;
  this->mass_ /= this->unit_;
  this->inverse_mass_ = Eigen::VectorXd::Zero(n);
  for (Index v = 0; v < n; ++v)
  {
    const bool alive = this->is_free_[v] || this->boundary_ != PatchBoundary::curve;
    this->inverse_mass_[v] = alive && this->mass_[v] > 0.0 ? 1.0 / this->mass_[v] : 0.0;
  }
  this->matrix_ = this->stiffness_;
  for (int k = 1; k < this->order_; ++k)
  {
    this->matrix_ =
      SparseMatrix(this->stiffness_ * this->inverse_mass_.asDiagonal() * this->matrix_).eval();
  }
  this->matrix_ = SparseMatrix(0.5 * (this->matrix_ + SparseMatrix(this->matrix_.transpose())));

  if (this->boundary_ == PatchBoundary::tangent)
  {
    this->inside_flux_ = side_flux(this->parameters_, this->triangles_, patch_sides);
    this->outside_flux_ = -side_flux(this->parameters_, this->triangles_, opposite_sides);
    std::vector<Eigen::Triplet<double, int>> entries;
    for (const TriangleSide& side : patch_sides)
    {
      const double sixth =
        (this->parameters_.row(side.a) - this->parameters_.row(side.b)).norm() / 6.0;
      const int a = static_cast<int>(side.a), b = static_cast<int>(side.b);
      entries.emplace_back(a, a, 2.0 * sixth);
      entries.emplace_back(b, b, 2.0 * sixth);
      entries.emplace_back(a, b, sixth);
      entries.emplace_back(b, a, sixth);
    }
    this->edge_mass_.resize(n, n);
    this->edge_mass_.setFromTriplets(entries.begin(), entries.end());
  }
  if (context.canceled())
  {
    return Status::canceled();
  }
  Status status = this->system_.prepare(
    this->matrix_, parts.component_of_vertex, parts.count, prescribed, constrained);
  if (!status.ok())
  {
    return Status::failure(StatusCode::unavailable,
      "order " + std::to_string(this->order_) +
        " is too ill-conditioned on this patch for double precision; use a lower order, or a "
        "coarser or more uniform mesh");
  }
  status.report.set(
    "counts.free", std::count(this->is_free_.begin(), this->is_free_.end(), char(1)));
  this->estimate_condition(status.report);
  return context.canceled() ? Status::canceled() : status;
}

/// Estimate the condition number of the matrix A after scaling to a diagonal of ones. The scaled
/// matrix has the same eigenvalues as D^-1 A, where D is the diagonal of A. Power iterations with
/// D^-1 A and with its inverse estimate the largest and the smallest eigenvalue. D^-1 A is
/// symmetric in the inner product of D.
void Polyharmonic::estimate_condition(Report& report) const
{
  const Index n = this->parameters_.rows();
  const Rows none = Rows::Zero(this->prescribed_count_, 1),
             points = Rows::Zero(this->constrained_count_, 1);
  const Eigen::VectorXd diagonal = this->matrix_.diagonal();
  const auto length = [&](const Rows& x)
  { return std::sqrt((diagonal.array() * x.col(0).array().square()).sum()); };
  Rows high = Rows::Zero(n, 1), low = Rows::Zero(n, 1);
  std::uint32_t noise = 1;
  for (Index v = 0; v < n; ++v)
  {
    if (this->is_free_[v])
    {
      noise = noise * 1664525u + 1013904223u;
      high(v, 0) = static_cast<double>(noise) / 4294967296.0 - 0.5;
      low(v, 0) = 1.0;
    }
  }
  double largest = 0.0, inverse = 0.0;
  for (int step = 0; step < power_steps; ++step)
  {
    if (!(length(high) > 0.0) || !(length(low) > 0.0))
    {
      return;
    }
    high /= length(high);
    low /= length(low);
    Rows next = this->matrix_ * high;
    for (Index v = 0; v < n; ++v)
    {
      next(v, 0) = this->is_free_[v] && diagonal[v] > 0.0 ? next(v, 0) / diagonal[v] : 0.0;
    }
    largest = length(next);
    high.swap(next);
    this->system_.solve(diagonal.asDiagonal() * low, none, points, next);
    inverse = length(next);
    low.swap(next);
  }
  report.set("condition", largest * inverse);
}

double Polyharmonic::solve(const Rows& prescribed, const Rows& constrained, const Rows& flux,
  const Rows& load, Rows& x) const
{
  const Index n = this->parameters_.rows();
  Rows weights = Rows::Zero(n, prescribed.cols()); // product of the mass M and the load
  if (load.size() > 0)
  {
    weights = (std::pow(this->unit_, this->order_) * this->mass_).asDiagonal() * load;
  }
  // Return the residual of the last mixed equation at free vertices, with v and w computed from u.
  const auto residual = [&](const Rows& u)
  {
    Rows v = this->stiffness_ * u;
    if (flux.size() > 0)
    {
      v -= flux;
    }
    for (int k = 1; k < this->order_; ++k)
    {
      v = (this->stiffness_ * (this->inverse_mass_.asDiagonal() * v)).eval();
    }
    return Rows(weights - v);
  };
  this->system_.solve(residual(Rows::Zero(n, prescribed.cols())), prescribed, constrained, x);
  const Rows zero_prescribed = Rows::Zero(prescribed.rows(), prescribed.cols());
  const Rows zero_constrained = Rows::Zero(constrained.rows(), constrained.cols());
  double last = -1.0;
  Rows step;
  for (int k = 0; k < maximum_refinements; ++k)
  {
    this->system_.solve(residual(x), zero_prescribed, zero_constrained, step);
    const double size = norm(step);
    if (!(last < 0.0 || size < last))
    {
      break;
    }
    x += step;
    last = size;
    if (size <= correction_tolerance * norm(x))
    {
      break;
    }
  }
  return std::max(last, 0.0) / std::max(norm(x), 1e-300);
}

Polyharmonic::Rows Polyharmonic::flux_of_derivatives(const Rows& derivatives) const
{
  return this->edge_mass_ * derivatives;
}

Polyharmonic::Rows Polyharmonic::flux_of_surroundings(const Rows& values) const
{
  return this->outside_flux_ * values;
}

Polyharmonic::Rows Polyharmonic::flux_of_patch(const Rows& values) const
{
  return this->inside_flux_ * values;
}

} // namespace bindpose

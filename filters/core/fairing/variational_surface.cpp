// Smooth surfaces by polyharmonic equations (polyharmonic.h). The patch consists of the free
// vertices, which neither a handle nor a flag constrains. The positions or displacements of the
// constrained vertices are passed to Polyharmonic as one column per coordinate. Tangents are passed
// as a flux. If the unknowns are displacements, the flux is the difference between the required
// flux and the flux at rest.
#include "fairing/variational_surface.h"

#include <cmath>
#include <cstdio>

namespace bindpose
{

namespace
{
/// If the last correction is above this fraction of the solution, fewer than six digits are
/// correct.
constexpr double uncertain = 1e-6;

Status check_length(const char* array_name, Index count, Index vertices)
{
  if (count == 0 || count == vertices)
  {
    return {};
  }
  return Status::invalid_input("there are " + std::to_string(count) + " " + array_name + ", but " +
    std::to_string(vertices) + " vertices");
}

/// Convert the parameters to the parameter frame. Tangents and loads are derivatives of positions
/// with respect to parameters, so they are scaled by both frames: tangents are derivatives of order
/// 1, and loads are derivatives of order 2 * `order`.
VariationalSurfaceOptions to_frame(const WorkingFrame& position_frame,
  const WorkingFrame& parameter_frame, VariationalSurfaceOptions options)
{
  options.parameters = parameter_frame.to_frame(options.parameters);
  options.tangents *= position_frame.scale() / parameter_frame.scale();
  options.load *= position_frame.scale();
  for (int k = 0; k < 2 * options.order; ++k)
  {
    options.load /= parameter_frame.scale();
  }
  return options;
}
} // namespace

Status VariationalSurface::bind(ExecutionContext& context, PointsView points,
  TrianglesView triangles, const Handles& handles, const VariationalSurfaceOptions& options)
{
  *this = VariationalSurface();
  const Index n = points.rows();
  Status status = check_mesh(points, triangles);
  const std::pair<const char*, Index> lengths[] = { { "parameters", options.parameters.rows() },
    { "flags of fixed vertices", static_cast<Index>(options.fixed.size()) },
    { "tangents", options.tangents.rows() }, { "loads", options.load.rows() },
    { "region labels", static_cast<Index>(options.region_ids.size()) } };
  for (const auto& [array_name, count] : lengths)
  {
    status = status.ok() ? check_length(array_name, count, n) : status;
  }
  if (!status.ok())
  {
    return status;
  }
  if (triangles.rows() == 0)
  {
    return Status::invalid_input("the mesh has no triangles; a surface is required");
  }
  if (!points.allFinite() || !options.parameters.allFinite() || !options.tangents.allFinite() ||
    !options.load.allFinite())
  {
    return Status::invalid_input(
      "a coordinate, parameter, tangent or load of the mesh is not a finite number");
  }
  if (options.order < 1 || options.order > 3)
  {
    return Status::invalid_input(
      "the order must be 1, 2 or 3, not " + std::to_string(options.order));
  }
  if (options.boundary == PatchBoundary::tangent &&
    options.tangent_source == PatchTangents::prescribed && options.tangents.rows() == 0)
  {
    return Status::invalid_input(
      "tangent source 'given' needs an array of tangents, but the mesh has none");
  }
  if (!handles.empty())
  {
    status = check_handles(handles);
    if (!status.ok())
    {
      return status;
    }
  }
  WorkingFrame position_frame;
  status = WorkingFrame::choose(points, triangles, "the surface", position_frame);
  WorkingFrame parameter_frame = position_frame;
  if (status.ok() && options.parameters.rows() > 0)
  {
    status =
      WorkingFrame::choose(options.parameters, triangles, "the parameter domain", parameter_frame);
  }
  if (!status.ok())
  {
    return status;
  }
  if (!position_frame.is_identity() || !parameter_frame.is_identity())
  {
    status = this->bind(context, position_frame.to_frame(points), triangles,
      to_frame(position_frame, handles), to_frame(position_frame, parameter_frame, options));
    this->frame_ = position_frame;
    this->posed_ = points;
    return status;
  }
  this->handles_ = handles;
  this->options_ = options;
  this->rest_ = this->posed_ = points;
  this->parts_ = connected_components(n, triangles);
  for (Index v = 0; v < static_cast<Index>(options.fixed.size()); ++v)
  {
    if (options.fixed[v] && this->parts_.component_of_vertex[v] >= 0)
    {
      this->fixed_vertices_.push_back(v);
    }
  }
  status = this->grips_.find(points, triangles, this->parts_, handles, options.region_ids);
  if (!status.ok())
  {
    return status;
  }
  if (options.parameters.rows() == 0)
  {
    this->system_.bind(points, triangles, options.order, options.boundary);
  }
  else
  {
    this->system_.bind(options.parameters, triangles, options.order, options.boundary);
  }
  status.report.set("counts.vertices", n);
  status.report.set("counts.triangles", triangles.rows());
  status.report.set("counts.handles", handles.size());
  status.report.set("method", "variational");
  status.report.set("order", options.order);
  status.report.set("boundary", to_string(options.boundary));
  return context.canceled() ? Status::canceled() : status;
}

Status VariationalSurface::prepare(ExecutionContext& context, const Pose& pose)
{
  const VariationalSurfaceOptions& options = this->options_;
  this->grips_.choose(pose, this->fixed_vertices_);
  if (options.fair)
  {
    std::vector<char> constrained(static_cast<std::size_t>(this->parts_.count), 0);
    for (const Index v : this->grips_.prescribed())
    {
      constrained[this->parts_.component_of_vertex[v]] = 1;
    }
    for (const MeshPoint& point : this->grips_.constrained())
    {
      constrained[this->parts_.component_of_vertex[point[0].first]] = 1;
    }
    for (Index v = 0; v < this->rest_.rows(); ++v)
    {
      if (this->parts_.component_of_vertex[v] >= 0 &&
        !constrained[this->parts_.component_of_vertex[v]])
      {
        return Status::invalid_input("the connected part that contains point " + std::to_string(v) +
          " must have at least one fixed point");
      }
    }
  }
  Status status = this->system_.prepare(
    context, this->parts_, this->grips_.prescribed(), this->grips_.constrained());
  if (!status.ok())
  {
    return status;
  }
  this->factorizations_ += 1;
  status.report.set(
    "counts.constrained", this->grips_.prescribed().size() + this->grips_.constrained().size());
  const int order = options.order;
  if (options.boundary == PatchBoundary::curve && order > 1 && options.load.rows() == 0)
  {
    status.warnings.push_back("boundary curve without a load reduces order " +
      std::to_string(order) +
      " to the membrane of order 1, because the Laplacian is zero at the curve and therefore "
      "everywhere");
  }
  if (options.boundary == PatchBoundary::tangent && order == 1)
  {
    status.warnings.emplace_back("tangents are ignored because order 1 cannot satisfy them");
  }
  if (options.boundary == PatchBoundary::tangent && order == 3)
  {
    status.warnings.emplace_back(
      "order 3 with boundary tangent does not continue the curvature: the derivative of the "
      "Laplacian across the boundary is zero; use boundary region with three fixed layers instead");
  }
  if (options.fair && options.boundary == PatchBoundary::region && this->system_.layers() < order)
  {
    status.warnings.push_back("order " + std::to_string(order) + " needs " + std::to_string(order) +
      " one-ring layers of fixed points around the patch, but the mesh has only " +
      std::to_string(this->system_.layers()) + "; slopes across the border of the mesh are zero");
  }
  return status;
}

/// Return a #V x 3 matrix with the rows of `prescribed` at the given vertices and zero elsewhere.
VariationalSurface::Rows VariationalSurface::expand_prescribed(const Rows& prescribed) const
{
  Rows all = Rows::Zero(this->rest_.rows(), 3);
  for (Index i = 0; i < prescribed.rows(); ++i)
  {
    all.row(this->grips_.prescribed()[i]) = prescribed.row(i);
  }
  return all;
}

Status VariationalSurface::solve(ExecutionContext& context, const Pose& pose)
{
  Status status = this->handles_.empty() ? Status() : check_pose(this->handles_, pose);
  if (!status.ok())
  {
    return status;
  }
  if (this->frame_.is_identity())
  {
    return this->solve_in_frame(context, pose);
  }
  status = this->solve_in_frame(context, to_frame(this->frame_, pose));
  if (status.usable())
  {
    this->posed_ = this->frame_.from_frame(this->posed_);
  }
  return status;
}

Status VariationalSurface::solve_in_frame(ExecutionContext& context, const Pose& pose)
{
  const VariationalSurfaceOptions& options = this->options_;
  if (!this->prepared_ || !same_modes(this->modes_, pose))
  {
    Phase phase(context, "factor", 0.0, 0.8);
    this->prepared_ = false;
    this->prepared_status_ = this->prepare(context, pose);
    if (!this->prepared_status_.ok())
    {
      return this->prepared_status_;
    }
    this->modes_ = modes_of(pose);
    this->prepared_ = true;
  }
  Status status = this->prepared_status_;
  std::vector<std::string> redundant = this->grips_.redundancy(pose, this->system_.redundant());
  status.warnings.insert(status.warnings.end(), redundant.begin(), redundant.end());

  Rows prescribed, constrained;
  this->grips_.targets(pose, prescribed, constrained);
  if (options.fair)
  {
    for (Index i = 0; i < prescribed.rows(); ++i)
    {
      prescribed.row(i) += this->rest_.row(this->grips_.prescribed()[i]);
    }
    for (Index i = 0; i < constrained.rows(); ++i)
    {
      for (const auto& [v, coordinate] : this->grips_.constrained()[i])
      {
        constrained.row(i) += coordinate * this->rest_.row(v);
      }
    }
  }
  Rows flux;
  if (options.boundary == PatchBoundary::tangent)
  {
    switch (options.tangent_source)
    {
      case PatchTangents::surroundings:
        flux = this->system_.flux_of_surroundings(this->expand_prescribed(prescribed));
        break;
      case PatchTangents::prescribed:
        flux = this->system_.flux_of_derivatives(options.tangents);
        if (!options.fair)
        {
          flux -= this->system_.flux_of_patch(this->rest_);
        }
        break;
      case PatchTangents::clamped:
        break;
    }
  }
  Rows x;
  const double refinement = this->system_.solve(prescribed, constrained, flux, options.load, x);
  if (!x.allFinite())
  {
    return Status::failure(StatusCode::unavailable,
      "the surface cannot be computed: the solution has values that are not finite");
  }
  if (!options.fair)
  {
    x += this->rest_;
  }
  for (Index v = 0; v < x.rows(); ++v)
  {
    if (this->parts_.component_of_vertex[v] < 0)
    {
      x.row(v) = this->rest_.row(v);
    }
  }
  this->posed_ = x;
  status.report.set("refinement", refinement);
  if (refinement > uncertain)
  {
    char text[16];
    std::snprintf(text, sizeof(text), "%.0e", refinement);
    status.warnings.push_back(std::string("the solver's last correction changed the result by ") +
      text +
      " of the largest coordinate, so the result is inaccurate; use a lower order or a coarser "
      "mesh");
  }
  if (!this->grips_.constraints().empty())
  {
    status.report.set(
      "constraint_residual", this->grips_.residual(pose, x - Rows(this->rest_), status.warnings));
  }
  return context.canceled() ? Status::canceled() : status;
}

} // namespace bindpose

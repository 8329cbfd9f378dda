// One way for the volume (tets, handles, method, transfer), one for the embedding (the same on a
// lattice, carried to the surface smoothly), and the choice between them. A result that is left for
// another one is thrown away; what it told is kept as the reason.
#include "weights/surface_weights.h"

#include "planar/planar_shape.h"
#include "weights/embedded_surface.h"
#include "weights/preview_weights.h"
#include "weights/transfer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <utility>

namespace bindpose
{

namespace
{
constexpr Index few_triangles = 20000;
constexpr Index many_tets = 120000;
constexpr double largest_rms = 0.02;
constexpr double largest_difference = 0.3;

class Solver
{
public:
  Solver(PointsView points, TrianglesView triangles, const std::vector<Index>& region_ids,
    const Handles& handles, const SurfaceWeightsOptions& options,
    const WeightsOptions& weights_options, const WeightsMethod& method, ExecutionContext& context)
    : points_(points), triangles_(triangles), region_ids_(region_ids), handles_(handles),
      options_(options), weights_options_(weights_options), method_(method), context_(context)
  {
  }

  Status run(SurfaceWeights& result);

private:
  Status automatic(SurfaceWeights& result);
  Status on_mesh(SurfaceWeights& result);
  Status in_volume(SurfaceWeights& result, Index most_tets = -1);
  Status in_embedding(SurfaceWeights& result, bool& trusted);
  Status in_cage(SurfaceWeights& result);
  Status fill_cage(const std::vector<CageElement>& faces, SurfaceWeights& result, Domain& domain);
  Status fill_plane_cage(
    const std::vector<CageElement>& edges, SurfaceWeights& result, Domain& domain);
  Status embed(Index resolution, SurfaceWeights& result);
  Status fill(PointsView points, TrianglesView triangles, const TetrahedralizeOptions& options,
    TetrahedralizeResult& tets);
  TetrahedralizeOptions fill_options() const;
  Status refuse_single_points(const char* domain) const;
  /// Adds what a step said to what came before it. @return the step's status with all of it.
  Status joined(Status before, Status step) const;
  /// From weights at the tets' vertices to weights at the surface's points.
  using Carry = std::function<Status(const Weights& solved, Weights& at_points)>;
  Status solve(const Domain& domain, const std::vector<Index>& region_ids, const WeightTerms& terms,
    const HandleInsertionOptions& insertion, const Carry& carry, SurfaceWeights& result);
  /// What is asked of the surface's vertices for a mesh of its inside.
  Status carry_terms_to(const Points& points, const std::vector<Index>& original,
    WeightTerms& terms, Status& status) const;

  PointsView points_;
  TrianglesView triangles_;
  const std::vector<Index>& region_ids_;
  const Handles& handles_;
  const SurfaceWeightsOptions& options_;
  const WeightsOptions& weights_options_;
  const WeightsMethod& method_;
  ExecutionContext& context_;
  Weights preview_; ///< once it is made
};

/// Rows divided by their sums; rows of nothing stay.
void normalise(Weights& weights)
{
  for (Index i = 0; i < weights.rows(); ++i)
  {
    const double sum = weights.row(i).sum();
    if (sum > 1e-3)
    {
      weights.row(i) /= sum;
    }
  }
}

/// NAME.rms_difference and NAME.max_difference, which are also returned.
std::pair<double, double> report_difference(
  const Weights& a, const Weights& b, const std::string& name, Report& report)
{
  const Weights difference = (a - b).cwiseAbs();
  const auto count = static_cast<double>(std::max<Index>(difference.size(), 1));
  const double rms = std::sqrt(difference.squaredNorm() / count);
  const double largest = difference.size() > 0 ? difference.maxCoeff() : 0.0;
  report.set(name + ".rms_difference", rms);
  report.set(name + ".max_difference", largest);
  return { rms, largest };
}

/// Edges of cages have no direction of their own: turned so that each begins where the one before
/// it ends, as far as two meet, and so that all of them enclose a positive area.
void run_around(PlanePointsView points, Segments& edges)
{
  std::vector<std::vector<Index>> at(static_cast<std::size_t>(points.rows()));
  for (Index e = 0; e < edges.rows(); ++e)
  {
    at[static_cast<std::size_t>(edges(e, 0))].push_back(e);
    at[static_cast<std::size_t>(edges(e, 1))].push_back(e);
  }
  std::vector<char> done(static_cast<std::size_t>(edges.rows()), 0);
  for (Index first = 0; first < edges.rows(); ++first)
  {
    Index e = first;
    while (e >= 0 && !done[static_cast<std::size_t>(e)])
    {
      done[static_cast<std::size_t>(e)] = 1;
      const Index end = edges(e, 1);
      Index next = -1;
      for (const Index other : at[static_cast<std::size_t>(end)])
      {
        next = next < 0 && !done[static_cast<std::size_t>(other)] ? other : next;
      }
      if (next >= 0 && edges(next, 0) != end)
      {
        std::swap(edges(next, 0), edges(next, 1));
      }
      e = next;
    }
  }
  double area = 0.0;
  for (Index e = 0; e < edges.rows(); ++e)
  {
    const auto a = points.row(edges(e, 0));
    const auto b = points.row(edges(e, 1));
    area += a[0] * b[1] - a[1] * b[0];
  }
  if (area < 0.0)
  {
    edges.col(0).swap(edges.col(1));
  }
}

Domain volume_of(const TetMesh& mesh)
{
  Domain domain;
  domain.points = mesh.points;
  domain.tets = mesh.tets;
  return domain;
}

Status Solver::joined(Status before, Status step) const
{
  step.warnings.insert(step.warnings.begin(), before.warnings.begin(), before.warnings.end());
  before.report.merge(step.report);
  step.report = std::move(before.report);
  return step;
}

Status Solver::fill(PointsView points, TrianglesView triangles,
  const TetrahedralizeOptions& options, TetrahedralizeResult& tets)
{
  const Phase phase(this->context_, "tetrahedralize", 0.0, 0.3);
  Status status = tetrahedralize(points, triangles, options, tets, this->context_);
  status.report.set("tetrahedralize.method", status.report.text("method"));
  status.report.erase("method");
  return status;
}

TetrahedralizeOptions Solver::fill_options() const
{
  TetrahedralizeOptions options;
  options.winding_threshold = this->options_.winding_threshold;
  return options;
}

/// What is asked of single points can only be kept where they are vertices.
Status Solver::refuse_single_points(const char* domain) const
{
  return asks_of_vertices(this->weights_options_.terms)
    ? Status::invalid_input("rigid sets, bounds, pins and mirrors of points need tets that keep "
                            "the surface's points: domain volume, not " +
        std::string(domain))
    : Status();
}

Status Solver::carry_terms_to(const Points& points, const std::vector<Index>& original,
  WeightTerms& terms, Status& status) const
{
  terms = this->weights_options_.terms;
  if (terms.rigidity.size() == 0 && !asks_of_vertices(terms))
  {
    return {};
  }
  Domain surface;
  surface.points = this->points_;
  surface.triangles = this->triangles_;
  const Status fits = check_terms(terms, surface.points.rows(), this->handles_);
  if (!fits.ok())
  {
    return fits;
  }
  Index lost = 0;
  const Status carried = carry_terms(
    this->weights_options_.terms, surface, points, original, this->context_, terms, lost);
  if (lost > 0)
  {
    status.warnings.push_back(std::to_string(lost) +
      (lost == 1 ? " point of the surface is no vertex"
                 : " points of the surface are no vertices") +
      " of the tets; bounds, pins, rigid sets and mirror points there are not kept");
  }
  return carried;
}

Status Solver::solve(const Domain& domain, const std::vector<Index>& region_ids,
  const WeightTerms& terms, const HandleInsertionOptions& insertion, const Carry& carry,
  SurfaceWeights& result)
{
  Status status;
  {
    const ProgressRange range(this->context_, 0.3, 0.95);
    WeightsOptions options = this->weights_options_;
    options.insertion = insertion;
    options.terms = terms;
    status = make_weights_problem(
      domain, region_ids, this->handles_, options, this->context_, result.problem);
    if (status.usable() && this->options_.preview && this->preview_.size() == 0)
    {
      const ProgressRange before(this->context_, 0.04, 0.1);
      status = preview_weights(result.problem, options, this->context_, result.solved);
      if (status.usable() && carry(result.solved.weights, this->preview_).usable())
      {
        normalise(this->preview_);
        this->options_.preview(this->preview_);
      }
    }
    if (status.usable())
    {
      status = this->method_(result.problem, this->context_, result.solved);
    }
    if (!status.usable())
    {
      return status;
    }
  }
  const Phase phase(this->context_, "transfer", 0.95, 1.0);
  const Index m = result.solved.weights.cols();
  Weights both(result.solved.weights.rows(), 2 * m);
  both << result.solved.weights, result.solved.raw;
  Weights at_points;
  const Status carried = carry(both, at_points);
  if (!carried.usable())
  {
    return carried;
  }
  result.weights = at_points.leftCols(m);
  result.raw = at_points.rightCols(m);
  if (result.domain == WeightsDomain::embedding)
  {
    normalise(result.weights); // clamped and smoothed
  }
  if (this->preview_.size() > 0)
  {
    report_difference(this->preview_, result.weights, "preview", status.report);
  }
  // How the solve ended is what counts.
  status.report.merge(carried.report);
  status.warnings.insert(status.warnings.end(), carried.warnings.begin(), carried.warnings.end());
  return status;
}

Status Solver::on_mesh(SurfaceWeights& result)
{
  Domain domain;
  domain.points = this->points_;
  domain.triangles = this->triangles_;
  result.domain = WeightsDomain::surface;
  return this->solve(
    domain, this->region_ids_, this->weights_options_.terms, this->weights_options_.insertion,
    [&](const Weights& solved, Weights& at_points)
    {
      at_points = solved.topRows(this->points_.rows()); // the surface's own points come first
      return Status();
    },
    result);
}

Status Solver::in_volume(SurfaceWeights& result, Index most_tets)
{
  TetrahedralizeOptions options = this->fill_options();
  options.handles = this->options_.places;
  Status status = this->fill(this->points_, this->triangles_, options, result.tets);
  if (!status.usable())
  {
    return status;
  }
  const Index count = result.tets.mesh.tets.rows();
  if (most_tets >= 0 && count > most_tets)
  {
    return Status::failure(
      StatusCode::unavailable, "it takes " + std::to_string(count) + " tets to fill it");
  }
  std::vector<Index> labels;
  if (!this->region_ids_.empty())
  {
    for (const Index original : result.tets.original_vertices)
    {
      labels.push_back(original < 0 ? 0 : this->region_ids_[original]);
    }
    if (std::all_of(labels.begin(), labels.end(), [](Index label) { return label <= 0; }))
    {
      return Status::invalid_input(
        "the tets share no labelled point with the surface; solve on the "
        "surface itself, or give tets with labels");
    }
  }
  result.domain = WeightsDomain::volume;
  WeightTerms terms;
  const Status carried =
    this->carry_terms_to(result.tets.mesh.points, result.tets.original_vertices, terms, status);
  if (!carried.ok())
  {
    return carried;
  }
  return this->joined(status,
    this->solve(
      volume_of(result.tets.mesh), labels, terms, this->weights_options_.insertion,
      [&](const Weights& solved, Weights& at_points)
      {
        TransferCounts counts;
        return transfer(
          result.problem.mesh.domain, solved, this->points_, {}, this->context_, at_points, counts);
      },
      result));
}

Status Solver::in_cage(SurfaceWeights& result)
{
  std::vector<CageElement> faces;
  std::vector<CageElement> edges;
  for (const Handle& handle : this->handles_)
  {
    for (const CageElement& element : handle.cage)
    {
      (element[2] >= 0 ? faces : edges).push_back(element);
    }
  }
  Status status = this->refuse_single_points("cage");
  if (!status.ok())
  {
    return status;
  }
  Domain domain;
  status = faces.empty() ? this->fill_plane_cage(edges, result, domain)
                         : this->fill_cage(faces, result, domain);
  if (!status.usable())
  {
    return status;
  }
  result.domain = WeightsDomain::cage;
  WeightTerms terms;
  const std::vector<Index> none(static_cast<std::size_t>(domain.points.rows()), -1);
  const Status carried_terms = this->carry_terms_to(domain.points, none, terms, status);
  if (!carried_terms.ok())
  {
    return carried_terms;
  }
  return this->joined(status,
    this->solve(
      domain, {}, terms, this->weights_options_.insertion,
      [&](const Weights& solved, Weights& at_points)
      {
        TransferCounts counts;
        Status carried = transfer(
          result.problem.mesh.domain, solved, this->points_, {}, this->context_, at_points, counts);
        if (counts.nearest + counts.misses > 0)
        {
          carried.warnings = { std::to_string(counts.nearest + counts.misses) +
            " points of the surface lie outside of the cage; they take the nearest weights" };
        }
        return carried;
      },
      result));
}

/// Tets of what the cage's faces enclose.
Status Solver::fill_cage(
  const std::vector<CageElement>& faces, SurfaceWeights& result, Domain& domain)
{
  Points corners(static_cast<Index>(this->handles_.size()), 3);
  for (Index i = 0; i < corners.rows(); ++i)
  {
    corners.row(i) = this->handles_[static_cast<std::size_t>(i)].head;
  }
  Triangles triangles(static_cast<Index>(faces.size()), 3);
  for (Index f = 0; f < triangles.rows(); ++f)
  {
    triangles.row(f) << faces[f][0], faces[f][1], faces[f][2];
  }
  TetrahedralizeOptions options;
  options.handles.points = this->options_.places.points;
  if (this->points_.rows() <= few_triangles)
  {
    const Index count = options.handles.points.rows();
    options.handles.points.conservativeResize(count + this->points_.rows(), 3);
    options.handles.points.bottomRows(this->points_.rows()) = this->points_;
  }
  Status status = this->fill(corners, triangles, options, result.tets);
  if (!status.usable())
  {
    status.message = "the cage cannot be filled: " + status.message;
    return status;
  }
  domain = volume_of(result.tets.mesh);
  return status;
}

/// Triangles of what the cage's edges enclose in the plane of a flat shape.
Status Solver::fill_plane_cage(
  const std::vector<CageElement>& edges, SurfaceWeights& result, Domain& domain)
{
  const char* needs = "domain cage needs a closed cage among the handles: of faces, or of edges in "
                      "the plane of a flat shape";
  if (edges.empty())
  {
    return Status::invalid_input(needs);
  }
  // All handles, tails of bones, and the shape's points, in this order.
  const auto handle_count = static_cast<Index>(this->handles_.size());
  const Index shape_points = this->points_.rows() <= few_triangles ? this->points_.rows() : 0;
  Points places(2 * handle_count + this->points_.rows(), 3);
  PlanarHandles inside;
  inside.bones.resize(handle_count, 2);
  Index bones = 0;
  for (Index j = 0; j < handle_count; ++j)
  {
    const Handle& handle = this->handles_[static_cast<std::size_t>(j)];
    const bool bone = handle.kind == HandleKind::bone;
    places.row(j) = handle.head;
    places.row(handle_count + j) = bone ? handle.tail : handle.head;
    if (bone)
    {
      inside.bones.row(bones++) << j, handle_count + j;
    }
  }
  inside.bones.conservativeResize(bones, 2);
  places.bottomRows(this->points_.rows()) = this->points_;
  Vec3 normal;
  if (!is_flat(places, bounding_box(places).diagonal(), normal))
  {
    return Status::invalid_input(std::string(needs) + "; these handles and the shape are not flat");
  }
  // Counter-clockwise seen from where the shape is.
  Vec3 area = Vec3::Zero();
  for (Index f = 0; f < this->triangles_.rows(); ++f)
  {
    const auto corner = [&](int k) { return Vec3(this->points_.row(this->triangles_(f, k))); };
    area += (corner(1) - corner(0)).cross(corner(2) - corner(0));
  }
  normal = area.dot(normal) < 0.0 ? Vec3(-normal) : normal;
  const Vec3 origin = places.colwise().mean();
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = normal.unitOrthogonal();
  axes.col(1) = normal.cross(axes.col(0));
  const PlanePoints flat = (places.rowwise() - origin.transpose()) * axes;
  inside.points = flat.topRows(2 * handle_count + shape_points);
  const PlanePoints corners = flat.topRows(handle_count);
  Segments outline(static_cast<Index>(edges.size()), 2);
  for (Index e = 0; e < outline.rows(); ++e)
  {
    outline.row(e) << edges[static_cast<std::size_t>(e)][0], edges[static_cast<std::size_t>(e)][1];
  }
  run_around(corners, outline);
  PlanarShapeOptions options;
  options.winding_threshold = this->options_.winding_threshold;
  PlanarShape shape;
  const Phase phase(this->context_, "triangulate", 0.0, 0.3);
  Status status = planar_shape(corners, outline, inside, options, shape, this->context_);
  if (!status.usable())
  {
    status.message = "the cage cannot be filled: " + status.message;
    return status;
  }
  if (status.report.number("counts.outside_handles", 0.0) > 0.0)
  {
    // Its last warning. Of the shape the transfer will say so, of a handle the problem.
    status.warnings.pop_back();
  }
  // Only this of its report: vertices and triangles are counted once more, of the weights' mesh.
  Report told;
  told.set("cage.min_angle", status.report.number("min_angle", 0.0));
  told.set("cage.area", status.report.number("area", 0.0));
  status.report = std::move(told);
  domain.points = (shape.points * axes.transpose()).rowwise() + origin.transpose();
  domain.triangles = shape.triangles;
  // Where a place was given, its own coordinates: what is on it is found there exactly.
  for (Index i = 0; i < static_cast<Index>(shape.handle_vertices.size()); ++i)
  {
    if (shape.handle_vertices[static_cast<std::size_t>(i)] >= 0)
    {
      domain.points.row(shape.handle_vertices[static_cast<std::size_t>(i)]) = places.row(i);
    }
  }
  result.plane_cage = { domain.points, domain.triangles };
  return status;
}

Status Solver::embed(Index resolution, SurfaceWeights& result)
{
  TetrahedralizeOptions options = this->fill_options();
  options.method = TetMethod::embed;
  options.resolution = resolution;
  Status status = this->fill(this->points_, this->triangles_, options, result.tets);
  if (!status.usable())
  {
    return status;
  }
  status.report.set(
    "embedding.resolution", static_cast<Index>(status.report.number("resolution", 0.0)));
  const EmbeddedSurface embedded(
    this->points_, this->triangles_, result.tets.mesh, result.tets.binding);
  HandleInsertionOptions insertion = this->weights_options_.insertion;
  insertion.spacing = 0.5;
  insertion.element_of = [&](const Vec3& place) { return embedded.tet_of(place); };
  result.domain = WeightsDomain::embedding;
  WeightTerms terms;
  const Domain lattice = EmbeddedSurface::domain(result.tets.mesh, result.tets.inside_fractions);
  const std::vector<Index> none(static_cast<std::size_t>(lattice.points.rows()), -1);
  const Status carried = this->carry_terms_to(lattice.points, none, terms, status);
  if (!carried.ok())
  {
    return carried;
  }
  status = this->joined(status,
    this->solve(
      lattice, {}, terms, insertion,
      [&](const Weights& solved, Weights& at_points) {
        return embedded.carry(
          result.problem.mesh, this->handles_, solved, this->context_, at_points);
      },
      result));
  return status;
}

Status Solver::in_embedding(SurfaceWeights& result, bool& trusted)
{
  trusted = true;
  if (!this->region_ids_.empty())
  {
    return Status::invalid_input(
      "regions need tets that keep the surface's points: domain volume, not embedding");
  }
  Status status = this->refuse_single_points("embedding");
  if (!status.ok())
  {
    return status;
  }
  const bool guard = this->options_.guard;
  {
    const ProgressRange range(this->context_, 0.0, guard ? 0.7 : 1.0);
    status = this->embed(this->options_.resolution, result);
  }
  if (!status.usable() || !guard)
  {
    return status;
  }
  const auto resolution = static_cast<Index>(status.report.number("embedding.resolution", 0.0));
  const auto compare = [&](Index other_resolution, SurfaceWeights& other, Status& of_other)
  {
    of_other = this->embed(other_resolution, other);
    if (!of_other.usable())
    {
      return false;
    }
    const auto [rms, largest] =
      report_difference(result.weights, other.weights, "guard", status.report);
    report_difference(result.weights, other.weights, "guard", of_other.report);
    trusted = rms <= largest_rms && largest <= largest_difference;
    status.report.set("guard.resolution", Report::Value(other_resolution));
    of_other.report.set("guard.resolution", Report::Value(resolution));
    return true;
  };
  SurfaceWeights other;
  Status of_other;
  const ProgressRange range(this->context_, 0.7, 1.0);
  if (!compare(std::max<Index>(4, (2 * resolution + 1) / 3), other, of_other))
  {
    return of_other;
  }
  if (!trusted && this->options_.resolution == 0)
  {
    if (!compare((4 * resolution + 1) / 3, other, of_other))
    {
      return of_other;
    }
    result = std::move(other);
    status = std::move(of_other);
  }
  if (!trusted)
  {
    char numbers[96];
    std::snprintf(numbers, sizeof(numbers), "%.2g rms and %.2g at most",
      status.report.number("guard.rms_difference", 0.0),
      status.report.number("guard.max_difference", 0.0));
    status.warnings.push_back(std::string("the weights of two lattices differ by ") + numbers +
      ": finer parts are not held");
  }
  return status;
}

Status Solver::automatic(SurfaceWeights& result)
{
  const auto with_reason = [](Status status, const std::string& reason)
  {
    status.report.set("domain_reason", Report::Value(reason));
    return status;
  };
  Vec3 normal;
  const double diagonal = bounding_box(this->points_, this->triangles_).diagonal();
  if (diagonal > 0.0 && is_flat(this->points_, diagonal, normal))
  {
    return with_reason(this->on_mesh(result), "the shape is flat");
  }
  bool trusted = true;
  const bool small = this->triangles_.rows() <= few_triangles;
  const bool asked = asks_of_vertices(this->weights_options_.terms);
  if (small || !this->region_ids_.empty() || asked)
  {
    const bool choice = this->region_ids_.empty() && !asked;
    Status status = this->in_volume(result, choice ? many_tets : -1);
    if (status.usable() || status.code == StatusCode::cancelled || !choice ||
      !(status.code == StatusCode::unavailable || result.tets.mesh.tets.rows() == 0))
    {
      return with_reason(status,
        choice    ? "the surface is small"
          : asked ? "something is asked of single points"
                  : "there are regions");
    }
    const std::string reason = status.message;
    const Status first = std::move(status);
    SurfaceWeights embedded;
    status = this->in_embedding(embedded, trusted);
    if (!status.usable())
    {
      return status.code == StatusCode::cancelled ? status : first;
    }
    result = std::move(embedded);
    status.report.set("tetrahedralize.fallback", "embed");
    status.report.set("tetrahedralize.reason", Report::Value(reason));
    status.warnings.insert(status.warnings.begin(),
      "the surface could not be filled (" + reason +
        "); the weights are solved on a lattice that holds it");
    return with_reason(status, "the surface could not be filled");
  }
  Status status = this->in_embedding(result, trusted);
  if (trusted || !status.usable())
  {
    return with_reason(status, "the surface is dense");
  }
  SurfaceWeights in_volume;
  Status of_volume = this->in_volume(in_volume);
  if (of_volume.usable())
  {
    for (const char* key : { "guard.rms_difference", "guard.max_difference", "guard.resolution" })
    {
      if (const Report::Value* value = status.report.find(key))
      {
        of_volume.report.set(key, *value);
      }
    }
    result = std::move(in_volume);
    return with_reason(of_volume, "the weights of two lattices differ too much");
  }
  return of_volume.code == StatusCode::cancelled ? of_volume
                                                 : with_reason(status, "the surface is dense");
}

Status Solver::run(SurfaceWeights& result)
{
  Status status;
  bool trusted = true;
  switch (this->options_.domain)
  {
    case WeightsDomain::surface:
      status = this->on_mesh(result);
      break;
    case WeightsDomain::volume:
      status = this->in_volume(result);
      break;
    case WeightsDomain::cage:
      status = this->in_cage(result);
      break;
    case WeightsDomain::embedding:
      status = this->in_embedding(result, trusted);
      break;
    default:
      status = this->automatic(result);
      break;
  }
  status.report.set("domain", to_string(result.domain));
  return status;
}
} // namespace

const char* to_string(WeightsDomain domain)
{
  constexpr const char* names[] = { "surface", "auto", "volume", "embedding", "cage" };
  return names[static_cast<int>(domain)];
}

Status surface_weights(PointsView points, TrianglesView triangles,
  const std::vector<Index>& region_ids, const Handles& handles,
  const SurfaceWeightsOptions& options, const WeightsOptions& weights_options,
  const WeightsMethod& method, ExecutionContext& context, SurfaceWeights& result)
{
  result = SurfaceWeights();
  if (!(options.winding_threshold > 0.0))
  {
    return Status::invalid_input("the winding threshold must be positive");
  }
  if (options.resolution != 0 && (options.resolution < 6 || options.resolution > 1000))
  {
    return Status::invalid_input("the embedding's resolution must lie between 6 and 1000");
  }
  // Handles first: what is wrong with them costs no tets.
  Status valid = check_handles(handles);
  if (valid.ok())
  {
    valid = check_regions(handles, region_ids, points.rows());
  }
  return valid.ok()
    ? Solver(points, triangles, region_ids, handles, options, weights_options, method, context)
        .run(result)
    : valid;
}

} // namespace bindpose

// Weights of a surface, solved in one of several domains (see surface_weights.h). If the domain is
// `volume`, the steps are: fill the inside with tets, insert the handles, run the weight method,
// and transfer the weights to the surface. If the domain is `embedding`, the same steps are done on
// lattices that contain the surface, and the transferred weights are smoothed. If a domain fails
// and the embedding replaces it, the report contains the status and the message of the failed
// domain.
#include "weights/surface_weights.h"

#include "base/range_check.h"
#include "domain/cage_domain.h"
#include "domain/domain_choice.h"
#include "domain/embedded_surface.h"
#include "domain/loose_parts.h"
#include "weights/preview_weights.h"
#include "transfer/transfer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

namespace bindpose
{

namespace
{
/// The finer of two lattices has converged if the rms difference between the weights of the two
/// lattices is at most this. In measurements on figures and furniture, the weights of the finer
/// lattice were then within 0.012 rms of the weights of much finer lattices.
constexpr double maximum_rms = 0.016;
/// Approximate number of tets of the first lattice. The second lattice has 3/2 times the resolution
/// of the first lattice and about three times as many tets.
constexpr Index first_lattice_tets = 4500;
/// Target number of tets of the third lattice. The resolution of the third lattice is limited to
/// 5/4 … 3/2 times the resolution of the second lattice.
constexpr double third_lattice_tets = 36000.0;
/// Approximate number of tets of the only lattice that is made if
/// SurfaceWeightsOptions::check_resolution is false.
constexpr Index single_lattice_tets = 12000;
constexpr int maximum_lattices = 3;
/// Progress after the work on each lattice, as a fraction of all work. Each lattice takes about
/// four times as long as the previous lattice. Measured on furniture with 8 point handles and with
/// 14 to 38 bones.
constexpr double lattice_progress_ends[maximum_lattices] = { 0.06, 0.22, 1.0 };
/// Progress at the end of meshing and at the end of solving, as fractions of one domain's work.
constexpr double meshing_end = 0.2;
constexpr double solving_end = 0.97;
/// Maximum predicted time of a third lattice, in seconds on one thread.
constexpr double maximum_seconds = 20.0;

/// One lattice that contains the surface, and its solution.
struct Lattice
{
  /// The solution. Its weights at the surface are interpolated but not smoothed.
  SurfaceWeights result;
  Status status;
  Index resolution = 0;
  EmbeddingTets tets;
  /// Transfers values to the surface; refers to the member `tets`.
  std::unique_ptr<EmbeddedSurface> surface;

  Status transfer_values(ExecutionContext& context, const Weights& solved, const Handles& handles,
    EmbeddedSurface::Smoothness smoothness, Weights& at_points) const
  {
    return this->surface->transfer_values(
      context, this->result.problem.mesh, handles, solved, smoothness, at_points);
  }
};

using LatticePtr = std::unique_ptr<Lattice>;

/// The numbers of tets and vertices are estimated to be proportional to resolution^tet_exponent.
/// The exponent is between 2 (sheets) and 3 (solids).
constexpr double tet_exponent = 2.5;

/// Return the resolution of the third lattice, divided by the resolution of the second lattice.
double growth_to_third(const Lattice& second)
{
  const double tets = second.status.report.number("counts.tets", third_lattice_tets);
  return std::clamp(
    std::pow(third_lattice_tets / std::max(tets, 1.0), 1.0 / tet_exponent), 1.25, 1.5);
}

class Solver
{
public:
  Solver(ExecutionContext& context, PointsView points, TrianglesView triangles,
    const std::vector<Index>& region_ids, const Handles& handles,
    const SurfaceWeightsOptions& options, const WeightsOptions& weights_options,
    const WeightsMethod& method)
    : points_(points), triangles_(triangles), region_ids_(region_ids), handles_(handles),
      options_(options), weights_options_(weights_options), method_(method), context_(context)
  {
  }

  Status run(SurfaceWeights& result);

private:
  Status automatic(SurfaceWeights& result);
  Status automatic_volume(SurfaceWeights& result);
  Status fall_back_to_embedding(const Status& first, SurfaceWeights& result);
  Status prepare();
  Status solve_on_surface(SurfaceWeights& result);
  Status solve_in_volume(SurfaceWeights& result);
  Status solve_volume(Status mesh_status, SurfaceWeights& result);
  Status solve_in_embedding(SurfaceWeights& result);
  Status solve_in_cage(SurfaceWeights& result);
  LatticePtr embed(Index resolution, Index tets);
  Status embed_with_links(EmbeddingOptions options, Lattice& lattice);
  Status link_openings();
  void attach_surface(Lattice& lattice);
  HandleInsertionOptions insertion_options(const Lattice& lattice) const;
  Status solve_on_lattice(Lattice& lattice, Status mesh_status);
  LatticePtr best_lattice();
  double transfer_fraction() const;
  Status finish(Lattice& lattice, SurfaceWeights& result);
  Status fill(TetrahedralizeResult& tets);
  Status reject_vertex_terms(const char* domain) const;
  /// Return the status of `step` with the warnings and the report of `before` added.
  Status merge_status(Status before, Status step) const;
  /// A function that transfers weights from the domain's vertices to the surface's points.
  using TransferFunction = std::function<Status(const Weights& solved, Weights& at_points)>;
  Status solve(const Domain& domain, const std::vector<Index>& region_ids, const WeightTerms& terms,
    const HandleInsertionOptions& insertion, const TransferFunction& transfer_values,
    const TransferFunction& transfer_preview, SurfaceWeights& result);
  Status transfer_weights(const TransferFunction& transfer_values, SurfaceWeights& result) const;
  /// Transfer the optional terms from the surface's vertices to a mesh of its inside.
  Status transfer_terms_to(const Points& points, const std::vector<Index>& original,
    WeightTerms& terms, Status& status) const;

  PointsView points_;
  TrianglesView triangles_;
  const std::vector<Index>& region_ids_;
  const Handles& handles_;
  const SurfaceWeightsOptions& options_;
  const WeightsOptions& weights_options_;
  const WeightsMethod& method_;
  ExecutionContext& context_;
  Weights preview_; ///< weights of the preview; empty until they have been computed
  /// The prepared surface, used for all tets and lattices; null until it is prepared.
  std::unique_ptr<PreparedSurface> prepared_;
  /// The locator of the surface, used for all lattices; null until it is needed.
  std::unique_ptr<SimplexLocator> surface_;
  /// Links between parts of the surface. Links of the first kind connect a part with an opening to
  /// the parts that cover the opening; these links are found once. Links of the second kind connect
  /// parts without a handle to other parts; these links are found for each lattice
  /// (find_loose_parts). All links are kept for later lattices.
  std::vector<PartLink> links_;
  /// Number of openings that other parts cover; empty until `links_` contains the links at these
  /// openings.
  std::optional<Index> covered_openings_;
  Index linked_parts_ = 0;
};

/// Divide rows by their sums. Rows with a sum of zero do not change.
void normalize(Weights& weights)
{
  for (Index i = 0; i < weights.rows(); ++i)
  {
    const double sum = weights.row(i).sum();
    if (sum > 0.0)
    {
      weights.row(i) /= sum;
    }
  }
}

/// Set the report keys NAME.rms_difference and NAME.max_difference, where NAME is `name`. Return
/// the rms difference.
double report_difference(
  const Weights& a, const Weights& b, const std::string& name, Report& report)
{
  const Weights difference = (a - b).cwiseAbs();
  const auto count = static_cast<double>(std::max<Index>(difference.size(), 1));
  const double rms = std::sqrt(difference.squaredNorm() / count);
  report.set(name + ".rms_difference", rms);
  report.set(name + ".max_difference", difference.size() > 0 ? difference.maxCoeff() : 0.0);
  return rms;
}

Status Solver::merge_status(Status before, Status step) const
{
  step.warnings.insert(step.warnings.begin(), before.warnings.begin(), before.warnings.end());
  before.report.merge(step.report);
  step.report = std::move(before.report);
  return step;
}

/// Rename the meshing report's key "method", because the weights report a method, too.
void rename_tet_method(Report& report)
{
  if (report.find("method"))
  {
    report.set("tetrahedralize.method", Report::Value(report.text("method")));
    report.erase("method");
  }
}

Status Solver::prepare()
{
  if (this->prepared_)
  {
    return {};
  }
  auto prepared = std::make_unique<PreparedSurface>();
  Status status = prepare_surface(
    this->context_, this->points_, this->triangles_, this->options_.winding_threshold, *prepared);
  if (status.ok())
  {
    this->prepared_ = std::move(prepared);
  }
  return status;
}

/// Fill the surface's inside with tets that are small enough for smooth weights.
Status Solver::fill(TetrahedralizeResult& tets)
{
  const Phase phase(this->context_, "tetrahedralize", 0.0, meshing_end);
  Status status;
  {
    const ProgressRange range(this->context_, 0.0, 0.3);
    status = this->prepare();
  }
  if (!status.ok())
  {
    return status;
  }
  TetrahedralizeOptions options;
  options.winding_threshold = this->options_.winding_threshold;
  options.interior_edge = interior_edge_of_weights(
    this->prepared_->inside.volume(), bounding_box(this->prepared_->surface.points).diagonal());
  options.handles = this->options_.handle_elements;
  const ProgressRange range(this->context_, 0.3, 1.0);
  status = tetrahedralize(
    this->context_, this->points_, this->triangles_, *this->prepared_, options, tets);
  rename_tet_method(status.report);
  return status;
}

/// Return an error if an optional term applies to individual points of the surface, because these
/// points are not vertices of `domain`.
Status Solver::reject_vertex_terms(const char* domain) const
{
  return has_vertex_terms(this->weights_options_.terms)
    ? Status::invalid_input("rigid sets, bounds, pins and mirrors of points need tets that "
                            "preserve the surface's points; use domain volume instead of " +
        std::string(domain))
    : Status();
}

Status Solver::transfer_terms_to(const Points& points, const std::vector<Index>& original,
  WeightTerms& terms, Status& status) const
{
  terms = this->weights_options_.terms;
  if (terms.rigidity.size() == 0 && !has_vertex_terms(terms))
  {
    return {};
  }
  Domain surface;
  surface.points = this->points_;
  surface.triangles = this->triangles_;
  const Status term_status = check_terms(terms, surface.points.rows(), this->handles_);
  if (!term_status.ok())
  {
    return term_status;
  }
  Index dropped_count = 0;
  const Status transfer_status = transfer_terms(
    this->context_, this->weights_options_.terms, surface, points, original, terms, dropped_count);
  if (dropped_count > 0)
  {
    status.warnings.push_back(std::to_string(dropped_count) +
      (dropped_count == 1 ? " point of the surface is not a vertex"
                          : " points of the surface are not vertices") +
      " of the tets; bounds, pins, rigid sets and mirror points there are ignored");
  }
  return transfer_status;
}

Status Solver::solve(const Domain& domain, const std::vector<Index>& region_ids,
  const WeightTerms& terms, const HandleInsertionOptions& insertion,
  const TransferFunction& transfer_values, const TransferFunction& transfer_preview,
  SurfaceWeights& result)
{
  Status status;
  {
    const ProgressRange range(this->context_, meshing_end, solving_end);
    WeightsOptions options = this->weights_options_;
    options.insertion = insertion;
    options.terms = terms;
    status = make_weights_problem_in_place(
      this->context_, domain, region_ids, this->handles_, options, result.problem);
    if (status.usable() && this->options_.preview && this->preview_.size() == 0)
    {
      const ProgressRange before(this->context_, 0.04, 0.1);
      status = preview_weights(this->context_, result.problem, options, result.solved);
      if (status.usable() && transfer_preview(result.solved.weights, this->preview_).usable())
      {
        normalize(this->preview_);
        this->options_.preview(this->preview_);
      }
    }
    if (status.usable())
    {
      status = this->method_(this->context_, result.problem, result.solved);
    }
    if (!status.usable())
    {
      return status;
    }
  }
  const Phase phase(this->context_, "transfer", solving_end, 1.0);
  const Status transfer_status = this->transfer_weights(transfer_values, result);
  if (!transfer_status.usable())
  {
    return transfer_status;
  }
  if (this->preview_.size() > 0)
  {
    report_difference(this->preview_, result.weights, "preview", status.report);
  }
  // The transfer adds report keys and warnings, but does not change the status code of the solve.
  status.report.merge(transfer_status.report);
  status.warnings.insert(
    status.warnings.end(), transfer_status.warnings.begin(), transfer_status.warnings.end());
  return status;
}

/// Transfer the weights, and the raw weights if requested, from the domain's vertices to the
/// surface's points.
Status Solver::transfer_weights(
  const TransferFunction& transfer_values, SurfaceWeights& result) const
{
  const Index m = result.solved.weights.cols();
  Weights solved = result.solved.weights;
  if (this->options_.keep_raw)
  {
    solved.conservativeResize(Eigen::NoChange, 2 * m);
    solved.rightCols(m) = result.solved.raw;
  }
  Weights at_points;
  const Status transfer_status = transfer_values(solved, at_points);
  if (transfer_status.usable())
  {
    result.raw = at_points.rightCols(at_points.cols() - m);
    at_points.conservativeResize(Eigen::NoChange, m);
    result.weights = std::move(at_points);
    if (result.domain == WeightsDomain::embedding)
    {
      normalize(result.weights); // clamping and smoothing have changed the row sums
    }
  }
  return transfer_status;
}

Status Solver::solve_on_surface(SurfaceWeights& result)
{
  Domain domain;
  domain.points = this->points_;
  domain.triangles = this->triangles_;
  result.domain = WeightsDomain::surface;
  const TransferFunction transfer_values = [&](const Weights& solved, Weights& at_points)
  {
    at_points = solved.topRows(this->points_.rows()); // the surface's own points come first
    return Status();
  };
  return this->solve(domain, this->region_ids_, this->weights_options_.terms,
    this->weights_options_.insertion, transfer_values, transfer_values, result);
}

Status Solver::solve_in_volume(SurfaceWeights& result)
{
  Status status = this->fill(result.tets);
  return status.usable() ? this->solve_volume(std::move(status), result) : status;
}

/// Insert handles into the tets that fill the surface, solve the weights and transfer them to the
/// surface.
/// @param mesh_status  status of making the tets.
Status Solver::solve_volume(Status mesh_status, SurfaceWeights& result)
{
  std::vector<Index> labels;
  if (!this->region_ids_.empty())
  {
    for (const Index original : result.tets.original_vertices)
    {
      labels.push_back(original < 0 ? 0 : this->region_ids_[original]);
    }
    if (std::all_of(labels.begin(), labels.end(), [](Index label) { return label <= 0; }))
    {
      return Status::invalid_input("no vertex of the tets is a surface point with a region label; "
                                   "use domain 'surface', or tets with region labels");
    }
  }
  result.domain = WeightsDomain::volume;
  WeightTerms terms;
  const Status transfer_status = this->transfer_terms_to(
    result.tets.mesh.points, result.tets.original_vertices, terms, mesh_status);
  if (!transfer_status.ok())
  {
    return transfer_status;
  }
  const TransferFunction transfer_values = [&](const Weights& solved, Weights& at_points)
  {
    TransferCounts counts;
    return transfer(
      this->context_, result.problem.mesh.domain, solved, this->points_, {}, at_points, counts);
  };
  return this->merge_status(mesh_status,
    this->solve(tet_domain(result.tets.mesh), labels, terms, this->weights_options_.insertion,
      transfer_values, transfer_values, result));
}

Status Solver::solve_in_cage(SurfaceWeights& result)
{
  Status status = this->reject_vertex_terms("cage");
  if (!status.ok())
  {
    return status;
  }
  CageOptions options;
  options.winding_threshold = this->options_.winding_threshold;
  options.handle_elements = this->options_.handle_elements;
  CageDomain cage;
  {
    const ProgressRange range(this->context_, 0.0, meshing_end);
    status =
      fill_cage(this->context_, this->points_, this->triangles_, this->handles_, options, cage);
  }
  if (!status.usable())
  {
    return status;
  }
  rename_tet_method(status.report);
  const Domain domain = std::move(cage.domain);
  result.tets = std::move(cage.tets);
  result.plane_cage = std::move(cage.plane_cage);
  result.domain = WeightsDomain::cage;
  WeightTerms terms;
  const std::vector<Index> none(static_cast<std::size_t>(domain.points.rows()), -1);
  const Status terms_status = this->transfer_terms_to(domain.points, none, terms, status);
  if (!terms_status.ok())
  {
    return terms_status;
  }
  const TransferFunction transfer_values = [&](const Weights& solved, Weights& at_points)
  {
    TransferCounts counts;
    Status transfer_status = transfer(
      this->context_, result.problem.mesh.domain, solved, this->points_, {}, at_points, counts);
    if (counts.nearest + counts.misses > 0)
    {
      transfer_status.warnings = { std::to_string(counts.nearest + counts.misses) +
        " points of the surface are outside the cage and get the nearest weights" };
    }
    return transfer_status;
  };
  return this->merge_status(status,
    this->solve(domain, {}, terms, this->weights_options_.insertion, transfer_values,
      transfer_values, result));
}

/// Make one lattice and solve the weights on it.
/// @param resolution 0: chosen to give about `tets` tets.
LatticePtr Solver::embed(Index resolution, Index tets)
{
  auto lattice = std::make_unique<Lattice>();
  EmbeddingOptions options;
  options.winding_threshold = this->options_.winding_threshold;
  options.resolution = resolution;
  options.tets = tets;
  lattice->status = this->embed_with_links(options, *lattice);
  if (lattice->status.usable())
  {
    lattice->resolution = lattice->tets.resolution;
    lattice->status.report.set("embedding.resolution", lattice->resolution);
    lattice->status = this->solve_on_lattice(*lattice, std::move(lattice->status));
  }
  return lattice;
}

/// Make a lattice in which every part has a handle or is linked to other parts. The links of one
/// lattice are also used for all later lattices.
Status Solver::embed_with_links(EmbeddingOptions options, Lattice& lattice)
{
  const Phase phase(this->context_, "tetrahedralize", 0.0, meshing_end);
  Status prepared;
  {
    const ProgressRange range(this->context_, 0.0, 0.3);
    prepared = this->prepare();
  }
  if (!prepared.ok())
  {
    return prepared;
  }
  // After links are added, a new lattice is made and checked again, because it may still have parts
  // without a handle. At most three rounds were needed for real models. Parts that still have no
  // handle after the last round get the weights of the nearest handle.
  constexpr int most_rounds = 4;
  const ProgressRange range(this->context_, 0.3, 1.0);
  Status status = this->link_openings();
  if (!status.ok())
  {
    return status;
  }
  for (int round = 0; round < most_rounds; ++round)
  {
    options.links = this->links_;
    status = embed_surface(this->context_, this->points_, this->triangles_,
      this->prepared_->inside.winding(), options, lattice.tets);
    if (!status.ok())
    {
      return status;
    }
    this->attach_surface(lattice);
    LooseParts loose_parts;
    const Status found = find_loose_parts(this->context_, this->points_, this->triangles_,
      this->prepared_->surface.representative_of_vertex, lattice.tets, *lattice.surface,
      this->handles_, this->insertion_options(lattice), loose_parts);
    if (!found.ok())
    {
      return found;
    }
    if (loose_parts.links.empty())
    {
      break;
    }
    this->links_.insert(this->links_.end(), loose_parts.links.begin(), loose_parts.links.end());
    this->linked_parts_ = std::max(this->linked_parts_, loose_parts.count);
  }
  status.warnings = this->prepared_->warnings;
  Report report = this->prepared_->report;
  report.merge(status.report);
  status.report = std::move(report);
  if (!this->links_.empty())
  {
    const auto links = static_cast<std::int64_t>(this->links_.size());
    status.report.set("counts.covered_openings", *this->covered_openings_);
    status.report.set("counts.links", Report::Value(links));
  }
  if (this->linked_parts_ > 0)
  {
    status.report.set("counts.linked_parts", this->linked_parts_);
    status.warnings.push_back(std::to_string(this->linked_parts_) +
      (this->linked_parts_ == 1 ? " connected part has no handle and is"
                                : " connected parts have no handle and are") +
      " linked to touching parts, or else to the nearest part");
  }
  return status;
}

/// Link components at openings that other components cover. The links are found only once and are
/// used for all lattices.
Status Solver::link_openings()
{
  if (this->covered_openings_)
  {
    return {};
  }
  CoveredOpenings openings;
  const Status status = link_covered_openings(this->context_, this->points_, this->triangles_,
    this->prepared_->surface.representative_of_vertex, openings);
  if (status.ok())
  {
    this->covered_openings_ = openings.count;
    this->links_ = std::move(openings.links);
  }
  return status;
}

/// Make the object that transfers weights from the lattice to the surface.
void Solver::attach_surface(Lattice& lattice)
{
  if (!this->surface_)
  {
    this->surface_ = std::make_unique<SimplexLocator>(this->points_, this->triangles_);
  }
  lattice.surface = std::make_unique<EmbeddedSurface>(
    this->points_, this->triangles_, *this->surface_, lattice.tets.mesh, lattice.tets.binding);
}

HandleInsertionOptions Solver::insertion_options(const Lattice& lattice) const
{
  HandleInsertionOptions insertion = this->weights_options_.insertion;
  insertion.spacing = 0.5;
  insertion.element_of = [&lattice](const Vec3& position)
  { return lattice.surface->tet_of(position); };
  return insertion;
}

/// Solve the weights on a lattice and transfer them to the surface without smoothing.
/// @param mesh_status  status of making the lattice.
Status Solver::solve_on_lattice(Lattice& lattice, Status mesh_status)
{
  SurfaceWeights& result = lattice.result;
  result.domain = WeightsDomain::embedding;
  WeightTerms terms;
  const Domain domain = lattice.surface->domain(lattice.tets.inside_fractions);
  const std::vector<Index> none(static_cast<std::size_t>(domain.points.rows()), -1);
  const Status transfer_status = this->transfer_terms_to(domain.points, none, terms, mesh_status);
  if (!transfer_status.ok())
  {
    return transfer_status;
  }
  using Smoothness = EmbeddedSurface::Smoothness;
  const auto transfer_values = [&](Smoothness smoothness)
  {
    return [&, smoothness](const Weights& solved, Weights& at_points) {
      return lattice.transfer_values(this->context_, solved, this->handles_, smoothness, at_points);
    };
  };
  return this->merge_status(std::move(mesh_status),
    this->solve(domain, {}, terms, this->insertion_options(lattice),
      transfer_values(Smoothness::as_interpolated), transfer_values(Smoothness::smoothed), result));
}

Status Solver::solve_in_embedding(SurfaceWeights& result)
{
  if (!this->region_ids_.empty())
  {
    return Status::invalid_input("regions need tets that preserve the surface's points; use domain "
                                 "volume instead of embedding");
  }
  Status status = this->reject_vertex_terms("embedding");
  if (!status.ok())
  {
    return status;
  }
  const double solved = 1.0 - this->transfer_fraction();
  LatticePtr best;
  {
    const ProgressRange range(this->context_, 0.0, solved);
    best = this->options_.check_resolution
      ? this->best_lattice()
      : this->embed(this->options_.resolution, single_lattice_tets);
  }
  const ProgressRange range(this->context_, solved, 1.0);
  return best->status.usable() ? this->finish(*best, result) : best->status;
}

/// Return the estimated time of the smoothed transfer to the surface, as a fraction of the total
/// time. For a dense surface and ten handles, the fraction is about half. Measured on surfaces with
/// one and four million triangles.
double Solver::transfer_fraction() const
{
  // Times in seconds on two threads: two constants for the transfer, then two constants for the
  // solves on all lattices.
  constexpr double seconds_per_point = 6e-6;
  constexpr double seconds_per_point_and_column = 1.5e-6;
  constexpr double lattice_seconds_per_point = 20e-6;
  constexpr double lattice_seconds = 1.0;
  const auto points = static_cast<double>(this->points_.rows());
  const auto columns = static_cast<double>(this->handles_.size());
  const double transfer = (seconds_per_point + seconds_per_point_and_column * columns) * points;
  return transfer / (transfer + lattice_seconds_per_point * points + lattice_seconds);
}

/// Solve on lattices of increasing resolution until the weights of two lattices agree (see
/// **guard** in surface_weights.h).
/// @return the finest lattice that converged. If no lattice converged, the finest lattice that has
/// a result. If no lattice has a result, a lattice whose status contains the reason.
LatticePtr Solver::best_lattice()
{
  const Index requested = this->options_.resolution;
  bool has_converged = false;
  // Use the finer lattice as `best`, unless only the coarser lattice converged, or only the coarser
  // lattice has a result.
  const auto compare = [&](LatticePtr& best, LatticePtr finer)
  {
    if (best->status.usable() && finer->status.usable())
    {
      for (Lattice* lattice : { best.get(), finer.get() })
      {
        const double rms = report_difference(
          best->result.weights, finer->result.weights, "guard", lattice->status.report);
        const Lattice& other = lattice == finer.get() ? *best : *finer;
        lattice->status.report.set("guard.resolution", other.resolution);
        has_converged = rms <= maximum_rms;
      }
    }
    if (finer->status.ok() || !best->status.usable() ||
      (finer->status.usable() && !best->status.ok()))
    {
      best = std::move(finer);
    }
  };
  LatticePtr best;
  {
    const ProgressRange range(this->context_, 0.0, lattice_progress_ends[0]);
    best = this->embed(
      requested > 0 ? std::max<Index>(4, (2 * requested + 1) / 3) : 0, first_lattice_tets);
  }
  if (best->resolution == 0 || best->status.code == StatusCode::canceled)
  {
    return best;
  }
  // Resolution of the last lattice. The solve on this lattice may have failed.
  Index resolution = best->resolution;
  for (int level = 1; level < maximum_lattices && !has_converged; ++level)
  {
    const double growth = level == 1 ? 1.5 : growth_to_third(*best);
    resolution = requested > 0
      ? requested
      : static_cast<Index>(std::ceil(growth * static_cast<double>(resolution)));
    const auto vertices = static_cast<double>(best->result.problem.vertex_count());
    const double seconds =
      predicted_seconds(static_cast<Index>(std::pow(growth, tet_exponent) * vertices),
        static_cast<Index>(this->handles_.size()));
    if (level > 1 && (requested > 0 || seconds > maximum_seconds))
    {
      break;
    }
    const ProgressRange range(
      this->context_, lattice_progress_ends[level - 1], lattice_progress_ends[level]);
    LatticePtr finer = this->embed(resolution, first_lattice_tets);
    if (finer->status.code == StatusCode::canceled)
    {
      return finer;
    }
    const bool has_lattice = finer->resolution > 0;
    compare(best, std::move(finer));
    if (!has_lattice)
    {
      break; // the lattice could not be made, because it is too fine
    }
  }
  Status& status = best->status;
  if (!has_converged && status.usable() && status.report.find("guard.resolution"))
  {
    const auto number = [&](const char* key) { return status.report.number(key, 0.0); };
    char text[200];
    std::snprintf(text, sizeof(text),
      "the weights on lattices of %.0f and %.0f cubes along the longest side differ by %.2g rms "
      "and %.2g at most: parts thinner than a cube are not resolved",
      std::min(number("embedding.resolution"), number("guard.resolution")),
      std::max(number("embedding.resolution"), number("guard.resolution")),
      number("guard.rms_difference"), number("guard.max_difference"));
    status.warnings.emplace_back(text);
  }
  return best;
}

/// Transfer a lattice's weights to the surface again, now with smoothing, and describe the
/// lattice's tets.
Status Solver::finish(Lattice& lattice, SurfaceWeights& result)
{
  const Phase phase(this->context_, "transfer");
  const Status transfer_status = this->transfer_weights(
    [&](const Weights& solved, Weights& at_points)
    {
      return lattice.transfer_values(
        this->context_, solved, this->handles_, EmbeddedSurface::Smoothness::smoothed, at_points);
    },
    lattice.result);
  if (!transfer_status.usable())
  {
    return transfer_status;
  }
  Status embedding_status = complete_embedding(this->context_, this->points_, this->triangles_,
    *this->prepared_, std::move(lattice.tets), lattice.result.tets);
  if (!embedding_status.usable())
  {
    return embedding_status;
  }
  rename_tet_method(embedding_status.report);
  embedding_status.warnings.clear(); // the lattice's status contains these warnings already
  Status status = this->merge_status(std::move(embedding_status), std::move(lattice.status));
  if (this->preview_.size() > 0)
  {
    report_difference(this->preview_, lattice.result.weights, "preview", status.report);
  }
  result = std::move(lattice.result);
  return status;
}

/// Add the reason for the choice of the domain to a status.
Status with_reason(Status status, const std::string& reason)
{
  status.report.set("domain_reason", Report::Value(reason));
  return status;
}

/// Choose the domain automatically (see WeightsDomain::automatic) and solve in this domain.
Status Solver::automatic(SurfaceWeights& result)
{
  Vec3 normal;
  const double diagonal = bounding_box(this->points_, this->triangles_).diagonal();
  if (diagonal > 0.0 && is_flat(this->points_, diagonal, normal))
  {
    const Status status = with_reason(this->solve_on_surface(result), "the shape is flat");
    return status.ok() ? status : this->fall_back_to_embedding(status, result);
  }
  const bool requested = has_vertex_terms(this->weights_options_.terms);
  if (requested || !this->region_ids_.empty())
  {
    return with_reason(this->solve_in_volume(result),
      requested ? "weight terms are given for single points" : "the surface has region labels");
  }
  {
    const ProgressRange range(this->context_, 0.0, 0.05);
    const Status status = this->prepare();
    if (!status.ok())
    {
      return status;
    }
  }
  const ProgressRange range(this->context_, 0.05, 1.0);
  const std::string reason = reason_against_volume(this->prepared_->surface);
  if (reason.empty())
  {
    return this->automatic_volume(result);
  }
  return with_reason(this->solve_in_embedding(result), reason);
}

/// Solve in the volume. If the tets are badly shaped or expensive, or if the volume fails, solve in
/// the embedding.
Status Solver::automatic_volume(SurfaceWeights& result)
{
  result.domain = WeightsDomain::volume;
  Status status = this->fill(result.tets);
  if (status.code == StatusCode::canceled)
  {
    return status;
  }
  if (status.usable())
  {
    const std::string reason =
      reason_against_tets(result.tets.mesh, static_cast<Index>(this->handles_.size()));
    if (!reason.empty())
    {
      return with_reason(this->solve_in_embedding(result), reason);
    }
    status = this->solve_volume(std::move(status), result);
  }
  return status.ok()
    ? with_reason(std::move(status), "the surface is closed and its tets are well shaped")
    : this->fall_back_to_embedding(status, result);
}

/// Solve in the embedding after another domain has failed. Add a warning that names this domain and
/// its error, and add the same information to the report (domain_fallback.*, domain_reason).
/// @param first status of the domain that failed; it is returned if the embedding fails, too.
Status Solver::fall_back_to_embedding(const Status& first, SurfaceWeights& result)
{
  if (first.code == StatusCode::canceled)
  {
    return first;
  }
  const std::string domain = to_string(result.domain);
  SurfaceWeights embedded;
  Status status = this->solve_in_embedding(embedded);
  if (!status.usable() || (first.usable() && !status.ok()))
  {
    return status.code == StatusCode::canceled ? status : first;
  }
  result = std::move(embedded);
  status.report.set("domain_fallback.from", Report::Value(domain));
  status.report.set("domain_fallback.status", to_string(first.code));
  status.report.set("domain_fallback.message", Report::Value(first.message));
  status.warnings.insert(status.warnings.begin(),
    "the weights were solved in a lattice that encloses the surface because domain " + domain +
      " failed: " + first.message);
  return with_reason(std::move(status), "domain " + domain + " failed");
}

Status Solver::run(SurfaceWeights& result)
{
  Status status;
  switch (this->options_.domain)
  {
    case WeightsDomain::surface:
      status = this->solve_on_surface(result);
      break;
    case WeightsDomain::volume:
      status = this->solve_in_volume(result);
      break;
    case WeightsDomain::cage:
      status = this->solve_in_cage(result);
      break;
    case WeightsDomain::embedding:
      status = this->solve_in_embedding(result);
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

namespace
{
/// Compute the weights in the working frame of the surface. Lengths in the report and the meshes
/// `tets` and `plane_cage` of the result are converted back from the frame. The coordinates in
/// `result.problem` remain those of the frame.
Status surface_weights_in_frame(ExecutionContext& context, const WorkingFrame& frame,
  PointsView points, TrianglesView triangles, const std::vector<Index>& region_ids,
  const Handles& handles, SurfaceWeightsOptions options, WeightsOptions weights_options,
  const WeightsMethod& method, SurfaceWeights& result)
{
  options.handle_elements.points = frame.to_frame(options.handle_elements.points);
  weights_options.terms = to_frame(frame, std::move(weights_options.terms));
  Status status = surface_weights(context, frame.to_frame(points), triangles, region_ids,
    to_frame(frame, handles), options, weights_options, method, result);
  result.problem.frame = frame;
  result.tets.mesh.points = frame.from_frame(result.tets.mesh.points);
  result.plane_cage.points = frame.from_frame(result.plane_cage.points);
  convert_lengths(frame, status.report);
  for (const char* key : { "spacing", "transfer_largest_distance" })
  {
    frame.convert_report(status.report, key, 1);
  }
  frame.convert_report(status.report, "cage.area", 2);
  for (const char* key : { "volume", "winding_volume" })
  {
    frame.convert_report(status.report, key, 3);
  }
  return status;
}
} // namespace

Status surface_weights(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const std::vector<Index>& region_ids, const Handles& handles,
  const SurfaceWeightsOptions& options, const WeightsOptions& weights_options,
  const WeightsMethod& method, SurfaceWeights& result)
{
  result = SurfaceWeights();
  const Status threshold = check_positive("winding_threshold", options.winding_threshold);
  if (!threshold.ok())
  {
    return threshold;
  }
  if (options.resolution != 0 && (options.resolution < 6 || options.resolution > 1000))
  {
    return Status::invalid_input(
      "the resolution of the embedding must be 0 (automatic) or between 6 and 1000");
  }
  WorkingFrame frame;
  Status valid = WorkingFrame::choose(points, triangles, "the surface", frame);
  if (valid.ok() && !frame.is_identity())
  {
    return surface_weights_in_frame(context, frame, points, triangles, region_ids, handles, options,
      weights_options, method, result);
  }
  // Check the handles before any tets are made.
  if (valid.ok())
  {
    valid = check_handles(handles);
  }
  if (valid.ok())
  {
    valid = check_regions(handles, region_ids, points.rows());
  }
  return valid.ok()
    ? Solver(context, points, triangles, region_ids, handles, options, weights_options, method)
        .run(result)
    : valid;
}

} // namespace bindpose

// Method cdt: constrained Delaunay tets by TetGen, with fallbacks for surfaces on which TetGen
// fails.
//
// A clean surface is passed to TetGen unchanged. The triangles of any other surface are first cut
// exactly along their crossings (the refinement), until they intersect only in shared vertices and
// edges. TetGen then fills the convex hull (or a box around it) with tets that keep all these
// triangles. The tets that the segmentation labels as outside are removed. If openings form most of
// the boundary of the enclosed region, small tets in a box are tried first, because the boundary of
// small tets can follow an isosurface of the winding number.
//
// TetGen 1.5 fails on some inputs with one set of switches and on other inputs with another set, so
// two sets are tried. Then both sets are tried with vertices rounded to a coarser grid, which welds
// nearly coincident vertices. Then the second set is tried with slightly displaced vertices, which
// separates the triangles of soups. The last attempt is a plain Delaunay triangulation of the
// refined vertices, or of the surface's vertices if too many triangles cross. The tets of this
// triangulation need not respect the triangles.
//
// cdt_tets_fill.cpp then inserts vertices into the tets that are kept, and improves these tets.
#include "inside/cdt_tets.h"

#include "base/number_text.h"
#include "base/side_task.h"
#include "helper/mesher_process.h"
#include "tets/tet_improvement.h"
#include "tets/tet_quality.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace bindpose
{

/// Command-line switches and domain of a TetGen run.
struct CdtTets::TetgenSetup
{
  std::string switches;
  bool box; ///< true: fill a box around the surface; false: fill the surface's convex hull
};

struct CdtTets::TetgenRun
{
  Status status;
  MesherResult answer;
};

/// A modification of the vertices before the refinement.
struct CdtTets::Perturbation
{
  const char* name;
  /// Spacing of the grid to which vertices are rounded, as a fraction of the bounding-box diagonal.
  double snap;
  double jitter; ///< largest displacement, as a fraction of the bounding-box diagonal

  bool is_active() const { return this->snap > 0.0 || this->jitter > 0.0; }
};

namespace
{
/// Number of evaluations of TetGen's predicates that counts as one second. Long runs evaluate 3 to
/// 10 million in a second of processor time.
constexpr double tetgen_work_per_second = 5e6;

/// Map an integer to a number in [-1, 1), identically on every machine (splitmix64).
double pseudo_random(std::uint64_t n)
{
  std::uint64_t z = (n + 1) * 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-52 - 1.0;
}

} // namespace

void AttemptLog::add(const std::string& attempt, double seconds, const Status& status)
{
  this->names_.push_back(attempt);
  this->seconds_.push_back(seconds);
  this->outcomes_.push_back(status.ok() ? "ok" : status.message);
}

void AttemptLog::report(Report& report) const
{
  if (!this->names_.empty())
  {
    report.set("rungs[].name", Report::Value(this->names_));
    report.set("rungs[].seconds", Report::Value(this->seconds_));
    report.set("rungs[].outcome", Report::Value(this->outcomes_));
  }
}

Status wrong_volume_error(double volume, const EnclosedRegion& inside)
{
  return Status::failure(StatusCode::internal_error, inside.relative_volume(volume));
}

CdtTets::CdtTets(ExecutionContext& context, const RepairedSurface& surface, EnclosedRegion& inside,
  const CdtOptions& options, AttemptLog& log)
  : surface_(surface), inside_(inside), options_(options), log_(log), context_(context),
    diagonal_(bounding_box(surface.points).diagonal()), start_(context.elapsed_seconds())
{
}

Status CdtTets::build(double seconds)
{
  this->deadline_ = this->context_.elapsed_seconds() + seconds;
  const Perturbation no_perturbation{ "", 0.0, 0.0 };
  Status status;
  if (this->surface_.is_clean())
  {
    const Phase phase(this->context_, "tetgen", 0.0, 0.6);
    this->original_ = this->surface_.original_vertices;
    MesherData data;
    data.points = this->surface_.points;
    data.triangles = this->surface_.triangles;
    // Without the switch `c`, TetGen removes the tets outside the surface.
    status = this->try_tetgen(
      { this->options_.keep_outside ? "pYcA" : "pYA", false }, no_perturbation, data);
    if (status.ok() || this->is_final(status))
    {
      return status;
    }
  }
  MesherData first_refined;
  std::vector<Index> first_original;
  const Perturbation perturbations[] = { no_perturbation, { ", vertices rounded", 0x1p-20, 0.0 },
    { ", vertices moved by 1e-5", 0.0, 1e-5 } };
  for (const Perturbation& move : perturbations)
  {
    MesherData refined;
    status = this->refine(move, refined);
    if (status.ok())
    {
      if (first_refined.points.rows() == 0)
      {
        first_refined = refined;
        first_original = this->original_;
      }
      status = this->try_switches(move, refined);
    }
    if (status.ok() && move.is_active())
    {
      this->warnings_.push_back(
        "the surface could be tetrahedralized only after its vertices were moved by up to " +
        short_number(std::max(move.snap, move.jitter)) + " of its bounding-box diagonal");
    }
    if (status.ok() || this->is_final(status))
    {
      return status;
    }
    if (this->too_many_crossings_ || this->time_budget_is_used())
    {
      break; // moving vertices would not remove crossings, or the time budget is used up
    }
  }
  if (this->too_many_crossings_ && first_refined.points.rows() == 0)
  {
    first_refined.points = this->surface_.points;
    first_original = this->surface_.original_vertices;
  }
  if (first_refined.points.rows() > 0)
  {
    this->original_ = first_original;
    return this->try_delaunay(first_refined);
  }
  return status;
}

/// Report whether the refinements and TetGen runs have used up their time budget. The budget does
/// not include the last attempt, a Delaunay triangulation, which takes about a tenth of the budget.
bool CdtTets::time_budget_is_used() const
{
  constexpr double base_limit = 8.0; // seconds
  constexpr double seconds_per_triangle = 8e-5;
  return this->job_seconds_ >
    base_limit + seconds_per_triangle * static_cast<double>(this->surface_.triangles.rows());
}

/// Run TetGen on refined triangles with each set of switches in turn. If the surface has wide
/// openings, small tets are tried first. In an opening, an isosurface of the winding number bounds
/// the region. Only small tets can follow this isosurface, which may extend beyond the convex hull.
/// Small tets are not tried first if near_threshold_fraction() is very large, because the region is
/// then too thin for small tets (for example, a thin sliver in front of a sheet).
Status CdtTets::try_switches(const Perturbation& move, const MesherData& refined)
{
  const Phase phase(this->context_, "tetgen", 0.4, 1.0);
  constexpr double minimum_near_fraction = 1.5;
  constexpr double maximum_near_fraction = 14.0;
  const double near_fraction = this->inside_.near_threshold_fraction();
  const bool fine_first =
    near_fraction > minimum_near_fraction && near_fraction < maximum_near_fraction;
  bool fine_tried = false;
  bool fine_is_wrong = false;
  Status status;
  const auto is_finished = [&]() { return status.ok() || this->is_final(status); };
  const auto try_fine = [&]()
  {
    fine_tried = true;
    status = this->try_fine_tets(move, refined);
    fine_is_wrong = this->wrong_volume_;
  };
  if (fine_first)
  {
    try_fine();
    if (is_finished())
    {
      return status;
    }
  }
  // Switch `T` sets the tolerance of TetGen's test for coplanar triangles. With the default of
  // 1e-8, TetGen treats some cut triangles as coplanar although they are not, and crashes. A third
  // set of switches would not help: on triangles on which TetGen crashed with both of these sets,
  // only one of thirty other sets succeeded (measured).
  std::vector<TetgenSetup> setups{ { "pYcAT1e-12", false }, { "pYAT1e-16", true } };
  if (move.jitter > 0.0)
  {
    setups.erase(setups.begin()); // after random displacements no triangles are coplanar
  }
  // If the first set of switches takes long, the run with the last set is started in parallel.
  constexpr double usual_delay = 1.0; // seconds
  constexpr double unlimited_delay = 1e6;
  const double delay = can_run_two_meshers(refined.triangles.rows(), this->options_.memory_limit)
    ? usual_delay
    : unlimited_delay;
  TetgenRun last_run;
  SideTask last(this->context_, delay,
    [&](ExecutionContext& side) { last_run = this->run_tetgen(side, setups.back(), refined); });
  for (std::size_t i = 0; i < setups.size(); ++i)
  {
    if (i + 1 < setups.size())
    {
      status = this->try_tetgen(setups[i], move, refined);
    }
    else
    {
      last.finish();
      status = this->evaluate_run(setups[i], move, last_run);
    }
    if (this->timed_out_ || (!status.ok() && this->time_budget_is_used()))
    {
      break; // other switches would reach the limit of a run too, or the time budget is used up
    }
    if (!is_finished() && this->wrong_volume_ && !fine_tried)
    {
      try_fine();
    }
    // If the tets of this run and those of try_fine_tets() have a wrong volume, more runs of TetGen
    // cannot help.
    this->refinement_is_useless_ = fine_is_wrong && this->wrong_volume_;
    if (is_finished())
    {
      break;
    }
  }
  return status;
}

/// Compute tets in a box around the region. The tets are small enough to resolve the boundary of
/// the region in the openings between triangles.
Status CdtTets::try_fine_tets(const Perturbation& move, const MesherData& refined)
{
  this->wrong_volume_ = false;
  if (this->fine_fails_)
  {
    return Status::failure(StatusCode::internal_error, "a mesh of small tets could not be created");
  }
  const double box = bounding_box(refined.points).size().prod();
  constexpr double tets_inside = 400.0;
  // Maximum number of tets in the box if every tet had the maximum volume. TetGen's grading creates
  // additional tets.
  constexpr double maximum_tets = 2e4;
  const double bound = std::max(
    std::min(this->volume_bound(), this->inside_.volume() / tets_inside), box / maximum_tets);
  const Status status = this->try_tetgen({ "pAq2a" + short_number(bound), true }, move, refined);
  this->fine_fails_ = !status.ok() && !this->wrong_volume_;
  this->timed_out_ = false; // runs with larger tets may still finish within the time limit
  return status;
}

Status CdtTets::try_tetgen(
  const TetgenSetup& setup, const Perturbation& move, const MesherData& input)
{
  return this->evaluate_run(setup, move, this->run_tetgen(this->context_, setup, input));
}

/// Run TetGen with a limit on the number of evaluations of its predicates. On furniture models,
/// 98 % of the successful runs need less than half of this number. Thread-safe.
CdtTets::TetgenRun CdtTets::run_tetgen(
  ExecutionContext& context, const TetgenSetup& setup, const MesherData& input) const
{
  const double seconds = 1.5 + 1e-4 * static_cast<double>(input.triangles.rows());
  // The time limit stops TetGen on slow machines and in endless loops that evaluate no predicates.
  constexpr double slack = 4.0;
  TetgenRun run;
  run.status = this->run_job(context,
    { "tetgen", "--switches", setup.switches, "--box", setup.box ? "1" : "0", "--work",
      std::to_string(seconds * tetgen_work_per_second) },
    input, slack * seconds, run.answer);
  return run;
}

/// Keep the tets of a TetGen run that are inside, and log the attempt.
Status CdtTets::evaluate_run(
  const TetgenSetup& setup, const Perturbation& move, const TetgenRun& run)
{
  const double start = this->context_.elapsed_seconds();
  this->wrong_volume_ = false;
  const Report& report = run.answer.report;
  this->timed_out_ = run.answer.timed_out || report.number("work_limit_reached", 0.0) > 0.0;
  const double work = report.number("work", 0.0);
  this->job_seconds_ += work > 0.0 ? work / tetgen_work_per_second : run.answer.seconds;
  const Status status = run.status.ok() ? this->keep_inside(run.answer.data) : run.status;
  this->log_.add("tetgen " + setup.switches + (setup.box ? " in a box" : "") + move.name,
    run.answer.seconds + this->context_.elapsed_seconds() - start, status);
  return status;
}

Status CdtTets::try_delaunay(const MesherData& refined)
{
  const double start = this->context_.elapsed_seconds();
  // The Delaunay triangulation need not contain the surface's triangles, so some vertices can be
  // omitted. Nearly coincident vertices would create slivers, so one vertex per small box is kept.
  constexpr double box_size = 1e-7; // size of a box, in bounding-box diagonals
  MesherData input = refined;
  std::set<std::array<double, 3>> boxes;
  Index kept = 0;
  Index original_count = 0;
  for (Index v = 0; v < refined.points.rows(); ++v)
  {
    std::array<double, 3> box{};
    for (int k = 0; k < 3; ++k)
    {
      box[k] = std::floor(refined.points(v, k) / (box_size * this->diagonal_));
    }
    if (boxes.insert(box).second)
    {
      input.points.row(kept) = refined.points.row(v);
      if (v < static_cast<Index>(this->original_.size()))
      {
        this->original_[kept] = this->original_[v];
        original_count = kept + 1;
      }
      ++kept;
    }
  }
  input.points.conservativeResize(kept, 3);
  input.triangles.resize(0, 3);
  this->original_.resize(static_cast<std::size_t>(original_count));
  MesherResult answer;
  const double seconds = 5.0 + 2e-4 * static_cast<double>(input.points.rows());
  Status status = this->run_job(this->context_, { "delaunay" }, input, seconds, answer);
  if (status.ok())
  {
    status = this->keep_inside(answer.data);
  }
  this->log_.add("delaunay of the vertices", this->context_.elapsed_seconds() - start, status);
  if (status.ok())
  {
    this->warnings_.emplace_back(
      "the boundary of the tets does not match the surface's triangles everywhere");
  }
  return status;
}

/// Displace the vertices, then cut the triangles along their crossings.
Status CdtTets::refine(const Perturbation& move, MesherData& refined)
{
  const Phase phase(this->context_, "refine", 0.0, 0.4);
  const double start = this->context_.elapsed_seconds();
  RepairedSurface moved;
  bool rounded = false;
  Status status = this->move_vertices(move, moved);
  if (status.ok())
  {
    this->original_ = moved.original_vertices;
    MesherResult answer;
    MesherData input;
    input.points = std::move(moved.points);
    input.triangles = std::move(moved.triangles);
    const double size = static_cast<double>(input.triangles.rows());
    status = this->run_job(this->context_, { "refine" }, input, 5.0 + 1e-4 * size, answer);
    this->job_seconds_ += answer.seconds;
    this->too_many_crossings_ = answer.timed_out || answer.report.number("too_many", 0.0) > 0.0;
    rounded = answer.report.number("rounded", 0.0) > 0.0;
    refined = std::move(answer.data);
    if (status.ok() && refined.triangles.rows() == 0)
    {
      status = Status::failure(
        StatusCode::internal_error, "all triangles became degenerate and were removed");
    }
  }
  this->log_.add(std::string("refine") + move.name + (rounded ? ", rounded to 2^-42" : ""),
    this->context_.elapsed_seconds() - start, status);
  return status;
}

Status CdtTets::move_vertices(const Perturbation& move, RepairedSurface& moved)
{
  if (move.snap > 0.0)
  {
    RepairOptions repair;
    repair.orient = false;
    repair.count_self_intersections = false;
    repair.snap = move.snap;
    Status status = repair_surface(
      this->context_, this->surface_.points, this->surface_.triangles, repair, moved);
    if (status.ok() && moved.triangles.rows() == 0)
    {
      status = Status::failure(
        StatusCode::internal_error, "all triangles became degenerate and were removed");
    }
    for (Index& v : moved.original_vertices)
    {
      v = this->surface_.original_vertices[v];
    }
    return status;
  }
  moved.points = this->surface_.points;
  moved.triangles = this->surface_.triangles;
  moved.original_vertices = this->surface_.original_vertices;
  const double size = move.jitter * this->diagonal_;
  for (Index k = 0; size > 0.0 && k < moved.points.size(); ++k)
  {
    moved.points.data()[k] += size * pseudo_random(static_cast<std::uint64_t>(k));
  }
  return {};
}

/// Run one job of the helper executable bindpose-mesher. The job ends after `seconds` of processor
/// time or at the deadline.
Status CdtTets::run_job(ExecutionContext& context, const std::vector<std::string>& arguments,
  const MesherData& input, double seconds, MesherResult& answer) const
{
  const double left = this->deadline_ - this->context_.elapsed_seconds();
  if (left <= 0.0)
  {
    return Status::failure(StatusCode::internal_error, "the time limit was reached");
  }
  MesherRequest request;
  request.arguments = arguments;
  request.memory_limit = this->options_.memory_limit;
  // On a busy machine the helper may get only a quarter of the time of a processor.
  constexpr double slack = 4.0;
  request.processor_limit = seconds;
  request.time_limit = std::min(left, slack * seconds);
  if (arguments.front() == "refine")
  {
    // Fraction of the job's time limit after which the helper stops by itself. The helper reports
    // its progress relative to this time.
    constexpr double helper_time_fraction = 0.9;
    request.arguments.insert(request.arguments.end(),
      { "--time", std::to_string(helper_time_fraction * std::min(left, seconds)) });
  }
  return run_mesher(context, request, input, answer);
}

/// Report whether no other attempt can succeed after this status.
bool CdtTets::is_final(const Status& status) const
{
  return status.code == StatusCode::canceled || status.code == StatusCode::unavailable ||
    (!status.ok() &&
      (this->refinement_is_useless_ || this->context_.elapsed_seconds() >= this->deadline_));
}

/// Keep the tets that the segmentation labels as inside. Return ok if their volume matches the
/// volume of the enclosed region.
Status CdtTets::keep_inside(const MesherData& data)
{
  const Phase phase(this->context_, "label", 0.9, 1.0);
  this->wrong_volume_ = false;
  Eigen::VectorXd w;
  Status status = this->inside_.label(this->context_, data, w);
  if (!status.ok())
  {
    return status;
  }
  if (this->inside_.labels_are_exact() ||
    this->options_.segmentation.method == SegmentationMethod::threshold)
  {
    return this->segment_and_store(data, w, SegmentationMethod::threshold);
  }
  const double start = this->context_.elapsed_seconds();
  status = this->segment_and_store(data, w, SegmentationMethod::graph_cut);
  if (status.ok() || !this->wrong_volume_)
  {
    return status;
  }
  // The graph cut changes the volume too much if the surface consists mostly of holes, or is thin.
  this->log_.add("graph cut", this->context_.elapsed_seconds() - start, status);
  return this->segment_and_store(data, w, SegmentationMethod::threshold);
}

Status CdtTets::segment_and_store(
  const MesherData& data, const Eigen::VectorXd& w, SegmentationMethod method)
{
  SegmentationOptions options = this->options_.segmentation;
  options.method = method;
  Segmentation segmentation;
  Status status = segment_tets(this->context_, data.points, data.tets, w, options, segmentation);
  if (!status.ok())
  {
    return status;
  }
  Tets kept(data.tets.rows(), 4);
  Index count = 0;
  for (Index t = 0; t < data.tets.rows(); ++t)
  {
    if (segmentation.inside[t])
    {
      kept.row(count++) = data.tets.row(t);
    }
  }
  kept.conservativeResize(count, 4);
  // For millions of tets, each of the following steps takes up to a few seconds. Therefore a cancel
  // request is checked between them.
  std::vector<TetFacet> facets = tet_facets(kept);
  if (this->context_.canceled())
  {
    return Status::canceled();
  }
  // A tet without a neighbor is removed if its volume is less than this fraction of the total. Such
  // tets occur where the winding number varies around the threshold.
  const double lone_tet_fraction = this->inside_.labels_are_exact() ? 1e-8 : 1e-4;
  remove_small_components(data.points, kept, facets, lone_tet_fraction);
  if (this->context_.canceled())
  {
    return Status::canceled();
  }
  peel_slivers(data.points, kept, facets, flat_height * this->diagonal_);
  if (count == 0 && this->inside_.labels_are_exact())
  {
    this->refinement_is_useless_ = true;
    return this->inside_.nothing_enclosed_error();
  }
  status = this->swap_flat(data.points, kept, facets);
  if (status.ok() && this->context_.canceled())
  {
    return Status::canceled();
  }
  status = status.ok() ? check_tets(data.points, kept, facets) : status;
  if (!status.ok())
  {
    return status;
  }
  const double volume = tet_volumes(data.points, kept).sum();
  const double misfit = this->inside_.misfit(volume);
  // The graph cut may choose a smooth boundary at the cost of a wrong volume. If the misfit exceeds
  // this value, the tets are labeled by the threshold instead.
  constexpr double maximum_cut_misfit = 0.05;
  const bool fits = this->inside_.fits(volume) &&
    (method == SegmentationMethod::threshold || misfit <= maximum_cut_misfit);
  this->wrong_volume_ = !fits;
  if (fits || misfit < this->misfit_)
  {
    // The tets with the smallest misfit are kept in case no later attempt has the right volume.
    this->misfit_ = misfit;
    this->volume_ = volume;
    this->mesh_.points = data.points;
    this->mesh_.tets = kept;
    if (this->options_.keep_outside)
    {
      this->store_all_tets(data, w, segmentation.inside);
    }
    this->mesh_original_ = this->original_;
    this->report_ = Report();
    this->report_.set("segmentation", to_string(method));
    if (method == SegmentationMethod::graph_cut)
    {
      this->report_.set("energy", segmentation.energy);
      this->report_.set("threshold_energy", segmentation.threshold_energy);
      this->report_.set("counts.changed_by_cut", segmentation.changed);
    }
  }
  return fits    ? Status()
    : count == 0 ? Status::failure(StatusCode::internal_error, "no tet is inside")
                 : wrong_volume_error(volume, this->inside_);
}

/// Remove tets without volume (up to rounding errors), which TetGen sometimes creates away from the
/// boundary. Edges and facets around such tets are swapped until the tets disappear.
Status CdtTets::swap_flat(const Points& points, Tets& tets, std::vector<TetFacet>& facets)
{
  // Smallest accepted volume of a tet, relative to the cube of its longest edge.
  constexpr double rounding = 1e-12;
  const Eigen::VectorXd volumes = tet_volumes(points, tets);
  bool any = false;
  for (Index t = 0; t < tets.rows() && !any; ++t)
  {
    any = !(volumes[t] > rounding * std::pow(longest_edge(points, tets, t), 3.0));
  }
  if (!any)
  {
    return {};
  }
  TetMesh mesh{ points, tets };
  ImproveOptions options;
  options.angle = 1e-8; // degrees
  options.release_angle = 0.0; // held (constrained) vertices do not move
  options.keep_boundary = true;
  Improvement improvement;
  if (!improve_tets(this->context_, mesh,
        std::vector<char>(static_cast<std::size_t>(points.rows()), 1), {}, options, improvement))
  {
    return Status::canceled();
  }
  tets = std::move(mesh.tets);
  facets = tet_facets(tets);
  return {};
}

/// Store all tets, inside and outside, except those that rounding has flattened.
void CdtTets::store_all_tets(
  const MesherData& data, const Eigen::VectorXd& w, const std::vector<char>& inside)
{
  const double minimum_volume = 1e-15 * std::pow(this->diagonal_, 3.0);
  const Eigen::VectorXd volumes = tet_volumes(data.points, data.tets);
  this->mesh_.tets = data.tets;
  this->winding_numbers_ = w;
  this->is_inside_ = inside;
  Index count = 0;
  for (Index t = 0; t < data.tets.rows(); ++t)
  {
    if (volumes[t] > minimum_volume)
    {
      this->mesh_.tets.row(count) = data.tets.row(t);
      this->winding_numbers_[count] = w[t];
      this->is_inside_[count++] = inside[t];
    }
  }
  this->mesh_.tets.conservativeResize(count, 4);
  this->winding_numbers_.conservativeResize(count);
  this->is_inside_.resize(static_cast<std::size_t>(count));
}

Status CdtTets::complete()
{
  this->refinement_is_useless_ = false;
  this->deadline_ = std::max(this->start_ + this->options_.time_limit, this->deadline_);
  if (this->options_.keep_outside)
  {
    this->renumber(); // no vertices are inserted, because the segmented tets must not change
    return {};
  }
  Status status;
  if (!this->options_.bare || !this->options_.handles.empty())
  {
    const Phase phase(this->context_, "fill", 0.0, 0.35);
    status = this->fill();
    if (!status.ok() && status.code != StatusCode::canceled)
    {
      this->warnings_.push_back("no interior vertices were added (" + status.message + ")");
    }
  }
  if (!this->options_.bare && status.code != StatusCode::canceled)
  {
    const Phase phase(this->context_, "improve", 0.35, 1.0);
    status = this->improve();
  }
  this->renumber();
  return status.code == StatusCode::canceled ? status : Status();
}

double CdtTets::mean_surface_edge() const
{
  double sum = 0.0;
  const Triangles& triangles = this->surface_.triangles;
  for (Index t = 0; t < triangles.rows(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      sum += (this->surface_.points.row(triangles(t, k)) -
        this->surface_.points.row(triangles(t, (k + 1) % 3)))
               .norm();
    }
  }
  return sum / static_cast<double>(std::max<Index>(1, triangles.size()));
}

/// Return the volume of a regular tet. Its edge length is `interior_edge` (or a default of 0.04 of
/// the bounding-box diagonal), but at least a third of the mean edge length of the surface.
double CdtTets::volume_bound() const
{
  constexpr double default_edge_length = 0.04;
  const double fraction =
    this->options_.interior_edge > 0.0 ? this->options_.interior_edge : default_edge_length;
  return regular_tet_volume *
    std::pow(std::max(fraction * this->diagonal_, this->mean_surface_edge() / 3.0), 3.0);
}

/// Renumber the vertices: the input's vertices first, in their input order, then the others. Remove
/// unused vertices.
void CdtTets::renumber()
{
  std::vector<char> used(static_cast<std::size_t>(this->mesh_.points.rows()), 0);
  for (Index k = 0; k < this->mesh_.tets.size(); ++k)
  {
    used[this->mesh_.tets.data()[k]] = 1;
  }
  const auto original_count = static_cast<Index>(this->mesh_original_.size());
  std::vector<Index> id(used.size(), -1);
  std::vector<Index> original_vertices;
  for (std::size_t v = 0; v < used.size(); ++v)
  {
    if (used[v])
    {
      id[v] = static_cast<Index>(original_vertices.size());
      original_vertices.push_back(
        static_cast<Index>(v) < original_count ? this->mesh_original_[v] : -1);
    }
  }
  Points points(static_cast<Index>(original_vertices.size()), 3);
  for (std::size_t v = 0; v < used.size(); ++v)
  {
    if (used[v])
    {
      points.row(id[v]) = this->mesh_.points.row(static_cast<Index>(v));
    }
  }
  for (Index k = 0; k < this->mesh_.tets.size(); ++k)
  {
    this->mesh_.tets.data()[k] = id[this->mesh_.tets.data()[k]];
  }
  this->mesh_.points = std::move(points);
  this->mesh_original_ = std::move(original_vertices);
}

} // namespace bindpose

// Choice of the meshing method and check of its result.
//
// Method automatic tries cdt (cdt_tets.h), then a cut lattice (lattice_tets.h), then Delaunay
// refinement (remesh_tets.h), then a finer lattice. Method remesh is Delaunay refinement; if it
// fails, a lattice is cut. The volume of the tets is compared with the volume of {w >= threshold}.
// If no attempt has the right volume, the tets with the smallest misfit are used, with a warning.
// The methods embed (embedding_tets.h), wrap (wrap_surface.h) and ftetwild (ftetwild_process.h) are
// not part of this sequence. Method wrap fills its closed surface with tets in the same way as cdt.
#include "inside/tetrahedralize.h"

#include "base/number_text.h"
#include "base/side_task.h"
#include "embedding/embedding_tets.h"
#include "geometry/working_frame.h"
#include "helper/child_process.h"
#include "helper/mesher_process.h"
#include "inside/cdt_tets.h"
#include "inside/enclosed_region.h"
#include "inside/ftetwild_process.h"
#include "inside/lattice_tets.h"
#include "inside/remesh_tets.h"
#include "inside/surface_distance.h"
#include "inside/wrap_surface.h"
#include "tets/tet_quality.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

namespace bindpose
{

namespace
{
/// Progress of method cdt when CdtTets::build() ends and CdtTets::complete() begins.
constexpr double cdt_build_end = 0.45;

/// Return the status with which method automatic fails. Whatever the cause, the message recommends
/// method embed. A canceled status is returned unchanged.
Status recommend_embedding(Status status)
{
  if (status.code == StatusCode::canceled)
  {
    return status;
  }
  status.code = StatusCode::invalid_input;
  status.message += "; method embed (--method embed) encloses any surface in a lattice of tets";
  return status;
}

SegmentationOptions segmentation_options(const TetrahedralizeOptions& options)
{
  return { options.segmentation, options.winding_threshold, options.cut_smoothness,
    options.cut_sigma };
}

class Tetrahedralizer
{
public:
  Tetrahedralizer(ExecutionContext& context, PointsView points, TrianglesView triangles,
    PreparedSurface& prepared, const TetrahedralizeOptions& options, TetrahedralizeResult& result)
    : points_(points), triangles_(triangles), options_(options), result_(result), context_(context),
      surface_(prepared.surface), inside_(prepared.inside),
      box_(bounding_box(prepared.surface.points)),
      time_limit_(options.time_limit > 0.0
          ? options.time_limit
          : std::max(minimum_time_limit,
              time_limit_per_triangle * static_cast<double>(prepared.surface.triangles.rows()))),
      preparation_report_(prepared.report), report_(prepared.report), warnings_(prepared.warnings)
  {
    result.defects = prepared.defects;
  }

  Status run()
  {
    return this->make_and_check([this]() { return this->run_method(); });
  }
  /// Complete method embed with tets that were computed by the caller.
  Status run(EmbeddingTets embedding)
  {
    return this->make_and_check([&]() { return this->use_embedding(std::move(embedding)); });
  }

private:
  template <typename MakeTets>
  Status make_and_check(const MakeTets& make_tets)
  {
    Status status = this->check_not_flat();
    if (status.ok())
    {
      const Phase phase(this->context_, "tetrahedralize", 0.0, 0.95);
      status = make_tets();
    }
    if (status.ok())
    {
      const Phase phase(this->context_, "check", 0.95, 1.0);
      status = this->check();
    }
    if (!status.usable())
    {
      this->result_ = TetrahedralizeResult();
    }
    status.warnings.insert(status.warnings.begin(), this->warnings_.begin(), this->warnings_.end());
    Report report = this->report_;
    this->log_.report(report);
    report.merge(status.report);
    status.report = report;
    return status;
  }

  Status check_not_flat() const
  {
    const bool accepts_flat_surface =
      this->options_.method == TetMethod::embed || this->options_.method == TetMethod::wrap;
    return this->surface_.found.flat && !accepts_flat_surface
      ? Status::invalid_input(
          "the surface is flat: all its points are in one plane, so it encloses no volume")
      : Status();
  }

  // ---- Attempts of the methods ----

  Status run_method()
  {
    this->method_start_ = this->context_.elapsed_seconds();
    if (this->options_.method == TetMethod::embed)
    {
      return this->embed();
    }
    if (this->options_.method == TetMethod::wrap)
    {
      return this->wrap();
    }
    if (this->options_.method == TetMethod::ftetwild)
    {
      return this->ftetwild();
    }
    if (this->options_.method == TetMethod::remesh)
    {
      Status status = this->remesh(this->remesh_resolution());
      if (status.code == StatusCode::unavailable)
      {
        status.message +=
          "; use method cdt (--method cdt), which also fills thin parts, or a resolution above " +
          std::to_string(this->remesh_resolution()) + " (--resolution) for smaller tets";
      }
      return status.ok() ? status : this->use_lattice_tets(status);
    }
    const bool automatic = this->options_.method == TetMethod::automatic;
    const Status specks = automatic ? this->inside_.check_not_specks(this->surface_) : Status();
    if (!specks.ok())
    {
      return recommend_embedding(specks);
    }
    const CdtOptions options = this->cdt_options();
    CdtTets cdt(this->context_, this->surface_, this->inside_, options, this->log_);
    if (automatic)
    {
      this->prepare_refinement();
    }
    Status status;
    {
      const Phase phase(this->context_, "cdt", 0.0, cdt_build_end);
      // Fraction of the time limit for build(); the rest is for inserting vertices inside.
      constexpr double fraction = 0.75;
      status = cdt.build(fraction * this->time_limit_);
    }
    if (status.ok() && this->options_.quality == 0.0)
    {
      this->refinement_task_.reset(); // the refinement is not needed
    }
    if (status.ok() || status.code == StatusCode::canceled)
    {
      status = status.ok() ? this->use_cdt_tets(cdt) : status;
      return automatic && status.ok() && !this->is_good_enough() ? this->improve_cdt_by_remesh()
                                                                 : status;
    }
    const std::string cdt_failure = status.message;
    if (automatic)
    {
      status = this->replace_cdt();
      if (status.ok())
      {
        this->warn("method remesh replaced method cdt (" + cdt_failure +
          "); the new tets do not preserve the surface's triangles");
      }
      if (status.ok() || status.code == StatusCode::canceled)
      {
        return status;
      }
    }
    // If no attempt has the right volume, use the tets with the smallest misfit.
    if (cdt.misfit() < maximum_misfit && cdt.misfit() <= this->lattice_misfit_)
    {
      this->warn(wrong_volume_error(cdt.volume(), this->inside_).message);
      return this->use_cdt_tets(cdt);
    }
    status = this->use_lattice_tets(status);
    return automatic && !status.ok() ? recommend_embedding(status) : status;
  }

  CdtOptions cdt_options() const
  {
    CdtOptions options;
    options.segmentation = segmentation_options(this->options_);
    options.time_limit = this->time_limit_;
    options.memory_limit = this->options_.memory_limit;
    options.bare = this->options_.bare;
    options.interior_edge = this->options_.interior_edge;
    options.keep_outside = this->options_.keep_outside;
    options.handles = this->options_.handles;
    return options;
  }

  Status use_cdt_tets(CdtTets& cdt, double begin = cdt_build_end, double end = 1.0)
  {
    const Phase phase(this->context_, "cdt", begin, end);
    Status status = cdt.complete();
    this->report_.set("method", to_string(TetMethod::cdt));
    this->report_.merge(cdt.report());
    this->result_.mesh = std::move(cdt.mesh());
    this->inside_tets_ = cdt.inside();
    this->result_.winding_numbers = cdt.winding_numbers();
    this->result_.original_vertices = std::move(cdt.original_vertices());
    this->warnings_.insert(this->warnings_.end(), cdt.warnings().begin(), cdt.warnings().end());
    this->find_handles();
    return status;
  }

  /// Find the vertices at the points of the handles.
  void find_handles()
  {
    const Points& handles = this->options_.handles.points;
    if (handles.rows() == 0)
    {
      return;
    }
    std::map<std::array<double, 3>, Index> vertices;
    const Points& points = this->result_.mesh.points;
    for (Index v = points.rows() - 1; v >= 0; --v)
    {
      vertices[{ points(v, 0), points(v, 1), points(v, 2) }] = v;
    }
    Index found = 0;
    for (Index h = 0; h < handles.rows(); ++h)
    {
      const auto entry = vertices.find({ handles(h, 0), handles(h, 1), handles(h, 2) });
      this->result_.handle_vertices.push_back(entry == vertices.end() ? -1 : entry->second);
      found += entry != vertices.end();
    }
    this->report_.set("counts.handle_points", Report::Value(handles.rows()));
    this->report_.set("counts.handle_vertices", Report::Value(found));
  }

  /// Use the lattice tets with the smallest misfit, with a warning. Return `status` if there are no
  /// lattice tets.
  Status use_lattice_tets(const Status& status)
  {
    if (!this->lattice_is_usable() || status.code == StatusCode::canceled)
    {
      return status;
    }
    this->warn(status.message + "; parts thinner than a lattice cube are missing");
    this->result_.mesh = std::move(this->lattice_mesh_);
    return this->finish_remeshed(TetMethod::remesh);
  }

  double angle() const
  {
    const TetMesh& mesh = this->result_.mesh;
    return measure_tets(mesh.points, mesh.tets).min_dihedral_angle;
  }

  bool is_good_enough() const
  {
    return this->options_.quality == 0.0 || this->angle() >= this->options_.quality;
  }

  /// Run another attempt. Keep the tets of this attempt only if their smallest dihedral angle is
  /// larger than that of the current tets.
  /// @return ok or canceled.
  template <typename Attempt>
  Status keep_if_better(const Attempt& attempt)
  {
    const double angle = this->angle();
    const Report report = std::exchange(this->report_, this->preparation_report_);
    TetrahedralizeResult result;
    result.defects = this->result_.defects;
    std::swap(result, this->result_);
    const Status status = attempt();
    if (status.code == StatusCode::canceled)
    {
      return status;
    }
    if (!status.ok() || this->angle() <= angle)
    {
      this->report_ = report;
      this->result_ = std::move(result);
    }
    return {};
  }

  /// Run method remesh. Replace the tets of cdt by the new tets if this increases the smallest
  /// dihedral angle.
  Status improve_cdt_by_remesh()
  {
    const double angle = this->angle();
    const Status status =
      this->keep_if_better([&] { return this->remesh(this->finest_remesh_resolution()); });
    if (status.ok() && this->report_.text("method") == to_string(TetMethod::remesh))
    {
      this->warn("method remesh replaced method cdt (the smallest dihedral angle was " +
        short_number(angle) + " degrees); the new tets do not preserve the surface's triangles");
    }
    return status;
  }

  /// Compute tets after method cdt has failed. A cut lattice takes a second at most, and usually
  /// has the right volume. If the volume is wrong, run the Delaunay refinement, which takes ten
  /// times as long. If the refinement fails, cut a finer lattice.
  Status replace_cdt()
  {
    const Index finest = this->finest_remesh_resolution();
    const Index resolution = std::min(2 * this->remesh_resolution(), finest);
    Status cut;
    {
      const ProgressRange range(this->context_, 0.0, 0.3);
      cut = this->remesh_by_lattice(resolution, resolution);
    }
    if (cut.code == StatusCode::canceled || (cut.ok() && this->is_good_enough()))
    {
      this->refinement_task_.reset(); // the refinement is not needed
      return cut;
    }
    const ProgressRange range(this->context_, 0.3, 1.0);
    Status refined;
    const auto refine = [&]
    {
      const Phase phase(this->context_, "remesh", 0.0, 0.7);
      refined = this->remesh_by_refinement();
      return refined;
    };
    if (cut.ok())
    {
      return this->keep_if_better(refine);
    }
    refine();
    // A region that is too thin for the refinement is too thin for the finer lattice, unless the
    // coarser lattice contains half of the region's volume.
    const bool is_too_thin = refined.report.number("thin_fraction", 0.0) > maximum_thin_fraction &&
      !this->lattice_is_usable();
    if (refined.ok() || refined.code == StatusCode::canceled)
    {
      return refined;
    }
    const ProgressRange lattice_range(this->context_, 0.7, 1.0);
    return is_too_thin || finest == resolution ? cut : this->remesh_by_lattice(finest, finest);
  }

  /// Run the Delaunay refinement. If it fails or its angles are too small, cut lattices of
  /// remesh_resolution() to `finest` cubes.
  Status remesh(Index finest)
  {
    Status refined;
    {
      const Phase phase(this->context_, "remesh", 0.0, 0.7);
      refined = this->remesh_by_refinement();
    }
    if (refined.code == StatusCode::canceled || (refined.ok() && this->is_good_enough()))
    {
      return refined;
    }
    const ProgressRange range(this->context_, 0.7, 1.0);
    const auto cut = [&] { return this->remesh_by_lattice(this->remesh_resolution(), finest); };
    return refined.ok() ? this->keep_if_better(cut) : cut();
  }

  /// Cut a lattice of `first` cubes along the longest side. Double the number of cubes, up to
  /// `last`, until the tets have the right volume.
  Status remesh_by_lattice(Index first, Index last)
  {
    Status status;
    for (Index resolution = first; resolution <= last; resolution *= 2)
    {
      const Phase phase(this->context_, "lattice", 0.0, 0.9);
      status = this->cut_lattice(resolution);
      if (status.ok() || status.code == StatusCode::canceled)
      {
        break;
      }
    }
    return status.ok() ? this->finish_remeshed(TetMethod::remesh) : status;
  }

  /// Cut a lattice and check its tets. Keep them for use_lattice_tets() if only their volume is
  /// wrong, and their misfit is the smallest so far.
  Status cut_lattice(Index resolution)
  {
    const double start = this->context_.elapsed_seconds();
    const Lattice lattice = Lattice::around(this->box_, resolution);
    TetMesh& mesh = this->result_.mesh;
    Status status = stuff_lattice(this->context_, this->inside_.winding(), lattice, this->box_,
      this->options_.winding_threshold, mesh);
    if (!status.ok())
    {
      return status;
    }
    const double volume = tet_volumes(mesh.points, mesh.tets).sum();
    if (mesh.tets.rows() == 0)
    {
      status = this->inside_.no_tets_error();
    }
    else if (status = check_tets(mesh.points, mesh.tets); !status.ok())
    {
      // check_tets() has written the reason to `status`
    }
    else if (!this->inside_.fits(volume))
    {
      status = wrong_volume_error(volume, this->inside_);
      if (this->inside_.misfit(volume) < this->lattice_misfit_)
      {
        this->lattice_misfit_ = this->inside_.misfit(volume);
        this->lattice_mesh_ = mesh;
      }
    }
    if (status.ok())
    {
      this->report_.set("resolution", Report::Value(resolution));
    }
    this->log("lattice of " + std::to_string(resolution) + " cubes, cut", start, status);
    return status;
  }

  /// Report whether lattice tets are stored whose volume is at most twice, and at least half, the
  /// volume of the region.
  bool lattice_is_usable() const { return this->lattice_misfit_ <= maximum_misfit; }

  Index remesh_resolution() const
  {
    constexpr Index automatic = 40;
    return this->options_.resolution == 0 ? automatic : this->options_.resolution;
  }

  /// Return the resolution of the finest lattice to try: one, two or four times
  /// remesh_resolution().
  Index finest_remesh_resolution() const
  {
    constexpr double maximum_cubes = 4e6;
    const auto is_small_enough = [&](Index resolution)
    {
      const std::array<Index, 3> cubes = Lattice::around(this->box_, resolution).cubes;
      return static_cast<double>(cubes[0]) * static_cast<double>(cubes[1]) *
        static_cast<double>(cubes[2]) <=
        maximum_cubes;
    };
    Index resolution = this->remesh_resolution();
    for (int k = 0; k < 2 && this->inside_.volume() > 0.0 && is_small_enough(2 * resolution); ++k)
    {
      resolution *= 2;
    }
    return resolution;
  }

  /// If method cdt takes long, start the Delaunay refinement in parallel, because method cdt and
  /// the lattice may fail.
  void prepare_refinement()
  {
    constexpr double delay = 10.0; // seconds
    if (can_run_two_meshers(this->surface_.triangles.rows(), this->options_.memory_limit))
    {
      this->refinement_task_ = std::make_unique<SideTask>(
        this->context_, delay, [this](ExecutionContext& side) { this->run_refinement(side); });
    }
  }

  /// Run the helper's Delaunay refinement. Edges are as long as the edges of the surface, within
  /// bounds that depend on the resolution. By default the bounds are 0.005 and 0.035 of the box's
  /// longest side.
  void run_refinement(ExecutionContext& context)
  {
    const double start = this->context_.elapsed_seconds();
    const double cube = this->box_.size().maxCoeff() /
      (this->box_.diagonal() * static_cast<double>(this->remesh_resolution()));
    constexpr double shortest = 0.2;
    constexpr double longest = 1.4;
    RemeshOptions options;
    options.winding_threshold = this->options_.winding_threshold;
    options.smallest_edge = shortest * cube;
    options.largest_edge = longest * cube;
    options.memory_limit = this->options_.memory_limit;
    // The refinement may use the time that remains after method cdt, minus a reserve for the
    // lattice, but at least a quarter of the time limit.
    constexpr double minimum_fraction = 0.25;
    constexpr double lattice_fraction = 0.1;
    options.time_limit = std::max(this->time_left() - lattice_fraction * this->time_limit_,
      minimum_fraction * this->time_limit_);
    if (this->options_.method == TetMethod::automatic)
    {
      // On most surfaces, the refinement takes a fraction of this limit. Without the limit, it
      // would take minutes on surfaces of needle-shaped triangles.
      constexpr double base_limit = 8.0; // seconds
      constexpr double seconds_per_triangle = 1e-4;
      constexpr double maximum_limit = 14.0;
      options.time_limit = std::min({ options.time_limit, maximum_limit,
        base_limit + seconds_per_triangle * static_cast<double>(this->surface_.triangles.rows()) });
      options.maximum_thin_fraction = maximum_thin_fraction;
    }
    this->refinement_.status = remesh_tets(context, this->surface_.points, this->surface_.triangles,
      this->inside_.winding(), options, this->refinement_.result);
    this->refinement_.seconds = this->context_.elapsed_seconds() - start;
  }

  Status remesh_by_refinement()
  {
    if (!this->refinement_task_ || this->refinement_task_->drop_unless_started())
    {
      this->run_refinement(this->context_);
    }
    else
    {
      this->refinement_task_->finish();
    }
    Status status = this->refinement_.status;
    RemeshResult& result = this->refinement_.result;
    if (status.ok())
    {
      const double volume = tet_volumes(result.mesh.points, result.mesh.tets).sum();
      if (!this->inside_.fits(volume))
      {
        status = wrong_volume_error(volume, this->inside_);
      }
    }
    this->log_.add("Delaunay refinement of the inside", this->refinement_.seconds, status);
    if (!status.ok())
    {
      return status;
    }
    for (const char* key : { "distance_max", "distance_mean" })
    {
      this->report_.set(key, Report::Value(status.report.number(key, 0.0)));
    }
    this->report_.set("method", to_string(TetMethod::remesh));
    this->result_.mesh = std::move(result.mesh);
    this->result_.original_vertices = std::move(result.original_vertices);
    for (Index& id : this->result_.original_vertices)
    {
      id = id < 0 ? -1 : this->surface_.original_vertices[id];
    }
    return {};
  }

  /// Embed the input instead of the repaired surface, so that the tets contain every input point.
  /// Unrepaired orientations do no harm, because the winding number is that of the repaired
  /// surface.
  Status embed()
  {
    const double start = this->context_.elapsed_seconds();
    EmbeddingOptions options;
    options.winding_threshold = this->options_.winding_threshold;
    options.resolution = this->options_.resolution;
    options.tets = this->options_.lattice_tets;
    EmbeddingTets embedding;
    const Status status = embed_surface(
      this->context_, this->points_, this->triangles_, this->inside_.winding(), options, embedding);
    this->log("lattice of " + std::to_string(embedding.resolution) + " cubes", start, status);
    if (!status.ok())
    {
      return status;
    }
    this->report_.merge(status.report);
    return this->use_embedding(std::move(embedding));
  }

  Status use_embedding(EmbeddingTets embedding)
  {
    this->result_.mesh = std::move(embedding.mesh);
    this->result_.inside_fractions = std::move(embedding.inside_fractions);
    this->result_.binding = std::move(embedding.binding);
    return this->mark_all_vertices_new(TetMethod::embed);
  }

  /// Compute a closed surface that wraps the surface. Then fill the wrap with tets by method cdt.
  Status wrap()
  {
    RepairedSurface wrap;
    EnclosedRegion wrap_region;
    Status status;
    {
      const Phase phase(this->context_, "wrap", 0.0, 0.5);
      status = this->make_wrap(wrap, wrap_region);
    }
    if (!status.ok())
    {
      return status;
    }
    CdtOptions options = this->cdt_options();
    options.segmentation.winding_threshold = wrap_threshold;
    options.time_limit = std::max(this->time_left(), 1.0);
    CdtTets cdt(this->context_, wrap, wrap_region, options, this->log_);
    {
      const Phase phase(this->context_, "cdt", 0.5, 0.7);
      // Fraction of the time limit for build(); the rest is for inserting vertices inside.
      constexpr double fraction = 0.75;
      status = cdt.build(fraction * options.time_limit);
    }
    if (status.ok())
    {
      status = this->use_cdt_tets(cdt, 0.7, 0.9);
    }
    if (!status.ok())
    {
      return status;
    }
    this->report_.set("counts.wrap_triangles", Report::Value(wrap.triangles.rows()));
    if (this->surface_.found.boundary_edges > 0)
    {
      const TetMesh& mesh = this->result_.mesh;
      this->warn("the surface is open (" + std::to_string(this->surface_.found.boundary_edges) +
        " boundary edges); where an opening is wider than twice wrap_alpha, the wrap is only a "
        "thin shell; " +
        this->inside_.relative_volume(tet_volumes(mesh.points, mesh.tets).sum()));
    }
    return this->finish_remeshed(TetMethod::wrap);
  }

  Status make_wrap(RepairedSurface& wrap, EnclosedRegion& wrap_region)
  {
    const double start = this->context_.elapsed_seconds();
    WrapOptions options;
    options.alpha = this->options_.wrap_alpha;
    options.offset = this->options_.wrap_offset;
    options.memory_limit = this->options_.memory_limit;
    // Fraction of the time limit that the wrap may use. The rest is for filling the wrap with tets.
    constexpr double fraction = 0.75;
    options.time_limit = fraction * this->time_limit_;
    Points points;
    Triangles triangles;
    Status status;
    {
      const ProgressRange range(this->context_, 0.0, 0.8);
      status = wrap_surface(this->context_, this->surface_.points, this->surface_.triangles,
        options, points, triangles);
    }
    this->log("alpha wrap", start, status);
    const ProgressRange range(this->context_, 0.8, 1.0);
    if (status.ok())
    {
      RepairOptions repair_options;
      repair_options.orient = false;
      status = repair_surface(this->context_, points, triangles, repair_options, wrap);
    }
    bool flipped = false;
    return status.ok() ? wrap_region.build(this->context_, wrap, wrap_threshold, flipped) : status;
  }

  Status ftetwild()
  {
    const double start = this->context_.elapsed_seconds();
    FtetwildOptions options;
    options.epsilon = this->options_.ftetwild_epsilon;
    options.edge = this->options_.interior_edge;
    options.time_limit = this->time_limit_;
    options.memory_limit = this->options_.memory_limit;
    Status status;
    {
      const Phase phase(this->context_, "ftetwild", 0.0, 0.9);
      status = run_ftetwild(this->context_, this->surface_.points, this->surface_.triangles,
        options, this->result_.mesh);
    }
    if (status.ok())
    {
      status = this->check_volume();
    }
    this->log("fTetWild", start, status);
    if (!status.ok())
    {
      return status;
    }
    return this->finish_remeshed(TetMethod::ftetwild);
  }

  /// Compare the volume of the tets with the volume of the region. If the volumes differ by at most
  /// a factor of two, a wrong volume is accepted with a warning.
  Status check_volume()
  {
    const TetMesh& mesh = this->result_.mesh;
    if (mesh.tets.rows() == 0)
    {
      return this->inside_.no_tets_error();
    }
    const double volume = tet_volumes(mesh.points, mesh.tets).sum();
    if (this->inside_.fits(volume))
    {
      return {};
    }
    const Status wrong_volume_status = wrong_volume_error(volume, this->inside_);
    if (this->inside_.misfit(volume) > maximum_misfit)
    {
      return wrong_volume_status;
    }
    this->warn(wrong_volume_status.message);
    return {};
  }

  /// Complete the result for tets whose boundary only approximates the surface: mark all vertices
  /// as new, and report the distance from the surface.
  Status finish_remeshed(TetMethod method)
  {
    this->mark_all_vertices_new(method);
    return this->report_distance();
  }

  Status report_distance()
  {
    const Phase phase(this->context_, "distance", 0.9, 1.0);
    const RegionBoundary region(this->surface_.points, this->surface_.triangles,
      this->inside_.winding(), this->options_.winding_threshold);
    SurfaceDistance distance;
    if (!measure_distance(this->context_, this->result_.mesh, region, distance))
    {
      return Status::canceled();
    }
    const double percent = 100.0 / this->box_.diagonal();
    this->report_.set("distance_max", Report::Value(percent * distance.maximum));
    this->report_.set("distance_mean", Report::Value(percent * distance.mean));
    return {};
  }

  double time_left() const
  {
    return this->time_limit_ - (this->context_.elapsed_seconds() - this->method_start_);
  }

  Status mark_all_vertices_new(TetMethod method)
  {
    this->report_.set("method", to_string(method));
    this->result_.original_vertices.assign(
      static_cast<std::size_t>(this->result_.mesh.points.rows()), -1);
    return {};
  }

  // ---- Check and result ----

  Status check()
  {
    const TetMesh& mesh = this->result_.mesh;
    Status status;
    const bool embedded = this->options_.method == TetMethod::embed;
    // Only tets of method embed and of option keep_outside are checked here. All other tets were
    // checked when they were created.
    if (embedded || this->options_.keep_outside)
    {
      status = check_tets(mesh.points, mesh.tets, embedded);
      if (!status.ok())
      {
        return status;
      }
    }
    if (this->result_.winding_numbers.size() == 0)
    {
      const Points centers = tet_centers(mesh.points, mesh.tets);
      status =
        this->inside_.winding().evaluate(this->context_, centers, this->result_.winding_numbers);
      if (!status.usable())
      {
        return status;
      }
    }
    this->label_tets();
    const TetQuality quality = measure_tets(mesh.points, mesh.tets);
    const auto& ids = this->result_.original_vertices;
    const auto kept =
      static_cast<Index>(std::count_if(ids.begin(), ids.end(), [](Index id) { return id >= 0; }));
    this->report_.set("counts.tets", Report::Value(mesh.tets.rows()));
    this->report_.set("counts.tet_vertices", Report::Value(mesh.points.rows()));
    this->report_.set("counts.kept_vertices", Report::Value(kept));
    this->report_.set("counts.tets_below_5_degrees", Report::Value(quality.below_5_degrees));
    this->report_.set("counts.tets_below_5_degrees_forced",
      Report::Value(quality.below_5_degrees == 0
          ? Index(0)
          : count_forced_tets(this->context_, mesh.points, mesh.tets,
              this->result_.min_dihedral_angles, sliver_angle)));
    if (this->inside_tets_.empty())
    {
      this->report_.set("volume", Report::Value(quality.volume));
    }
    this->report_.set("winding_volume", Report::Value(this->inside_.volume()));
    this->report_.set("winding_volume_error", Report::Value(this->inside_.volume_error()));
    this->report_.set("min_dihedral_angle", Report::Value(quality.min_dihedral_angle));
    std::vector<double> from;
    for (std::size_t bin = 0; bin < quality.histogram.tets.size(); ++bin)
    {
      from.push_back(DihedralHistogram::bin_width * static_cast<double>(bin));
    }
    this->report_.set("quality[].dihedral_angle", from);
    this->report_.set("quality[].tets",
      std::vector<std::int64_t>(quality.histogram.tets.begin(), quality.histogram.tets.end()));
    return quality.min_dihedral_angle >= this->options_.quality
      ? Status()
      : Status::failure(StatusCode::not_converged,
          "the smallest dihedral angle is " + short_number(quality.min_dihedral_angle) +
            " degrees, less than the requested " + short_number(this->options_.quality) +
            (this->options_.method == TetMethod::cdt || this->options_.method == TetMethod::wrap
                ? "; method auto (--method auto) can improve it by not preserving the surface's "
                  "triangles"
                : ""));
  }

  /// Set the labels and angles of the tets. With keep_outside, also report the number and the
  /// volume of the tets inside.
  void label_tets()
  {
    const TetMesh& mesh = this->result_.mesh;
    const Eigen::VectorXd volumes = tet_volumes(mesh.points, mesh.tets);
    const bool all_inside = this->options_.method != TetMethod::embed;
    this->result_.labels.resize(static_cast<std::size_t>(mesh.tets.rows()));
    this->result_.min_dihedral_angles.resize(mesh.tets.rows());
    double volume = 0.0;
    Index kept = 0;
    for (Index t = 0; t < mesh.tets.rows(); ++t)
    {
      const bool above_threshold =
        this->result_.winding_numbers[t] >= this->options_.winding_threshold;
      const bool inside =
        this->inside_tets_.empty() ? above_threshold || all_inside : this->inside_tets_[t];
      this->result_.labels[t] = inside
        ? (above_threshold ? TetLabel::inside : TetLabel::inside_below)
        : above_threshold ? TetLabel::outside_above
                          : TetLabel::outside;
      const auto tet = mesh.tets.row(t);
      this->result_.min_dihedral_angles[t] = min_dihedral_angle(mesh.points.row(tet[0]),
        mesh.points.row(tet[1]), mesh.points.row(tet[2]), mesh.points.row(tet[3]));
      volume += inside ? volumes[t] : 0.0;
      kept += inside;
    }
    if (!this->inside_tets_.empty())
    {
      this->report_.set("counts.tets_inside", Report::Value(kept));
      this->report_.set("volume", Report::Value(volume));
    }
  }

  void warn(const std::string& sentence) { this->warnings_.push_back(sentence); }

  void log(const std::string& attempt, double start, const Status& status)
  {
    this->log_.add(attempt, this->context_.elapsed_seconds() - start, status);
  }

  /// Largest misfit of a usable result: a factor of two in volume.
  static constexpr double maximum_misfit = 0.6931471805599453;
  /// Value of RemeshOptions::maximum_thin_fraction in method automatic. Above this fraction, the
  /// refinement gave a wrong volume for every furniture model.
  static constexpr double maximum_thin_fraction = 0.8;
  /// Threshold for the interior of a wrap. It does not depend on the options, because a wrap of any
  /// surface has the winding number 1 inside.
  static constexpr double wrap_threshold = 0.5;

  PointsView points_;
  TrianglesView triangles_;
  const TetrahedralizeOptions& options_;
  TetrahedralizeResult& result_;
  ExecutionContext& context_;

  const RepairedSurface& surface_;
  EnclosedRegion& inside_;
  const Box box_;
  static constexpr double minimum_time_limit = 120.0; ///< seconds
  static constexpr double time_limit_per_triangle = 1.2e-4;
  const double time_limit_;
  double method_start_ = 0.0;
  std::vector<char> inside_tets_; ///< with keep_outside, #T: 1 for tets inside; otherwise empty
  /// Lattice tets with the smallest misfit so far. They are used if no attempt has the right
  /// volume.
  TetMesh lattice_mesh_;
  double lattice_misfit_ = std::numeric_limits<double>::infinity();
  /// Result of run_refinement().
  struct Refinement
  {
    Status status;
    RemeshResult result;
    double seconds = 0.0;
  };
  Refinement refinement_;
  std::unique_ptr<SideTask> refinement_task_; ///< runs run_refinement(); null if it is not needed
  const Report& preparation_report_; ///< initial report of each attempt (prepare_surface())
  Report report_;
  AttemptLog log_;
  std::vector<std::string> warnings_;
};

Status check_options(const TetrahedralizeOptions& options)
{
  const Status valid = check_options(segmentation_options(options));
  if (!valid.ok())
  {
    return valid;
  }
  if (options.resolution != 0 && (options.resolution < 4 || options.resolution > 1000))
  {
    return Status::invalid_input(
      "resolution must be 0 or from 4 to 1000 cubes, not " + std::to_string(options.resolution));
  }
  if (!(options.time_limit >= 0.0))
  {
    return Status::invalid_input("time_limit must be 0 (automatic) or positive, not " +
      short_number(options.time_limit) + " s");
  }
  constexpr double placeholder_limit = 1.0;
  Status limits = check_limits(
    options.time_limit > 0.0 ? options.time_limit : placeholder_limit, options.memory_limit);
  if (!limits.ok())
  {
    return limits;
  }
  if (options.keep_outside && options.method != TetMethod::cdt)
  {
    return Status::invalid_input(
      "keep_outside needs method cdt, the only method that fills the convex hull");
  }
  constexpr double maximum_quality = 20.0;
  if (!(options.quality >= 0.0 && options.quality <= maximum_quality))
  {
    return Status::invalid_input(
      "quality must be from 0 to 20 degrees, not " + short_number(options.quality));
  }
  if (!(options.interior_edge >= 0.0))
  {
    return Status::invalid_input(
      "interior_edge must be at least 0, not " + short_number(options.interior_edge));
  }
  if (options.bare && (options.interior_edge > 0.0 || options.quality > 0.0))
  {
    return Status::invalid_input("interior_edge and quality must be 0 if bare is on");
  }
  constexpr double ftetwild_threshold = 0.5;
  if (options.method == TetMethod::ftetwild && options.winding_threshold != ftetwild_threshold)
  {
    return Status::invalid_input("winding_threshold must be 0.5 for method ftetwild, not " +
      short_number(options.winding_threshold));
  }
  return check_handle_elements(options.handles);
}
} // namespace

double interior_edge_of_weights(double volume, double diagonal)
{
  constexpr double longest_edge = 0.04;
  constexpr double minimum_tets = 10000.0;
  const double edge = std::cbrt(volume / (minimum_tets * regular_tet_volume)) / diagonal;
  return edge > 0.0 ? std::min(longest_edge, edge) : longest_edge;
}

const char* to_string(TetMethod method)
{
  switch (method)
  {
    case TetMethod::cdt:
      return "cdt";
    case TetMethod::remesh:
      return "remesh";
    case TetMethod::embed:
      return "embed";
    case TetMethod::wrap:
      return "wrap";
    case TetMethod::ftetwild:
      return "ftetwild";
    case TetMethod::automatic:
      break;
  }
  return "auto";
}

namespace
{
/// Add the warnings and the report of the preparation to a failure. Failures of the class
/// Tetrahedralizer already contain these warnings and this report.
Status with_preparation_report(Status status, const PreparedSurface& prepared)
{
  status.warnings.insert(
    status.warnings.begin(), prepared.warnings.begin(), prepared.warnings.end());
  Report report = prepared.report;
  report.merge(status.report);
  status.report = std::move(report);
  return status;
}

/// Convert the input to the working frame, compute the tets there, and convert the tets and the
/// report back to input coordinates.
Status tetrahedralize_in_frame(ExecutionContext& context, const WorkingFrame& frame,
  PointsView points, TrianglesView triangles, TetrahedralizeOptions options,
  TetrahedralizeResult& result)
{
  options.handles.points = frame.to_frame(options.handles.points);
  Status status = tetrahedralize(context, frame.to_frame(points), triangles, options, result);
  result.mesh.points = frame.from_frame(result.mesh.points);
  frame.convert_report(status.report, "spacing", 1);
  for (const char* key : { "volume", "winding_volume" })
  {
    frame.convert_report(status.report, key, 3);
  }
  return status;
}
} // namespace

Status tetrahedralize(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const TetrahedralizeOptions& options, TetrahedralizeResult& result)
{
  result = TetrahedralizeResult();
  Status status = check_options(options);
  WorkingFrame frame;
  if (status.ok())
  {
    status = WorkingFrame::choose(points, triangles, "the surface", frame);
  }
  if (!status.ok())
  {
    return status;
  }
  if (!frame.is_identity())
  {
    return tetrahedralize_in_frame(context, frame, points, triangles, options, result);
  }
  PreparedSurface prepared;
  {
    const ProgressRange range(context, 0.0, 0.15);
    status = prepare_surface(context, points, triangles, options.winding_threshold, prepared);
  }
  if (!status.ok())
  {
    return with_preparation_report(std::move(status), prepared);
  }
  const ProgressRange range(context, 0.15, 1.0);
  return tetrahedralize(context, points, triangles, prepared, options, result);
}

Status tetrahedralize(ExecutionContext& context, PointsView points, TrianglesView triangles,
  PreparedSurface& prepared, const TetrahedralizeOptions& options, TetrahedralizeResult& result)
{
  result = TetrahedralizeResult();
  Status status = check_options(options);
  if (status.ok() && options.winding_threshold != prepared.winding_threshold)
  {
    status =
      Status::invalid_input("winding_threshold is " + short_number(options.winding_threshold) +
        ", but the surface was prepared with a winding_threshold of " +
        short_number(prepared.winding_threshold));
  }
  return status.ok() ? Tetrahedralizer(context, points, triangles, prepared, options, result).run()
                     : status;
}

Status complete_embedding(ExecutionContext& context, PointsView points, TrianglesView triangles,
  PreparedSurface& prepared, EmbeddingTets embedding, TetrahedralizeResult& result)
{
  result = TetrahedralizeResult();
  TetrahedralizeOptions options;
  options.method = TetMethod::embed;
  options.winding_threshold = prepared.winding_threshold;
  return Tetrahedralizer(context, points, triangles, prepared, options, result)
    .run(std::move(embedding));
}

} // namespace bindpose

// The ladder.
//
// cdt: a clean surface goes to TetGen as it is. Any other is first refined exactly until triangles
// meet only in shared vertices and edges; TetGen then fills the convex hull (or a box around it)
// with tets that keep all these triangles, and tets with a winding number below the threshold are
// thrown away. TetGen 1.5 fails on some inputs with one set of switches and on others with another,
// so several are tried; then the same with vertices rounded to a coarser grid (which welds nearly
// coincident ones) and with vertices moved a little (which takes soups apart). Last comes a plain
// Delaunay triangulation of the refined vertices, whose tets need not respect the triangles.
//
// Kept tets get vertices inside, by TetGen's refinement with the boundary left alone: angles become
// better and weights have something to vary over.
//
// remesh: see lattice_tets.h. Finer lattices are tried when the volume is off.
//
// Every rung is judged by the volume it has against the volume that winds enough.
#include "inside/tetrahedralize.h"

#include "base/parallel.h"
#include "inside/lattice_tets.h"
#include "inside/mesher_process.h"
#include "inside/surface_repair.h"
#include "inside/tet_quality.h"
#include "inside/winding_number.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>

namespace bindpose
{

namespace
{
constexpr double smallest_volume_ratio = 0.9;
constexpr double largest_volume_ratio = 1.1;

/// How the vertices are moved before refinement.
struct Move
{
  const char* name;
  double snap; ///< fraction of the diagonal
  double jitter; ///< fraction of the diagonal
};

constexpr Move moves[] = { { "", 0.0, 0.0 }, { ", vertices rounded", 0x1p-20, 0.0 },
  { ", vertices moved by 1e-5", 0.0, 1e-5 }, { ", vertices moved by 1e-4", 0.0, 1e-4 } };

/// A number in [-1, 1) from an integer, the same everywhere (splitmix64).
double scatter(std::uint64_t n)
{
  std::uint64_t z = (n + 1) * 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-52 - 1.0;
}

std::string short_number(double x)
{
  std::ostringstream text;
  text.precision(4);
  text << x;
  return text.str();
}

Points centers_of(const Points& points, const Tets& tets)
{
  Points centers(tets.rows(), 3);
  for (Index t = 0; t < tets.rows(); ++t)
  {
    centers.row(t) = 0.25 *
      (points.row(tets(t, 0)) + points.row(tets(t, 1)) + points.row(tets(t, 2)) +
        points.row(tets(t, 3)));
  }
  return centers;
}

double longest_edge(const Points& points, const Tets& tets, Index t)
{
  double longest = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    for (int j = 0; j < i; ++j)
    {
      longest = std::max(longest, (points.row(tets(t, i)) - points.row(tets(t, j))).squaredNorm());
    }
  }
  return std::sqrt(longest);
}

/// Removes groups of tets, joined by facets, that hold next to nothing: crumbs of rounding.
Index drop_crumbs(const Points& points, Tets& tets)
{
  constexpr int facet[4][3] = { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } };
  struct Facet
  {
    std::array<Index, 3> key;
    Index tet;
  };
  std::vector<Facet> facets;
  facets.reserve(static_cast<std::size_t>(tets.rows()) * 4);
  for (Index t = 0; t < tets.rows(); ++t)
  {
    for (const auto& f : facet)
    {
      std::array<Index, 3> key{ tets(t, f[0]), tets(t, f[1]), tets(t, f[2]) };
      std::sort(key.begin(), key.end());
      facets.push_back({ key, t });
    }
  }
  std::sort(facets.begin(), facets.end(),
    [](const Facet& x, const Facet& y) { return x.key != y.key ? x.key < y.key : x.tet < y.tet; });
  std::vector<Index> group(static_cast<std::size_t>(tets.rows()));
  std::iota(group.begin(), group.end(), Index(0));
  const auto find = [&](Index t)
  {
    while (group[t] != t)
    {
      group[t] = group[group[t]];
      t = group[t];
    }
    return t;
  };
  for (std::size_t i = 1; i < facets.size(); ++i)
  {
    if (facets[i].key == facets[i - 1].key)
    {
      const Index a = find(facets[i - 1].tet);
      const Index b = find(facets[i].tet);
      group[std::max(a, b)] = std::min(a, b);
    }
  }
  const Eigen::VectorXd volumes = tet_volumes(points, tets);
  Eigen::VectorXd of_group = Eigen::VectorXd::Zero(tets.rows());
  for (Index t = 0; t < tets.rows(); ++t)
  {
    of_group[find(t)] += volumes[t];
  }
  constexpr double crumb = 1e-8;
  const double least = crumb * volumes.sum();
  Index kept = 0;
  for (Index t = 0; t < tets.rows(); ++t)
  {
    if (of_group[find(t)] >= least)
    {
      tets.row(kept++) = tets.row(t).eval();
    }
  }
  const Index dropped = tets.rows() - kept;
  tets.conservativeResize(kept, 4);
  return dropped;
}

class Ladder
{
public:
  Ladder(PointsView points, TrianglesView triangles, const TetrahedralizeOptions& options,
    TetrahedralizeResult& result, ExecutionContext& context)
    : points_(points), triangles_(triangles), options_(options), result_(result), context_(context)
  {
  }

  Status run()
  {
    Status status = this->prepare();
    if (status.ok())
    {
      const Phase phase(this->context_, "tetrahedralize", 0.15, 0.95);
      status = this->climb();
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
    this->report_rungs(report);
    report.merge(status.report);
    status.report = report;
    return status;
  }

private:
  // ---- Before the ladder -----------------------------------------------------------------------

  Status prepare()
  {
    {
      const Phase phase(this->context_, "repair", 0.0, 0.05);
      Status status = repair_surface(
        this->points_, this->triangles_, RepairOptions(), this->surface_, this->context_);
      if (!status.ok())
      {
        return status;
      }
    }
    const SurfaceDiagnosis& found = this->surface_.found;
    add_to_report(found, this->report_);
    if (this->surface_.triangles.rows() == 0)
    {
      return Status::invalid_input(this->triangles_.rows() == 0
          ? "the surface has no triangles"
          : "no triangle of the surface has an area, so it encloses nothing");
    }
    if (found.flat && this->options_.method != TetMethod::embed)
    {
      return Status::invalid_input(
        "the surface is flat: all its points lie in one plane, so it encloses nothing");
    }
    if (this->surface_.turned_triangles > 0)
    {
      this->report_.set("counts.turned_triangles", Report::Value(this->surface_.turned_triangles));
      this->warn(std::to_string(this->surface_.turned_triangles) +
        " triangles were turned to agree with their neighbours");
    }
    if (this->surface_.turned_components > 0)
    {
      this->report_.set(
        "counts.turned_components", Report::Value(this->surface_.turned_components));
      this->warn(std::to_string(this->surface_.turned_components) +
        " closed components were inside out and were turned");
    }
    this->box_ = bounding_box(this->surface_.points);
    const Phase phase(this->context_, "winding", 0.05, 0.15);
    return this->measure_inside();
  }

  /// Builds the winding number and estimates the volume where it reaches the threshold. Turns a
  /// surface that is inside out as a whole (closed components are right by now, open ones may not
  /// be).
  Status measure_inside()
  {
    double negative = 0.0;
    Status status = this->sample_inside(negative);
    if (status.ok() && negative > this->winding_volume_ && !this->surface_.clean())
    {
      this->surface_.triangles.col(1).swap(this->surface_.triangles.col(2));
      this->warn("the surface was inside out and was turned");
      status = this->sample_inside(negative);
    }
    if (this->surface_.clean() && this->surface_.found.components == 1)
    {
      this->winding_volume_ = signed_volume(this->surface_.points, this->surface_.triangles);
      this->winding_volume_error_ = 0.0;
    }
    return status;
  }

  Status sample_inside(double& negative)
  {
    Status status =
      this->winding_.build(this->surface_.points, this->surface_.triangles, this->context_);
    // More samples until enough are inside, as long as that costs less than some seconds: a sample
    // costs about 0.1 us and 15 ns more for every open edge.
    const auto open_edges = static_cast<double>(this->surface_.found.boundary_edges);
    constexpr double affordable = 4e6;
    Index samples = 40;
    const double longest = this->box_.size().maxCoeff();
    constexpr double enough = 4000.0; // samples inside, for an error of some percent
    for (;; samples = samples * 3 / 2)
    {
      SampleGrid grid;
      grid.spacing = Vec3::Constant(longest / static_cast<double>(samples));
      for (int k = 0; k < 3; ++k)
      {
        const double cells = std::max(1.0, std::ceil(this->box_.size()[k] / grid.spacing[k]));
        grid.extent[2 * k] = 0;
        grid.extent[2 * k + 1] = static_cast<Index>(cells) - 1;
        grid.spacing[k] = this->box_.size()[k] / cells;
      }
      grid.origin = this->box_.lower + 0.5 * grid.spacing;
      Eigen::VectorXd w;
      status = this->winding_.evaluate(grid, this->context_, w);
      if (!status.ok())
      {
        break;
      }
      const double cell = grid.spacing.prod();
      const double threshold = this->options_.winding_threshold;
      const auto hits = static_cast<double>((w.array() >= threshold).count());
      negative = cell * static_cast<double>((w.array() <= -threshold).count());
      this->winding_volume_ = cell * hits;
      this->winding_volume_error_ = hits > 0.0 ? 1.0 / std::sqrt(hits) : 1.0;
      this->largest_winding_ = std::max(this->largest_winding_, w.maxCoeff());
      constexpr double growth = 3.375;
      const double next_cost = growth * static_cast<double>(w.size()) * (0.1 + 0.015 * open_edges);
      if (hits >= enough || negative > this->winding_volume_ || next_cost > affordable)
      {
        break;
      }
    }
    return status.code == StatusCode::cancelled ? status
      : status.usable()                         ? Status()
                                                : Status::failure(status.code, status.message);
  }

  // ---- Rungs -----------------------------------------------------------------------------------

  Status climb()
  {
    switch (this->options_.method)
    {
      case TetMethod::embed:
        return this->embed();
      case TetMethod::remesh:
        return this->remesh(false);
      case TetMethod::cdt:
        return this->cdt(this->options_.time_limit);
      case TetMethod::automatic:
        break;
    }
    constexpr double share = 0.75; // of the time for cdt
    Status status = this->cdt(share * this->options_.time_limit);
    if (status.ok() || status.code == StatusCode::cancelled)
    {
      return status;
    }
    const std::string why = status.message;
    status = this->remesh(true);
    if (status.ok())
    {
      this->warn("method cdt was left (" + why +
        "); the tets are remesh's and do not keep the "
        "surface's vertices");
    }
    return status;
  }

  Status cdt(double time_limit)
  {
    this->deadline_ = this->context_.elapsed_seconds() + time_limit;
    Status status;
    if (this->surface_.clean())
    {
      const Phase phase(this->context_, "tetgen", 0.0, 0.3);
      this->original_ = this->surface_.original_vertices;
      const MesherData data{ this->surface_.points, this->surface_.triangles, {}, {}, {} };
      status = this->try_tetgen("tetgen", data, "pYA", false);
      if (status.ok() || this->final(status))
      {
        return status.ok() ? this->complete() : status;
      }
    }
    MesherData first_refined;
    std::vector<Index> first_original;
    for (const Move& move : moves)
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
      if (status.ok() || this->final(status))
      {
        return status.ok() ? this->complete() : status;
      }
    }
    if (first_refined.points.rows() > 0)
    {
      this->original_ = first_original;
      const double start = this->context_.elapsed_seconds();
      MesherAnswer answer;
      status = this->run_job({ "delaunay" }, first_refined, 30.0, answer);
      if (status.ok())
      {
        status = this->keep_inside(answer.data);
      }
      this->log("delaunay of the refined vertices", start, status);
      if (status.ok())
      {
        this->warn("the tets do not follow the surface's triangles everywhere");
        return this->complete();
      }
    }
    return status;
  }

  /// TetGen on refined triangles, with one set of switches after the other.
  Status try_switches(const Move& move, const MesherData& refined)
  {
    struct Way
    {
      const char* switches;
      bool box;
    };
    const Phase phase(this->context_, "tetgen", 0.3, 0.6);
    Status status;
    for (const Way& way :
      { Way{ "pYcA", false }, Way{ "pYA", true }, Way{ "pcA", false }, Way{ "pA", true } })
    {
      const auto name = [&](const std::string& switches, bool box)
      { return "tetgen " + switches + (box ? " in a box" : "") + move.name; };
      status = this->try_tetgen(name(way.switches, way.box), refined, way.switches, way.box);
      if (status.ok() || this->final(status))
      {
        break;
      }
      if (this->wrong_volume_)
      {
        // TetGen did what it could: across wide openings the tets are too coarse to end where the
        // winding number does, which may be outside the convex hull.
        const std::string fine = "pYAq2a" + short_number(this->volume_bound());
        status = this->try_tetgen(name(fine, true), refined, fine, true);
        this->gave_volume_ = true;
        break;
      }
    }
    return status;
  }

  /// Volume of a regular tet with edges of interior_edge; no shorter than a third of the surface's.
  double volume_bound() const
  {
    constexpr double regular = 0.11785113019775793;
    constexpr double default_edge = 0.04;
    const double fraction =
      this->options_.interior_edge > 0.0 ? this->options_.interior_edge : default_edge;
    return regular *
      std::pow(std::max(fraction * this->box_.diagonal(), this->mean_surface_edge() / 3.0), 3.0);
  }

  /// Moves the vertices, then cuts triangles along their crossings.
  Status refine(const Move& move, MesherData& refined)
  {
    const double start = this->context_.elapsed_seconds();
    RepairedSurface moved;
    if (move.snap > 0.0)
    {
      RepairOptions repair;
      repair.orient = false;
      repair.count_self_intersections = false;
      repair.snap = move.snap;
      Status status = repair_surface(
        this->surface_.points, this->surface_.triangles, repair, moved, this->context_);
      if (!status.ok())
      {
        return status;
      }
      for (Index& v : moved.original_vertices)
      {
        v = this->surface_.original_vertices[v];
      }
      if (moved.triangles.rows() == 0)
      {
        status = Status::failure(StatusCode::internal_error, "nothing is left after rounding");
        this->log(std::string("refine") + move.name, start, status);
        return status;
      }
    }
    else
    {
      moved.points = this->surface_.points;
      moved.triangles = this->surface_.triangles;
      moved.original_vertices = this->surface_.original_vertices;
      const double size = move.jitter * this->box_.diagonal();
      for (Index k = 0; size > 0.0 && k < moved.points.size(); ++k)
      {
        moved.points.data()[k] += size * scatter(static_cast<std::uint64_t>(k));
      }
    }
    this->original_ = moved.original_vertices;
    const Phase phase(this->context_, "refine", 0.0, 0.3);
    MesherAnswer answer;
    const MesherData input{ moved.points, moved.triangles, {}, {}, {} };
    Status status = this->run_job({ "refine" }, input, 25.0, answer);
    refined = std::move(answer.data);
    if (status.ok() && refined.triangles.rows() == 0)
    {
      status = Status::failure(StatusCode::internal_error, "refinement left no triangles");
    }
    this->log(std::string("refine") + move.name, start, status);
    return status;
  }

  Status try_tetgen(
    const std::string& name, const MesherData& input, const std::string& switches, bool box)
  {
    const double start = this->context_.elapsed_seconds();
    MesherAnswer answer;
    Status status = this->run_job(
      { "tetgen", "--switches", switches, "--box", box ? "1" : "0" }, input, 30.0, answer);
    if (status.ok())
    {
      status = this->keep_inside(answer.data);
    }
    this->log(name, start, status);
    return status;
  }

  /// One job of the helper, within what is left of the time.
  Status run_job(const std::vector<std::string>& arguments, const MesherData& input, double seconds,
    MesherAnswer& answer)
  {
    constexpr double per_triangle = 2e-4;
    const double left = this->deadline_ - this->context_.elapsed_seconds();
    if (left <= 0.0)
    {
      return Status::failure(StatusCode::internal_error, "the time limit was reached");
    }
    MesherRequest request;
    request.arguments = arguments;
    request.memory_limit = this->options_.memory_limit;
    request.time_limit = std::min(left,
      seconds + per_triangle * static_cast<double>(input.triangles.rows() + input.tets.rows()));
    if (arguments.front() == "refine")
    {
      // It gives up by itself, a little earlier, and says how far it came.
      constexpr double earlier = 0.9;
      request.arguments.insert(
        request.arguments.end(), { "--time", std::to_string(earlier * request.time_limit) });
    }
    return run_mesher(request, input, answer, this->context_);
  }

  /// A status after which no other rung of cdt can help.
  bool final(const Status& status) const
  {
    return status.code == StatusCode::cancelled || status.code == StatusCode::unavailable ||
      (!status.ok() && this->gave_volume_) ||
      (!status.ok() && this->context_.elapsed_seconds() >= this->deadline_);
  }

  // ---- Inside or outside -----------------------------------------------------------------------

  /// Keeps the tets that the surface winds around; they become the result when their volume is
  /// right.
  Status keep_inside(const MesherData& data)
  {
    const Phase phase(this->context_, "label", 0.9, 1.0);
    this->wrong_volume_ = false;
    Eigen::VectorXd w;
    const bool by_region = this->surface_.closed && !data.regions.empty();
    Status status = by_region ? this->wind_regions(data, w) : this->wind_tets(data, w);
    if (!status.ok())
    {
      return status;
    }
    this->largest_winding_ = std::max(this->largest_winding_, w.maxCoeff());
    Tets kept(data.tets.rows(), 4);
    Index count = 0;
    for (Index t = 0; t < data.tets.rows(); ++t)
    {
      if (w[t] >= this->options_.winding_threshold)
      {
        kept.row(count++) = data.tets.row(t);
      }
    }
    kept.conservativeResize(count, 4);
    if (count == 0)
    {
      this->wrong_volume_ = true;
      return Status::failure(StatusCode::internal_error, "no tet is inside");
    }
    drop_crumbs(data.points, kept);
    const double volume = tet_volumes(data.points, kept).sum();
    if (!this->volume_fits(volume))
    {
      this->wrong_volume_ = true;
      return this->wrong_volume(volume);
    }
    this->result_.mesh.points = data.points;
    this->result_.mesh.tets = std::move(kept);
    return {};
  }

  bool volume_fits(double volume) const
  {
    const double slack = this->winding_volume_error_;
    return volume > 0.0 &&
      (slack >= 0.5 ||
        (volume >= (smallest_volume_ratio - slack) * this->winding_volume_ &&
          volume <= (largest_volume_ratio + slack) * this->winding_volume_));
  }

  Status wrong_volume(double volume) const
  {
    return Status::failure(StatusCode::internal_error,
      "the tets hold " + short_number(volume) + ", but the winding number encloses " +
        short_number(this->winding_volume_));
  }

  /// Closed surface: the winding number is the same all over a region between triangles.
  Status wind_regions(const MesherData& data, Eigen::VectorXd& w)
  {
    const Eigen::VectorXd volumes = tet_volumes(data.points, data.tets);
    std::map<Index, Index> largest; // region -> its largest tet
    for (Index t = 0; t < data.tets.rows(); ++t)
    {
      const auto [entry, fresh] = largest.emplace(data.regions[t], t);
      if (!fresh && volumes[t] > volumes[entry->second])
      {
        entry->second = t;
      }
    }
    std::map<Index, double> of_region;
    for (const auto& [region, t] : largest)
    {
      Vec3 center = Vec3::Zero();
      for (int k = 0; k < 4; ++k)
      {
        center += 0.25 * data.points.row(data.tets(t, k)).transpose();
      }
      of_region[region] = this->winding_.evaluate_at(center);
    }
    w.resize(data.tets.rows());
    for (Index t = 0; t < data.tets.rows(); ++t)
    {
      w[t] = of_region[data.regions[t]];
    }
    return this->context_.cancelled() ? Status::cancelled() : Status();
  }

  /// Open surface: at each tet's centre; for large tets near the threshold the mean of four points.
  Status wind_tets(const MesherData& data, Eigen::VectorXd& w)
  {
    const Points centers = centers_of(data.points, data.tets);
    Status status = this->winding_.evaluate(centers, this->context_, w);
    if (!status.usable())
    {
      return status;
    }
    constexpr double large = 0.05; // of the diagonal
    constexpr double doubtful = 0.25;
    std::vector<Index> tets;
    for (Index t = 0; t < data.tets.rows(); ++t)
    {
      if (std::abs(w[t] - this->options_.winding_threshold) < doubtful &&
        longest_edge(data.points, data.tets, t) > large * this->box_.diagonal())
      {
        tets.push_back(t);
      }
    }
    Points more(4 * static_cast<Index>(tets.size()), 3);
    for (std::size_t i = 0; i < tets.size(); ++i)
    {
      for (int k = 0; k < 4; ++k)
      {
        // Four-point rule of degree 2.
        constexpr double near = 0.5854101966249685;
        constexpr double others = 0.1381966011250105;
        more.row(4 * static_cast<Index>(i) + k) = 4.0 * others * centers.row(tets[i]) +
          (near - others) * data.points.row(data.tets(tets[i], k));
      }
    }
    Eigen::VectorXd values;
    status = this->winding_.evaluate(more, this->context_, values);
    for (std::size_t i = 0; i < tets.size() && status.usable(); ++i)
    {
      w[tets[i]] = 0.25 * values.segment(4 * static_cast<Index>(i), 4).sum();
    }
    return status.usable() ? Status() : status;
  }

  // ---- After cdt: vertices inside --------------------------------------------------------------

  Status complete()
  {
    if (this->options_.quality > 0.0 || this->options_.interior_edge > 0.0)
    {
      const Phase phase(this->context_, "fill", 0.6, 0.95);
      const Status status = this->fill();
      if (status.code == StatusCode::cancelled)
      {
        return status;
      }
      if (!status.ok())
      {
        this->warn("no vertices were added inside (" + status.message + ")");
      }
    }
    this->report_.set("method", to_string(TetMethod::cdt));
    this->renumber();
    return {};
  }

  /// Ways to add vertices, the first that works. What is bounded by many needles (CAD) stays bad
  /// with the boundary left alone; then its triangles may be split, and so may large ones that are
  /// in the way of small tets.
  Status fill()
  {
    const MesherData coarse{ this->result_.mesh.points, {}, this->result_.mesh.tets, {}, {} };
    const std::string size = this->options_.interior_edge > 0.0 ? "a" : "";
    const std::string good =
      this->options_.quality > 0.0 ? "q" + short_number(this->options_.quality) + "/10" : "";
    const std::string fair = good.empty() ? "" : "q2";
    const bool large_triangles = this->options_.interior_edge > 0.0 &&
      this->mean_surface_edge() > 3.0 * this->options_.interior_edge * this->box_.diagonal();
    Status status;
    if (large_triangles)
    {
      status = this->try_fill("r" + good + size, coarse);
      if (status.ok() || this->final(status))
      {
        return status;
      }
    }
    status = this->try_fill("rY" + good + size, coarse);
    if (!status.ok() && !this->final(status) && good != fair)
    {
      status = this->try_fill("rY" + fair + size, coarse);
    }
    const auto bad =
      measure_tets(this->result_.mesh.points, this->result_.mesh.tets).below_5_degrees;
    constexpr double too_many = 0.2;
    if (!good.empty() && !this->final(status) &&
      static_cast<double>(bad) > too_many * static_cast<double>(this->result_.mesh.tets.rows()))
    {
      const Status split = this->try_fill("r" + fair + size, coarse);
      status = split.ok() || split.code == StatusCode::cancelled ? split : status;
    }
    return status;
  }

  /// One run of TetGen's refinement; its tets replace the result's when they fill the same volume.
  Status try_fill(const std::string& switches, const MesherData& coarse)
  {
    const double start = this->context_.elapsed_seconds();
    MesherData data = coarse;
    if (this->options_.interior_edge > 0.0)
    {
      data.largest_volumes.assign(
        static_cast<std::size_t>(coarse.tets.rows()), this->volume_bound());
    }
    MesherAnswer answer;
    Status status = this->run_job({ "tetgen", "--switches", switches }, data, 10.0, answer);
    if (status.ok())
    {
      status = this->accept_fill(answer.data, tet_volumes(coarse.points, coarse.tets).sum());
    }
    this->log("vertices inside by tetgen " + switches, start, status);
    return status;
  }

  Status accept_fill(MesherData& data, double volume)
  {
    const double after = tet_volumes(data.points, data.tets).sum();
    constexpr double rounding = 1e-9;
    if (std::abs(after - volume) > rounding * volume)
    {
      return Status::failure(StatusCode::internal_error,
        "they changed the volume from " + short_number(volume) + " to " + short_number(after));
    }
    Status status = check_tets(data.points, data.tets);
    if (status.ok())
    {
      this->result_.mesh.points = std::move(data.points);
      this->result_.mesh.tets = std::move(data.tets);
    }
    return status;
  }

  double mean_surface_edge() const
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

  /// Vertices of the input first, in their order, then the others; unused ones go.
  void renumber()
  {
    TetMesh& mesh = this->result_.mesh;
    std::vector<char> used(static_cast<std::size_t>(mesh.points.rows()), 0);
    for (Index k = 0; k < mesh.tets.size(); ++k)
    {
      used[mesh.tets.data()[k]] = 1;
    }
    std::vector<Index> order;
    for (Index v = 0; v < mesh.points.rows(); ++v)
    {
      if (used[v])
      {
        order.push_back(v);
      }
    }
    const auto originals = static_cast<Index>(this->original_.size());
    std::vector<Index> id(used.size(), -1);
    Points points(static_cast<Index>(order.size()), 3);
    this->result_.original_vertices.resize(order.size());
    for (std::size_t v = 0; v < order.size(); ++v)
    {
      id[order[v]] = static_cast<Index>(v);
      points.row(static_cast<Index>(v)) = mesh.points.row(order[v]);
      this->result_.original_vertices[v] = order[v] < originals ? this->original_[order[v]] : -1;
    }
    for (Index k = 0; k < mesh.tets.size(); ++k)
    {
      mesh.tets.data()[k] = id[mesh.tets.data()[k]];
    }
    mesh.points = std::move(points);
  }

  // ---- Lattices --------------------------------------------------------------------------------

  Status remesh(bool finer_when_needed)
  {
    Index resolution = this->options_.resolution;
    constexpr double most_cubes = 4e6;
    for (;;)
    {
      const double start = this->context_.elapsed_seconds();
      const Phase phase(this->context_, "lattice", 0.0, 1.0);
      const Lattice lattice = Lattice::around(this->box_, resolution);
      Status status = stuff_lattice(this->winding_, lattice, this->options_.winding_threshold,
        this->result_.mesh, this->context_);
      if (!status.ok())
      {
        return status;
      }
      const TetMesh& mesh = this->result_.mesh;
      const double volume = tet_volumes(mesh.points, mesh.tets).sum();
      const bool fits = this->volume_fits(volume);
      if (mesh.tets.rows() == 0)
      {
        status = Status::failure(StatusCode::internal_error, "no tet is inside");
      }
      else if (!fits)
      {
        status = this->wrong_volume(volume);
      }
      const auto cubes = static_cast<double>(lattice.cubes[0]) *
        static_cast<double>(lattice.cubes[1]) * static_cast<double>(lattice.cubes[2]);
      this->log("lattice of " + std::to_string(resolution) + " cubes, cut", start, status);
      if (!fits && finer_when_needed && this->winding_volume_ > 0.0 && 8.0 * cubes <= most_cubes)
      {
        resolution *= 2;
        continue;
      }
      this->report_.set("method", to_string(TetMethod::remesh));
      this->report_.set("resolution", Report::Value(resolution));
      if (mesh.tets.rows() == 0)
      {
        return this->encloses_nothing();
      }
      if (!fits)
      {
        this->warn(status.message + ": parts thinner than a lattice cube are lost");
      }
      this->result_.original_vertices.assign(static_cast<std::size_t>(mesh.points.rows()), -1);
      return {};
    }
  }

  Status embed()
  {
    const double start = this->context_.elapsed_seconds();
    const Lattice lattice = Lattice::around(this->box_, this->options_.resolution);
    Status status = cover_lattice(this->surface_.points, this->surface_.triangles, this->winding_,
      lattice, this->options_.winding_threshold, this->result_.mesh, this->context_);
    this->report_.set("method", to_string(TetMethod::embed));
    this->report_.set("resolution", Report::Value(this->options_.resolution));
    this->log("lattice of " + std::to_string(this->options_.resolution) + " cubes", start, status);
    this->result_.original_vertices.assign(
      static_cast<std::size_t>(this->result_.mesh.points.rows()), -1);
    return status;
  }

  Status encloses_nothing() const
  {
    const double threshold = this->options_.winding_threshold;
    return Status::invalid_input("the surface encloses nothing: its winding number reaches " +
      short_number(this->largest_winding_) +
      (this->largest_winding_ < threshold
          ? ", below the threshold of " + short_number(threshold)
          : ", the threshold of " + short_number(threshold) + " only in specks of no size"));
  }

  // ---- The end ---------------------------------------------------------------------------------

  Status check()
  {
    const TetMesh& mesh = this->result_.mesh;
    Status status = check_tets(mesh.points, mesh.tets);
    if (!status.ok())
    {
      return status;
    }
    const Points centers = centers_of(mesh.points, mesh.tets);
    status = this->winding_.evaluate(centers, this->context_, this->result_.winding_numbers);
    if (!status.usable())
    {
      return status;
    }
    const TetQuality quality = measure_tets(mesh.points, mesh.tets);
    const auto& ids = this->result_.original_vertices;
    const auto kept =
      static_cast<Index>(std::count_if(ids.begin(), ids.end(), [](Index id) { return id >= 0; }));
    this->report_.set("counts.tets", Report::Value(mesh.tets.rows()));
    this->report_.set("counts.tet_vertices", Report::Value(mesh.points.rows()));
    this->report_.set("counts.kept_vertices", Report::Value(kept));
    this->report_.set("counts.tets_below_5_degrees", Report::Value(quality.below_5_degrees));
    this->report_.set("volume", Report::Value(quality.volume));
    this->report_.set("winding_volume", Report::Value(this->winding_volume_));
    this->report_.set("min_dihedral_angle", Report::Value(quality.min_dihedral_angle));
    return {};
  }

  void warn(const std::string& sentence) { this->warnings_.push_back(sentence); }

  void log(const std::string& rung, double start, const Status& status)
  {
    this->rung_names_.push_back(rung);
    this->rung_seconds_.push_back(this->context_.elapsed_seconds() - start);
    this->rung_outcomes_.push_back(status.ok() ? "ok" : status.message);
  }

  void report_rungs(Report& report) const
  {
    if (!this->rung_names_.empty())
    {
      report.set("rungs[].name", Report::Value(this->rung_names_));
      report.set("rungs[].seconds", Report::Value(this->rung_seconds_));
      report.set("rungs[].outcome", Report::Value(this->rung_outcomes_));
    }
  }

  PointsView points_;
  TrianglesView triangles_;
  const TetrahedralizeOptions& options_;
  TetrahedralizeResult& result_;
  ExecutionContext& context_;

  RepairedSurface surface_;
  Box box_;
  WindingNumber winding_;
  double winding_volume_ = 0.0;
  double winding_volume_error_ = 1.0; ///< relative
  double largest_winding_ = 0.0;
  double deadline_ = 0.0;
  bool wrong_volume_ = false; ///< of the last tets: TetGen ended well, but other tets are inside
  bool gave_volume_ = false; ///< finer tets did not mend that: more of the same will not either
  std::vector<Index> original_; ///< input id of the helper's first vertices
  Report report_;
  std::vector<std::string> warnings_;
  std::vector<std::string> rung_names_;
  std::vector<double> rung_seconds_;
  std::vector<std::string> rung_outcomes_;
};

Status check_options(const TetrahedralizeOptions& options)
{
  if (!std::isfinite(options.winding_threshold) || options.winding_threshold <= 0.0)
  {
    return Status::invalid_input(
      "winding_threshold must be positive, not " + short_number(options.winding_threshold));
  }
  if (options.resolution < 4 || options.resolution > 1000)
  {
    return Status::invalid_input(
      "resolution must be from 4 to 1000 cubes, not " + std::to_string(options.resolution));
  }
  if (!(options.time_limit > 0.0))
  {
    return Status::invalid_input(
      "time_limit must be positive, not " + short_number(options.time_limit) + " s");
  }
  if (options.memory_limit < 0)
  {
    return Status::invalid_input("memory_limit must not be negative");
  }
  if (!(options.quality == 0.0 || (options.quality >= 1.1 && options.quality <= 10.0)))
  {
    return Status::invalid_input(
      "quality must be 0 or from 1.1 to 10, not " + short_number(options.quality));
  }
  if (!(options.interior_edge >= 0.0))
  {
    return Status::invalid_input(
      "interior_edge must not be negative, but is " + short_number(options.interior_edge));
  }
  return {};
}
} // namespace

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
    case TetMethod::automatic:
      break;
  }
  return "auto";
}

Status tetrahedralize(PointsView points, TrianglesView triangles,
  const TetrahedralizeOptions& options, TetrahedralizeResult& result, ExecutionContext& context)
{
  result = TetrahedralizeResult();
  Status status = check_options(options);
  if (!status.ok())
  {
    return status;
  }
  return Ladder(points, triangles, options, result, context).run();
}

} // namespace bindpose

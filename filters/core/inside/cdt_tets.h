#ifndef bindpose_inside_cdt_tets_h
#define bindpose_inside_cdt_tets_h

#include "base/execution.h"
#include "base/tet_facets.h"
#include "inside/enclosed_region.h"
#include "inside/handle_places.h"
#include "inside/segmentation.h"
#include "surface/surface_repair.h"

#include <limits>
#include <string>
#include <vector>

namespace bindpose
{

struct MesherAnswer;

/// Everything that was tried, with seconds and how it ended.
class RungLog
{
public:
  void add(const std::string& rung, double seconds, const Status& status);
  /// rungs[].name, rungs[].seconds, rungs[].outcome ("ok" or why it was left).
  void report(Report& report) const;

private:
  std::vector<std::string> names_;
  std::vector<double> seconds_;
  std::vector<std::string> outcomes_;
};

/// See TetrahedralizeOptions.
struct CdtOptions
{
  SegmentationOptions segmentation; ///< of open surfaces; a closed one's numbers are whole
  double time_limit = 120.0;
  Index memory_limit = 0;
  bool bare = false;
  double interior_edge = 0.0;
  bool keep_outside = false; ///< the tets that were told apart as they are, outside ones, too
  HandlePlaces handles;
};

/// "the tets hold 3.9, but the winding number encloses 8"
Status wrong_volume(double volume, const EnclosedRegion& inside);

/// Constrained Delaunay tets of a surface's hull, kept where the surface winds around them, by the
/// helper executable: the rungs of method cdt. Call build(), then complete().
class CdtTets
{
public:
  CdtTets(const RepairedSurface& surface, EnclosedRegion& inside, const CdtOptions& options,
    RungLog& log, ExecutionContext& context);

  /// Climbs the rungs until the kept tets' volume is right, for at most `seconds`. On failure the
  /// tets that came nearest are kept: see misfit().
  Status build(double seconds);
  /// EnclosedRegion::misfit of the tets that are there, infinity for none.
  double misfit() const { return this->misfit_; }
  /// Of the tets inside.
  double volume() const { return this->volume_; }
  /// Adds vertices inside, those of handles first, makes flat tets better and numbers the input's
  /// vertices first. Only cancelled is a failure; what else goes wrong is a warning.
  Status complete();

  TetMesh& mesh() { return this->mesh_; }
  std::vector<Index>& original_vertices() { return this->mesh_original_; }
  const std::vector<std::string>& warnings() const { return this->warnings_; }
  /// Of keep_outside, else empty: #T the winding numbers that the decision was made from, and 1 for
  /// the tets that are inside.
  const Eigen::VectorXd& winding_numbers() const { return this->winding_numbers_; }
  const std::vector<char>& inside() const { return this->kept_; }
  /// segmentation of the tets that are kept, and where it was a graph cut, energy,
  /// threshold_energy, counts.changed_by_cut (see Segmentation).
  const Report& report() const { return this->report_; }

private:
  struct Move;
  struct Way;
  struct TetgenRun;
  struct Inside;
  /// Height of tets at the boundary that are taken off, of the diagonal.
  static constexpr double flat_height = 1e-11;

  Status try_switches(const Move& move, const MesherData& refined);
  Status try_fine_tets(const Move& move, const MesherData& refined);
  Status try_tetgen(const Way& way, const Move& move, const MesherData& input);
  TetgenRun run_tetgen(const Way& way, const MesherData& input, ExecutionContext& context) const;
  Status judge(const Way& way, const Move& move, const TetgenRun& run);
  Status try_delaunay(const MesherData& refined);
  Status refine(const Move& move, MesherData& refined);
  Status move_vertices(const Move& move, RepairedSurface& moved);
  Status run_job(const std::vector<std::string>& arguments, const MesherData& input, double seconds,
    MesherAnswer& answer, ExecutionContext& context) const;
  bool final(const Status& status) const;
  bool out_of_patience() const;
  Status keep_inside(const MesherData& data);
  Status take_inside(const MesherData& data, const Eigen::VectorXd& w, SegmentationMethod method);
  Status swap_flat(const Points& points, Tets& tets, std::vector<TetFacet>& facets);
  void take_all(const MesherData& data, const Eigen::VectorXd& w, const std::vector<char>& inside);
  Status fill();
  Status find_places(Inside& inside);
  Status find_even_places(
    double length, double long_edge, Index most_tets, Index most, Inside& inside);
  Status find_inner_places(Index most, Inside& inside);
  Status look_inside(double longest, Inside& inside);
  Points places_of_handles(Inside& inside) const;
  Status insert(const Points& places, std::vector<Index>& vertices);
  Status accept(TetMesh& mesh);
  Status improve();
  double mean_surface_edge() const;
  double volume_bound() const;
  void renumber();

  const RepairedSurface& surface_;
  EnclosedRegion& inside_;
  CdtOptions options_;
  RungLog& log_;
  ExecutionContext& context_;
  double diagonal_ = 0.0;
  double start_ = 0.0;
  double deadline_ = 0.0;
  std::vector<Index> original_; ///< input id of the first vertices of the rung's points
  bool wrong_volume_ = false; ///< the rung's tets are there, but their volume is wrong
  bool finer_is_no_better_ = false; ///< then more of the same will not help
  bool timed_out_ = false; ///< the last run of TetGen ended because of its time limit
  double job_seconds_ = 0.0; ///< of refinements and of TetGen, one after the other
  bool too_many_crossings_ = false; ///< the refinement gave up because of them
  bool fine_fails_ = false; ///< small tets were tried, and there were none
  TetMesh mesh_;
  Eigen::VectorXd winding_numbers_;
  std::vector<char> kept_;
  std::vector<Index> mesh_original_;
  std::vector<Index> handle_vertices_; ///< at points of handles, inside
  double misfit_ = std::numeric_limits<double>::infinity();
  double volume_ = 0.0;
  std::vector<std::string> warnings_;
  Report report_;
};

} // namespace bindpose

#endif

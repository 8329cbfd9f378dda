#ifndef bindpose_inside_cdt_tets_h
#define bindpose_inside_cdt_tets_h

// Method cdt of tetrahedralize(): TetGen computes constrained Delaunay tets, and the tets inside
// the surface are kept.

#include "base/execution.h"
#include "geometry/tet_facets.h"
#include "inside/enclosed_region.h"
#include "inside/handle_elements.h"
#include "segmentation/segmentation.h"
#include "surface/surface_repair.h"

#include <limits>
#include <string>
#include <vector>

namespace bindpose
{

struct MesherResult;

/// Log of the attempts of a meshing method (`rungs` in the report). Each attempt has a duration in
/// seconds and an outcome.
class AttemptLog
{
public:
  void add(const std::string& attempt, double seconds, const Status& status);
  /// Report rungs[].name, rungs[].seconds and rungs[].outcome. An outcome is "ok" or the message of
  /// the failure.
  void report(Report& report) const;

private:
  std::vector<std::string> names_;
  std::vector<double> seconds_;
  std::vector<std::string> outcomes_;
};

/// Options of method cdt; documented at TetrahedralizeOptions.
struct CdtOptions
{
  /// Options of the segmentation. For closed surfaces, only the threshold is used, because all
  /// winding numbers are integers.
  SegmentationOptions segmentation;
  double time_limit = 120.0;
  Index memory_limit = 0;
  bool bare = false;
  double interior_edge = 0.0;
  bool keep_outside = false; ///< keep all segmented tets unchanged, including the tets outside
  HandleElements handles;
};

/// Return the failure for tets whose total volume differs from the volume of the enclosed region.
/// The message is EnclosedRegion::relative_volume(volume), which compares the two volumes.
/// @param volume total volume of the tets.
Status wrong_volume_error(double volume, const EnclosedRegion& inside);

/// Constrained Delaunay tets of the convex hull of a surface, reduced to the tets that the
/// segmentation labels as inside. The helper executable bindpose-mesher runs TetGen. This class
/// implements all attempts of method cdt. Call build() first, then complete().
class CdtTets
{
public:
  CdtTets(ExecutionContext& context, const RepairedSurface& surface, EnclosedRegion& inside,
    const CdtOptions& options, AttemptLog& log);

  /// Try one set of TetGen switches after another, for at most `seconds`, until the tets inside
  /// have the right volume. On failure, the tets with the smallest misfit() are kept.
  Status build(double seconds);
  /// Return EnclosedRegion::misfit of the kept tets, or infinity if there are none.
  double misfit() const { return this->misfit_; }
  /// Return the volume of the tets inside.
  double volume() const { return this->volume_; }
  /// Insert vertices inside (first at the points of handles), improve flat tets, and renumber the
  /// vertices so that the input's vertices come first. Return ok or the status `canceled`; other
  /// problems become warnings.
  Status complete();

  TetMesh& mesh() { return this->mesh_; }
  std::vector<Index>& original_vertices() { return this->mesh_original_; }
  const std::vector<std::string>& warnings() const { return this->warnings_; }
  /// #T: winding numbers from which the segmentation was computed; empty unless `keep_outside` is
  /// set.
  const Eigen::VectorXd& winding_numbers() const { return this->winding_numbers_; }
  /// #T: 1 for a tet inside, 0 for a tet outside; empty unless `keep_outside` is set.
  const std::vector<char>& inside() const { return this->is_inside_; }
  /// Report of the kept tets: segmentation and, if the labels are from a graph cut, energy,
  /// threshold_energy and counts.changed_by_cut (see Segmentation).
  const Report& report() const { return this->report_; }

private:
  struct Perturbation;
  struct TetgenSetup;
  struct TetgenRun;
  struct FillState;
  /// Tets at the boundary are removed if their height is smaller than this, in bounding-box
  /// diagonals.
  static constexpr double flat_height = 1e-11;

  Status try_switches(const Perturbation& move, const MesherData& refined);
  Status try_fine_tets(const Perturbation& move, const MesherData& refined);
  Status try_tetgen(const TetgenSetup& setup, const Perturbation& move, const MesherData& input);
  TetgenRun run_tetgen(
    ExecutionContext& context, const TetgenSetup& setup, const MesherData& input) const;
  Status evaluate_run(const TetgenSetup& setup, const Perturbation& move, const TetgenRun& run);
  Status try_delaunay(const MesherData& refined);
  Status refine(const Perturbation& move, MesherData& refined);
  Status move_vertices(const Perturbation& move, RepairedSurface& moved);
  Status run_job(ExecutionContext& context, const std::vector<std::string>& arguments,
    const MesherData& input, double seconds, MesherResult& answer) const;
  bool is_final(const Status& status) const;
  bool time_budget_is_used() const;
  Status keep_inside(const MesherData& data);
  Status segment_and_store(
    const MesherData& data, const Eigen::VectorXd& w, SegmentationMethod method);
  Status swap_flat(const Points& points, Tets& tets, std::vector<TetFacet>& facets);
  void store_all_tets(
    const MesherData& data, const Eigen::VectorXd& w, const std::vector<char>& inside);
  Status fill();
  Status find_positions(FillState& inside);
  Status find_even_positions(
    double length, double long_edge, Index maximum_tets, Index most, FillState& inside);
  Status find_inner_positions(Index most, FillState& inside);
  Status prepare_interior(double longest, FillState& inside);
  Points positions_on_handles(FillState& inside) const;
  Status insert(const Points& positions, std::vector<Index>& vertices);
  Status accept(TetMesh& mesh);
  Status improve();
  double mean_surface_edge() const;
  double volume_bound() const;
  void renumber();

  const RepairedSurface& surface_;
  EnclosedRegion& inside_;
  CdtOptions options_;
  AttemptLog& log_;
  ExecutionContext& context_;
  double diagonal_ = 0.0;
  double start_ = 0.0;
  double deadline_ = 0.0;
  /// Input ids of the vertices that the current attempt takes from the input. These vertices come
  /// first in the attempt's mesh.
  std::vector<Index> original_;
  bool wrong_volume_ = false; ///< whether the last attempt gave tets with a wrong volume
  bool refinement_is_useless_ = false; ///< whether finer tets cannot improve the result
  bool timed_out_ = false; ///< whether the last run of TetGen reached its time or work limit
  double job_seconds_ = 0.0; ///< total duration of the refinements and the TetGen runs
  /// Whether the refinement was stopped because too many triangles cross each other.
  bool too_many_crossings_ = false;
  /// Whether try_fine_tets() has failed for another reason than a wrong volume.
  bool fine_fails_ = false;
  TetMesh mesh_;
  Eigen::VectorXd winding_numbers_;
  std::vector<char> is_inside_;
  std::vector<Index> mesh_original_;
  std::vector<Index> handle_vertices_; ///< vertices at the handle points inside the tets
  double misfit_ = std::numeric_limits<double>::infinity();
  double volume_ = 0.0;
  std::vector<std::string> warnings_;
  Report report_;
};

} // namespace bindpose

#endif

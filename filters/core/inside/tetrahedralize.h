#ifndef bindpose_inside_tetrahedralize_h
#define bindpose_inside_tetrahedralize_h

#include "base/execution.h"
#include "base/mesh.h"
#include "inside/embedding_tets.h"
#include "inside/handle_places.h"
#include "inside/segmentation.h"
#include "inside/surface_defects.h"

#include <vector>

namespace bindpose
{

/// How tets are made. The order is the one vtkTetrahedralizeSurface exposes.
enum class TetMethod
{
  automatic, ///< cdt, then remesh
  cdt, ///< constrained Delaunay tets of the convex hull, kept where the surface winds around them
  remesh, ///< well-shaped tets of the winding number's field, graded
  embed ///< lattice tets that hold the surface, each part its own
};

/// "auto", "cdt", "remesh", "embed".
const char* to_string(TetMethod method);

struct TetrahedralizeOptions
{
  TetMethod method = TetMethod::automatic;
  /// Inside is where the winding number is at least this. 0.5 is half way through the surface;
  /// up to 0.9 pulls the lid of an opening inwards, 1.5 keeps what is enclosed twice.
  double winding_threshold = 0.5;
  /// cdt of open surfaces only: see SegmentationOptions. (A closed surface's winding numbers are
  /// whole between its triangles, and nothing is left to decide.)
  SegmentationMethod segmentation = SegmentationMethod::graph_cut;
  double cut_smoothness = 1.0; ///< >= 0
  double cut_sigma = 0.1; ///< > 0
  /// Lattice cubes along the longest side (remesh, embed), 4 … 1000. Tets grow with its cube; those
  /// of remesh have edges from 0.2 to 1.4 cubes. 0: automatic, 40 for remesh, as many as give about
  /// 30,000 tets for embed.
  Index resolution = 0;
  double time_limit = 120.0; ///< seconds for all of the helper's work, > 0
  Index memory_limit = 0; ///< MiB of address space for the helper process, 0: no limit
  /// cdt only: largest ratio of circumradius to shortest edge that interior vertices are added for;
  /// 1.1 … 2, 0: none are added. The surface's triangles are never split for it.
  double quality = 1.414;
  /// cdt only: longest edges inside, as a fraction of the surface's diagonal; 0: no bound. Smooth
  /// weights need vertices inside, not only on the surface.
  double interior_edge = 0.04;
  /// cdt only: points that become vertices where they are inside, segments and triangles on which
  /// vertices are put at the local edge length. (insert_handles splits other methods' tets.)
  HandlePlaces handles;
};

struct TetrahedralizeResult
{
  TetMesh mesh; ///< positive tets, no stray vertices
  std::vector<Index> original_vertices; ///< #V: id of the input vertex, ascending, then -1 for new
  Eigen::VectorXd winding_numbers; ///< #T: at the tets' centres
  std::vector<DefectPlace> defects; ///< where the surface is unclean
  std::vector<Index> handle_vertices; ///< of cdt, #H: vertex at the handles' point, -1 for none
  /// Of embed only, else empty: #T share of the tet that is inside, and where the input's points
  /// lie.
  Eigen::VectorXd inside_fractions;
  PointBinding binding;
};

/// Tets of what a surface encloses, whatever the surface: open, crossing, doubled, non-manifold,
/// partly inside out (Jacobson, Kavan, Sorkine-Hornung, Robust Inside-Outside Segmentation using
/// Generalized Winding Numbers, 2013).
///
/// - **cdt** keeps the input's vertices and triangles, cut where triangles cross. Clean surfaces go
///   to TetGen as they are. The work is done by the helper executable bindpose-mesher.
/// - **remesh** has good angles. Delaunay refinement by the helper grades edges by the
///   surface's own and keeps its vertices where they are not too near to each other, not its
///   triangles (remesh_tets.h). Without the helper, or when it fails, runs out of time or the
///   volume does not fit, a lattice is cut, which always ends: it keeps no vertex, and parts
///   thinner than a lattice cube are lost.
/// - **embed** is not the inside but a lattice around it; every point of the surface is in a tet.
///   Parts that are near but not connected share no vertex (embed_surface).
///
/// Orientation is repaired first (repair_surface); what was turned is in a warning.
///
/// Report: method; rungs[].name, rungs[].seconds, rungs[].outcome (each thing tried, and why it was
/// left); counts.* of the diagnosis; counts.tets, counts.tet_vertices, counts.kept_vertices;
/// volume (of the tets), winding_volume (of {w >= threshold}: exact for clean surfaces, sampled
/// otherwise), winding_volume_error (its standard error, relative), min_dihedral_angle (degrees),
/// counts.tets_below_5_degrees, quality[].dihedral_angle, quality[].tets (how many tets have their
/// smallest dihedral angle from this many degrees to the next);
/// counts.handle_points, counts.handle_vertices (of cdt with handles: how many of their points are
/// vertices);
/// segmentation (of cdt; a graph cut whose volume does not fit is left for the threshold), energy,
/// threshold_energy, counts.changed_by_cut (see Segmentation); for remesh and embed resolution, for
/// embed what embed_surface reports.
/// For remesh by refinement distance_max and distance_mean (of the tets' boundary and the surface,
/// percent of its diagonal).
///
/// invalid_input: not finite, flat, or encloses nothing; or, of method automatic, neither cdt nor
/// remesh gives a valid mesh: the message tells the last reason and names method embed.
/// unavailable: method cdt without helper. internal_error: the method asked for gave no valid mesh.
/// Cost: about 10 us a triangle and 5 us a tet for clean surfaces, 50 us a triangle for others.
Status tetrahedralize(PointsView points, TrianglesView triangles,
  const TetrahedralizeOptions& options, TetrahedralizeResult& result, ExecutionContext& context);

} // namespace bindpose

#endif

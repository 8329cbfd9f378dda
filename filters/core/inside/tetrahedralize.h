#ifndef bindpose_inside_tetrahedralize_h
#define bindpose_inside_tetrahedralize_h

#include "base/execution.h"
#include "base/mesh.h"
#include "embedding/embedding_tets.h"
#include "inside/handle_places.h"
#include "inside/prepared_surface.h"
#include "inside/segmentation.h"

#include <vector>

namespace bindpose
{

/// How tets are made. The order is the one vtkTetrahedralizeSurface exposes.
enum class TetMethod
{
  automatic, ///< cdt, then remesh
  cdt, ///< constrained Delaunay tets of the convex hull, kept where the surface winds around them
  remesh, ///< well-shaped tets of the winding number's field, graded
  embed, ///< lattice tets that hold the surface, each part its own
  wrap, ///< cdt of a closed surface around the surface
  ftetwild ///< by the program fTetWild, where it is installed
};

/// "auto", "cdt", "remesh", "embed", "wrap", "ftetwild".
const char* to_string(TetMethod method);

/// The interior_edge that smooth weights need in a surface that encloses a volume in a box of this
/// diagonal: at most 0.04, and such that there are at least about 10,000 tets. With fewer of them
/// weights are more than 0.015 rms from those of much finer tets.
double interior_edge_of_weights(double volume, double diagonal);

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
  /// embed with resolution 0: about how many lattice tets, >= 1.
  Index lattice_tets = 30000;
  /// Seconds for all of the helper's or fTetWild's work, >= 0. 0: 120, or 120 per million triangles
  /// if that is more.
  double time_limit = 0.0;
  Index memory_limit = 0; ///< MiB of address space for a helper process, 0: no limit
  /// Smallest dihedral angle that every tet must have, degrees, 0 … 20. Method automatic leaves the
  /// surface's triangles for it where they do not allow it (remesh reaches 10.7 on any surface); a
  /// result that misses it is not_converged. 0: as large as the surface's triangles allow.
  double quality = 0.0;
  /// cdt and wrap only: no vertices are added inside and flat tets stay as they are; interior_edge
  /// and quality must be 0.
  bool bare = false;
  /// cdt and wrap: longest edges inside, as a fraction of the surface's diagonal, >= 0; edges of
  /// the surface that are longer than three of these are split. 0: automatic; edges inside are as
  /// long as the surface's own near them and grow with the distance to it, vertices are added until
  /// there are 4.5 tets per triangle, and a surface of few triangles is filled with about 1,500
  /// tets, for which its long edges are split. Smooth weights need vertices inside, not only on the
  /// surface. ftetwild: the edge length that it aims at everywhere; 0: its own 0.05.
  double interior_edge = 0.0;
  /// cdt only: keep all tets of the surface's convex hull (or of a box around it, where that was
  /// needed), as the segmentation told them apart: labels says which are inside. No vertices are
  /// added, not for handles either.
  bool keep_outside = false;
  /// wrap only, fractions of the surface's diagonal: radius of the ball that carves (0.0001 … 1)
  /// and distance of the wrap from the surface (0.000001 … 1): see WrapOptions.
  double wrap_alpha = 0.02;
  double wrap_offset = 0.001;
  /// ftetwild only: how far the boundary may be from the surface, as a fraction of the diagonal,
  /// 0.00001 … 0.1.
  double ftetwild_epsilon = 1e-3;
  /// cdt and wrap: points that become vertices where they are inside, segments and triangles on
  /// which vertices are put at the local edge length. (insert_handles splits other methods' tets.)
  HandlePlaces handles;
};

/// What became of a tet. The numbers are those of the array `Label`: above 0 is inside.
enum class TetLabel
{
  outside_above = -1, ///< outside, though its winding number reaches the threshold
  outside = 0,
  inside = 1,
  inside_below = 2 ///< inside, though its winding number is below the threshold
};

struct TetrahedralizeResult
{
  TetMesh mesh; ///< positive tets, no stray vertices
  std::vector<Index> original_vertices; ///< #V: id of the input vertex, ascending, then -1 for new
  /// #T: at the tets' centres; with keep_outside what the segmentation decided on, which is a mean
  /// for large tets near the threshold.
  Eigen::VectorXd winding_numbers;
  std::vector<TetLabel> labels; ///< #T; a tet of embed is inside where its centre is
  Eigen::VectorXd min_dihedral_angles; ///< #T, degrees
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
/// - **wrap** is cdt of an alpha wrap (wrap_surface.h), by the helper: for surfaces whose
///   orientation is hopeless, sheets and loose triangles; winding numbers have no say. What is
///   closed up to gaps of two alpha becomes solid, and **what is open becomes a thin shell**, with
///   a warning that names both volumes. All of the surface is in it or, at
///   corners, on its boundary; no vertex is kept.
/// - **ftetwild** is what the program fTetWild makes of the surface, where it is installed
///   (ftetwild_process.h). winding_threshold must be 0.5. No vertex is kept.
///
/// auto takes neither embed nor wrap nor ftetwild.
///
/// Orientation is repaired first (repair_surface); what was turned is in a warning.
///
/// Report: method; rungs[].name, rungs[].seconds, rungs[].outcome (each thing tried, and why it was
/// left); counts.* of the diagnosis; counts.tets, counts.tet_vertices, counts.kept_vertices;
/// volume (of the tets inside), winding_volume (of {w >= threshold}: exact for clean surfaces,
/// sampled otherwise), winding_volume_error (its standard error, relative), min_dihedral_angle
/// (degrees), counts.tets_below_5_degrees, counts.tets_below_5_degrees_forced (how many of these
/// have an edge of a boundary triangle with a corner below 5 degrees or with another boundary
/// triangle close in front of it, or an edge at which two boundary triangles meet at less than 5
/// degrees: while the surface's triangles are kept, few of them can be better),
/// quality[].dihedral_angle, quality[].tets (how many tets have their smallest dihedral angle from
/// this many degrees to the next); counts.handle_points,
/// counts.handle_vertices (of cdt with handles: how many of their points are vertices);
/// segmentation (of cdt; a graph cut whose volume does not fit is left for the threshold), energy,
/// threshold_energy, counts.changed_by_cut (see Segmentation); for remesh and embed resolution, for
/// embed what embed_surface reports.
/// For remesh by refinement, wrap and ftetwild distance_max and distance_mean (of the tets'
/// boundary and the surface where that bounds the inside, percent of its diagonal); for wrap
/// counts.wrap_triangles.
///
/// not_converged: a dihedral angle is below quality; the message names the smallest angle.
/// invalid_input: not finite, flat (but for embed and wrap), or encloses nothing (the same);
/// keep_outside with another method than cdt; or, of
/// method automatic, neither cdt nor remesh gives a valid mesh: the message tells the last reason
/// and names method embed. unavailable: method cdt or wrap without helper, ftetwild without
/// fTetWild; method remesh (or another) found no tet in what is enclosed, too thin for its tets.
/// internal_error: the method asked for gave no valid mesh.
/// Cost: about 0.1 ms a triangle, and up to 1 ms where many are needles or cross.
Status tetrahedralize(PointsView points, TrianglesView triangles,
  const TetrahedralizeOptions& options, TetrahedralizeResult& result, ExecutionContext& context);

/// The same for a surface that prepare_surface() has made ready, with the same points, triangles
/// and winding threshold (another threshold: invalid_input).
Status tetrahedralize(PointsView points, TrianglesView triangles, PreparedSurface& prepared,
  const TetrahedralizeOptions& options, TetrahedralizeResult& result, ExecutionContext& context);

/// The result of method embed for tets that embed_surface() has made of the prepared surface: with
/// winding numbers, labels, angles and the report. Cost: a winding number a tet.
Status take_embedding(PointsView points, TrianglesView triangles, PreparedSurface& prepared,
  EmbeddingTets embedding, TetrahedralizeResult& result, ExecutionContext& context);

} // namespace bindpose

#endif

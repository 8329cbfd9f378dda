#ifndef bindpose_inside_tetrahedralize_h
#define bindpose_inside_tetrahedralize_h

// Tets of the volume that any triangle mesh encloses: choice of the method, options and report.

#include "base/execution.h"
#include "embedding/embedding_tets.h"
#include "geometry/mesh.h"
#include "inside/handle_elements.h"
#include "inside/prepared_surface.h"
#include "segmentation/segmentation.h"

#include <vector>

namespace bindpose
{

/// Method of tetrahedralization. vtkTetrahedralizeSurface uses the same integer values.
enum class TetMethod
{
  automatic, ///< method cdt; if it fails, a cut lattice or Delaunay refinement
  /// Constrained Delaunay tets of the convex hull, reduced to the tets that the segmentation labels
  /// as inside.
  cdt,
  remesh, ///< well-shaped, graded tets of the region that the winding number defines
  embed, ///< lattice tets that contain the surface; unconnected surface parts share no vertex
  wrap, ///< method cdt, applied to a closed surface that wraps the input
  ftetwild ///< the program fTetWild, if it is installed
};

/// Return "auto", "cdt", "remesh", "embed", "wrap" or "ftetwild".
const char* to_string(TetMethod method);

/// Return the value of `interior_edge` that smooth weights need in a surface with this volume and
/// this bounding-box diagonal. The value is at most 0.04, and small enough for about 10,000 tets.
/// With fewer tets, the weights differ by more than 0.015 (root mean square) from the weights on
/// much finer tets.
double interior_edge_of_weights(double volume, double diagonal);

/// Options of tetrahedralize().
struct TetrahedralizeOptions
{
  TetMethod method = TetMethod::automatic;
  /// Threshold > 0: a point is inside if its winding number is at least this value. 0.5 is the mean
  /// of the winding numbers on the two sides of the surface. With values up to 0.9, the boundary in
  /// openings moves inwards. With 1.5, the result is the volume that is enclosed twice.
  double winding_threshold = 0.5;
  /// Used by cdt for open surfaces only: see SegmentationOptions. (All winding numbers of a closed
  /// surface are integers, so the graph cut and the threshold give the same labels.)
  SegmentationMethod segmentation = SegmentationMethod::graph_cut;
  double cut_smoothness = 1.0; ///< >= 0
  double cut_sigma = 0.1; ///< > 0
  /// Lattice cubes along the longest side (remesh, embed), 4 … 1000. The number of tets grows with
  /// the cube of the resolution. The edges of method remesh are between 0.2 and 1.4 cubes long. If
  /// the resolution is 0, remesh uses 40, and embed uses the resolution that gives about
  /// `lattice_tets` tets.
  Index resolution = 0;
  /// For embed with resolution 0: approximate number (>= 1) of lattice tets.
  Index lattice_tets = 30000;
  /// Time limit for the helper executable or fTetWild in seconds, >= 0. If it is 0, the limit is
  /// 120 seconds for up to a million triangles, and 120 seconds per million triangles for more.
  double time_limit = 0.0;
  Index memory_limit = 0; ///< largest address space of a helper process in MiB, 0: no limit
  /// Required smallest dihedral angle of every tet, degrees, 0 … 20. If the surface's triangles do
  /// not allow this angle, method automatic uses remesh, which does not keep the triangles and
  /// reaches 10.7 degrees on any surface. The status is not_converged if a tet of the result has a
  /// smaller angle. If `quality` is 0, no angle is required.
  double quality = 0.0;
  /// For cdt and wrap only: if true, no vertices are inserted inside, except for handles, and flat
  /// tets are not improved. Then `interior_edge` and `quality` must be 0.
  bool bare = false;
  /// For cdt and wrap: maximum length (>= 0) of edges inside, in bounding-box diagonals. Surface
  /// edges longer than three times `interior_edge` are split.
  ///
  /// If `interior_edge` is 0, edges inside are as long as the surface's edges near them, and their
  /// length increases with the distance to the surface. Vertices are inserted until there are about
  /// 4.2 tets per triangle of the surface. If these are fewer than 1,500 tets, long edges of the
  /// surface are split and about 1,500 tets are created.
  ///
  /// Smooth weights need vertices inside, in addition to those on the surface. For ftetwild,
  /// `interior_edge` is the target edge length everywhere; if it is 0, fTetWild uses its default of
  /// 0.05.
  double interior_edge = 0.0;
  /// For cdt only: keep all segmented tets of the surface's convex hull (or of a larger box, if
  /// TetGen filled a box). See TetrahedralizeResult::labels for the tets that are inside. No
  /// vertices are added, not even for handles.
  bool keep_outside = false;
  /// For wrap only, in bounding-box diagonals: radius of the carving ball (0.0001 … 1) and distance
  /// of the wrap's vertices from the surface (0.000001 … 1). See WrapOptions.
  double wrap_alpha = 0.02;
  double wrap_offset = 0.001;
  /// For ftetwild only: maximum distance of the tets' boundary from the surface, in bounding-box
  /// diagonals, 0.00001 … 0.1.
  double ftetwild_epsilon = 1e-3;
  /// For cdt and wrap: each handle point that is inside becomes a vertex. Along segments and
  /// triangles of handles, vertices are inserted at intervals of the local edge length.
  /// (insert_handles() splits the tets of the other methods.)
  HandleElements handles;
};

/// Label of a tet. The values are those of the array `Label`: a tet is inside if its value is above
/// 0.
enum class TetLabel
{
  outside_above = -1, ///< outside, though the tet's winding number reaches the threshold
  outside = 0,
  inside = 1,
  inside_below = 2 ///< inside, though the tet's winding number is below the threshold
};

/// Result of tetrahedralize().
struct TetrahedralizeResult
{
  TetMesh mesh; ///< positively oriented tets; no vertex is unused
  /// #V: id of the input vertex; -1 for a new vertex. Vertices of the input come first, with
  /// ascending ids.
  std::vector<Index> original_vertices;
  /// Winding numbers at the centers of the tets, #T. With keep_outside, they are the winding
  /// numbers that the segmentation used: for a large tet near the threshold, the mean of four
  /// points.
  Eigen::VectorXd winding_numbers;
  /// Label of each tet, #T; a tet of method embed is inside if its center is inside.
  std::vector<TetLabel> labels;
  Eigen::VectorXd min_dihedral_angles; ///< #T, degrees
  std::vector<DefectOccurrence> defects; ///< defects of the surface with their locations
  std::vector<Index> handle_vertices; ///< for cdt and wrap, #H: vertex at the handle point, or -1
  /// For embed only, otherwise empty: the fraction of each tet that is inside, #T, and the
  /// positions of the input points in the tets.
  Eigen::VectorXd inside_fractions;
  PointBinding binding;
};

/// Compute tets of the volume that a surface encloses. The surface may be open, crossing, doubled,
/// non-manifold or partly inside out (Jacobson, Kavan, Sorkine-Hornung, Robust Inside-Outside
/// Segmentation using Generalized Winding Numbers, 2013).
///
/// - **cdt** keeps the input's vertices and triangles. Triangles are cut along their crossings.
///   Clean surfaces are passed to TetGen unchanged. The helper executable bindpose-mesher does the
///   work.
/// - **remesh** gives tets with good angles. The helper computes them by Delaunay refinement. Edge
///   lengths are graded like the edges of the surface. The surface's vertices are kept if they are
///   far enough from each other; its triangles are not kept (remesh_tets.h). A lattice is cut
///   instead if there is no helper, if the helper fails or exceeds its time limit, or if the volume
///   is wrong. The lattice always gives a mesh, but it keeps no vertex, and parts thinner than a
///   lattice cube are lost.
/// - **embed** computes a lattice around the inside; every point of the surface is in a tet. Parts
///   that are near each other but not connected share no vertex (embed_surface).
/// - **wrap** applies cdt to an alpha wrap of the surface (wrap_surface.h), which the helper
///   computes. It is intended for surfaces with unusable orientation, for sheets and for loose
///   triangles. The winding number does not affect the result. A part whose gaps are narrower than
///   two alpha becomes solid. **An open part becomes a thin shell**, with a warning that contains
///   both volumes. The whole surface is inside the tets or, at corners, on their boundary. No input
///   vertex is kept.
/// - **ftetwild** runs the program fTetWild on the surface, if it is installed
///   (ftetwild_process.h). winding_threshold must be 0.5. No input vertex is kept.
///
/// Method automatic tries cdt. If it fails, the following attempts are made until one has the right
/// volume: cut a lattice of twice the resolution (at most four million cubes); Delaunay refinement
/// as in remesh, unless most of the region is too thin for it; cut a lattice of four times the
/// resolution. The report then contains remesh as the method. If cdt does not reach `quality`, the
/// refinement is tried first. Method automatic never uses embed, wrap or ftetwild.
///
/// Orientation is repaired first (repair_surface); a warning reports the flipped parts.
///
/// Report:
/// - method
/// - rungs[].name, rungs[].seconds, rungs[].outcome: each attempt and its outcome
/// - counts.* of the diagnosis of surface defects
/// - counts.tets, counts.tet_vertices, counts.kept_vertices
/// - volume: volume of the tets inside
/// - winding_volume: volume of {w >= threshold}, exact for clean surfaces, sampled otherwise
/// - winding_volume_error: relative standard error of winding_volume
/// - min_dihedral_angle: degrees
/// - counts.tets_below_5_degrees
/// - counts.tets_below_5_degrees_forced: the number of these tets that have an edge at which the
///   boundary forces a small angle (see count_forced_tets). Most of them cannot be improved while
///   the surface's triangles are kept.
/// - quality[].dihedral_angle, quality[].tets: number of tets whose smallest dihedral angle is
///   between dihedral_angle (degrees) and the next value of the list
/// - counts.handle_points, counts.handle_vertices: for cdt and wrap with handles, the number of
///   handle points and the number of handle points that are vertices of the mesh
/// - segmentation: for cdt and wrap, the method in use; if the volume of a graph cut is wrong, the
///   threshold is used instead
/// - energy, threshold_energy, counts.changed_by_cut: see Segmentation
/// - resolution: for remesh and embed
/// - the report of embed_surface: for embed
/// - distance_max, distance_mean: for remesh, wrap and ftetwild, distances between the tets'
///   boundary and the part of the surface that bounds the inside, percent of the bounding-box
///   diagonal
/// - counts.wrap_triangles: for wrap
///
/// Status codes:
/// - not_converged: a dihedral angle is below `quality`; the message contains the smallest angle.
/// - invalid_input: a coordinate is not finite; the surface is flat or encloses no volume (except
///   for embed and wrap); keep_outside is used with another method than cdt; or, for method
///   automatic, neither cdt nor remesh gives a valid mesh. In the last case, the message contains
///   the last reason and recommends method embed.
/// - unavailable: there is no helper for method cdt or wrap; there is no fTetWild for method
///   ftetwild; or a method found no tet inside, because the enclosed region is too thin for its
///   tets.
/// - internal_error: the requested method gave no valid mesh.
///
/// Cost: about 0.1 ms per triangle, and up to 1 ms if many triangles are needles or cross.
Status tetrahedralize(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const TetrahedralizeOptions& options, TetrahedralizeResult& result);

/// Compute the tets as above for a surface from prepare_surface(). The points, triangles and
/// winding threshold must be the same as in the preparation; a different threshold gives
/// invalid_input.
Status tetrahedralize(ExecutionContext& context, PointsView points, TrianglesView triangles,
  PreparedSurface& prepared, const TetrahedralizeOptions& options, TetrahedralizeResult& result);

/// Finish method embed, for tets that embed_surface() has computed for the prepared surface: set
/// their winding numbers, labels, angles and the report. Cost: one winding number per tet.
Status complete_embedding(ExecutionContext& context, PointsView points, TrianglesView triangles,
  PreparedSurface& prepared, EmbeddingTets embedding, TetrahedralizeResult& result);

} // namespace bindpose

#endif

/**
 * @class   vtkTetrahedralizeSurface
 * @brief   computes tets that fill the inside of any surface
 *
 * The surface may be open, cross itself, be doubled, non-manifold, made of loose triangles or
 * partly inside out. Its generalized winding number determines the inside. The orientation is
 * repaired first; a warning reports triangles that were flipped.
 *
 * **Input 0**: a vtkPointSet with 2D cells (polygons and strips are split into triangles; other
 * cells are ignored and counted).
 * **Input 1** (optional): handles (see vtkHandleFileReader). CDT and WRAP add the handles inside of
 * the surface to the mesh. Points, ends of bones and cage vertices become points of the mesh.
 * Further points are added along bones and cages, at distances of the local edge length. The
 * weights filters split the cells of other methods where handles need it.
 * **Output**: a vtkUnstructuredGrid of tets (VTK_TETRA, all of positive volume) with the point
 * array `OriginalPointIds` (id of the input point, ascending, then -1 for new points) and three
 * cell arrays. `WindingNumber` (double) is evaluated at the tets' centers. `Label` (int) is 1 for
 * tets inside and 0 outside. It is 2 for tets that are inside although their winding number is
 * below the threshold, and -1 for tets that are outside although their winding number reaches the
 * threshold. Tets outside occur only with KeepOutside and EMBED. `MinDihedralAngle` (double) is the
 * tet's smallest dihedral angle in degrees. The field data array `Method` contains the method (as
 * in the report).
 * **Output 1**: a vtkPolyData with the defects of the surface, as from vtkSurfaceDefects.
 * (vtkSurfaceDefects also works if the tetrahedralization fails.)
 * **Output 2**: the surface's points and triangles as a vtkPolyData for EMBED, otherwise empty. Its
 * point arrays are `TetIds` (the cell of output 0 that contains the point; -1 for a point that
 * belongs to no triangle and is in no cell) and `BarycentricCoordinates` (4 components, in the
 * order of the cell's points). Output 0 then has the cell array `InsideFraction` (fraction of the
 * tet that is inside).
 *
 * Methods:
 * - CDT (constrained Delaunay tetrahedralization) keeps the input's points and triangles, cut where
 *   triangles cross, and adds points inside. Clean surfaces are passed to TetGen unchanged. Other
 *   surfaces are cut with exact arithmetic along their crossings, and their convex hull is filled
 *   with tets. The tets that the segmentation by winding numbers classifies as inside are kept (see
 *   Segmentation). A helper process does the work (bindpose-mesher, built with the packages
 *   libcgal-dev and libtet1.5-dev).
 * - REMESH fills the region where the winding number reaches the threshold with well-shaped tets,
 *   by Delaunay refinement in the helper process. The size of the tets follows the lengths of the
 *   surface's edges. REMESH keeps points that are not too close to each other, but not the
 *   triangles. If there is no helper or the refinement fails, REMESH cuts a body-centered cubic
 *   lattice. In this case no point is kept, dihedral angles are above 10 degrees, and parts thinner
 *   than a lattice cube are lost.
 * - EMBED creates a body-centered cubic lattice that covers the surface and its inside. Every point
 *   of the surface is in a tet; dihedral angles are 60 and 90 degrees. Parts that are close to each
 *   other but not connected inside share no point, even within one lattice cube.
 * - WRAP computes a closed surface around the input surface (CGAL's alpha wrap, in the helper
 *   process) and fills it like CDT. It does not use winding numbers, so it also works for surfaces
 *   whose orientation cannot be repaired, for flat surfaces and for loose triangles. A surface
 *   whose gaps are all narrower than twice WrapAlpha becomes solid. An open surface becomes a
 *   **thin shell**; a warning states its volume and the volume where the winding number reaches the
 *   threshold. The whole input surface is inside the wrap or on its boundary; no point of the input
 *   is kept.
 * - FTETWILD runs the program fTetWild (https://github.com/wildmeshing/fTetWild). Its executable
 *   FloatTetwild_bin or ftetwild must be on PATH or be named by the environment variable
 *   BINDPOSE_FTETWILD. Its tets are well shaped and within FtetwildEpsilon of the surface; no point
 *   is kept; WindingThreshold must be 0.5. Files are exchanged in a temporary folder, which is
 *   always removed. A run usually takes minutes.
 * - AUTO (default) tries CDT. If that fails, it tries tets that do not keep the triangles until one
 *   attempt has the right volume: a cut lattice of twice the Resolution, Delaunay refinement as in
 *   REMESH, and a lattice of four times the Resolution. It never uses another method.
 *
 * Report: method, rungs[].{name, seconds, outcome} (all methods that were tried and why they were
 * rejected), counts.{vertices, triangles, duplicate_vertices, unreferenced_vertices,
 * degenerate_triangles, duplicate_triangles, boundary_edges, nonmanifold_edges, misoriented_edges,
 * components, inward_components, self_intersections, turned_triangles, turned_components,
 * triangulated_cells, ignored_cells} of the input, counts.{tets, tet_vertices, kept_vertices,
 * tets_below_5_degrees}, volume, winding_volume (exact for clean surfaces, sampled otherwise),
 * min_dihedral_angle (degrees), resolution (of the lattice), distance_max, distance_mean (REMESH,
 * WRAP, FTETWILD: distances between the boundary of the tets and the parts of the surface that
 * bound the inside, in % of the surface's diagonal), counts.wrap_triangles (WRAP), spacing,
 * counts.{lattice_tets, duplicated_nodes, branching_facets, tet_components} (EMBED),
 * segmentation, energy, threshold_energy, counts.changed_by_cut (these four are about the graph
 * cut), counts.tets_inside (KeepOutside), quality[].{dihedral_angle, tets} (histogram of the tets'
 * smallest dihedral angles: lower end of the bin in degrees, number of tets), winding_volume_error
 * (relative standard error of the sampling), counts.{handle_points, handle_vertices} and
 * handles[].{name, vertex} (CDT, WRAP with handles: the id of the handle's point, for a bone of its
 * head; -1 if it is not a point of the mesh), seconds.*.
 *
 * Errors: invalid_input for a surface without 2D cells, with ids out of range or with coordinates
 * that are not finite; for a flat surface and one that encloses nothing (except with EMBED and
 * WRAP); and for a surface that neither CDT nor REMESH can fill (the message recommends EMBED,
 * which accepts any surface). The status is unavailable for CDT and WRAP without the helper, for
 * FTETWILD without fTetWild, and for REMESH if the whole inside is too thin for its tets. The
 * status is internal_error if the requested method gave no valid mesh. Cost: 0.3 s for 5k
 * triangles, 4 s for 90k clean triangles.
 *
 * @par Thanks:
 * Jacobson, Kavan, Sorkine-Hornung, "Robust Inside-Outside Segmentation using Generalized Winding
 * Numbers", ACM Transactions on Graphics 32(4), 2013. Labelle, Shewchuk, "Isosurface Stuffing: Fast
 * Tetrahedral Meshes with Good Dihedral Angles", ACM Transactions on Graphics 26(3), 2007.
 * Portaneri, Rouxel-Labbé, Hemmer, Cohen-Steiner, Alliez, "Alpha Wrapping with an Offset", ACM
 * Transactions on Graphics 41(4), 2022. Hu, Schneider, Wang, Zorin, Panozzo, "Fast Tetrahedral
 * Meshing in the Wild", ACM Transactions on Graphics 39(4), 2020.
 *
 * @sa vtkSurfaceDefects vtkWindingNumberField vtkBoundedBiharmonicWeights vtkDelaunay3D
 */

#ifndef vtkTetrahedralizeSurface_h
#define vtkTetrahedralizeSurface_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkTetrahedralizeSurface : public vtkBindposeAlgorithm
{
public:
  static vtkTetrahedralizeSurface* New();
  vtkTypeMacro(vtkTetrahedralizeSurface, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Set the connection of the handles; null for no handles.
  void SetHandlesConnection(vtkAlgorithmOutput* handles) { this->SetInputConnection(1, handles); }

  enum MethodType
  {
    AUTO = 0,
    CDT = 1,
    REMESH = 2,
    EMBED = 3,
    WRAP = 4,
    FTETWILD = 5
  };

  ///@{
  /// Meshing method: AUTO (default), CDT, REMESH, EMBED, WRAP or FTETWILD.
  vtkSetClampMacro(Method, int, AUTO, FTETWILD);
  vtkGetMacro(Method, int);
  void SetMethodToAuto() { this->SetMethod(AUTO); }
  void SetMethodToCDT() { this->SetMethod(CDT); }
  void SetMethodToRemesh() { this->SetMethod(REMESH); }
  void SetMethodToEmbed() { this->SetMethod(EMBED); }
  void SetMethodToWrap() { this->SetMethod(WRAP); }
  void SetMethodToFtetwild() { this->SetMethod(FTETWILD); }
  ///@}

  ///@{
  /**
   * Winding number at or above which a point is inside. Must be above 0; default 0.5. With larger
   * values the boundary across an opening moves inwards; 1.5 keeps only regions that are enclosed
   * twice.
   */
  vtkSetMacro(WindingThreshold, double);
  vtkGetMacro(WindingThreshold, double);
  ///@}

  enum SegmentationType
  {
    GRAPH_CUT = 0,
    THRESHOLD = 1
  };

  ///@{
  /**
   * Method by which CDT decides which tets are inside of an open surface. GRAPH_CUT (default)
   * labels all tets in one optimization, so that the boundary follows the surface, and is small and
   * smooth across openings.
   * THRESHOLD labels each tet by its own winding number alone; it is also used if the volume of the
   * graph cut differs from the volume of the winding number by more than 5 %. For closed surfaces
   * both methods give the same result.
   */
  vtkSetClampMacro(Segmentation, int, GRAPH_CUT, THRESHOLD);
  vtkGetMacro(Segmentation, int);
  void SetSegmentationToGraphCut() { this->SetSegmentation(GRAPH_CUT); }
  void SetSegmentationToThreshold() { this->SetSegmentation(THRESHOLD); }
  ///@}

  ///@{
  /// GRAPH_CUT: weight of the boundary's area in the energy, relative to the term of the winding
  /// numbers. Must be at least 0; default 1. With a larger weight the boundary is smaller.
  vtkSetMacro(CutSmoothness, double);
  vtkGetMacro(CutSmoothness, double);
  ///@}

  ///@{
  /**
   * GRAPH_CUT: scale of the differences of winding numbers. Must be above 0; default 0.1. A face of
   * the boundary costs its area times exp(-d^2 / (2 CutSigma^2)), where d is the difference of the
   * winding numbers of its two tets. With a larger scale the cost depends less on d.
   */
  vtkSetMacro(CutSigma, double);
  vtkGetMacro(CutSigma, double);
  ///@}

  ///@{
  /**
   * REMESH, EMBED: number of lattice cubes along the longest side of the surface's box. Must be 4
   * to 1000, or 0 (default): 40 for REMESH, and the resolution with about 30,000 tets for EMBED.
   * The edges of REMESH's tets are 0.2 to 1.4 times as long as a cube. The number of tets grows
   * with the cube of the resolution: a solid block has 12 tets per lattice cube.
   */
  vtkSetClampMacro(Resolution, int, 0, 1000);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /// Total time limit of the helper process, or of fTetWild, in seconds. 0 (default): 120, or 120
  /// per million triangles if that is more.
  vtkSetMacro(TimeLimit, double);
  vtkGetMacro(TimeLimit, double);
  ///@}

  ///@{
  /// Limit of the address space of the helper process, or of fTetWild, in MiB; 0 (default): no
  /// limit.
  vtkSetClampMacro(MemoryLimit, int, 0, VTK_INT_MAX);
  vtkGetMacro(MemoryLimit, int);
  ///@}

  ///@{
  /**
   * Smallest allowed dihedral angle of a tet, from 0 to 20 degrees; 0 (default): as large as the
   * surface's triangles allow. If the triangles do not allow the requested angle, AUTO uses a
   * method that does not keep the triangles. REMESH reaches 10.7 degrees on any surface. If a tet
   * has a smaller angle, the status is NOT_CONVERGED.
   */
  vtkSetMacro(Quality, double);
  vtkGetMacro(Quality, double);
  ///@}

  ///@{
  /**
   * CDT and WRAP only: add no points inside, and keep flat tets; `InteriorEdge` and `Quality` must
   * be 0. Default off.
   */
  vtkSetMacro(Bare, bool);
  vtkGetMacro(Bare, bool);
  vtkBooleanMacro(Bare, bool);
  ///@}

  ///@{
  /**
   * CDT, WRAP: longest interior edge, as a fraction of the surface's diagonal. Must be at least 0.
   * Default 0 (automatic): edges are as long as the surface's own edges nearby and longer with
   * increasing distance from the surface, which gives about 4.5 tets per triangle. Smooth weights
   * need points inside, in addition to those on the surface. For FTETWILD this is the target length
   * of all edges; 0 means fTetWild's default 0.05.
   */
  vtkSetMacro(InteriorEdge, double);
  vtkGetMacro(InteriorEdge, double);
  ///@}

  ///@{
  /**
   * Keep all tets of the surface's convex hull, or of a box around the surface if a box was needed,
   * for inspection. CDT only (INVALID_INPUT otherwise). Tets with `Label` above 0 are inside.
   * `WindingNumber` is then the winding number that the segmentation used, and no points are added
   * for InteriorEdge. Default off.
   */
  vtkSetMacro(KeepOutside, bool);
  vtkGetMacro(KeepOutside, bool);
  vtkBooleanMacro(KeepOutside, bool);
  ///@}

  ///@{
  /**
   * WRAP: radius of the ball that carves the wrap from outside, as a fraction of the surface's
   * diagonal. Must be 0.0001 to 1; default 0.02. Gaps narrower than twice this radius are closed,
   * and edges are up to about twice as long as the radius. The number of triangles and the time
   * grow with 1 / WrapAlpha^2.
   */
  vtkSetMacro(WrapAlpha, double);
  vtkGetMacro(WrapAlpha, double);
  ///@}

  ///@{
  /**
   * WRAP: distance of the wrap's points from the surface, as a fraction of the surface's diagonal.
   * Must be 0.000001 to 1; default 0.001. The shell around an open sheet is twice as thick.
   */
  vtkSetMacro(WrapOffset, double);
  vtkGetMacro(WrapOffset, double);
  ///@}

  ///@{
  /**
   * FTETWILD: largest distance between the boundary of the tets and the surface, as a fraction of
   * the surface's diagonal. Must be 0.00001 to 0.1; default 0.001. Smaller values take longer.
   */
  vtkSetMacro(FtetwildEpsilon, double);
  vtkGetMacro(FtetwildEpsilon, double);
  ///@}

protected:
  vtkTetrahedralizeSurface();
  ~vtkTetrahedralizeSurface() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkTetrahedralizeSurface(const vtkTetrahedralizeSurface&) = delete;
  void operator=(const vtkTetrahedralizeSurface&) = delete;

  int Method = AUTO;
  double WindingThreshold = 0.5;
  int Segmentation = GRAPH_CUT;
  double CutSmoothness = 1.0;
  double CutSigma = 0.1;
  int Resolution = 0;
  double TimeLimit = 0.0;
  int MemoryLimit = 0;
  double Quality = 0.0;
  bool Bare = false;
  double InteriorEdge = 0.0;
  bool KeepOutside = false;
  double WrapAlpha = 0.02;
  double WrapOffset = 0.001;
  double FtetwildEpsilon = 0.001;
};

#endif

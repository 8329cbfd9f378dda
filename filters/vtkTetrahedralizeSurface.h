/**
 * @class   vtkTetrahedralizeSurface
 * @brief   tets of what a surface encloses, whatever the surface
 *
 * The surface may be open, cross itself, be doubled, non-manifold, made of loose triangles or
 * partly inside out: its generalized winding number decides what is inside. Orientation is repaired
 * first; what was turned is a warning.
 *
 * **Input 0**: a vtkPointSet with 2D cells (polygons and strips are split into triangles; other
 * cells are ignored and counted).
 * **Input 1** (optional): handles (see vtkHandleFileReader) that CDT and WRAP make part of the mesh
 * where they are inside: points, ends of bones and cage vertices become points of it, bones and
 * cages get points along them at the local edge length. The weights filters split the cells of
 * other methods where handles need it.
 * **Output**: a vtkUnstructuredGrid of tets (VTK_TETRA, all of positive volume) with the point
 * array `OriginalPointIds` (id of the input point, ascending, then -1 for new points) and the cell
 * arrays `WindingNumber` (double, at the tets' centres), `Label` (int: 1 inside, 2 inside though
 * the winding number is below the threshold, 0 outside, -1 outside though it is not below; outside
 * ones are there with KeepOutside and EMBED only) and `MinDihedralAngle` (double, the tet's
 * smallest, degrees), and the field data array `Method` (as in the report).
 * **Output 1**: a vtkPolyData that shows where the surface is unclean, as vtkSurfaceDefects does
 * (which also works where there are no tets to be had).
 * **Output 2**: of EMBED, else empty: the surface's points and triangles as a vtkPolyData with the
 * point arrays `TetIds` (the cell of output 0 that holds the point; -1 for a point of no triangle
 * that none holds) and `BarycentricCoordinates` (4 components, in the order of the cell's points).
 * Output 0 then has the cell array `InsideFraction` (share of the tet that is inside).
 *
 * Methods:
 * - CDT keeps the input's points and triangles, cut where triangles cross, and adds points inside.
 *   Clean surfaces go to TetGen as they are; others are refined exactly, their hull is filled and
 *   tets are kept where the winding number says inside (see Segmentation). A helper process does
 * the work (bindpose-mesher, built with the packages libcgal-dev and libtet1.5-dev).
 * - REMESH makes well-shaped tets of where the winding number reaches the threshold, graded by the
 *   surface's edges, by Delaunay refinement in the helper process; keeps points that are not too
 *   near to each other, not the triangles. Without the helper, or where that fails, it cuts a
 *   body-centred cubic lattice: no point is kept, dihedral angles are above 10 degrees, and parts
 *   thinner than a lattice cube are lost.
 * - EMBED is a body-centred cubic lattice wherever it touches the surface or its inside: every
 *   point of the surface lies in a tet; dihedral angles are 60 and 90 degrees. Parts that are near
 *   but not connected inside share no point, even in one lattice cube.
 * - WRAP fills, as CDT does, a closed surface around the surface: CGAL's alpha wrap, by the helper
 *   process. Winding numbers have no say, so it is for surfaces whose orientation is hopeless; flat
 *   ones and loose triangles have a wrap, too. What is closed up to gaps of two WrapAlpha becomes
 *   solid, and what is open becomes a **thin shell**: a warning names its volume and the winding
 *   number's. The whole surface is in it or on its boundary; no point is kept.
 * - FTETWILD runs the program fTetWild (https://github.com/wildmeshing/fTetWild), where its
 *   executable FloatTetwild_bin or ftetwild is on PATH or named by the environment variable
 *   BINDPOSE_FTETWILD. Its tets are well shaped and within FtetwildEpsilon of the surface; no point
 *   is kept; WindingThreshold must be 0.5. Files go through a temporary folder, which is always
 *   removed. Minutes are normal.
 * - AUTO (default) tries CDT, then REMESH, and nothing else.
 *
 * Report: method, rungs[].{name, seconds, outcome} (all that was tried and why it was left),
 * counts.{vertices, triangles, duplicate_vertices, unreferenced_vertices, degenerate_triangles,
 * duplicate_triangles, boundary_edges, nonmanifold_edges, misoriented_edges, components,
 * inward_components, self_intersections, turned_triangles, turned_components, triangulated_cells,
 * ignored_cells} of the input, counts.{tets, tet_vertices, kept_vertices, tets_below_5_degrees},
 * volume, winding_volume (exact for clean surfaces, sampled otherwise), min_dihedral_angle
 * (degrees), resolution (of the lattice), distance_max, distance_mean (REMESH by refinement,
 * WRAP, FTETWILD: of the tets' boundary and the surface where that bounds the inside, % of its
 * diagonal), counts.wrap_triangles (WRAP), spacing, counts.{lattice_tets,
 * duplicated_nodes, branching_facets, tet_components} (EMBED), segmentation, energy,
 * threshold_energy, counts.changed_by_cut (of the graph cut), counts.tets_inside (KeepOutside),
 * quality[].{dihedral_angle, tets} (how many tets have their smallest dihedral angle from this many
 * degrees to the next), winding_volume_error (standard error of sampling, relative),
 * counts.{handle_points, handle_vertices} and handles[].{name, vertex} (CDT, WRAP with handles: the
 * point's id, of a bone the head's, -1 where it is no point of the mesh), seconds.*.
 *
 * Errors: invalid_input for a surface without 2D cells, with ids out of range or coordinates that
 * are not finite, for a flat one and one that encloses nothing (but of EMBED and WRAP), and for one
 * that neither CDT nor REMESH can fill (the text names EMBED, which takes any); unavailable for CDT
 * and WRAP without the helper, for FTETWILD without fTetWild, and for REMESH where all that is
 * enclosed is too thin for its tets; internal_error when the method asked for gave no valid mesh.
 * Cost: 5k triangles 0.3 s, 90k triangles 4 s when clean.
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

  /// The handles, by a connection; null for none.
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
  /// AUTO (default), CDT, REMESH, EMBED, WRAP or FTETWILD.
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
   * Inside is where the winding number is at least this, above 0; default 0.5. Larger values pull
   * the lid of an opening inwards; 1.5 keeps only what is enclosed twice.
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
   * How CDT tells the tets of an open surface apart: GRAPH_CUT (default) decides for all of them
   * together, so that the boundary follows the surface and is small and even across openings;
   * THRESHOLD looks at each tet's winding number alone, and is taken too when the graph cut's
   * volume is more than 5 % off. Closed surfaces leave nothing to decide.
   */
  vtkSetClampMacro(Segmentation, int, GRAPH_CUT, THRESHOLD);
  vtkGetMacro(Segmentation, int);
  void SetSegmentationToGraphCut() { this->SetSegmentation(GRAPH_CUT); }
  void SetSegmentationToThreshold() { this->SetSegmentation(THRESHOLD); }
  ///@}

  ///@{
  /// Weight of a small boundary against the winding numbers in GRAPH_CUT, 0 or more; default 1.
  vtkSetMacro(CutSmoothness, double);
  vtkGetMacro(CutSmoothness, double);
  ///@}

  ///@{
  /**
   * Difference of winding numbers between neighbouring tets that GRAPH_CUT takes for the surface,
   * above 0; default 0.1. Larger values also let it cut where the number hardly changes.
   */
  vtkSetMacro(CutSigma, double);
  vtkGetMacro(CutSigma, double);
  ///@}

  ///@{
  /**
   * Lattice cubes along the longest side of the surface's box, 4 to 1000 (REMESH, EMBED); edges of
   * REMESH are 0.2 to 1.4 cubes long. The number of tets grows with its cube: a solid block has 12
   * tets a cube. 0 (default): 40 for REMESH, as many as give about 30,000 tets for EMBED.
   */
  vtkSetClampMacro(Resolution, int, 0, 1000);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /// Seconds that the helper process, or fTetWild, may take in all. 0 (default): 120, or 120 per
  /// million triangles if that is more.
  vtkSetMacro(TimeLimit, double);
  vtkGetMacro(TimeLimit, double);
  ///@}

  ///@{
  /// MiB of address space that the helper process, or fTetWild, may take; 0 (default): no limit.
  vtkSetClampMacro(MemoryLimit, int, 0, VTK_INT_MAX);
  vtkGetMacro(MemoryLimit, int);
  ///@}

  ///@{
  /**
   * Smallest dihedral angle that every tet must have, degrees, 0 (default) to 20. AUTO leaves the
   * surface's triangles for it where they do not allow it; REMESH reaches 10.7 on any surface. A
   * result that misses it is NOT_CONVERGED. 0: as large as the surface's triangles allow.
   */
  vtkSetMacro(Quality, double);
  vtkGetMacro(Quality, double);
  ///@}

  ///@{
  /**
   * CDT and WRAP only: no points are added inside and flat tets stay as they are; InteriorEdge and
   * Quality must be 0. Default off.
   */
  vtkSetMacro(Bare, bool);
  vtkGetMacro(Bare, bool);
  vtkBooleanMacro(Bare, bool);
  ///@}

  ///@{
  /**
   * Longest edges that CDT and WRAP leave inside, as a fraction of the surface's diagonal, 0 or
   * more. Default 0: automatic, as long as the surface's own edges nearby and longer with the
   * distance to it, about 4.5 tets per triangle. Smooth weights need points inside, not only on the
   * surface. FTETWILD aims at this length everywhere; 0: at its own 0.05.
   */
  vtkSetMacro(InteriorEdge, double);
  vtkGetMacro(InteriorEdge, double);
  ///@}

  ///@{
  /**
   * CDT only (INVALID_INPUT otherwise): keep all tets of the surface's convex hull, or of a box
   * around it where that was needed, for inspection: those with `Label` above 0 are inside.
   * `WindingNumber` is then what the segmentation decided on, and no points are added for
   * InteriorEdge. Default off.
   */
  vtkSetMacro(KeepOutside, bool);
  vtkGetMacro(KeepOutside, bool);
  vtkBooleanMacro(KeepOutside, bool);
  ///@}

  ///@{
  /**
   * Radius of the ball that carves the wrap of WRAP from outside, as a fraction of the surface's
   * diagonal, 0.0001 to 1; default 0.02. Gaps narrower than twice this are closed; edges are up to
   * about twice as long; triangles and seconds grow with 1 over its square.
   */
  vtkSetMacro(WrapAlpha, double);
  vtkGetMacro(WrapAlpha, double);
  ///@}

  ///@{
  /**
   * How far outside of the surface the wrap's points lie, as a fraction of the diagonal, 0.000001
   * to 1; default 0.001. Half of the thickness of what a sheet becomes.
   */
  vtkSetMacro(WrapOffset, double);
  vtkGetMacro(WrapOffset, double);
  ///@}

  ///@{
  /**
   * How far the boundary of FTETWILD may be from the surface, as a fraction of its diagonal,
   * 0.00001 to 0.1; default 0.001. Smaller ones take longer.
   */
  vtkSetMacro(FtetwildEpsilon, double);
  vtkGetMacro(FtetwildEpsilon, double);
  ///@}

protected:
  vtkTetrahedralizeSurface();
  ~vtkTetrahedralizeSurface() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

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

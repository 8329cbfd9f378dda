/**
 * @class   vtkAutomaticHandles
 * @brief   creates handles automatically: bones along the curve skeleton, or points spread over the
 *   shape
 *
 * **Input**: a surface (vtkPointSet with 2D cells), which may be unclean, or tets, whose boundary
 * is used. **Output**: a handle dataset in the rest pose, for example as input of
 * vtkBoundedBiharmonicWeights.
 *
 * SKELETON contracts the surface to a curve (mean curvature flow, in the helper executable
 * bindpose-mesher) and simplifies the curve. Ends and junctions are joints. Branches shorter than
 * the thickness of the shape are pruned. The other branches are split at their bends, which gives
 * the bones b1, b2, … The root of a component is the joint nearest to its center of mass, and its
 * bones point away from the root. The `Parent` of a bone is the bone that ends at its head. Each
 * component has its own bones; a ball-like component gets a point handle instead. Exactly one bone
 * has no parent: the bone with the largest volume among the bones at the root of the largest
 * component. This bone is the parent of the other bones at that root. The first bone of every other
 * component, and every point, has the nearest bone of the largest component as its parent. A cycle
 * of the curve is cut where it is farthest from the root, with a warning. A very dense surface, or
 * one that is not clean (open, crossing, doubled, flat), is replaced by the boundary of a lattice
 * of cubes. The lattice covers the inside of the surface and a layer around its thin parts.
 *
 * POINTS spreads points p1, p2, … over the vertices. Each point is the vertex farthest from all
 * earlier points, measured along edges or through space. The points are then moved into the middle
 * of the shape if it has an inside. Components get points in proportion to their area; a component
 * below 1/100 of the largest component's area may get none.
 *
 * The same shape gives the same handles, for any order of its points and cells and for any number
 * of threads.
 *
 * Report: method, counts.handles, handles[].{name, kind}. SKELETON: surface (clean or lattice),
 * counts.{parts, left_out_parts, contracted_triangles, iterations, skeleton_points, joints,
 * junctions, joints_outside, bones_outside, cut_cycles, pruned_branches, merged_branches}; for a
 * lattice also resolution (cubes along the longest side) and counts.thickened_triangles. POINTS:
 * distance, counts.{components, served_components (those with at least one point), points_inside},
 * handles[].vertex (point id on the surface). seconds.*.
 *
 * Errors: INVALID_INPUT for a surface without 2D cells, with ids out of range or coordinates that
 * are not finite, and for an option out of its range. Also INVALID_INPUT if no triangle has an area
 * (SKELETON), or if there are fewer different vertices than NumberOfPoints (POINTS). UNAVAILABLE:
 * SKELETON without the helper. INTERNAL_ERROR: the helper failed, or exceeded its time or memory
 * limit.
 * Cost on one core: SKELETON takes 1.2 s for 6,000 clean triangles, 3.5 s for 90,000, and 3.4 s for
 * 4,500 with many holes. POINTS computes shortest paths once per point: 0.4 s for 50 points on
 * 45,000 vertices.
 *
 * @par Thanks:
 * Tagliasacchi, Alhashim, Olson, Zhang, "Mean Curvature Skeletons", Computer Graphics Forum 31(5),
 * 2012. Douglas, Peucker, "Algorithms for the Reduction of the Number of Points Required to
 * Represent a Digitized Line or its Caricature", Cartographica 10(2), 1973. Gonzalez, "Clustering
 * to Minimize the Maximum Intercluster Distance", 1985.
 *
 * @sa vtkFarthestPointHandles vtkHandleFileReader vtkBoundedBiharmonicWeights
 */

#ifndef vtkAutomaticHandles_h
#define vtkAutomaticHandles_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkAutomaticHandles : public vtkBindposeAlgorithm
{
public:
  static vtkAutomaticHandles* New();
  vtkTypeMacro(vtkAutomaticHandles, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum MethodType
  {
    SKELETON = 0,
    POINTS = 1
  };

  ///@{
  /// Method of placing the handles: SKELETON (default) or POINTS.
  vtkSetClampMacro(Method, int, SKELETON, POINTS);
  vtkGetMacro(Method, int);
  void SetMethodToSkeleton() { this->SetMethod(SKELETON); }
  void SetMethodToPoints() { this->SetMethod(POINTS); }
  ///@}

  ///@{
  /// POINTS: number of point handles, at least 1; default 8.
  vtkSetClampMacro(NumberOfPoints, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfPoints, int);
  ///@}

  enum DistanceType
  {
    ALONG_EDGES = 0,
    STRAIGHT = 1
  };

  ///@{
  /// POINTS: how distances are measured. ALONG_EDGES (default): along the edges of the surface.
  /// STRAIGHT: in a straight line through space.
  vtkSetClampMacro(Distance, int, ALONG_EDGES, STRAIGHT);
  vtkGetMacro(Distance, int);
  void SetDistanceToAlongEdges() { this->SetDistance(ALONG_EDGES); }
  void SetDistanceToStraight() { this->SetDistance(STRAIGHT); }
  ///@}

  ///@{
  /// POINTS: move each point from its vertex into the middle of the shape. Default on.
  vtkSetMacro(PlaceInside, bool);
  vtkGetMacro(PlaceInside, bool);
  vtkBooleanMacro(PlaceInside, bool);
  ///@}

  ///@{
  /// SKELETON: maximum number of bones; 0 (default): no limit. A component keeps at least one bone.
  vtkSetClampMacro(MaximumBones, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumBones, int);
  ///@}

  ///@{
  /// SKELETON: largest distance (0.001 to 1, default 0.03) of the curve from its bones, as a
  /// fraction of the bounding-box diagonal.
  vtkSetMacro(BoneTolerance, double);
  vtkGetMacro(BoneTolerance, double);
  ///@}

  ///@{
  /// SKELETON: largest length (at least 0.01) of a bone, as a fraction of the bounding-box
  /// diagonal. Longer bones are split. 0 (default): no limit.
  vtkSetMacro(LongestBone, double);
  vtkGetMacro(LongestBone, double);
  ///@}

  ///@{
  /**
   * SKELETON: pruning factor, 0 to 10; default 1. The pruning length is this factor times half of
   * the thickness of the shape at the start of the branch. Shorter branches are pruned, and
   * junctions closer to each other than this length are merged.
   */
  vtkSetMacro(Prune, double);
  vtkGetMacro(Prune, double);
  ///@}

  ///@{
  /// SKELETON: approximate number of triangles after remeshing, 100 to 1000000; default 10000.
  /// Before the contraction, the surface is remeshed to triangles of about equal size.
  vtkSetMacro(SkeletonTriangles, int);
  vtkGetMacro(SkeletonTriangles, int);
  ///@}

  ///@{
  /// Threshold (above 0, default 0.5): a point is inside if its winding number is at least this
  /// value.
  vtkSetMacro(WindingThreshold, double);
  vtkGetMacro(WindingThreshold, double);
  ///@}

  ///@{
  /// SKELETON: total time limit of the helper process in seconds, above 0; default 120.
  vtkSetMacro(TimeLimit, double);
  vtkGetMacro(TimeLimit, double);
  ///@}

  ///@{
  /// SKELETON: limit of the helper process's address space in MiB; 0 (default): no limit.
  vtkSetClampMacro(MemoryLimit, int, 0, VTK_INT_MAX);
  vtkGetMacro(MemoryLimit, int);
  ///@}

protected:
  vtkAutomaticHandles() = default;
  ~vtkAutomaticHandles() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkAutomaticHandles(const vtkAutomaticHandles&) = delete;
  void operator=(const vtkAutomaticHandles&) = delete;

  int Method = SKELETON;
  int NumberOfPoints = 8;
  int Distance = ALONG_EDGES;
  bool PlaceInside = true;
  int MaximumBones = 0;
  double BoneTolerance = 0.03;
  double LongestBone = 0.0;
  double Prune = 1.0;
  int SkeletonTriangles = 10000;
  double WindingThreshold = 0.5;
  double TimeLimit = 120.0;
  int MemoryLimit = 0;
};

#endif

/**
 * @class   vtkAutomaticHandles
 * @brief   handles of a shape without a hand: bones along its curve skeleton, or points spread over
 * it
 *
 * **Input**: a surface (vtkPointSet with 2D cells), however unclean, or tets, whose boundary
 * counts. **Output**: a handle dataset in the rest pose, as vtkBoundedBiharmonicWeights takes it.
 *
 * SKELETON contracts the surface to a curve (mean curvature flow, in the helper executable
 * bindpose-mesher) and simplifies it: ends and junctions are joints, branches shorter than the
 * shape is thick are pruned, the others split where they bend into bones b1, b2, … Bones lead away
 * from the joint nearest to the centroid of mass, and have as `Parent` the one whose tail is their
 * head. Each component has its own bones; a component like a ball has a point. Exactly one bone has
 * no parent: among the bones at the root of the largest component, the one with the largest volume.
 * It is the parent of the others at that root. The first bone of every other component, and every
 * point, has the nearest bone of the largest component as its parent.
 * A cycle is cut where it is farthest from the root, with a warning. A surface that is not clean
 * (open, crossing, doubled, flat), or very dense, is replaced by the boundary of a lattice of what
 * it encloses, together with a layer around its thin parts.
 *
 * POINTS spreads points p1, p2, … over the vertices, each the farthest from all before it, along
 * edges or through space; moved into the middle of the shape where it has an inside. Every
 * component that is no crumb gets its share.
 *
 * The same shape gives the same handles, whatever the order of its points and cells, and for any
 * number of threads.
 *
 * Report: method, counts.handles, handles[].{name, kind}. SKELETON: surface (clean or lattice),
 * counts.{parts, left_out_parts, contracted_triangles, iterations, skeleton_points, joints,
 * junctions, joints_outside, bones_outside, cut_cycles, pruned_branches, merged_branches}, of a
 * lattice resolution (cubes along the longest side) and counts.thickened_triangles. POINTS:
 * distance, counts.{components, served_components, points_inside}, handles[].vertex (point id on
 * the surface). seconds.*.
 *
 * Errors: INVALID_INPUT for a surface without 2D cells, with ids out of range or coordinates that
 * are not finite, an option out of its range; SKELETON: no triangle with an area;
 * POINTS: fewer different vertices than NumberOfPoints. UNAVAILABLE: SKELETON without the helper.
 * INTERNAL_ERROR: the helper failed, or ran out of time or memory.
 * Cost, on one core: SKELETON 1.2 s for 6,000 clean triangles, 3.5 s for 90,000, 3.4 s for 4,500
 * full of holes; POINTS a shortest-path pass a point, 50 of 45,000 vertices 0.4 s.
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
  /// SKELETON (default) or POINTS.
  vtkSetClampMacro(Method, int, SKELETON, POINTS);
  vtkGetMacro(Method, int);
  void SetMethodToSkeleton() { this->SetMethod(SKELETON); }
  void SetMethodToPoints() { this->SetMethod(POINTS); }
  ///@}

  ///@{
  /// POINTS: how many, at least 1; default 8.
  vtkSetClampMacro(NumberOfPoints, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfPoints, int);
  ///@}

  enum DistanceType
  {
    ALONG_EDGES = 0,
    STRAIGHT = 1
  };

  ///@{
  /// POINTS: what far means, ALONG_EDGES (default) of the surface or STRAIGHT through space.
  vtkSetClampMacro(Distance, int, ALONG_EDGES, STRAIGHT);
  vtkGetMacro(Distance, int);
  void SetDistanceToAlongEdges() { this->SetDistance(ALONG_EDGES); }
  void SetDistanceToStraight() { this->SetDistance(STRAIGHT); }
  ///@}

  ///@{
  /// POINTS: move each from its vertex into the middle of the shape. Default on.
  vtkSetMacro(PlaceInside, bool);
  vtkGetMacro(PlaceInside, bool);
  vtkBooleanMacro(PlaceInside, bool);
  ///@}

  ///@{
  /// SKELETON: bones at most; 0 (default): any number. A component keeps one.
  vtkSetClampMacro(MaximumBones, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumBones, int);
  ///@}

  ///@{
  /// SKELETON: how far the curve may be from its bones, of the diagonal, 0.001 to 1; default 0.03.
  vtkSetMacro(BoneTolerance, double);
  vtkGetMacro(BoneTolerance, double);
  ///@}

  ///@{
  /// SKELETON: longer bones are split, of the diagonal, at least 0.01; 0 (default): none is.
  vtkSetMacro(LongestBone, double);
  vtkGetMacro(LongestBone, double);
  ///@}

  ///@{
  /**
   * SKELETON: branches shorter than this times half of the thickness where they begin are pruned,
   * junctions nearer than that to each other become one, 0 to 10; default 1.
   */
  vtkSetMacro(Prune, double);
  vtkGetMacro(Prune, double);
  ///@}

  ///@{
  /// SKELETON: about as many even triangles are contracted, 100 to 1000000; default 10000.
  vtkSetMacro(SkeletonTriangles, int);
  vtkGetMacro(SkeletonTriangles, int);
  ///@}

  ///@{
  /// Inside is where the winding number is at least this, above 0; default 0.5.
  vtkSetMacro(WindingThreshold, double);
  vtkGetMacro(WindingThreshold, double);
  ///@}

  ///@{
  /// SKELETON: seconds that the helper process may take in all, above 0; default 120.
  vtkSetMacro(TimeLimit, double);
  vtkGetMacro(TimeLimit, double);
  ///@}

  ///@{
  /// SKELETON: MiB of address space that the helper process may take; 0 (default): no limit.
  vtkSetClampMacro(MemoryLimit, int, 0, VTK_INT_MAX);
  vtkGetMacro(MemoryLimit, int);
  ///@}

protected:
  vtkAutomaticHandles() = default;
  ~vtkAutomaticHandles() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

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

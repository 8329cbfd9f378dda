/**
 * @class   vtkSkinningDeformation
 * @brief   poses a mesh by blending its handles' transforms
 *
 * The filter moves every point of the mesh by the transforms of the handles, blended with the
 * point's weights:
 * - **linear blend** (Magnenat-Thalmann et al. 1988): v' = sum_j w_j T_j v. Fast and exact for
 *   affine handles; twists by large angles lose volume.
 * - **dual quaternion** (Kavan et al. 2008): blends rigid motions, after scale and shear have been
 *   blended linearly. Twists keep the radius of a limb.
 * - **stretchable bones** (Jacobson and Sorkine 2011): linear blend in which each bone also applies
 *   its `Stretch` and `Twist` along its own axis. Points beyond the tail are moved, not scaled, and
 *   a twist keeps the radius. The position of a point along a bone is its endpoint weight, from 0
 *   at the head to 1 at the tail. The point array `EndpointWeights` (from vtkBoneEndpointWeights,
 *   or painted) contains it in the component of the bone. If the weight is missing or NaN, the
 *   projection of the point onto the bone is used. Other handles are blended linearly.
 * - **centers of rotation** (Le and Hodgins 2016): a point is rotated by the blended rotation about
 *   its center of rotation. This center is the mean position of the parts of the mesh with weights
 *   similar to the point's; it moves by linear blend. Twists and bends keep the radius of a limb,
 *   and bent joints do not bulge as with dual quaternions. The centers are computed on first use
 *   and cached with the bind.
 *
 * **Pseudo-edges** (Jacobson et al. 2011) are lines between point handles (HandleKind -2, or found
 * automatically). They determine the rotations of point handles, so that users only need to
 * translate the points. Pseudo-edges have no weights. For each edge at a point there is a smallest
 * rotation from the edge's direction at rest to its direction when posed. The point is rotated by
 * the mean of these rotations, in addition to the rotation of its `Transform`. In a plane a rigid
 * motion of all points is reproduced exactly; in space an edge does not determine the rotation
 * about itself. Points without edges keep their own rotation.
 *
 * **Pieces.** With linear blend and dual quaternions, a posed point depends only on its own
 * weights. Each process then poses its own piece of the mesh with the whole set of handles, and
 * every point gets the same bits as on one process. Counts and stretch in the report, and the signs
 * in the array `Stretch` of a surface, are computed from the piece alone. The other methods, and
 * automatic pseudo-edges, depend on the whole mesh; the first process then poses the whole mesh.
 *
 * Ports, arrays, bind cache and errors: see vtkPoseAlgorithm. Handles in mode position contribute a
 * translation, handles in mode free the identity (with a warning). Skinning does not compute
 * transforms; see vtkReducedARAP for that. The filter accepts any vtkPointSet, including FE meshes.
 *
 * Report: method, seconds.bind, seconds.centers, seconds.edges (automatic pseudo-edges),
 * seconds.skin, counts (including pseudo_edges and centers), row_sum_error.
 */

#ifndef vtkSkinningDeformation_h
#define vtkSkinningDeformation_h

#include "BindposeFiltersModule.h" // for export macro
#include "block_caches.h" // for BlockCaches
#include "vtkPoseAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkSkinningDeformation : public vtkPoseAlgorithm
{
public:
  static vtkSkinningDeformation* New();
  vtkTypeMacro(vtkSkinningDeformation, vtkPoseAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum MethodType
  {
    LINEAR_BLEND = 0,
    DUAL_QUATERNION = 1,
    STRETCHABLE_BONES = 2,
    CENTERS_OF_ROTATION = 3
  };

  ///@{
  /// Method of blending transforms. Default LINEAR_BLEND. This is a pose parameter: a change does
  /// not run the bind again.
  vtkSetClampMacro(Method, int, LINEAR_BLEND, CENTERS_OF_ROTATION);
  vtkGetMacro(Method, int);
  void SetMethodToLinearBlend() { this->SetMethod(LINEAR_BLEND); }
  void SetMethodToDualQuaternion() { this->SetMethod(DUAL_QUATERNION); }
  void SetMethodToStretchableBones() { this->SetMethod(STRETCHABLE_BONES); }
  void SetMethodToCentersOfRotation() { this->SetMethod(CENTERS_OF_ROTATION); }
  ///@}

  /// Return the port of the mesh if the method can pose a piece of the mesh alone, i.e. if a posed
  /// point depends only on the weights of this point. Otherwise return -1.
  int GetPiecePort() override;

  enum PseudoEdgesType
  {
    NO_PSEUDO_EDGES = 0,
    GIVEN_PSEUDO_EDGES = 1,
    AUTOMATIC_PSEUDO_EDGES = 2
  };

  ///@{
  /**
   * Pseudo-edges that rotate point handles: none, those of the handle dataset (default), or
   * automatic ones. Automatic pseudo-edges are the minimum spanning tree of the point handles by
   * distances along the mesh's edges, so they follow the shape and cross no gap. This is a pose
   * parameter.
   */
  vtkSetClampMacro(PseudoEdges, int, NO_PSEUDO_EDGES, AUTOMATIC_PSEUDO_EDGES);
  vtkGetMacro(PseudoEdges, int);
  ///@}

  ///@{
  /// Also scale each point handle by the mean length ratio (posed length divided by rest length) of
  /// its pseudo-edges. Default off.
  vtkSetMacro(PseudoEdgeStretch, bool);
  vtkGetMacro(PseudoEdgeStretch, bool);
  vtkBooleanMacro(PseudoEdgeStretch, bool);
  ///@}

  ///@{
  /**
   * Store weights and transforms as floats. This takes half the memory, is about twice as fast, and
   * is accurate to a millionth of the diagonal of mesh and handles. Default off. This is a bind
   * parameter: a change runs the bind again.
   */
  void SetSinglePrecision(bool single);
  vtkGetMacro(SinglePrecision, bool);
  vtkBooleanMacro(SinglePrecision, bool);
  ///@}

  ///@{
  /**
   * Limits of the stored weights. Weights up to SmallestWeight are treated as zero; at least 0 and
   * less than 1. 0 (default): no weight is dropped. MaximumInfluences is the maximum number of
   * weights per point; the largest weights are kept. 0 (default): no limit. Dropped weight is
   * distributed over the remaining weights of the point. The report contains counts.dropped_weights
   * and dropped_share (the largest dropped fraction of a point). Both are bind parameters.
   */
  void SetSmallestWeight(double smallest);
  vtkGetMacro(SmallestWeight, double);
  void SetMaximumInfluences(int influences);
  vtkGetMacro(MaximumInfluences, int);
  ///@}

  ///@{
  /**
   * Name of the mesh's point array of endpoint weights, one component per handle, 0 to 1 or NaN.
   * Default EndpointWeights; an empty name disables the array. This is a bind parameter.
   */
  void SetEndpointArrayName(const std::string& name);
  std::string GetEndpointArrayName() { return this->EndpointArrayName; }
  ///@}

protected:
  vtkSkinningDeformation();
  ~vtkSkinningDeformation() override;

  std::vector<std::string> BindArrays() override;
  bindpose::Status Bind(
    bindpose::ExecutionContext& context, const bindpose::PoseInput& input) override;
  bindpose::StretchUse GetStretchUse() override;
  bindpose::Status Deform(bindpose::ExecutionContext& context, const bindpose::PoseInput& input,
    bindpose::PosedPoints& posed) override;
  bindpose::Status DeformNormals(bindpose::ExecutionContext& context,
    const bindpose::PoseInput& input, const bindpose::PosedPoints& posed,
    bindpose::PosedPoints& normals) override;

private:
  vtkSkinningDeformation(const vtkSkinningDeformation&) = delete;
  void operator=(const vtkSkinningDeformation&) = delete;

  bindpose::Status BindMissing(
    bindpose::ExecutionContext& context, const bindpose::PoseInput& input);

  int Method = LINEAR_BLEND;
  int PseudoEdges = GIVEN_PSEUDO_EDGES;
  bool PseudoEdgeStretch = false;
  bool SinglePrecision = false;
  double SmallestWeight = 0.0;
  int MaximumInfluences = 0;
  std::string EndpointArrayName = "EndpointWeights";
  struct Internals;
  bindpose::BlockCaches<Internals> Internal;
};

#endif

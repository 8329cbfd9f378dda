/**
 * @class   vtkSkinningDeformation
 * @brief   poses a mesh by blending its handles' transforms
 *
 * Moves every point of the mesh by the transforms of the handles, blended with the point's weights:
 * - **linear blend** (Magnenat-Thalmann et al. 1988): v' = sum_j w_j T_j v. Fast and exact for
 *   affine handles; twists by large angles lose volume.
 * - **dual quaternion** (Kavan et al. 2008): blends rigid motions; scale and shear are blended
 *   linearly before. Twists keep their radius.
 * - **stretchable bones** (Jacobson and Sorkine 2011): linear blend in which bones also do their
 *   `Stretch` and `Twist` along themselves: what is beyond the tail is moved along, not scaled, and
 *   a twist keeps the radius. How far along a bone a point is, is its endpoint weight, 0 at the
 *   head to 1 at the tail: the component of that handle in the point array `EndpointWeights`
 *   (vtkBoneEndpointWeights, or painted), where it is missing or NaN the projection to the bone.
 *   Other handles are blended linearly.
 * - **centers of rotation** (Le and Hodgins 2016): a point turns by the blended rotations about a
 *   center of its own, the mean place of all of the mesh with similar weights, which moves by
 *   linear blend. Twists and bends keep their radius, without the bulge of dual quaternions.
 *   Centers are made when they are asked for first, and kept with the bind.
 *
 * **Pseudo-edges** (Jacobson et al. 2011) let points be dragged only: lines between point handles
 * (HandleKind -2, or found automatically), which bend nothing themselves, turn each point by the
 * mean of the least rotations that take its edges from rest to where their ends are posed, on top
 * of what its `Transform` turns. In a plane a rigid motion of all points is found exactly; in space
 * an edge does not see a turn about itself. Points without edges keep their own rotation.
 *
 * Ports, arrays, bind cache and errors: vtkPoseAlgorithm. Handles whose mode is position count as a
 * translation, free ones as identity (with a warning): skinning finds nothing by itself, see
 * vtkReducedARAP. Works on any vtkPointSet, FE meshes included.
 *
 * Report: method, seconds.bind, seconds.skin, counts (pseudo_edges and centers
 * among them), row_sum_error.
 */

#ifndef vtkSkinningDeformation_h
#define vtkSkinningDeformation_h

#include "BindposeFiltersModule.h" // for export macro
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
  /// How transforms are blended. Default LINEAR_BLEND. A pose parameter: changing it keeps the
  /// bind.
  vtkSetClampMacro(Method, int, LINEAR_BLEND, CENTERS_OF_ROTATION);
  vtkGetMacro(Method, int);
  void SetMethodToLinearBlend() { this->SetMethod(LINEAR_BLEND); }
  void SetMethodToDualQuaternion() { this->SetMethod(DUAL_QUATERNION); }
  void SetMethodToStretchableBones() { this->SetMethod(STRETCHABLE_BONES); }
  void SetMethodToCentersOfRotation() { this->SetMethod(CENTERS_OF_ROTATION); }
  ///@}

  enum PseudoEdgesType
  {
    NO_PSEUDO_EDGES = 0,
    GIVEN_PSEUDO_EDGES = 1,
    AUTOMATIC_PSEUDO_EDGES = 2
  };

  ///@{
  /**
   * Which pseudo-edges turn points: none, those of the handles (default), or automatic ones: the
   * minimum spanning tree of the point handles by distances along the mesh's edges, so that they
   * follow the shape and no gap is crossed. A pose parameter.
   */
  vtkSetClampMacro(PseudoEdges, int, NO_PSEUDO_EDGES, AUTOMATIC_PSEUDO_EDGES);
  vtkGetMacro(PseudoEdges, int);
  ///@}

  ///@{
  /// Whether points are scaled by the mean ratio of their pseudo-edges' lengths. Default off.
  vtkSetMacro(PseudoEdgeStretch, bool);
  vtkGetMacro(PseudoEdgeStretch, bool);
  vtkBooleanMacro(PseudoEdgeStretch, bool);
  ///@}

  ///@{
  /**
   * Weights and transforms as floats: half the memory, about twice as fast, right to a millionth of
   * the mesh's diagonal. Default off. A bind parameter.
   */
  void SetSinglePrecision(bool single);
  vtkGetMacro(SinglePrecision, bool);
  vtkBooleanMacro(SinglePrecision, bool);
  ///@}

  ///@{
  /**
   * Weights of at most this size count as zero, 0 (default: none) to 1; and how many weights of a
   * point are kept at most, the largest, 0 (default) for all. What is dropped is shared out among
   * those that are left and reported: counts.dropped_weights, dropped_share (the largest of a
   * point). Bind parameters.
   */
  void SetSmallestWeight(double smallest);
  vtkGetMacro(SmallestWeight, double);
  void SetMaximumInfluences(int influences);
  vtkGetMacro(MaximumInfluences, int);
  ///@}

  ///@{
  /**
   * Name of the mesh's point array of endpoint weights, a component a handle, 0 to 1 or NaN.
   * Default EndpointWeights; an empty name: not looked for. A bind parameter.
   */
  void SetEndpointArrayName(const std::string& name);
  std::string GetEndpointArrayName() { return this->EndpointArrayName; }
  ///@}

protected:
  vtkSkinningDeformation();
  ~vtkSkinningDeformation() override;

  std::vector<std::string> BindArrays() override;
  bindpose::Status Bind(const PoseInput& input, bindpose::ExecutionContext& context) override;
  bindpose::StretchUse GetStretchUse() override;
  bindpose::Status Deform(
    const PoseInput& input, bindpose::ExecutionContext& context, PosedPoints& posed) override;
  bindpose::Status DeformNormals(const PoseInput& input, bindpose::ExecutionContext& context,
    const PosedPoints& posed, PosedPoints& normals) override;

private:
  vtkSkinningDeformation(const vtkSkinningDeformation&) = delete;
  void operator=(const vtkSkinningDeformation&) = delete;

  bindpose::Status FindCenters(
    const PoseInput& input, bindpose::ExecutionContext& context, double begin, double end);
  bindpose::Status FindTransforms(const PoseInput& input, bindpose::ExecutionContext& context);

  int Method = LINEAR_BLEND;
  int PseudoEdges = GIVEN_PSEUDO_EDGES;
  bool PseudoEdgeStretch = false;
  bool SinglePrecision = false;
  double SmallestWeight = 0.0;
  int MaximumInfluences = 0;
  std::string EndpointArrayName = "EndpointWeights";
  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif

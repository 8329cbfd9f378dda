/**
 * @class   vtkBoneEndpointWeights
 * @brief   computes the position of every point of a mesh along each bone
 *
 * Stretchable, twistable bones (Jacobson and Sorkine 2011; vtkSkinningDeformation) need a second
 * weight per bone, which increases from 0 at its head to 1 at its tail. This endpoint weight
 * determines which fraction of the bone's stretch applies to a point, and how the twists of head
 * and tail are mixed at the point. The methods are:
 * - **PROJECTION** onto the bone, clamped: immediate, but constant in planes perpendicular to the
 *   bone;
 * - **JOINTS**: W_tail / (W_head + W_tail), where W_head and W_tail are the bounded biharmonic
 *   weights of point handles at the ends of the bone. One problem has the ends of all bones as
 *   handles. The result is shape-aware, and smooth beyond the ends;
 * - **BOUNDED**: one bounded biharmonic problem per bone in which the weight is linear along the
 *   bone: exact on the bone, but the most expensive method.
 *
 * Ports: see vtkMeshAndHandlesAlgorithm. The output is the mesh with the point array
 * `EndpointWeights`, with one component per handle, named after the handle; NaN for handles that
 * are not bones. Users may paint over the array before it is used.
 *
 * For a surface the weights are solved in one of the domains of vtkWeightsAlgorithm (see
 * SetDomain), for a mesh of tets on the tets. The result is cached until points, cells, the
 * handles' rest data or this filter's parameters change.
 *
 * Errors: no bone; all input that vtkBoundedBiharmonicWeights rejects. The status is not_converged
 * (with the result) if the optimality certificate of a column exceeds its tolerance. Cost:
 * PROJECTION needs almost no time; JOINTS costs as much as bounded weights for the joints, BOUNDED
 * as much as bounded weights for two handles per bone.
 *
 * Report: method, counts.{vertices, handles, bones, problems}, binds.
 */

#ifndef vtkBoneEndpointWeights_h
#define vtkBoneEndpointWeights_h

#include "BindposeFiltersModule.h" // for export macro
#include "block_caches.h" // for BlockCaches
#include "vtkMeshAndHandlesAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkBoneEndpointWeights : public vtkMeshAndHandlesAlgorithm
{
public:
  static vtkBoneEndpointWeights* New();
  vtkTypeMacro(vtkBoneEndpointWeights, vtkMeshAndHandlesAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum MethodType
  {
    PROJECTION = 0,
    JOINTS = 1,
    BOUNDED = 2
  };

  ///@{
  /// Method of computing the endpoint weights. Default JOINTS. Values out of range are clamped.
  vtkSetClampMacro(Method, int, PROJECTION, BOUNDED);
  vtkGetMacro(Method, int);
  void SetMethodToProjection() { this->SetMethod(PROJECTION); }
  void SetMethodToJoints() { this->SetMethod(JOINTS); }
  void SetMethodToBounded() { this->SetMethod(BOUNDED); }
  ///@}

  ///@{
  /// Domain in which the endpoint weights of a surface are solved: vtkWeightsAlgorithm's SURFACE,
  /// AUTO (default), VOLUME or EMBEDDING.
  vtkSetClampMacro(Domain, int, 0, 3);
  vtkGetMacro(Domain, int);
  ///@}

  /// Number of times that the weights were computed.
  vtkGetMacro(NumberOfBinds, int);

protected:
  vtkBoneEndpointWeights();
  ~vtkBoneEndpointWeights() override;

  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkBoneEndpointWeights(const vtkBoneEndpointWeights&) = delete;
  void operator=(const vtkBoneEndpointWeights&) = delete;

  struct Cache;
  bindpose::BlockCaches<Cache> BindCache;
  int Method = JOINTS;
  int Domain = 1;
  int NumberOfBinds = 0;
};

#endif

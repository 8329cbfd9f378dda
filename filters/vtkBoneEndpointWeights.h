/**
 * @class   vtkBoneEndpointWeights
 * @brief   how far along each bone every point of a mesh is
 *
 * Stretchable, twistable bones (Jacobson and Sorkine 2011; vtkSkinningDeformation) need a second
 * weight a bone, 0 at its head to 1 at its tail, which says how much of a stretch and which mixture
 * of both twists a point gets:
 * - **PROJECTION** onto the bone, clamped: at once, but the same for all that is beside the bone;
 * - **JOINTS**: W_tail / (W_head + W_tail) of bounded biharmonic weights with all ends of bones as
 *   point handles, one problem for all bones: aware of the shape, smooth beyond the ends;
 * - **BOUNDED**: a bounded biharmonic problem for each bone in which the weight is linear along
 *   it: exact on the bone, the most work.
 *
 * Ports: vtkMeshAndHandlesAlgorithm. The output is the mesh with the point array `EndpointWeights`,
 * a component a handle, named after it; NaN for handles that are no bones. The array can be painted
 * over before it is used.
 *
 * Surfaces are solved on in the Domain of vtkWeightsAlgorithm, default AUTO; tets as they are. The
 * result is kept while points, cells, the handles' rest and this filter's parameters stay.
 *
 * Errors: no bone; what vtkBoundedBiharmonicWeights refuses. Status not_converged (with the result)
 * when a column misses the certificate. Cost: none, that of bounded weights for the joints, or for
 * two handles a bone.
 *
 * Report: method, counts.{vertices, handles, bones, problems}, binds.
 */

#ifndef vtkBoneEndpointWeights_h
#define vtkBoneEndpointWeights_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkMeshAndHandlesAlgorithm.h"
#include <memory> // for std::unique_ptr

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
  /// Default JOINTS. Out of range: clamped.
  vtkSetClampMacro(Method, int, PROJECTION, BOUNDED);
  vtkGetMacro(Method, int);
  void SetMethodToProjection() { this->SetMethod(PROJECTION); }
  void SetMethodToJoints() { this->SetMethod(JOINTS); }
  void SetMethodToBounded() { this->SetMethod(BOUNDED); }
  ///@}

  ///@{
  /// Where to solve for a surface: vtkWeightsAlgorithm's SURFACE, AUTO (default), VOLUME,
  /// EMBEDDING.
  vtkSetClampMacro(Domain, int, 0, 3);
  vtkGetMacro(Domain, int);
  ///@}

  /// How often the weights were made.
  vtkGetMacro(NumberOfBinds, int);

protected:
  vtkBoneEndpointWeights();
  ~vtkBoneEndpointWeights() override;

  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

private:
  vtkBoneEndpointWeights(const vtkBoneEndpointWeights&) = delete;
  void operator=(const vtkBoneEndpointWeights&) = delete;

  struct Cache;
  std::unique_ptr<Cache> Bound;
  int Method = JOINTS;
  int Domain = 1;
  int NumberOfBinds = 0;
};

#endif

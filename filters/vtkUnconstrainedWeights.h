/**
 * @class   vtkUnconstrainedWeights
 * @brief   weights without bounds, and other fast ones to compare with
 *
 * One factorisation and one solve a handle, or a closed form. Rows sum to one.
 *
 * | Method | what | shape | smooth | in [0, 1] |
 * |---|---|---|---|---|
 * | HARMONIC | least gradient | knows it | peaks at points | where cotangents are positive |
 * | BIHARMONIC | least Laplacian, the same on any mesh | knows it | yes | no |
 * | TRIHARMONIC | least gradient of the Laplacian | knows it | yes | no |
 * | GRAPH_BIHARMONIC | least Laplacian without masses | knows it | where the mesh is even | no |
 * | LINEAR_SUBSPACE | as BIHARMONIC; points carry affine maps exactly | knows it | yes | no |
 * | INVERSE_DISTANCE | 1 / distance^Power | does not | peaks | yes |
 * | SMOOTHED_HARMONIC | HARMONIC, smoothed over the length Smoothing | knows it | yes | nearly |
 * | BONE_HEAT | nearest handle in sight, Heat / distance^2 | partly | creases | as HARMONIC |
 *
 * LINEAR_SUBSPACE is made for points: beyond bones, which are constant along themselves, it
 * overshoots far (-40 on an elephant's ear).
 *
 * WeightsMinimum, WeightsMaximum and WeightsInteriorExtrema tell what the bounds and monotonicity
 * of the other filters are for. The first five minimise an energy, which the certificate is about;
 * for the others the gap is 0 and the residual that of a linear system.
 *
 * Ports, arrays, certificate, bind cache, report and errors: vtkWeightsAlgorithm.
 *
 * @par Thanks:
 * Botsch, Kobbelt, "An intuitive framework for real-time freeform modeling", ACM Transactions on
 * Graphics 23(3), 2004 (GRAPH_BIHARMONIC). Jacobson, Tosun, Sorkine, Zorin, "Mixed finite elements
 * for variational surface modeling", SGP 2010. Wang, Jacobson, Barbic, Kavan, "Linear subspace
 * design for real-time shape deformation", 2015. Baran, Popovic, "Automatic rigging and animation
 * of 3D characters", 2007 (BONE_HEAT). Shepard 1968 (INVERSE_DISTANCE).
 *
 * @sa vtkBoundedBiharmonicWeights vtkMonotoneWeights
 */

#ifndef vtkUnconstrainedWeights_h
#define vtkUnconstrainedWeights_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkWeightsAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkUnconstrainedWeights : public vtkWeightsAlgorithm
{
public:
  static vtkUnconstrainedWeights* New();
  vtkTypeMacro(vtkUnconstrainedWeights, vtkWeightsAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum MethodType
  {
    HARMONIC = 1,
    BIHARMONIC = 2,
    TRIHARMONIC = 3,
    GRAPH_BIHARMONIC = 4,
    LINEAR_SUBSPACE = 5,
    INVERSE_DISTANCE = 6,
    SMOOTHED_HARMONIC = 7,
    BONE_HEAT = 8
  };

  ///@{
  /// Which weights, see above; default BIHARMONIC. All parameters here belong to the bind.
  void SetMethod(int method);
  vtkGetMacro(Method, int);
  void SetMethodToHarmonic() { this->SetMethod(HARMONIC); }
  void SetMethodToBiharmonic() { this->SetMethod(BIHARMONIC); }
  void SetMethodToTriharmonic() { this->SetMethod(TRIHARMONIC); }
  void SetMethodToGraphBiharmonic() { this->SetMethod(GRAPH_BIHARMONIC); }
  void SetMethodToLinearSubspace() { this->SetMethod(LINEAR_SUBSPACE); }
  void SetMethodToInverseDistance() { this->SetMethod(INVERSE_DISTANCE); }
  void SetMethodToSmoothedHarmonic() { this->SetMethod(SMOOTHED_HARMONIC); }
  void SetMethodToBoneHeat() { this->SetMethod(BONE_HEAT); }
  ///@}

  ///@{
  /// Of INVERSE_DISTANCE: the exponent, above 0. Default 2.
  void SetPower(double power);
  vtkGetMacro(Power, double);
  ///@}

  ///@{
  /// Of SMOOTHED_HARMONIC: a length, fraction of the diagonal, 0 or more. Default 0.05.
  void SetSmoothing(double smoothing);
  vtkGetMacro(Smoothing, double);
  ///@}

  ///@{
  /// Of BONE_HEAT: above 0; more makes weights switch faster between handles. Default 1.
  void SetHeat(double heat);
  vtkGetMacro(Heat, double);
  ///@}

protected:
  vtkUnconstrainedWeights();
  ~vtkUnconstrainedWeights() override;

  bindpose::Status Solve(const bindpose::WeightsProblem& problem,
    const bindpose::WeightsOptions& options, bindpose::ExecutionContext& context,
    bindpose::WeightsResult& result) override;

private:
  vtkUnconstrainedWeights(const vtkUnconstrainedWeights&) = delete;
  void operator=(const vtkUnconstrainedWeights&) = delete;

  int Method = BIHARMONIC;
  double Power = 2.0;
  double Smoothing = 0.05;
  double Heat = 1.0;
};

#endif

/**
 * @class   vtkUnconstrainedWeights
 * @brief   weights without bounds, and other fast weights for comparison
 *
 * Each method needs one factorization and one solve per handle, or evaluates a formula directly.
 * Rows of weights sum to one.
 *
 * | Method | definition | shape-aware | smooth | in [0, 1] |
 * |---|---|---|---|---|
 * | harmonic | least gradient | yes | peaks at points | where cotangents are positive |
 * | biharmonic | least Laplacian, independent of the mesh | yes | yes | no |
 * | triharmonic | least gradient of the Laplacian | yes | yes | no |
 * | graph-biharmonic | least Laplacian without masses | yes | where the mesh is uniform | no |
 * | linear-subspace | as biharmonic; points reproduce affine maps exactly | yes | yes | no |
 * | inverse-distance | 1 / distance^Power | no | peaks | yes |
 * | smoothed-harmonic | harmonic, smoothed over the length Smoothing | yes | yes | nearly |
 * | bone-heat | nearest visible handle, Heat / distance^2 | partly | creases | as harmonic |
 *
 * linear-subspace is designed for point handles. Along a bone its weights are constant; beyond the
 * bones they leave the range 0 to 1 by far (-40 on an elephant's ear).
 *
 * WeightsMinimum, WeightsMaximum and WeightsInteriorExtrema show how far the weights are from the
 * bounds of bounded weights and from the monotonicity of monotone weights. The first five methods
 * minimize an energy, to which the optimality certificate (gap and residual) applies. For the other
 * methods the gap is 0, and the residual is that of a linear system.
 *
 * Ports, arrays, certificate, bind cache, report and errors: see vtkWeightsAlgorithm.
 *
 * @par Thanks:
 * Botsch, Kobbelt, "An intuitive framework for real-time freeform modeling", ACM Transactions on
 * Graphics 23(3), 2004 (graph-biharmonic). Jacobson, Tosun, Sorkine, Zorin, "Mixed finite elements
 * for variational surface modeling", SGP 2010. Wang, Jacobson, Barbic, Kavan, "Linear subspace
 * design for real-time shape deformation", 2015. Baran, Popovic, "Automatic rigging and animation
 * of 3D characters", 2007 (bone-heat). Shepard 1968 (inverse-distance).
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

  ///@{
  /// Method, one of the names in the table of the class documentation; default "biharmonic". With
  /// an unknown name the filter fails with the status INVALID_INPUT when it executes. All
  /// parameters of this class are bind parameters.
  void SetMethod(const std::string& word);
  std::string GetMethod() { return this->Method; }
  ///@}

  ///@{
  /// inverse-distance: the exponent. Must be above 0; default 2.
  void SetPower(double power);
  vtkGetMacro(Power, double);
  ///@}

  ///@{
  /// smoothed-harmonic: the smoothing length, as a fraction of the bounding-box diagonal. Must be
  /// at least 0; default 0.05.
  void SetSmoothing(double smoothing);
  vtkGetMacro(Smoothing, double);
  ///@}

  ///@{
  /// bone-heat: the heat factor. Must be above 0; default 1. A larger factor makes weights change
  /// faster between handles.
  void SetHeat(double heat);
  vtkGetMacro(Heat, double);
  ///@}

protected:
  vtkUnconstrainedWeights();
  ~vtkUnconstrainedWeights() override;

  bindpose::Status Solve(bindpose::ExecutionContext& context,
    const bindpose::WeightsProblem& problem, const bindpose::WeightsOptions& options,
    bindpose::WeightsResult& result) override;

private:
  vtkUnconstrainedWeights(const vtkUnconstrainedWeights&) = delete;
  void operator=(const vtkUnconstrainedWeights&) = delete;

  std::string Method = "biharmonic";
  double Power = 2.0;
  double Smoothing = 0.05;
  double Heat = 1.0;
};

#endif

/**
 * @class   vtkMonotoneWeights
 * @brief   bounded weights without extrema between handles
 *
 * The weights are those of vtkBoundedBiharmonicWeights with one more constraint: each weight
 * increases and decreases along the same edges as a guide function that has extrema only at the
 * handles. This avoids weights that rise again far from their handle, which make distant or small
 * features swell. It takes about twice the time of bounded weights.
 *
 * For maxima and minima at arbitrary points instead of handles see vtkMonotoneSmoothing.
 *
 * Ports, arrays, certificate, bind cache, report and errors: see vtkWeightsAlgorithm.
 *
 * @par Thanks:
 * Jacobson, Weinkauf, Sorkine, "Smooth Shape-Aware Functions with Controlled Extrema", Computer
 * Graphics Forum 31(5), 2012.
 *
 * @sa vtkBoundedBiharmonicWeights vtkMonotoneSmoothing vtkUnconstrainedWeights
 */

#ifndef vtkMonotoneWeights_h
#define vtkMonotoneWeights_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkWeightsAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkMonotoneWeights : public vtkWeightsAlgorithm
{
public:
  static vtkMonotoneWeights* New();
  vtkTypeMacro(vtkMonotoneWeights, vtkWeightsAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Order of the energy: 2 biharmonic (default), 3 triharmonic. This is a bind parameter: a change
  /// computes the weights again.
  void SetOrder(int order);
  vtkGetMacro(Order, int);
  ///@}

protected:
  vtkMonotoneWeights();
  ~vtkMonotoneWeights() override;

  bool TakesTerms() const override { return true; }
  bindpose::Status Solve(bindpose::ExecutionContext& context,
    const bindpose::WeightsProblem& problem, const bindpose::WeightsOptions& options,
    bindpose::WeightsResult& result) override;

private:
  vtkMonotoneWeights(const vtkMonotoneWeights&) = delete;
  void operator=(const vtkMonotoneWeights&) = delete;

  int Order = 2;
};

#endif

/**
 * @class   vtkMonotoneWeights
 * @brief   bounded weights without extrema between handles
 *
 * As vtkBoundedBiharmonicWeights, and each weight rises and falls as a guide does that has its
 * extrema on the handles only: no far-away bumps, no small features that swell. Costs about twice
 * the time of bounded weights.
 *
 * Maxima and minima of one's own choice instead of handles: vtkMonotoneSmoothing.
 *
 * Ports, arrays, certificate, bind cache, report and errors: vtkWeightsAlgorithm.
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
  /// Order of the energy: 2 biharmonic (default), 3 triharmonic. A bind parameter.
  void SetOrder(int order);
  vtkGetMacro(Order, int);
  ///@}

protected:
  vtkMonotoneWeights();
  ~vtkMonotoneWeights() override;

  bool TakesTerms() const override { return true; }
  bindpose::Status Solve(const bindpose::WeightsProblem& problem,
    const bindpose::WeightsOptions& options, bindpose::ExecutionContext& context,
    bindpose::WeightsResult& result) override;

private:
  vtkMonotoneWeights(const vtkMonotoneWeights&) = delete;
  void operator=(const vtkMonotoneWeights&) = delete;

  int Order = 2;
};

#endif

/**
 * @class   vtkUnconstrainedWeights
 * @brief   harmonic, biharmonic or triharmonic weights without bounds
 *
 * One factorisation and one solve a handle: the fast baseline. Rows sum to one by themselves.
 * Harmonic weights peak at point handles; biharmonic and triharmonic ones are smooth, but leave
 * [0, 1] and have extrema between handles (WeightsMinimum, WeightsMaximum, WeightsInteriorExtrema
 * tell).
 *
 * Ports, arrays, certificate, bind cache, report and errors: vtkWeightsAlgorithm.
 *
 * @par Thanks:
 * Botsch, Kobbelt, "An intuitive framework for real-time freeform modeling", ACM Transactions on
 * Graphics 23(3), 2004.
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
    TRIHARMONIC = 3
  };

  ///@{
  /// Which energy: HARMONIC, BIHARMONIC (default) or TRIHARMONIC. A bind parameter.
  void SetMethod(int method);
  vtkGetMacro(Method, int);
  void SetMethodToHarmonic() { this->SetMethod(HARMONIC); }
  void SetMethodToBiharmonic() { this->SetMethod(BIHARMONIC); }
  void SetMethodToTriharmonic() { this->SetMethod(TRIHARMONIC); }
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
};

#endif

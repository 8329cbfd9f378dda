/**
 * @class   vtkBoundedBiharmonicWeights
 * @brief   smooth, local weights between 0 and 1
 *
 * The weight of a handle is the function of least bending energy (the integral of its squared
 * Laplacian) that is 1 on the handle, 0 on all other handles and between 0 and 1 everywhere. It is
 * smooth, also at handles, shape-aware and local. An active-set method solves it to a certificate;
 * an interior-point method takes over where the active-set method does not terminate. All handles
 * share one symbolic analysis and are solved in parallel. Cost: 3 to 6 sparse factorizations per
 * handle, three to five times that where the interior-point method is needed (10k vertices of a
 * lattice: 0.3 to 0.7 s per handle on one core).
 *
 * Ports, arrays, certificate, bind cache, report and errors: see vtkWeightsAlgorithm.
 *
 * @par Thanks:
 * Jacobson, Baran, Popovic, Sorkine, "Bounded Biharmonic Weights for Real-Time Deformation", ACM
 * Transactions on Graphics 30(4), 2011.
 *
 * @sa vtkMonotoneWeights vtkUnconstrainedWeights vtkTransferWeights
 */

#ifndef vtkBoundedBiharmonicWeights_h
#define vtkBoundedBiharmonicWeights_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkWeightsAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkBoundedBiharmonicWeights : public vtkWeightsAlgorithm
{
public:
  static vtkBoundedBiharmonicWeights* New();
  vtkTypeMacro(vtkBoundedBiharmonicWeights, vtkWeightsAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Order of the energy: 2 biharmonic (default), 3 triharmonic. A bind parameter.
  void SetOrder(int order);
  vtkGetMacro(Order, int);
  ///@}

protected:
  vtkBoundedBiharmonicWeights();
  ~vtkBoundedBiharmonicWeights() override;

  bool TakesTerms() const override { return true; }
  bindpose::Status Solve(const bindpose::WeightsProblem& problem,
    const bindpose::WeightsOptions& options, bindpose::ExecutionContext& context,
    bindpose::WeightsResult& result) override;

private:
  vtkBoundedBiharmonicWeights(const vtkBoundedBiharmonicWeights&) = delete;
  void operator=(const vtkBoundedBiharmonicWeights&) = delete;

  int Order = 2;
};

#endif

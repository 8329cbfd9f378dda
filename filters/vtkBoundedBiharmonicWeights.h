/**
 * @class   vtkBoundedBiharmonicWeights
 * @brief   smooth, local weights between 0 and 1
 *
 * For each handle the function of least bending energy (the integral of its squared Laplacian) that
 * is 1 on the handle, 0 on all others and nowhere below 0 or above 1. Smooth also at handles, aware
 * of the shape, local. Solved to a certificate by an active-set method, or by an interior-point
 * method where that does not end; all handles share one symbolic analysis and are solved at the
 * same time. Cost: 3 to 6 sparse factorisations a handle, three to five times that where the
 * interior-point method is needed (10k vertices of a lattice: 0.3 to 0.7 s a handle on one core).
 *
 * Ports, arrays, certificate, bind cache, report and errors: vtkWeightsAlgorithm.
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

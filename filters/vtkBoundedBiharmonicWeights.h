/**
 * @class   vtkBoundedBiharmonicWeights
 * @brief   smooth, local weights between 0 and 1
 *
 * The weight of a handle is 1 on the handle, 0 on all other handles and between 0 and 1 everywhere.
 * Of all such functions, it is the one of least bending energy, which is the integral of the
 * squared Laplacian. The weight is shape-aware, local and smooth, even at handles. An active-set
 * method solves the problem until its optimality certificate (duality gap and KKT residual) is
 * within Tolerance. An interior-point method is used for columns where the active-set method does
 * not terminate. All handles share one symbolic analysis and are solved in parallel. Cost: 3 to 6
 * sparse factorizations per handle, and three to five times as many where the interior-point method
 * is needed. A lattice of 10k vertices takes 0.3 to 0.7 s per handle on one core.
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
  /// Order of the energy: 2 biharmonic (default), 3 triharmonic. This is a bind parameter: a change
  /// computes the weights again.
  void SetOrder(int order);
  vtkGetMacro(Order, int);
  ///@}

protected:
  vtkBoundedBiharmonicWeights();
  ~vtkBoundedBiharmonicWeights() override;

  bool TakesTerms() const override { return true; }
  bindpose::Status Solve(bindpose::ExecutionContext& context,
    const bindpose::WeightsProblem& problem, const bindpose::WeightsOptions& options,
    bindpose::WeightsResult& result) override;

private:
  vtkBoundedBiharmonicWeights(const vtkBoundedBiharmonicWeights&) = delete;
  void operator=(const vtkBoundedBiharmonicWeights&) = delete;

  int Order = 2;
};

#endif

/**
 * @class   vtkFarthestPointHandles
 * @brief   spreads point handles p1, p2, … evenly over a surface
 *
 * The first handle is the vertex farthest from the vertices' centroid. Each next handle is the
 * vertex farthest in space from all handles before it. Ties go to the smaller point id, so the same
 * surface always gives the same handles. A larger NumberOfHandles appends handles and does not
 * change the earlier ones. The filter is useful for a first look at weights on a mesh without a
 * skeleton: the first handles are at tips (fingers, ears, feet).
 *
 * Input: a surface (vtkPointSet with 2D cells), or tets, whose boundary is used. Output: a handle
 * dataset in the rest pose.
 * The status is INVALID_INPUT if the surface has fewer different vertices than NumberOfHandles.
 * Cost: NumberOfHandles passes over the points.
 *
 * Report: `counts.vertices`, `counts.handles`, `handles[].name`, `handles[].kind`,
 * `handles[].vertex` (point id on the surface).
 */

#ifndef vtkFarthestPointHandles_h
#define vtkFarthestPointHandles_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkFarthestPointHandles : public vtkBindposeAlgorithm
{
public:
  static vtkFarthestPointHandles* New();
  vtkTypeMacro(vtkFarthestPointHandles, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Number of handles, at least 1. Default: 8.
  vtkSetClampMacro(NumberOfHandles, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfHandles, int);
  ///@}

protected:
  vtkFarthestPointHandles() = default;
  ~vtkFarthestPointHandles() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkFarthestPointHandles(const vtkFarthestPointHandles&) = delete;
  void operator=(const vtkFarthestPointHandles&) = delete;

  int NumberOfHandles = 8;
};

#endif

/**
 * @class   vtkCutAlongBones
 * @brief   cuts a planar mesh along bones, so that each side of a bone becomes a separate handle
 *
 * A diffusion curve has one color on its left and another on its right (Orzan et al., "Diffusion
 * Curves", 2008). Finch et al., "Freeform Vector Graphics with Controlled Thin-Plate Splines",
 * 2011, use biharmonic weights for such curves. Weights can reproduce these two colors if the mesh
 * is cut along the curve. This filter duplicates the vertices along each bone and creates a region
 * handle for each side. The usual pipeline is:
 *
 *     vtkPlanarShape (with the bones) - vtkCutAlongBones - a weights filter - vtkWeightedColors
 *
 * **Input 1**: the handles. The mesh is cut along bones. Left and right refer to the direction from
 * head to tail, seen from +z. All other handles are passed on, except cage elements, which are left
 * out. Bones with the same value in the cell array `Curve` form one curve, which has the name and
 * colors of its first bone. Without the array each bone is a separate curve. The cell arrays
 * `LeftColor` and `RightColor` (of bones) and `Color` (of the other handles), with 3 components
 * each, become `Color` of the output handles.
 * **Output 0**: the cut surface: the input points with their ids, then the duplicated points; the
 * point arrays of the input, `OriginalPointIds`, and the label `RegionId` of each side. An end of a
 * curve inside of the shape is one point that belongs to neither side. Different colors are
 * adjacent at this point, so unconstrained weights overshoot near it; the overshoot is larger on
 * finer meshes. **Output 1**: the handles. Each curve is replaced by the regions `NAME left` and
 * `NAME right` (a side without points is left out), with `Color`.
 *
 * Report: counts.{vertices, handles, doubled_vertices}, seconds.cut. Errors: a surface that is not
 * flat, no bone, a bone that is not a chain of edges or is a single interior edge, LeftColor
 * without RightColor, a color array whose number of components is not 3.
 *
 * @sa vtkPlanarShape vtkWeightedColors
 */

#ifndef vtkCutAlongBones_h
#define vtkCutAlongBones_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkBindposeAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkCutAlongBones : public vtkBindposeAlgorithm
{
public:
  static vtkCutAlongBones* New();
  vtkTypeMacro(vtkCutAlongBones, vtkBindposeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Set the handles with bones, like SetInputData(1, handles).
  void SetHandlesData(vtkDataObject* handles) { this->SetInputData(1, handles); }
  void SetHandlesConnection(vtkAlgorithmOutput* handles) { this->SetInputConnection(1, handles); }

protected:
  vtkCutAlongBones();
  ~vtkCutAlongBones() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkCutAlongBones(const vtkCutAlongBones&) = delete;
  void operator=(const vtkCutAlongBones&) = delete;
};

#endif

/**
 * @class   vtkCutAlongBones
 * @brief   opens a planar mesh along bones, so that each side of them is a handle of its own
 *
 * A diffusion curve has one colour on its left and another on its right (Orzan et al., "Diffusion
 * Curves", 2008; with biharmonic weights Finch et al., "Freeform Vector Graphics with Controlled
 * Thin-Plate Splines", 2011). Weights can do that where the mesh is cut open along the curve: this
 * filter doubles the vertices along each bone and makes a region handle of each side. What follows
 * is the usual pipeline:
 *
 *     vtkPlanarShape (with the bones) - vtkCutAlongBones - a weights filter - vtkWeightedColors
 *
 * **Input 0**: a flat surface (z = const, vtkPolyData) whose edges run along the bones.
 * **Input 1**: the handles. Bones are cut along, in their direction from head to tail, seen from
 * +z; all other handles are handed on, cage elements left out. Bones with the same number in the
 * cell array `Curve` are one curve, which has the name and colours of its first bone; without the
 * array each bone is one. Cell arrays `LeftColor` and `RightColor` (of bones) and
 * `Color` (of the others), 3 components each, become `Color` of the handles put out.
 * **Output 0**: the cut surface: input points with their numbers, then doubled ones; point arrays
 * of the input, `OriginalPointIds`, and the label `RegionId` of each side. A curve's end inside of
 * the shape is one point, on neither side: colours that differ meet there, and unconstrained
 * weights overshoot the more, the finer the mesh. **Output 1**: the handles: instead of each curve
 * the regions `NAME left` and `NAME right` (without a side that has no point), with `Color`.
 *
 * Report: counts.{vertices, handles, doubled_vertices}, seconds.cut. Errors: a surface that is not
 * flat, no bone, a bone that is not a row of edges or is a single edge inside, LeftColor without
 * RightColor, a colour array with other than 3 components.
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

  /// Handles with bones: SetInputData(1, handles).
  void SetHandlesData(vtkDataObject* handles) { this->SetInputData(1, handles); }
  void SetHandlesConnection(vtkAlgorithmOutput* handles) { this->SetInputConnection(1, handles); }

protected:
  vtkCutAlongBones();
  ~vtkCutAlongBones() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

private:
  vtkCutAlongBones(const vtkCutAlongBones&) = delete;
  void operator=(const vtkCutAlongBones&) = delete;
};

#endif

/**
 * @class   vtkWeightedColors
 * @brief   blends the colors of the handles over a mesh by its weights
 *
 * The color of a point is c = sum_j w_j c_j, where w_j is the weight of handle j at the point and
 * c_j the color of handle j. With weights between 0 and 1 that sum to one
 * (vtkBoundedBiharmonicWeights, vtkMonotoneWeights) every color is between those of the handles.
 * Unconstrained weights can give colors outside of the gamut (below 0 or above 1) and hues that no
 * handle has. The report counts both cases.
 *
 * **Input 0**: a mesh with weights (any vtkPointSet; see vtkWeightsAlgorithm), posed or not.
 * **Input 1**: the handles, with a cell array `Color` of 3 components: numbers from 0 to 1, or
 * unsigned chars. If the array is missing or contains three NaN, the handle gets a color that
 * differs clearly from those of the other handles.
 * **Output**: input 0 with the point arrays
 * - `Color`: 3 unsigned chars, the active scalars, for direct display by a renderer;
 * - `ColorValues`: 3 doubles, the same color before rounding; not clamped if Clamp is off;
 * - `OutOfGamut`: 1 where the blend is outside 0 to 1 before clamping.
 *
 * Report: counts.{vertices, handles, out_of_gamut, beyond_handles}, largest_gamut_violation,
 * largest_overshoot (see bindpose::weighted_colors()), row_sum_error, colors ("Color" or
 * "categorical"), seconds.blend. Errors: no weights of that name, weights that belong to other
 * handles or are not finite, a `Color` array whose number of components is not 3 or with values
 * outside 0 to 1.
 *
 * @sa vtkDepthOrder vtkCutAlongBones
 */

#ifndef vtkWeightedColors_h
#define vtkWeightedColors_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkMeshAndHandlesAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkWeightedColors : public vtkMeshAndHandlesAlgorithm
{
public:
  static vtkWeightedColors* New();
  vtkTypeMacro(vtkWeightedColors, vtkMeshAndHandlesAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Name of the point array of weights, for example "RawWeights". Default "Weights".
  void SetArrayName(const std::string& name);
  std::string GetArrayName() { return this->ArrayName; }
  ///@}

  ///@{
  /// Name of the handles' cell array of colors. Default "Color".
  void SetColorArrayName(const std::string& name);
  std::string GetColorArrayName() { return this->ColorArrayName; }
  ///@}

  ///@{
  /// Blend linear light intensities instead of sRGB values, so that saturated colors do not become
  /// darker where they mix. Default on.
  vtkSetMacro(LinearLight, bool);
  vtkGetMacro(LinearLight, bool);
  vtkBooleanMacro(LinearLight, bool);
  ///@}

  ///@{
  /// Clamp ColorValues to the range 0 to 1. Default on. (The unsigned chars of Color are always
  /// clamped.)
  vtkSetMacro(Clamp, bool);
  vtkGetMacro(Clamp, bool);
  vtkBooleanMacro(Clamp, bool);
  ///@}

protected:
  vtkWeightedColors() = default;
  ~vtkWeightedColors() override = default;

  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

private:
  vtkWeightedColors(const vtkWeightedColors&) = delete;
  void operator=(const vtkWeightedColors&) = delete;

  std::string ArrayName = "Weights";
  std::string ColorArrayName = "Color";
  bool LinearLight = true;
  bool Clamp = true;
};

#endif

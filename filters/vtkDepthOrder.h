/**
 * @class   vtkDepthOrder
 * @brief   which part of a planar shape is in front where a pose makes it overlap itself
 *
 * Each handle has a layer; the depth of a point is depth = sum_j w_j d_j, smooth over the shape and
 * nearly the handle's own layer around it. What is larger is in front for a camera that looks along
 * -z. With Displace on, the points move to z + Scale * depth, so that an ordinary depth buffer
 * shows limbs in the order of their layers. Where layers are equal, handles later in the list are
 * in front: by Tie of a layer from the first to the last, in z only.
 *
 * **Input 0**: a mesh with weights, usually posed and with z = const (any vtkPointSet; see
 * vtkWeightsAlgorithm). **Input 1**: the handles, with a cell array `Layer` of a number each, whole
 * or not; without it all are 0. **Output**: input 0 with the double point array `Depth`, and
 * displaced points when asked for.
 *
 * Report: counts.{vertices, handles}, least_depth, largest_depth, scale (used), seconds.order.
 * Errors: no weights of that name, weights of other handles or with a number that is not finite, a
 * layer that is not finite or has several components.
 *
 * @sa vtkSkinningDeformation vtkWeightedColors
 */

#ifndef vtkDepthOrder_h
#define vtkDepthOrder_h

#include "BindposeFiltersModule.h" // for export macro
#include "vtkMeshAndHandlesAlgorithm.h"

class BINDPOSEFILTERS_EXPORT vtkDepthOrder : public vtkMeshAndHandlesAlgorithm
{
public:
  static vtkDepthOrder* New();
  vtkTypeMacro(vtkDepthOrder, vtkMeshAndHandlesAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Name of the point array of weights. Default "Weights".
  void SetArrayName(const std::string& name);
  std::string GetArrayName() { return this->ArrayName; }
  ///@}

  ///@{
  /// Name of the handles' cell array of layers. Default "Layer".
  void SetLayerArrayName(const std::string& name);
  std::string GetLayerArrayName() { return this->LayerArrayName; }
  ///@}

  ///@{
  /// Move points by their depth along z. Default on.
  vtkSetMacro(Displace, bool);
  vtkGetMacro(Displace, bool);
  vtkBooleanMacro(Displace, bool);
  ///@}

  ///@{
  /// Length of one layer along z, > 0. 0 (default): a thousandth of the mesh's diagonal.
  vtkSetClampMacro(Scale, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Scale, double);
  ///@}

  ///@{
  /// How much of a layer the last handle is before the first where layers are equal, >= 0. Default
  /// 0.001.
  vtkSetClampMacro(Tie, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Tie, double);
  ///@}

protected:
  vtkDepthOrder() = default;
  ~vtkDepthOrder() override = default;

  bindpose::Status Execute(vtkInformationVector** input, vtkInformationVector* output,
    bindpose::ExecutionContext& context) override;

private:
  vtkDepthOrder(const vtkDepthOrder&) = delete;
  void operator=(const vtkDepthOrder&) = delete;

  std::string ArrayName = "Weights";
  std::string LayerArrayName = "Layer";
  bool Displace = true;
  double Scale = 0.0;
  double Tie = 1e-3;
};

#endif

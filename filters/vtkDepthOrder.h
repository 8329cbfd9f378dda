/**
 * @class   vtkDepthOrder
 * @brief   computes which part of a planar shape is in front where parts of the posed shape overlap
 *
 * Each handle j has a layer d_j and each point its weights w_j. The depth of a point is sum_j w_j
 * d_j. The depth varies smoothly over the shape; near a handle it is nearly equal to the layer of
 * that handle. A larger depth is in front for a camera that looks along -z. With Displace on, the
 * points move to z + Scale * depth, so that an ordinary depth buffer shows limbs in the order of
 * their layers. If layers are equal, handles later in the list are in front: the displacement in z
 * grows by up to Tie layers from the first to the last handle.
 *
 * **Input 0**: a mesh with weights, usually posed and with z = const (any vtkPointSet; see
 * vtkWeightsAlgorithm). **Input 1**: the handles, with the cell array `Layer`, one integer or real
 * number per handle; without it all layers are 0. **Output**: input 0 with the double point array
 * `Depth`, and with displaced points if Displace is on.
 *
 * Report: counts.{vertices, handles}, least_depth, largest_depth, scale (used), seconds.order.
 * Errors: no weights of that name, weights that belong to other handles or are not finite, layers
 * that are not finite, a layer array with several components.
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
  /// Length of one layer along z. Default 0: a thousandth of the mesh's bounding-box diagonal.
  vtkSetClampMacro(Scale, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Scale, double);
  ///@}

  ///@{
  /// Additional displacement at the last handle of the list, in layers; at least 0, default 0.001.
  /// It decreases linearly along the list to 0 at the first handle. Of two handles with equal
  /// layers, the later one is therefore in front.
  vtkSetClampMacro(Tie, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Tie, double);
  ///@}

protected:
  vtkDepthOrder() = default;
  ~vtkDepthOrder() override = default;

  bindpose::Status Execute(bindpose::ExecutionContext& context, vtkInformationVector** input,
    vtkInformationVector* output) override;

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

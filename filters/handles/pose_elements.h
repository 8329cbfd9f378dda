#ifndef pose_elements_h
#define pose_elements_h

#include "conversion.h"
#include "pose/element_stretch.h"

namespace bindpose
{

/// The cells of a mesh as simplices, for measuring their stretch.
struct PoseElements
{
  SharedMatrix<Tets> tets;
  SharedMatrix<Triangles> triangles;
  /// Cell of each simplex; empty if simplex i is cell i.
  std::vector<Index> cell_of_element;
  bool volume = false; ///< true: the elements are tets; false: triangles
};

/// Split the volume cells (tets, hexes and other types) into tets. If there are no volume cells,
/// return the 2D cells as triangles. If the cells are invalid, the result is empty; filters that
/// need the cells report the error.
PoseElements to_pose_elements(vtkPointSet* mesh);

/// Return the rest shapes of the tets or triangles.
RestElements to_rest_elements(const PoseElements& elements, PointsView rest);

/// Measure the stretch and return the kernel's report. If options.values is true, add the cell
/// array Stretch to the result: the largest and smallest stretch of each cell, NaN for cells
/// without elements.
Status measure_stretch(ExecutionContext& context, const ElementStretchOptions& options,
  const PoseElements& elements, const RestElements& rest, PointsView posed, vtkDataSet* result);

} // namespace bindpose

#endif

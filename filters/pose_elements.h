#ifndef pose_elements_h
#define pose_elements_h

#include "conversion.h"
#include "pose/element_stretch.h"

namespace bindpose
{

/// A mesh's cells as the simplices whose stretch can be told.
struct PoseElements
{
  SharedMatrix<Tets> tets;
  SharedMatrix<Triangles> triangles;
  /// Cell that each simplex comes from; empty when simplex i is cell i.
  std::vector<Index> cell_of_element;
  bool volume = false; ///< tets count, not triangles
};

/// The cells of volume as tets (hexes and others are split), else the 2D cells as triangles. Cells
/// that cannot be read leave none: whoever needs them says so.
PoseElements to_pose_elements(vtkPointSet* mesh);

/// The shapes of those that count.
RestElements to_rest_elements(const PoseElements& elements, PointsView rest);

/// The kernel's report; with options.values the cell array Stretch of the result has the largest
/// and smallest stretch of each cell, NaN where there is none.
Status measure_stretch(ExecutionContext& context, const ElementStretchOptions& options,
  const PoseElements& elements, const RestElements& rest, PointsView posed, vtkDataSet* result);

} // namespace bindpose

#endif

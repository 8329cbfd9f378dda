#ifndef bindpose_scene_rotation_colors_h
#define bindpose_scene_rotation_colors_h

#include "scene/categories.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkDataSet;
class vtkDoubleArray;

namespace bindpose
{

/// Check the point array RotationCluster. The array contains the index of each point's rotation
/// cluster (vertices that share one fitted rotation), or -1 for none. Return invalid_input if no
/// dataset has the array, or if a value is not an integer from -1 to #points + #cells - 1. Larger
/// values cannot be indices of clusters.
Status check_clusters(const std::vector<vtkDataSet*>& datasets);

/// Return for each cell the cluster of most of its points (the lowest if several are equally
/// frequent), or -1 if no point has a cluster. Return null if there is no point array
/// RotationCluster. The data must have passed check_clusters().
vtkSmartPointer<vtkDoubleArray> clusters_of_cells(vtkDataSet* data);

/// Return one category per cluster of the datasets, in ascending order, with the number of cells of
/// the cluster. Each cluster gets one of the colors of handles. Clusters that touch get different
/// colors if possible. The datasets must have passed check_clusters().
std::vector<Category> cluster_categories(const std::vector<vtkDataSet*>& datasets);

/// Return the upper end of the color range for rotation angles up to `largest` degrees. The result
/// is a round angle, so that it rarely changes while a shape is bent.
double angle_scale(double largest);

} // namespace bindpose

#endif

#ifndef bindpose_scene_rotation_colors_h
#define bindpose_scene_rotation_colors_h

#include "scene/categories.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkDataSet;
class vtkDoubleArray;

namespace bindpose
{

/// Check the point array RotationCluster. Return invalid_input if no dataset has the array, or if a
/// value is not -1 (no cluster) or a cluster number 0, 1, … below the number of points plus cells.
Status check_clusters(const std::vector<vtkDataSet*>& datasets);

/// Return for each cell the cluster of most of its points (the lowest if several are equally
/// frequent), or -1 if no point has a cluster. Return null without the point array RotationCluster.
/// The data must have passed check_clusters().
vtkSmartPointer<vtkDoubleArray> clusters_of_cells(vtkDataSet* data);

/// Return the clusters of all datasets by number, with the count of their cells. The colors are
/// those of handles, assigned such that clusters that touch differ. The datasets must have passed
/// check_clusters().
std::vector<Category> cluster_categories(const std::vector<vtkDataSet*>& datasets);

/// Return the upper end of a scale of angles that contains `largest` degrees. It is a round angle,
/// so that it rarely changes while a shape is bent.
double angle_scale(double largest);

} // namespace bindpose

#endif

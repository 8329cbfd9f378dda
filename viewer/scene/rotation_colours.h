#ifndef bindpose_scene_rotation_colours_h
#define bindpose_scene_rotation_colours_h

#include "scene/categories.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkDataSet;
class vtkDoubleArray;

namespace bindpose
{

/// invalid_input when no dataset has the point array RotationCluster, or one has a value that is no
/// number of a cluster: -1 (none), 0, 1, … and no more than there are points and cells.
Status check_clusters(const std::vector<vtkDataSet*>& datasets);

/// For each cell the cluster that most of its points follow by the point array RotationCluster (the
/// lowest of equals), -1 where they follow none. Null without that array. Checked before.
vtkSmartPointer<vtkDoubleArray> clusters_of_cells(vtkDataSet* data);

/// The clusters of all these datasets by their numbers, and how many cells follow them. The colours
/// are those of handles, dealt out such that clusters that touch differ. Checked before.
std::vector<Category> cluster_categories(const std::vector<vtkDataSet*>& datasets);

/// Where a scale of angles ends that holds these degrees: at a round angle, so that it stays where
/// it is while a shape is bent.
double angle_scale(double largest);

} // namespace bindpose

#endif

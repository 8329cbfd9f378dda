// Assigns colors to rotation clusters (vertices that share one fitted rotation) such that adjacent
// clusters differ. The clusters are graph-colored greedily in ascending order. The search for a
// free color begins at the cluster's own index, so that all colors are used about equally often.
#include "scene/rotation_colors.h"

#include "base/most_frequent.h"
#include "base/number_text.h"

#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace bindpose
{

namespace
{
vtkDataArray* cluster_array(vtkDataSet* data)
{
  return data ? data->GetPointData()->GetArray("RotationCluster") : nullptr;
}

/// Call `each` for every cell. The arguments of `each` are the cell, the cluster of most of its
/// points (the lowest if several are equally frequent), and the clusters of all its points in
/// ascending order. A cell without a cluster gets -1 and an empty list.
template <typename Cell>
void for_each_cell(vtkDataSet* data, const Cell& each)
{
  vtkDataArray* array = cluster_array(data);
  vtkNew<vtkIdList> ids;
  std::vector<int> clusters;
  for (vtkIdType cell = 0; array && cell < data->GetNumberOfCells(); ++cell)
  {
    data->GetCellPoints(cell, ids);
    clusters.clear();
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      const int cluster = static_cast<int>(array->GetComponent(ids->GetId(k), 0));
      if (cluster >= 0)
      {
        clusters.push_back(cluster);
      }
    }
    const int cell_cluster =
      clusters.empty() ? -1 : most_frequent(clusters.begin(), clusters.end());
    each(cell, cell_cluster, clusters);
  }
}

using Pairs = std::set<std::pair<int, int>>; // pairs of clusters that touch, the higher index first

/// Return a handle color for each cluster. The color differs from the colors of all touching
/// clusters with a lower index.
std::vector<std::size_t> assign_colors(std::size_t clusters, const Pairs& touching)
{
  std::vector<std::size_t> colors;
  for (std::size_t k = 0; k < clusters; ++k)
  {
    std::vector<char> is_used(handle_color_count, 0);
    const int number = static_cast<int>(k);
    for (auto pair = touching.lower_bound({ number, 0 });
         pair != touching.end() && pair->first == number; ++pair)
    {
      is_used[colors[static_cast<std::size_t>(pair->second)]] = 1;
    }
    std::size_t color = k % handle_color_count;
    for (std::size_t attempt = 0; is_used[color] && attempt < handle_color_count; ++attempt)
    {
      color = (color + 1) % handle_color_count;
    }
    colors.push_back(color);
  }
  return colors;
}
} // namespace

Status check_clusters(const std::vector<vtkDataSet*>& datasets)
{
  bool any = false;
  for (vtkDataSet* data : datasets)
  {
    vtkDataArray* array = cluster_array(data);
    any = any || array;
    const auto value_limit =
      array ? static_cast<double>(data->GetNumberOfPoints() + data->GetNumberOfCells()) : 0.0;
    for (vtkIdType v = 0; array && v < array->GetNumberOfTuples(); ++v)
    {
      const double value = array->GetComponent(v, 0);
      if (!(value >= -1.0 && value < value_limit && value == std::floor(value)))
      {
        return Status::invalid_input("'RotationCluster' of point " + std::to_string(v) + " is " +
          short_number(value) + ", which is not a cluster number");
      }
    }
  }
  return any ? Status()
             : Status::invalid_input(
                 "colors by rotation cluster need a mesh with the point array 'RotationCluster'; "
                 "bindpose deform --rotation-arrays writes it");
}

vtkSmartPointer<vtkDoubleArray> clusters_of_cells(vtkDataSet* data)
{
  if (!cluster_array(data))
  {
    return nullptr;
  }
  auto result = vtkSmartPointer<vtkDoubleArray>::New();
  result->SetNumberOfValues(data->GetNumberOfCells());
  for_each_cell(data,
    [&](vtkIdType cell, int cluster, const std::vector<int>&) { result->SetValue(cell, cluster); });
  return result;
}

std::vector<Category> cluster_categories(const std::vector<vtkDataSet*>& datasets)
{
  std::vector<Index> counts;
  Pairs touching;
  for (vtkDataSet* data : datasets)
  {
    for_each_cell(data,
      [&](vtkIdType, int cluster, const std::vector<int>& point_clusters)
      {
        if (cluster < 0)
        {
          return;
        }
        counts.resize(
          std::max(counts.size(), static_cast<std::size_t>(point_clusters.back()) + 1), 0);
        ++counts[static_cast<std::size_t>(cluster)];
        for (const int higher : point_clusters)
        {
          for (std::size_t b = 0; point_clusters[b] < higher; ++b)
          {
            touching.emplace(higher, point_clusters[b]);
          }
        }
      });
  }
  std::vector<Category> categories;
  const std::vector<std::size_t> colors = assign_colors(counts.size(), touching);
  for (std::size_t k = 0; k < counts.size(); ++k)
  {
    categories.push_back(
      { static_cast<int>(k), std::to_string(k), handle_color(colors[k]), counts[k] });
  }
  return categories;
}

double angle_scale(double largest)
{
  const double ends[] = { 15.0, 30.0, 45.0, 60.0, 90.0, 120.0 };
  const auto* end = std::lower_bound(std::begin(ends), std::end(ends), largest);
  return end == std::end(ends) ? 180.0 : *end;
}

} // namespace bindpose

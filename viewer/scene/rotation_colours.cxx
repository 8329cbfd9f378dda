// Clusters are graph-coloured greedily in the order of their numbers, each beginning to look for a
// free colour at its own number, so that all colours are used about equally often.
#include "scene/rotation_colours.h"

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

/// The clusters of a cell's points, ascending, with those that follow none left out.
void clusters_of_points(
  vtkDataSet* data, vtkDataArray* array, vtkIdType cell, vtkIdList* ids, std::vector<int>& clusters)
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
  std::sort(clusters.begin(), clusters.end());
}
} // namespace

Status check_clusters(const std::vector<vtkDataSet*>& datasets)
{
  bool any = false;
  for (vtkDataSet* data : datasets)
  {
    vtkDataArray* array = cluster_array(data);
    any = any || array;
    const auto most =
      array ? static_cast<double>(data->GetNumberOfPoints() + data->GetNumberOfCells()) : 0.0;
    for (vtkIdType v = 0; array && v < array->GetNumberOfTuples(); ++v)
    {
      const double value = array->GetComponent(v, 0);
      if (!(value >= -1.0 && value < most && value == std::floor(value)))
      {
        return Status::invalid_input("'RotationCluster' of point " + std::to_string(v) + " is " +
          short_number(value) + ", which is no number of a cluster");
      }
    }
  }
  return any ? Status()
             : Status::invalid_input(
                 "colours by rotation cluster need a mesh with the point array 'RotationCluster'; "
                 "bindpose deform --rotation-arrays writes it");
}

vtkSmartPointer<vtkDoubleArray> clusters_of_cells(vtkDataSet* data)
{
  vtkDataArray* array = cluster_array(data);
  if (!array)
  {
    return nullptr;
  }
  auto result = vtkSmartPointer<vtkDoubleArray>::New();
  result->SetNumberOfValues(data->GetNumberOfCells());
  vtkNew<vtkIdList> ids;
  std::vector<int> clusters;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    clusters_of_points(data, array, cell, ids, clusters);
    int best = -1;
    std::ptrdiff_t most = 0;
    for (const int cluster : clusters)
    {
      const std::ptrdiff_t votes = std::count(clusters.begin(), clusters.end(), cluster);
      best = votes > most ? cluster : best;
      most = std::max(most, votes);
    }
    result->SetValue(cell, best);
  }
  return result;
}

std::vector<Category> cluster_categories(const std::vector<vtkDataSet*>& datasets)
{
  std::vector<Index> counts;
  std::set<std::pair<int, int>> touching; // higher, lower
  for (vtkDataSet* data : datasets)
  {
    const auto of_cells = clusters_of_cells(data);
    vtkNew<vtkIdList> ids;
    std::vector<int> clusters;
    for (vtkIdType cell = 0; of_cells && cell < data->GetNumberOfCells(); ++cell)
    {
      clusters_of_points(data, cluster_array(data), cell, ids, clusters);
      if (clusters.empty())
      {
        continue;
      }
      counts.resize(std::max(counts.size(), static_cast<std::size_t>(clusters.back()) + 1), 0);
      ++counts[static_cast<std::size_t>(of_cells->GetValue(cell))];
      for (std::size_t a = 0; a < clusters.size(); ++a)
      {
        for (std::size_t b = 0; clusters[b] < clusters[a]; ++b)
        {
          touching.emplace(clusters[a], clusters[b]);
        }
      }
    }
  }
  std::vector<std::string> names;
  for (std::size_t k = 0; k < counts.size(); ++k)
  {
    names.push_back(std::to_string(k));
  }
  constexpr std::size_t different = 24; // colours of handles
  std::vector<Category> categories = handle_categories(names);
  const std::vector<Category> colours =
    handle_categories(std::vector<std::string>(different, std::string()));
  std::vector<std::size_t> colour_of(names.size());
  for (std::size_t k = 0; k < names.size(); ++k)
  {
    std::vector<char> taken(different, 0);
    const int number = static_cast<int>(k);
    for (auto pair = touching.lower_bound({ number, 0 });
         pair != touching.end() && pair->first == number; ++pair)
    {
      taken[colour_of[static_cast<std::size_t>(pair->second)]] = 1;
    }
    std::size_t colour = k % different;
    for (std::size_t tried = 0; taken[colour] && tried < different; ++tried)
    {
      colour = (colour + 1) % different;
    }
    colour_of[k] = colour;
    categories[k].colour = colours[colour].colour;
    categories[k].count = counts[k];
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

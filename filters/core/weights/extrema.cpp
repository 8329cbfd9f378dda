// Find extrema of weights and their persistence (see extrema.h). The persistence of minima is
// computed by union-find over vertices sorted by value. Maxima are the minima of the negated
// function.
#include "weights/extrema.h"

#include <algorithm>
#include <numeric>

namespace bindpose
{

namespace
{
/// Find the minima of sign * values and their persistence.
void sweep(const VertexGraph& graph, const Eigen::VectorXd& values,
  const std::vector<char>& is_exempt, double sign, double range, std::vector<Extremum>& found)
{
  const Index count = values.size();
  std::vector<Index> order;
  for (Index v = 0; v < count; ++v)
  {
    if (graph.begin[v] != graph.begin[v + 1])
    {
      order.push_back(v);
    }
  }
  const auto before = [&](Index a, Index b)
  {
    const double x = sign * values[a];
    const double y = sign * values[b];
    if (x != y)
    {
      return x < y;
    }
    return is_exempt[a] != is_exempt[b] ? is_exempt[a] > is_exempt[b] : a < b;
  };
  std::sort(order.begin(), order.end(), before);
  std::vector<Index> rank(static_cast<std::size_t>(count), -1);
  std::vector<Index> parent(static_cast<std::size_t>(count));
  // The minimum of each part, stored at the index of the part's root in the union-find. A part is a
  // connected set of vertices that have been visited.
  std::vector<Index> minimum_of_part(static_cast<std::size_t>(count));
  std::iota(parent.begin(), parent.end(), Index(0));
  std::iota(minimum_of_part.begin(), minimum_of_part.end(), Index(0));
  const auto root = [&](Index v)
  {
    while (parent[v] != v)
    {
      parent[v] = parent[parent[v]];
      v = parent[v];
    }
    return v;
  };
  const auto add_extremum = [&](Index minimum, double persistence)
  {
    if (!is_exempt[minimum])
    {
      found.push_back({ minimum, sign < 0.0, values[minimum], persistence });
    }
  };
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const Index v = order[i];
    rank[v] = static_cast<Index>(i);
    for (Index k = graph.begin[v]; k < graph.begin[v + 1]; ++k)
    {
      const Index u = graph.neighbors[k];
      if (rank[u] < 0)
      {
        continue;
      }
      Index a = root(u);
      Index b = root(v);
      if (a == b)
      {
        continue;
      }
      // The merged part keeps one of the two minima: the minimum on a handle, or else the lower
      // one. Let a be the part with this minimum. The minimum of the other part b ends at vertex v.
      // If b contains only v, then v is not a minimum, and no minimum ends.
      const bool handle_a = is_exempt[minimum_of_part[a]] != 0;
      const bool handle_b = is_exempt[minimum_of_part[b]] != 0;
      if (handle_a != handle_b ? handle_b : rank[minimum_of_part[b]] < rank[minimum_of_part[a]])
      {
        std::swap(a, b);
      }
      if (minimum_of_part[b] != v)
      {
        add_extremum(minimum_of_part[b], sign * (values[v] - values[minimum_of_part[b]]) / range);
      }
      parent[b] = a;
    }
  }
  for (const Index v : order)
  {
    if (parent[v] == v)
    {
      add_extremum(minimum_of_part[v], 1.0);
    }
  }
}
} // namespace

std::vector<Extremum> interior_extrema(const VertexGraph& graph, const Eigen::VectorXd& values,
  const std::vector<char>& is_exempt, double minimum_persistence)
{
  std::vector<Extremum> found;
  if (values.size() == 0)
  {
    return found;
  }
  const double range = values.maxCoeff() - values.minCoeff();
  if (!(range > 0.0))
  {
    return found;
  }
  sweep(graph, values, is_exempt, 1.0, range, found);
  sweep(graph, values, is_exempt, -1.0, range, found);
  found.erase(std::remove_if(found.begin(), found.end(),
                [&](const Extremum& e) { return !(e.persistence > minimum_persistence); }),
    found.end());
  std::sort(found.begin(), found.end(),
    [](const Extremum& a, const Extremum& b)
    {
      if (a.persistence != b.persistence)
      {
        return a.persistence > b.persistence;
      }
      return a.vertex != b.vertex ? a.vertex < b.vertex : a.maximum < b.maximum;
    });
  return found;
}

} // namespace bindpose

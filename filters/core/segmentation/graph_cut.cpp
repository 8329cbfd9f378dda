// Minimization of a binary energy by maximum flow (Boykov, Kolmogorov, 2004).
//
// Most nodes are labeled without flow, because the difference of their two costs exceeds the costs
// of their edges. The other nodes form a network. A node that is cheaper inside is connected to the
// source, with the difference of its two costs as capacity; a node that is cheaper outside is
// connected to the sink. The maximum flow from source to sink saturates the cheapest set of edges
// that separates the source from the sink. Costs are first rounded to integers, so that the flow
// arithmetic is exact and the result does not depend on rounding.
#include "segmentation/graph_cut.h"

#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/range/iterator_range.hpp>

#include <algorithm>
#include <cmath>

namespace bindpose
{

namespace
{
using Flow = std::int64_t;
using Network = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property,
  boost::no_property, boost::no_property, std::int64_t, std::int64_t>;
using Vertex = boost::graph_traits<Network>::vertex_descriptor;
using Arc = boost::graph_traits<Network>::edge_descriptor;
using ArcIndex = boost::property_map<Network, boost::edge_index_t>::const_type;

struct CancelException
{
};

/// Residual capacities of the flow algorithm. The function put(), which writes a capacity, also
/// checks for a cancel request every 65,536 calls, because the algorithm has no callback.
struct Residuals
{
  using key_type = Arc;
  using value_type = Flow;
  using reference = Flow&;
  using category = boost::lvalue_property_map_tag;

  ArcIndex index;
  std::vector<Flow>* values;
  ExecutionContext* context;
  std::int64_t* countdown;

  Flow& operator[](const Arc& arc) const { return (*this->values)[get(this->index, arc)]; }
};

Flow get(const Residuals& map, const Arc& arc)
{
  return map[arc];
}

void put(const Residuals& map, const Arc& arc, Flow value)
{
  constexpr std::int64_t check_interval = 1 << 16;
  if (--*map.countdown <= 0)
  {
    *map.countdown = check_interval;
    if (map.context->canceled())
    {
      throw CancelException();
    }
  }
  map[arc] = value;
}

Status check(const CutEnergy& energy)
{
  const auto bad = [](double cost) { return !std::isfinite(cost) || cost < 0.0; };
  const auto nodes = static_cast<Index>(energy.inside_costs.size());
  if (energy.outside_costs.size() != energy.inside_costs.size())
  {
    return Status::invalid_input(
      "the number of outside costs must equal the number of inside costs");
  }
  for (Index i = 0; i < nodes; ++i)
  {
    if (bad(energy.inside_costs[i]) || bad(energy.outside_costs[i]))
    {
      return Status::invalid_input(
        "the costs of node " + std::to_string(i) + " must be finite and at least 0");
    }
  }
  for (std::size_t e = 0; e < energy.edges.size(); ++e)
  {
    const CutEnergy::Edge& edge = energy.edges[e];
    if (bad(edge.cost) || std::min(edge.a, edge.b) < 0 || std::max(edge.a, edge.b) >= nodes ||
      edge.a == edge.b)
    {
      return Status::invalid_input("edge " + std::to_string(e) +
        " must connect two different nodes and have a finite cost of at least 0");
    }
  }
  return {};
}
} // namespace

double CutEnergy::evaluate(const std::vector<char>& inside) const
{
  double sum = 0.0;
  for (std::size_t i = 0; i < inside.size(); ++i)
  {
    sum += inside[i] ? this->inside_costs[i] : this->outside_costs[i];
  }
  for (const Edge& edge : this->edges)
  {
    sum += inside[edge.a] != inside[edge.b] ? edge.cost : 0.0;
  }
  return sum;
}

namespace
{
/// Labels of the nodes. Most labels are decided before the maximum flow is computed.
class Labels
{
public:
  explicit Labels(const CutEnergy& energy)
    : energy_(energy), gains_(energy.inside_costs.size()),
      labels_(energy.inside_costs.size(), undecided)
  {
  }

  /// Decide nodes that have the same label in every minimum. The gain of a node is the difference
  /// between the energies of its two labels, including edges to decided nodes. A node is decided if
  /// the gain exceeds the total cost of its edges to undecided nodes. Each decision may make
  /// decisions for neighbors possible. The loop ends after a round that decides few nodes.
  void decide_labels()
  {
    const auto nodes = static_cast<Index>(this->labels_.size());
    // Total cost of each node's edges to undecided nodes.
    std::vector<double> edges(this->labels_.size());
    for (bool has_progress = true; has_progress;)
    {
      for (Index i = 0; i < nodes; ++i)
      {
        this->gains_[i] = this->energy_.outside_costs[i] - this->energy_.inside_costs[i];
        edges[i] = 0.0;
      }
      for (const CutEnergy::Edge& edge : this->energy_.edges)
      {
        this->add(edge.a, edge.b, edge.cost, edges);
        this->add(edge.b, edge.a, edge.cost, edges);
      }
      // Relative margin for rounding errors. The gain of a node must exceed the costs of the edges
      // by more than this margin. Nodes that fail this test are labeled by the maximum flow.
      constexpr double rounding = 1e-9;
      Index left = 0;
      Index decided = 0;
      for (Index i = 0; i < nodes; ++i)
      {
        if (this->labels_[i] != undecided)
        {
          continue;
        }
        const double gain = this->gains_[i];
        if (std::abs(gain) * (1.0 - rounding) > edges[i])
        {
          this->labels_[i] = gain > 0.0 ? inside : outside;
          ++decided;
        }
        else
        {
          ++left;
        }
      }
      // The loop ends if a round decides at most one node per 20 undecided nodes.
      constexpr Index round_divisor = 20;
      has_progress = round_divisor * decided > left;
    }
  }

  /// Return the energy as a function of the undecided nodes, with the labels of their decided
  /// neighbors inserted.
  CutEnergy reduced()
  {
    this->ids_.assign(this->labels_.size(), -1);
    CutEnergy reduced;
    for (std::size_t i = 0; i < this->labels_.size(); ++i)
    {
      if (this->labels_[i] == undecided)
      {
        this->ids_[i] = static_cast<Index>(reduced.inside_costs.size());
        reduced.inside_costs.push_back(std::max(0.0, -this->gains_[i]));
        reduced.outside_costs.push_back(std::max(0.0, this->gains_[i]));
      }
    }
    for (const CutEnergy::Edge& edge : this->energy_.edges)
    {
      if (this->ids_[edge.a] >= 0 && this->ids_[edge.b] >= 0)
      {
        reduced.edges.push_back({ this->ids_[edge.a], this->ids_[edge.b], edge.cost });
      }
    }
    return reduced;
  }

  /// Return the labels of all nodes.
  /// @param reduced labels of the nodes of the energy that reduced() returns.
  std::vector<char> expand(const std::vector<char>& reduced) const
  {
    std::vector<char> all = this->labels_;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      all[i] = this->ids_[i] >= 0 ? reduced[this->ids_[i]] : all[i];
    }
    return all;
  }

private:
  static constexpr char outside = 0;
  static constexpr char inside = 1;
  static constexpr char undecided = 2;

  void add(Index node, Index neighbor, double cost, std::vector<double>& edges)
  {
    const char label = this->labels_[neighbor];
    this->gains_[node] += label == undecided ? 0.0 : label == inside ? cost : -cost;
    edges[node] += label == undecided ? cost : 0.0;
  }

  const CutEnergy& energy_;
  std::vector<double> gains_; ///< cost of label outside minus cost of label inside, per node
  std::vector<char> labels_;
  std::vector<Index> ids_; ///< index of each node in the result of reduced(); -1: label is decided
};

/// Compute the labels by maximum flow.
Status cut(ExecutionContext& context, const CutEnergy& energy, std::vector<char>& inside)
{
  const auto nodes = static_cast<Index>(energy.inside_costs.size());
  const Index source = nodes;
  const Index sink = nodes + 1;
  double sum = 0.0;
  for (Index i = 0; i < nodes; ++i)
  {
    sum += std::abs(energy.outside_costs[i] - energy.inside_costs[i]);
  }
  for (const CutEnergy::Edge& edge : energy.edges)
  {
    sum += edge.cost;
  }
  const double scale = sum > 0.0 ? 0x1p40 / sum : 0.0;
  const auto to_integer = [&](double cost)
  { return static_cast<Flow>(std::llround(scale * cost)); };

  struct ArcData
  {
    Index from, to;
    Flow capacity;
    Index pair; ///< index of the pair of opposite arcs to which this arc belongs
  };
  std::vector<ArcData> lines;
  lines.reserve(2 * (energy.edges.size() + static_cast<std::size_t>(nodes)));
  Index pairs = 0;
  const auto connect = [&](Index a, Index b, Flow capacity_ab, Flow back)
  {
    lines.push_back({ a, b, capacity_ab, pairs });
    lines.push_back({ b, a, back, pairs });
    ++pairs;
  };
  for (Index i = 0; i < nodes; ++i)
  {
    const Flow gain = to_integer(energy.outside_costs[i] - energy.inside_costs[i]);
    if (gain > 0)
    {
      connect(source, i, gain, 0);
    }
    else if (gain < 0)
    {
      connect(i, sink, -gain, 0);
    }
  }
  for (const CutEnergy::Edge& edge : energy.edges)
  {
    const Flow capacity = to_integer(edge.cost);
    if (capacity > 0)
    {
      connect(edge.a, edge.b, capacity, capacity);
    }
  }
  std::sort(lines.begin(), lines.end(),
    [](const ArcData& x, const ArcData& y) {
      return x.from != y.from ? x.from < y.from : x.to != y.to ? x.to < y.to : x.pair < y.pair;
    });
  if (context.canceled())
  {
    return Status::canceled();
  }

  std::vector<std::pair<Index, Index>> ends;
  std::vector<Flow> capacities;
  std::vector<std::array<Index, 2>> arcs_of_pair(
    static_cast<std::size_t>(pairs), { Index(-1), Index(-1) });
  ends.reserve(lines.size());
  capacities.reserve(lines.size());
  for (std::size_t k = 0; k < lines.size(); ++k)
  {
    ends.emplace_back(lines[k].from, lines[k].to);
    capacities.push_back(lines[k].capacity);
    auto& arcs = arcs_of_pair[lines[k].pair];
    arcs[arcs[0] >= 0] = static_cast<Index>(k);
  }
  const Network network(
    boost::edges_are_sorted, ends.begin(), ends.end(), static_cast<std::int64_t>(nodes + 2));
  const ArcIndex index = get(boost::edge_index, network);
  std::vector<Arc> all;
  all.reserve(lines.size());
  for (const Arc& arc : boost::make_iterator_range(boost::edges(network)))
  {
    all.push_back(arc); // arcs are visited in the order of their indices
  }
  std::vector<Arc> reverse(lines.size());
  for (const auto& arcs : arcs_of_pair)
  {
    reverse[arcs[0]] = all[arcs[1]];
    reverse[arcs[1]] = all[arcs[0]];
  }
  const auto vertices = static_cast<std::size_t>(nodes + 2);
  std::vector<Flow> residuals(capacities);
  std::vector<Arc> predecessors(vertices);
  std::vector<boost::default_color_type> colors(vertices, boost::gray_color);
  std::vector<Index> distances(vertices, 0);
  std::int64_t countdown = 0;
  const auto vertex_index_map = get(boost::vertex_index, network);
  try
  {
    boost::boykov_kolmogorov_max_flow(network,
      boost::make_iterator_property_map(capacities.begin(), index),
      Residuals{ index, &residuals, &context, &countdown },
      boost::make_iterator_property_map(reverse.begin(), index),
      boost::make_iterator_property_map(predecessors.begin(), vertex_index_map),
      boost::make_iterator_property_map(colors.begin(), vertex_index_map),
      boost::make_iterator_property_map(distances.begin(), vertex_index_map), vertex_index_map,
      static_cast<Vertex>(source), static_cast<Vertex>(sink));
  }
  catch (const CancelException&)
  {
    return Status::canceled();
  }
  inside.resize(static_cast<std::size_t>(nodes));
  for (Index i = 0; i < nodes; ++i)
  {
    inside[i] = colors[i] == boost::black_color; // black nodes belong to the source's tree
  }
  return {};
}
} // namespace

Status minimize(ExecutionContext& context, const CutEnergy& energy, std::vector<char>& inside)
{
  Status status = check(energy);
  if (!status.ok())
  {
    return status;
  }
  Labels labels(energy);
  labels.decide_labels();
  std::vector<char> reduced;
  status = cut(context, labels.reduced(), reduced);
  if (status.ok())
  {
    inside = labels.expand(reduced);
  }
  return status;
}

} // namespace bindpose

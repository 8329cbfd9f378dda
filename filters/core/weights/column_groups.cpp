// This file converts vertices and terms to the unknowns and columns of the solver (see
// column_groups.h). Unknowns are the classes of a union-find over the pairs (copy of the mesh,
// vertex). In every column, a class must satisfy the requirements of all its members. The bounds of
// the members are intersected. Two members with different given values are a contradiction.
#include "weights/column_groups.h"

#include "base/disjoint_sets.h"
#include "base/sort_unique.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

namespace bindpose
{

namespace
{
constexpr double same_value = 1e-12;

/// Make the unknowns and columns of one group.
class GroupMaker
{
public:
  GroupMaker(const WeightsProblem& problem, const WeightTerms& terms, const Exclusions& excluded,
    bool coupled, ColumnGroup& group)
    : problem_(problem), terms_(terms), excluded_(excluded), coupled_(coupled), group_(group),
      n_(problem.vertex_count())
  {
  }

  Status make(bool mirrored)
  {
    this->find_unknowns(mirrored);
    this->find_fixed_vertices();
    this->group_.columns.resize(this->group_.handles.size());
    this->group_.has_pins.assign(this->group_.handles.size(), 0);
    for (std::size_t c = 0; c < this->group_.columns.size(); ++c)
    {
      const Status status = this->make_column(static_cast<Index>(c));
      if (!status.ok())
      {
        return status;
      }
    }
    if (this->coupled_)
    {
      this->keep_common_constants();
    }
    this->collect_pins();
    return {};
  }

private:
  void find_unknowns(bool mirrored)
  {
    const auto& component_of_vertex = this->problem_.constraints.components.component_of_vertex;
    const Index copies = this->group_.copies;
    DisjointSets<Index> classes(static_cast<std::size_t>(copies * this->n_));
    bool merged = false;
    std::map<Index, Index> first_of_set;
    for (Index v = 0; v < this->n_; ++v)
    {
      const Index set = this->terms_.rigid_sets.empty() ? 0 : this->terms_.rigid_sets[v];
      if (set > 0 && component_of_vertex[v] >= 0)
      {
        const Index first = first_of_set.insert({ set, v }).first->second;
        for (Index k = 0; k < copies; ++k)
        {
          classes.unite(k * this->n_ + first, k * this->n_ + v);
        }
        merged = merged || first != v;
      }
      const Index other = mirrored ? this->terms_.mirror[v] : -1;
      if (other >= 0 && component_of_vertex[v] >= 0 && component_of_vertex[other] >= 0)
      {
        classes.unite(v, (copies - 1) * this->n_ + other);
        merged = merged || copies > 1 || other != v;
      }
    }
    this->group_.count = copies * this->n_;
    this->members_.clear();
    if (merged || copies > 1)
    {
      std::vector<Index>& unknowns = this->group_.unknowns;
      unknowns.assign(static_cast<std::size_t>(copies * this->n_), -1);
      this->group_.count = 0;
      for (Index i = 0; i < copies * this->n_; ++i)
      {
        const Index first = classes.find(i);
        unknowns[i] = first == i ? this->group_.count++ : unknowns[first];
      }
    }
    this->members_.assign(static_cast<std::size_t>(this->group_.count), {});
    for (Index k = 0; k < copies; ++k)
    {
      for (Index v = 0; v < this->n_; ++v)
      {
        this->members_[this->unknown(v, k)].push_back(k * this->n_ + v);
      }
    }
    // Find the connected components of the unknowns.
    const Index parts = this->problem_.constraints.components.count;
    DisjointSets<Index> joined(static_cast<std::size_t>(copies * parts));
    this->component_of_unknown_.assign(static_cast<std::size_t>(this->group_.count), -1);
    for (Index u = 0; u < this->group_.count; ++u)
    {
      for (const Index member : this->members_[u])
      {
        const Index part = component_of_vertex[member % this->n_];
        if (part >= 0)
        {
          const Index at = (member / this->n_) * parts + part;
          this->component_of_unknown_[u] =
            this->component_of_unknown_[u] < 0 ? at : this->component_of_unknown_[u];
          joined.unite(this->component_of_unknown_[u], at);
        }
      }
    }
    for (Index& part : this->component_of_unknown_)
    {
      part = part < 0 ? -1 : joined.find(part);
    }
    this->part_count_ = copies * parts;
  }

  Index unknown(Index vertex, Index copy) const
  {
    return this->group_.unknown(vertex, copy, this->n_);
  }

  void find_fixed_vertices()
  {
    this->fixed_row_.assign(static_cast<std::size_t>(this->n_), -1);
    for (std::size_t i = 0; i < this->problem_.fixed.size(); ++i)
    {
      this->fixed_row_[this->problem_.fixed[i]] = static_cast<Index>(i);
    }
    this->is_fixed_.assign(static_cast<std::size_t>(this->group_.count), 0);
    for (Index u = 0; u < this->group_.count; ++u)
    {
      for (const Index member : this->members_[u])
      {
        this->is_fixed_[u] = this->is_fixed_[u] || this->fixed_row_[member % this->n_] >= 0;
      }
      if (this->is_fixed_[u])
      {
        this->group_.fixed.push_back(u);
      }
    }
  }

  const std::string& handle_name(Index handle) const { return this->problem_.handles[handle].name; }

  /// Return the handle with the largest weight at a fixed vertex. This handle is on the vertex, or
  /// the weights of the vertex were copied from the handle (see VertexRole::without_handle).
  Index owner(Index vertex) const
  {
    Index best = 0;
    this->problem_.fixed_values.row(this->fixed_row_[vertex]).maxCoeff(&best);
    return best;
  }

  Status make_column(Index c)
  {
    BoxQpColumn& column = this->group_.columns[c];
    const std::vector<Index>& handles = this->group_.handles[c];
    const Index count = this->group_.count;
    column.fixed_values.resize(static_cast<Index>(this->group_.fixed.size()));
    const bool bounded = this->terms_.has_bounds();
    if (bounded)
    {
      column.bounds.lower = Eigen::VectorXd::Constant(count, -1e300);
      column.bounds.upper = Eigen::VectorXd::Constant(count, 1e300);
    }
    std::vector<double>& given = this->given_values_.emplace_back(count, std::nan(""));
    Index fixed_count = 0;
    for (Index u = 0; u < count; ++u)
    {
      Index from = -1; // the last member so far that has a given value, or -1
      for (const Index member : this->members_[u])
      {
        const Index v = member % this->n_;
        const Index handle = handles[member / this->n_];
        const Index row = this->fixed_row_[v];
        double value = row >= 0 ? this->problem_.fixed_values(row, handle) : std::nan("");
        const double pin = this->terms_.pinned.size() > 0 && this->component_of_unknown_[u] >= 0 &&
            !(this->inserted(v) && row >= 0)
          ? this->terms_.pinned(v, handle)
          : std::nan("");
        if (!std::isnan(pin))
        {
          if (row >= 0 && std::abs(pin - value) > same_value)
          {
            return Status::invalid_input("the weight of '" + this->handle_name(handle) +
              "' is pinned to " + text(pin) + " at vertex " + std::to_string(v) +
              ", but the handle '" + this->handle_name(this->owner(v)) + "' sets it to " +
              text(value) + " there");
          }
          value = row >= 0 ? value : pin;
        }
        if (bounded && this->component_of_unknown_[u] >= 0)
        {
          const Status status = this->intersect_bounds(v, handle, value, u, column.bounds);
          if (!status.ok())
          {
            return status;
          }
        }
        if (std::isnan(value))
        {
          continue;
        }
        if (from >= 0 && std::abs(given[u] - value) > same_value)
        {
          return this->contradiction(from, member, handles, given[u], value);
        }
        given[u] = value;
        from = member;
      }
      // An excluded weight is 0 unless a handle or a term gives it another value.
      for (const Index member : this->members_[u])
      {
        const Index at =
          (member % this->n_) * this->problem_.handle_count() + handles[member / this->n_];
        if (!this->excluded_.empty() && this->excluded_[at] && std::isnan(given[u]))
        {
          given[u] = 0.0;
        }
      }
      if (this->is_fixed_[u])
      {
        column.fixed_values[fixed_count++] = given[u];
      }
      else if (bounded && this->component_of_unknown_[u] >= 0 && std::isnan(given[u]) &&
        column.bounds.lower[u] == column.bounds.upper[u])
      {
        given[u] = column.bounds.lower[u];
      }
      if (bounded && (this->component_of_unknown_[u] < 0 || !std::isnan(given[u])))
      {
        // The bounds of unknown u are unused, because its value is given or it is in no component.
        // Make the bounds finite and consistent with a given value.
        column.bounds.lower[u] = std::isnan(given[u]) ? 0.0 : std::min(0.0, given[u]);
        column.bounds.upper[u] = std::isnan(given[u]) ? 1.0 : std::max(1.0, given[u]);
      }
    }
    this->find_constants(column);
    return {};
  }

  bool inserted(Index v) const
  {
    return v >= this->n_ - static_cast<Index>(this->problem_.mesh.inserted.size());
  }

  static std::string text(double value)
  {
    char buffer[32];
    std::snprintf(buffer, sizeof(buffer), "%.6g", value);
    return buffer;
  }

  Status intersect_bounds(Index v, Index handle, double value, Index u, Bounds& bounds) const
  {
    const bool on_inserted_handle = this->inserted(v) && this->fixed_row_[v] >= 0;
    const auto [low, high] =
      on_inserted_handle ? this->terms_.bounds_of(handle) : this->terms_.bounds_of(handle, v);
    const std::string weight_name =
      "'" + this->handle_name(handle) + "' at vertex " + std::to_string(v);
    if (low > high)
    {
      return Status::invalid_input("the lower bound of the weight of " + weight_name + " is " +
        text(low) + ", above the upper bound " + text(high));
    }
    if (!std::isnan(value) && (value < low - same_value || value > high + same_value))
    {
      return Status::invalid_input("the weight of " + weight_name + " is " +
        (this->fixed_row_[v] >= 0 ? "set by the handle '" + this->handle_name(this->owner(v)) + "'"
                                  : std::string("pinned")) +
        " to " + text(value) + ", outside its bounds " + text(low) + " and " + text(high));
    }
    bounds.lower[u] = std::max(bounds.lower[u], low);
    bounds.upper[u] = std::min(bounds.upper[u], high);
    if (bounds.lower[u] > bounds.upper[u])
    {
      return Status::invalid_input("the bounds of " + weight_name +
        " contradict the bounds of vertices that must have the same weight: at least " +
        text(bounds.lower[u]) + " and at most " + text(bounds.upper[u]));
    }
    return {};
  }

  Status contradiction(
    Index a, Index b, const std::vector<Index>& handles, double first, double second) const
  {
    const Index v = a % this->n_;
    const Index w = b % this->n_;
    const bool on_handles = this->fixed_row_[v] >= 0 && this->fixed_row_[w] >= 0;
    const Index set = this->terms_.rigid_sets.empty() ? 0 : this->terms_.rigid_sets[v];
    if (on_handles && set > 0 && set == this->terms_.rigid_sets[w])
    {
      return Status::invalid_input("the rigid set " + std::to_string(set) +
        " contains vertices of the handles '" + this->handle_name(this->owner(v)) + "' and '" +
        this->handle_name(this->owner(w)) + "', whose weights differ");
    }
    return Status::invalid_input("the weight of '" + this->handle_name(handles[a / this->n_]) +
      "' is " + text(first) + " at vertex " + std::to_string(v) + ", that of '" +
      this->handle_name(handles[b / this->n_]) + "' is " + text(second) + " at vertex " +
      std::to_string(w) + ", but a rigid set or the mirror requires equal weights");
  }

  /// Find the components in which the column is constant: all given values are equal, and this
  /// value is within all bounds of the component. Store this value for each such component.
  void find_constants(const BoxQpColumn& column)
  {
    const std::vector<double>& given = this->given_values_.back();
    std::vector<double>& constant =
      this->constant_.emplace_back(this->part_count_, std::numeric_limits<double>::infinity());
    for (Index u = 0; u < this->group_.count; ++u)
    {
      const Index part = this->component_of_unknown_[u];
      if (part >= 0 && !std::isnan(given[u]))
      {
        constant[part] = std::isinf(constant[part]) || constant[part] == given[u]
          ? given[u]
          : std::nan(""); // given values differ, so the column is not constant in this component
      }
    }
    for (Index u = 0; u < this->group_.count; ++u)
    {
      const Index part = this->component_of_unknown_[u];
      if (part >= 0 && std::isnan(given[u]) &&
        !(constant[part] >= column.bounds.low(u) && constant[part] <= column.bounds.high(u)))
      {
        constant[part] = std::nan("");
      }
    }
  }

  void keep_common_constants()
  {
    for (Index part = 0; part < this->part_count_; ++part)
    {
      const bool common = std::none_of(this->constant_.begin(), this->constant_.end(),
        [&](const std::vector<double>& constant) { return std::isnan(constant[part]); });
      for (std::vector<double>& constant : this->constant_)
      {
        constant[part] = common ? constant[part] : std::nan("");
      }
    }
  }

  void collect_pins()
  {
    for (std::size_t c = 0; c < this->group_.columns.size(); ++c)
    {
      BoxQpColumn& column = this->group_.columns[c];
      std::vector<double> values;
      for (Index u = 0; u < this->group_.count; ++u)
      {
        if (this->is_fixed_[u] || this->component_of_unknown_[u] < 0)
        {
          continue;
        }
        const double given = this->given_values_[c][u];
        const double constant = this->constant_[c][this->component_of_unknown_[u]];
        if (!std::isnan(given) || !std::isnan(constant))
        {
          column.pinned.push_back(u);
          values.push_back(std::isnan(given) ? constant : given);
          this->group_.has_pins[c] = this->group_.has_pins[c] || std::isnan(constant);
        }
      }
      column.pinned_values =
        Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));
    }
  }

  const WeightsProblem& problem_;
  const WeightTerms& terms_;
  const Exclusions& excluded_;
  const bool coupled_;
  ColumnGroup& group_;
  const Index n_;
  std::vector<std::vector<Index>> members_; // members of every unknown, each as copy * #V + vertex
  std::vector<Index> component_of_unknown_; // component of every unknown; -1: in no component
  Index part_count_ = 0;
  // Row of each vertex in problem.fixed_values; -1: the vertex is not fixed.
  std::vector<Index> fixed_row_;
  std::vector<char> is_fixed_; // 1 for fixed unknowns
  // The following lists have one entry per column.
  std::vector<std::vector<double>> given_values_; // given values of the unknowns; NaN: solved for
  std::vector<std::vector<double>> constant_; // constant of every component; NaN: not constant
};
} // namespace

Status make_column_groups(const WeightsProblem& problem, const Exclusions& excluded, bool coupled,
  std::vector<ColumnGroup>& groups)
{
  const Index m = problem.handle_count();
  const std::vector<Index> partner =
    mirrored_handles(problem.terms, problem.constraints, problem.handle_count());
  ColumnGroup unmirrored, self_mirrored, pairs;
  pairs.copies = 2;
  for (Index j = 0; j < m; ++j)
  {
    if (partner[j] < 0)
    {
      unmirrored.handles.push_back({ j });
    }
    else if (partner[j] == j)
    {
      self_mirrored.handles.push_back({ j });
    }
    else if (partner[j] > j)
    {
      pairs.handles.push_back({ j, partner[j] });
    }
  }
  groups.clear();
  for (ColumnGroup* group : { &unmirrored, &self_mirrored, &pairs })
  {
    if (!group->handles.empty())
    {
      groups.push_back(std::move(*group));
      const bool mirrored = group != &unmirrored;
      const Status status =
        GroupMaker(problem, problem.terms, excluded, coupled, groups.back()).make(mirrored);
      if (!status.ok())
      {
        return status;
      }
    }
  }
  return {};
}

std::vector<BoxQpColumn> columns_without_terms(const WeightsProblem& problem)
{
  ColumnGroup group;
  for (Index j = 0; j < problem.handle_count(); ++j)
  {
    group.handles.push_back({ j });
  }
  const WeightTerms no_terms;
  const Exclusions no_exclusions;
  // If there are no optional terms, make() cannot fail.
  GroupMaker(problem, no_terms, no_exclusions, false, group).make(false);
  return std::move(group.columns);
}

SparseMatrix merge_form(const ColumnGroup& group, const SparseMatrix& form)
{
  if (group.unknowns.empty())
  {
    return form;
  }
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(static_cast<std::size_t>(group.copies * form.nonZeros()));
  for (Index k = 0; k < group.copies; ++k)
  {
    for (Index v = 0; v < form.cols(); ++v)
    {
      for (SparseMatrix::InnerIterator entry(form, static_cast<int>(v)); entry; ++entry)
      {
        entries.emplace_back(static_cast<int>(group.unknown(entry.row(), k, form.cols())),
          static_cast<int>(group.unknown(v, k, form.cols())), entry.value());
      }
    }
  }
  SparseMatrix merged(static_cast<int>(group.count), static_cast<int>(group.count));
  merged.setFromTriplets(entries.begin(), entries.end());
  return merged;
}

VertexGraph merge_graph(
  const ColumnGroup& group, const VertexGraph& graph, const std::vector<VertexRole>& roles)
{
  const auto n = static_cast<Index>(roles.size());
  std::vector<std::vector<Index>> neighbors(static_cast<std::size_t>(group.count));
  for (Index k = 0; k < group.copies; ++k)
  {
    for (Index v = 0; v < n; ++v)
    {
      const Index u = group.unknown(v, k, n);
      for (Index i = graph.begin[v]; i < graph.begin[v + 1]; ++i)
      {
        const Index other = graph.neighbors[i];
        const Index neighbor_unknown = group.unknown(other, k, n);
        if (neighbor_unknown != u && roles[v] != VertexRole::follower &&
          roles[other] != VertexRole::follower)
        {
          neighbors[u].push_back(neighbor_unknown);
        }
      }
    }
  }
  VertexGraph merged;
  for (std::vector<Index>& list : neighbors)
  {
    merged.begin.push_back(static_cast<Index>(merged.neighbors.size()));
    sort_unique(list);
    merged.neighbors.insert(merged.neighbors.end(), list.begin(), list.end());
  }
  merged.begin.push_back(static_cast<Index>(merged.neighbors.size()));
  return merged;
}

} // namespace bindpose

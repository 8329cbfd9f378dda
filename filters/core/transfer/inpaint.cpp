// Transfer weights by matching and inpainting (see inpaint.h).
#include "transfer/inpaint.h"

#include "qp/box_qp.h"
#include "transfer/solved_mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <queue>
#include <utility>

namespace bindpose
{

namespace
{
/// Set all but the `most` largest positive entries of a row to 0, and scale the others to the same
/// sum. If entries are equal, those with lower indices are kept. Negative entries do not count as
/// weights; they are set to 0 if the row has too many positive ones.
/// @return whether the row changed
bool keep_largest(Index most, Eigen::Ref<Eigen::RowVectorXd> row)
{
  if ((row.array() > 0.0).count() <= most)
  {
    return false;
  }
  const double sum = row.sum();
  std::vector<Index> order;
  for (Index j = 0; j < row.size(); ++j)
  {
    if (row[j] > 0.0)
    {
      order.push_back(j);
    }
  }
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(most);
  std::nth_element(order.begin(), end, order.end(),
    [&](Index a, Index b) { return row[a] != row[b] ? row[a] > row[b] : a < b; });
  Eigen::RowVectorXd kept = Eigen::RowVectorXd::Zero(row.size());
  for (auto it = order.begin(); it != end; ++it)
  {
    kept[*it] = row[*it];
  }
  row = sum > 0.0 ? Eigen::RowVectorXd(kept * (sum / kept.sum())) : kept;
  return true;
}

/// Properties of the source's rows that the rows of the target keep.
struct SourceRows
{
  bool sum_to_one = true; ///< whether all rows that are not zero sum to one, within 1 %
  Index maximum_influences = 1; ///< the largest number of weights above 0 in a row, at least 1
};

Status find_source_rows(const Triangles& triangles, WeightsView values, SourceRows& rows)
{
  std::vector<char> used(static_cast<std::size_t>(values.rows()), 0);
  for (Index i = 0; i < triangles.size(); ++i)
  {
    used[triangles.data()[i]] = 1;
  }
  for (Index v = 0; v < values.rows(); ++v)
  {
    if (!used[v])
    {
      continue;
    }
    if (!values.row(v).allFinite())
    {
      return Status::invalid_input(
        "the weights of source vertex " + std::to_string(v) + " are not finite");
    }
    constexpr double sum_tolerance = 0.01;
    rows.sum_to_one = rows.sum_to_one &&
      (values.row(v).isZero(0.0) || std::abs(values.row(v).sum() - 1.0) <= sum_tolerance);
    rows.maximum_influences =
      std::max<Index>(rows.maximum_influences, (values.row(v).array() > 0.0).count());
  }
  return {};
}

/// Return the biharmonic energy of the mesh.
/// @param uniform if true, all edges have the same weight and all vertices the same mass
SparseMatrix biharmonic_energy(const SolvedMesh& mesh, bool uniform)
{
  if (!uniform)
  {
    return harmonic_energy(mesh.scaled.stiffness, mesh.scaled.mass, 2);
  }
  const VertexGraph graph = vertex_graph(mesh.domain);
  const Index n = mesh.domain.points.rows();
  std::vector<Eigen::Triplet<double>> entries;
  for (Index v = 0; v < n; ++v)
  {
    const double degree = static_cast<double>(graph.begin[v + 1] - graph.begin[v]);
    entries.emplace_back(static_cast<int>(v), static_cast<int>(v), degree);
    for (Index k = graph.begin[v]; k < graph.begin[v + 1]; ++k)
    {
      entries.emplace_back(static_cast<int>(v), static_cast<int>(graph.neighbors[k]), -1.0);
    }
  }
  SparseMatrix laplacian(n, n);
  laplacian.setFromTriplets(entries.begin(), entries.end());
  return harmonic_energy(laplacian, Eigen::VectorXd::Ones(n), 2);
}

/// Computes the rows of all vertices. The rows of matched vertices and of parts without a match are
/// given; all others are solved for.
class Inpainter
{
public:
  /// @param nearest #V x #columns: the rows at the nearest points of the source
  Inpainter(ExecutionContext& context, const SolvedMesh& mesh, const SourceRows& source,
    const InpaintOptions& options, Weights nearest)
    : context_(context), mesh_(mesh), source_(source), options_(options), rows_(std::move(nearest)),
      most_(
        options.maximum_influences > 0 ? options.maximum_influences : source.maximum_influences),
      certificates_(static_cast<std::size_t>(rows_.cols()))
  {
    this->find_given();
  }

  const Weights& rows() const { return this->rows_; }
  const std::vector<Certificate>& certificates() const { return this->certificates_; }
  /// Report whether the row of the vertex is solved for.
  bool is_free(Index vertex) const { return this->free_[vertex] != 0; }
  Index part_count_without_match() const { return this->part_count_without_match_; }
  Index maximum_influences() const { return this->most_; }
  double row_sum_error() const { return this->row_sum_error_; }
  Index iterations() const { return this->iterations_; }
  bool uses_uniform_energy() const { return this->uniform_; }

  Status solve()
  {
    if (this->free_count_ == 0)
    {
      return {};
    }
    Status status = this->solve_columns(0.0, 0.5);
    if (!status.usable())
    {
      return status;
    }
    this->row_sum_error_ = this->largest_sum_error();
    this->finish_rows(this->rows_before_solve_);
    // The first solution only selects the weights that are kept; the certificates are those of the
    // second.
    const Weights selected = this->rows_;
    if (this->exclude_smallest())
    {
      status = this->solve_columns(0.5, 1.0);
      if (!status.usable())
      {
        return status;
      }
      this->finish_rows(selected);
    }
    return status;
  }

  /// Average the rows near inpainted vertices with those of their neighbors.
  /// @param distance largest distance from an inpainted vertex, along edges
  void smooth(double distance)
  {
    const VertexGraph graph = vertex_graph(this->mesh_.domain);
    std::vector<Index> near = this->find_near(graph, distance);
    near.erase(std::remove_if(near.begin(), near.end(),
                 [&](Index v) { return graph.begin[v] == graph.begin[v + 1]; }),
      near.end());
    constexpr double step = 0.2;
    Weights smoothed(static_cast<Index>(near.size()), this->rows_.cols());
    for (int i = 0; i < this->options_.smoothing_steps && !this->context_.canceled(); ++i)
    {
      for (std::size_t k = 0; k < near.size(); ++k)
      {
        const Index v = near[k];
        Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(this->rows_.cols());
        for (Index at = graph.begin[v]; at < graph.begin[v + 1]; ++at)
        {
          mean += this->rows_.row(graph.neighbors[at]);
        }
        mean /= static_cast<double>(graph.begin[v + 1] - graph.begin[v]);
        smoothed.row(static_cast<Index>(k)) = (1.0 - step) * this->rows_.row(v) + step * mean;
      }
      for (std::size_t k = 0; k < near.size(); ++k)
      {
        this->rows_.row(near[k]) = smoothed.row(static_cast<Index>(k));
      }
    }
    for (const Index v : near)
    {
      keep_largest(this->most_, this->rows_.row(v));
    }
  }

private:
  void find_given()
  {
    const std::vector<Index>& part_of_vertex = this->mesh_.parts.component_of_vertex;
    std::vector<char> has_match(static_cast<std::size_t>(this->mesh_.parts.count), 0);
    for (std::size_t v = 0; v < part_of_vertex.size(); ++v)
    {
      if (this->mesh_.matched[v] && part_of_vertex[v] >= 0)
      {
        has_match[part_of_vertex[v]] = 1;
      }
    }
    this->part_count_without_match_ =
      static_cast<Index>(std::count(has_match.begin(), has_match.end(), 0));
    this->free_.assign(part_of_vertex.size(), 0);
    for (std::size_t v = 0; v < part_of_vertex.size(); ++v)
    {
      const Index part = part_of_vertex[v];
      this->free_[v] = !this->mesh_.matched[v] && part >= 0 && has_match[part];
      this->free_count_ += this->free_[v];
      if (!this->free_[v])
      {
        keep_largest(this->most_, this->rows_.row(static_cast<Index>(v)));
        this->given_.push_back(static_cast<Index>(v));
      }
    }
    this->rows_before_solve_ = this->rows_;
  }

  /// Make the quadratic program of a column. The bounds of a part are its smallest and its largest
  /// given value. If they are equal, within the tolerance, its free vertices are pinned to this
  /// value.
  BoxQpColumn make_column(Index column) const
  {
    const auto n = static_cast<Index>(this->free_.size());
    const std::vector<Index>& part_of_vertex = this->mesh_.parts.component_of_vertex;
    std::vector<double> lowest(
      static_cast<std::size_t>(this->mesh_.parts.count), std::numeric_limits<double>::infinity());
    std::vector<double> highest(
      static_cast<std::size_t>(this->mesh_.parts.count), -std::numeric_limits<double>::infinity());
    BoxQpColumn result;
    result.fixed_values.resize(static_cast<Index>(this->given_.size()));
    for (std::size_t i = 0; i < this->given_.size(); ++i)
    {
      const Index v = this->given_[i];
      const double value = this->rows_(v, column);
      result.fixed_values[static_cast<Index>(i)] = value;
      if (const Index part = part_of_vertex[v]; part >= 0)
      {
        lowest[part] = std::min(lowest[part], value);
        highest[part] = std::max(highest[part], value);
      }
    }
    std::vector<double> pinned_values;
    result.bounds.lower = Eigen::VectorXd::Zero(n);
    result.bounds.upper = Eigen::VectorXd::Ones(n);
    for (Index v = 0; v < n; ++v)
    {
      if (!this->free_[v])
      {
        continue;
      }
      const Index part = part_of_vertex[v];
      const bool excluded =
        !this->excluded_.empty() && this->excluded_[v * this->rows_.cols() + column];
      // Interpolated values of a constant differ by round-off.
      if (excluded || highest[part] - lowest[part] <= this->options_.tolerance)
      {
        result.pinned.push_back(v);
        pinned_values.push_back(excluded ? 0.0 : 0.5 * (lowest[part] + highest[part]));
        continue;
      }
      result.bounds.lower[v] = lowest[part];
      result.bounds.upper[v] = highest[part];
    }
    result.pinned_values =
      Eigen::Map<Eigen::VectorXd>(pinned_values.data(), static_cast<Index>(pinned_values.size()));
    return result;
  }

  /// Solve all columns, with the cotangent energy if it can be factored.
  Status solve_columns(double begin, double end)
  {
    const ProgressRange range(this->context_, begin, end);
    Status status = this->solve_with_energy();
    const bool cannot_be_factored =
      status.code == StatusCode::invalid_input || status.code == StatusCode::internal_error;
    if (cannot_be_factored && !this->uniform_)
    {
      this->uniform_ = true;
      this->solver_.reset();
      status = this->solve_with_energy();
    }
    return status;
  }

  /// Solve the columns that are not constant, in groups, which limits the memory.
  Status solve_with_energy()
  {
    constexpr Index group_size = 64;
    this->certificates_.assign(this->certificates_.size(), {});
    this->unconverged_.clear();
    for (Index begin = 0; begin < this->rows_.cols(); begin += group_size)
    {
      const Index end = std::min(begin + group_size, this->rows_.cols());
      const double count = static_cast<double>(this->rows_.cols());
      const ProgressRange range(
        this->context_, static_cast<double>(begin) / count, static_cast<double>(end) / count);
      const Status status = this->solve_group(begin, end);
      if (!status.usable())
      {
        return status;
      }
    }
    Status status;
    if (!this->unconverged_.empty())
    {
      double gap = 0.0;
      double residual = 0.0;
      for (const Index column : this->unconverged_)
      {
        gap = std::max(gap, this->certificates_[column].relative_gap);
        residual = std::max(residual, this->certificates_[column].kkt_residual);
      }
      status.code = StatusCode::not_converged;
      status.message = "the inpainted weights of " + std::to_string(this->unconverged_.size()) +
        " of " + std::to_string(this->rows_.cols()) + " handles " +
        certificate_message(gap, residual, this->options_.tolerance);
    }
    return status;
  }

  Status solve_group(Index begin, Index end)
  {
    std::vector<BoxQpColumn> columns;
    std::vector<Index> ids; // of the columns
    for (Index j = begin; j < end; ++j)
    {
      BoxQpColumn column = this->make_column(j);
      for (std::size_t i = 0; i < column.pinned.size(); ++i)
      {
        this->rows_(column.pinned[i], j) = column.pinned_values[static_cast<Index>(i)];
      }
      if (static_cast<Index>(column.pinned.size()) < this->free_count_)
      {
        columns.push_back(std::move(column));
        ids.push_back(j);
      }
    }
    if (columns.empty())
    {
      return {};
    }
    constexpr double prepared = 0.1; // part of the time
    if (!this->solver_)
    {
      const ProgressRange range(this->context_, 0.0, prepared);
      this->solver_ =
        std::make_unique<BoxQp>(biharmonic_energy(this->mesh_, this->uniform_), this->given_,
          BoxQpOptions{
            this->options_.tolerance, this->options_.maximum_iterations, this->options_.solver });
      const Status status = this->solver_->prepare(this->context_, columns);
      if (!status.ok())
      {
        this->solver_.reset();
        return status;
      }
    }
    const ProgressRange range(this->context_, prepared, 1.0);
    const std::vector<BoxQpSolution> solutions = this->solver_->solve_all(this->context_, columns);
    const Status status = first_failure(solutions);
    if (!status.usable())
    {
      return status;
    }
    for (std::size_t c = 0; c < solutions.size(); ++c)
    {
      this->use_solution(ids[c], solutions[c]);
    }
    return {};
  }

  void use_solution(Index column, const BoxQpSolution& solution)
  {
    for (std::size_t v = 0; v < this->free_.size(); ++v)
    {
      if (this->free_[v])
      {
        this->rows_(static_cast<Index>(v), column) = solution.w[static_cast<Index>(v)];
      }
    }
    this->certificates_[column] = solution.certificate;
    this->iterations_ += solution.iterations;
    const Certificate& certificate = solution.certificate;
    const bool converged = solution.status.ok() &&
      certificate.relative_gap <= this->options_.tolerance &&
      certificate.kkt_residual <= this->options_.tolerance;
    if (!converged)
    {
      this->unconverged_.push_back(column);
    }
  }

  /// Return the largest difference between one and the sum of a solved row.
  double largest_sum_error() const
  {
    double error = 0.0;
    for (std::size_t v = 0; v < this->free_.size() && this->source_.sum_to_one; ++v)
    {
      if (this->free_[v])
      {
        error = std::max(error, std::abs(1.0 - this->rows_.row(static_cast<Index>(v)).sum()));
      }
    }
    return error;
  }

  /// Divide solved rows by their sums, if the rows of the source sum to one.
  /// @param fallback rows that replace solved rows with a sum near 0
  void finish_rows(const Weights& fallback)
  {
    for (std::size_t v = 0; v < this->free_.size() && this->source_.sum_to_one; ++v)
    {
      if (!this->free_[v])
      {
        continue;
      }
      auto row = this->rows_.row(static_cast<Index>(v));
      const double sum = row.sum();
      constexpr double least_sum = 1e-3;
      if (sum >= least_sum)
      {
        row /= sum;
      }
      else
      {
        row = fallback.row(static_cast<Index>(v));
        keep_largest(this->most_, row);
      }
    }
  }

  /// If solved rows have too many weights above 0, exclude the smallest ones. Also exclude the
  /// weights of 0 in all solved rows, because the next solution could have other weights above 0.
  /// @return whether a row has too many weights
  bool exclude_smallest()
  {
    const Index m = this->rows_.cols();
    this->excluded_.assign(static_cast<std::size_t>(this->rows_.size()), 0);
    bool any = false;
    for (std::size_t v = 0; v < this->free_.size(); ++v)
    {
      if (!this->free_[v])
      {
        continue;
      }
      Eigen::RowVectorXd kept = this->rows_.row(static_cast<Index>(v));
      any = keep_largest(this->most_, kept) || any;
      for (Index j = 0; j < m; ++j)
      {
        this->excluded_[v * m + j] = kept[j] == 0.0;
      }
    }
    return any;
  }

  /// Return the vertices within the distance of an inpainted vertex, along edges.
  std::vector<Index> find_near(const VertexGraph& graph, double distance) const
  {
    const Points& points = this->mesh_.domain.points;
    std::vector<double> distances(this->free_.size(), std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (std::size_t v = 0; v < this->free_.size(); ++v)
    {
      if (this->free_[v])
      {
        distances[v] = 0.0;
        queue.emplace(0.0, static_cast<Index>(v));
      }
    }
    while (!queue.empty())
    {
      const auto [length, v] = queue.top();
      queue.pop();
      for (Index k = graph.begin[v]; k < graph.begin[v + 1] && length <= distances[v]; ++k)
      {
        const Index other = graph.neighbors[k];
        const double next = length + (points.row(v) - points.row(other)).norm();
        if (next <= distance && next < distances[other])
        {
          distances[other] = next;
          queue.emplace(next, other);
        }
      }
    }
    std::vector<Index> near;
    for (std::size_t v = 0; v < distances.size(); ++v)
    {
      if (distances[v] <= distance)
      {
        near.push_back(static_cast<Index>(v));
      }
    }
    return near;
  }

  ExecutionContext& context_;
  const SolvedMesh& mesh_;
  const SourceRows& source_;
  const InpaintOptions& options_;
  Weights rows_; // #V x #columns
  Weights rows_before_solve_; // the given rows, and those of the nearest points
  const Index most_; // largest number of weights above 0 in a row
  std::vector<Certificate> certificates_; // one per column
  std::vector<Index> unconverged_; // columns
  std::vector<char> free_; // #V: 1 if the row is solved for
  Index free_count_ = 0;
  std::vector<Index> given_; // the other vertices
  std::vector<char> excluded_; // #V * #columns: 1 if the weight must be 0; empty: no such weight
  std::unique_ptr<BoxQp> solver_;
  Index part_count_without_match_ = 0;
  double row_sum_error_ = 0.0; // of the first solution
  Index iterations_ = 0;
  bool uniform_ = false; // whether the energy of uniform edge weights is used
};

Status check_inputs(
  const Domain& source, WeightsView values, const Domain& target, const InpaintOptions& options)
{
  if (source.element_count() == 0)
  {
    return Status::invalid_input("the source mesh has neither tets nor triangles");
  }
  if (target.element_count() == 0)
  {
    return Status::invalid_input(
      "the target mesh has neither tets nor triangles; use the method nearest for points");
  }
  if (values.rows() != source.points.rows() || values.cols() == 0)
  {
    return Status::invalid_input("the weights must have one row for each of the " +
      std::to_string(source.points.rows()) + " source vertices and at least one column, not " +
      std::to_string(values.rows()) + " x " + std::to_string(values.cols()));
  }
  if (options.maximum_influences < 0 || options.smoothing_steps < 0)
  {
    return Status::invalid_input(
      "the number of influences and the number of smoothing steps must be 0 or more (got " +
      std::to_string(options.maximum_influences) + " and " +
      std::to_string(options.smoothing_steps) + ")");
  }
  if (!(options.smallest_group >= 0.0 && options.smallest_group <= 1.0))
  {
    return Status::invalid_input(
      "the size of the smallest group must be a fraction from 0 to 1 (got " +
      std::to_string(options.smallest_group) + ")");
  }
  if (!(options.tolerance > 0.0 && options.tolerance < 1.0) || options.maximum_iterations < 1)
  {
    return Status::invalid_input(
      "the tolerance must be between 0 and 1, and the number of iterations at least 1");
  }
  return {};
}

/// Return the result's rows at the points of the target.
Weights rows_at_points(
  const SolvedMesh& mesh, const Inpainter& inpainter, const SurfaceMatch& match, WeightsView values)
{
  const auto n = static_cast<Index>(mesh.vertex_of_point.size());
  Weights result(n, values.cols());
  for (Index i = 0; i < n; ++i)
  {
    const Index v = mesh.vertex_of_point[i];
    if (v >= 0)
    {
      result.row(i) = inpainter.rows().row(v);
      continue;
    }
    result.row(i) = match.row(values, i);
    keep_largest(inpainter.maximum_influences(), result.row(i));
  }
  return result;
}

void report_result(const SolvedMesh& mesh, const Inpainter& inpainter,
  const InpaintedWeights& result, Status& status)
{
  Index matched = 0;
  Index inpainted = 0;
  const auto n = static_cast<Index>(mesh.vertex_of_point.size());
  for (Index i = 0; i < n; ++i)
  {
    const Index v = mesh.vertex_of_point[i];
    matched += result.matched[i] != 0;
    inpainted += v >= 0 && inpainter.is_free(v);
  }
  double gap = 0.0;
  double residual = 0.0;
  for (const Certificate& certificate : inpainter.certificates())
  {
    gap = std::max(gap, certificate.relative_gap);
    residual = std::max(residual, certificate.kkt_residual);
  }
  Report& report = status.report;
  report.set("transfer", "inpaint");
  report.set("counts.matched", matched);
  report.set("counts.inpainted", inpainted);
  report.set("counts.nearest", n - matched - inpainted);
  report.set("counts.small_groups", mesh.small_group_count);
  report.set("counts.unmatched_parts", inpainter.part_count_without_match());
  report.set("matched_fraction", static_cast<double>(matched) / static_cast<double>(n));
  report.set("relative_gap", gap);
  report.set("kkt_residual", residual);
  report.set("row_sum_error", inpainter.row_sum_error());
  report.set("iterations", inpainter.iterations());
  report.set("maximum_influences", inpainter.maximum_influences());
  if (inpainter.part_count_without_match() > 0)
  {
    status.warnings.push_back(std::to_string(inpainter.part_count_without_match()) + " of " +
      std::to_string(mesh.parts.count) +
      " connected parts of the target have no matched point; their points get the weights of the "
      "nearest points of the source");
  }
  if (inpainter.uses_uniform_energy())
  {
    status.warnings.emplace_back("the triangles of the target are too thin for cotangent weights, "
                                 "so uniform edge weights were used");
  }
}
} // namespace

Status inpaint_weights(ExecutionContext& context, const Domain& source, WeightsView values,
  const Domain& target, const InpaintOptions& options, InpaintedWeights& result)
{
  result = {};
  Status status = check_inputs(source, values, target, options);
  SurfaceMatch match;
  if (status.ok())
  {
    const Phase phase(context, "match", 0.0, 0.2);
    status = match_surface(context, source, target, options.match, match);
  }
  SourceRows source_rows;
  status = status.ok() ? find_source_rows(match.triangles, values, source_rows) : status;
  for (std::size_t i = 0; status.ok() && i < match.matched.size(); ++i)
  {
    // There is nothing to copy where the source has no weights.
    match.matched[i] = match.matched[i] && !match.row(values, static_cast<Index>(i)).isZero(0.0);
  }
  SolvedMesh mesh;
  const Phase phase(context, "inpaint", 0.2, 1.0);
  status = status.ok() ? make_solved_mesh(target, match, options.smallest_group, mesh) : status;
  if (!status.ok())
  {
    return status;
  }
  Weights nearest(mesh.domain.points.rows(), values.cols());
  for (Index v = 0; v < nearest.rows(); ++v)
  {
    nearest.row(v) = match.row(values, mesh.point_of_vertex[v]);
  }
  Inpainter inpainter(context, mesh, source_rows, options, std::move(nearest));
  status = inpainter.solve();
  if (!status.usable())
  {
    return status;
  }
  if (options.smoothing_steps > 0)
  {
    inpainter.smooth(options.match.maximum_distance * match.diagonal);
  }
  if (context.canceled())
  {
    return Status::canceled();
  }
  result.weights = rows_at_points(mesh, inpainter, match, values);
  result.certificates = inpainter.certificates();
  result.matched.resize(mesh.vertex_of_point.size());
  for (std::size_t i = 0; i < result.matched.size(); ++i)
  {
    const Index v = mesh.vertex_of_point[i];
    result.matched[i] = v >= 0 ? mesh.matched[v] : match.matched[i];
  }
  report_result(mesh, inpainter, result, status);
  return status;
}

} // namespace bindpose

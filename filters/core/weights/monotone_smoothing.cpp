// Topological simplification as a quadratic program with ordered pairs (see monotone_smoothing.h).
// The linear part of the data term is stored as a row of the quadratic form: Q gets an additional
// unknown whose value is 1, so that 1/2 (w, 1)' Q (w, 1) is the whole energy: smoothness plus
// distance to the data. Solver and certificate are therefore the same as for weights. There are no
// bounds. The minimum is unique because of the data term or the kept values.
//
// The ordered pairs that exclude unlisted extrema are computed from an order of the vertices. This
// order has exactly the listed extrema (extrema_order.cpp) and is as close as possible to the order
// of the minimizer without pairs. If that minimizer already has the listed extrema, it is the
// result. If the data weight is large, the order is close to the order of the data. With
// SmoothingGuide::harmonic, the order is determined by a harmonic function instead. Its boundary
// values are given at the listed extrema; the data at all other vertices have no effect.
//
// The vertices can be sorted again, by the values of a result. Vertices with equal values keep
// their earlier order. The result also satisfies the ordered pairs of this new order. Solving again
// with the new pairs can therefore only lower the energy.
#include "weights/monotone_smoothing.h"

#include "domain/scaled_mesh.h"
#include "qp/free_system.h"
#include "qp/ordered_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bindpose
{

namespace
{
using Eigen::VectorXd;

std::string vertex_phrase(std::size_t count, const char* suffix)
{
  return std::to_string(count) + (count == 1 ? " vertex " : " vertices ") + suffix;
}

class Smoothing
{
public:
  Smoothing(ExecutionContext& context, const Domain& domain, const VectorXd& data,
    const MonotoneSmoothingOptions& options, MonotoneSmoothingResult& result)
    : domain_(domain), data_(data), options_(options), context_(context), result_(result)
  {
  }

  Status run();

private:
  Status check() const;
  void remove_degenerate();
  bool scale_data();
  Status find_extrema();
  void choose_extrema();
  Status check_extrema();
  void scale_to_size();
  void assemble();
  double expected_energy(const BoxQpColumn& column, const BoxQpSolution& unconstrained) const;
  Status guide_values(const VectorXd& unconstrained, VectorXd& values);
  Status solve();
  void rebuild(BoxQpColumn& column, BoxQpSolution& best);
  void record_energy(const BoxQpSolution& solution);
  void finish(Status& status);

  const Domain& domain_;
  const VectorXd& data_;
  const MonotoneSmoothingOptions& options_;
  ExecutionContext& context_;
  MonotoneSmoothingResult& result_;

  Domain measurable_; // the domain without triangles of zero area
  Components components_;
  std::vector<char> used_; // #V: 1 for vertices in elements of positive measure
  std::vector<char> is_included_; // #V: 1 for used vertices in parts that are not constant
  VertexGraph graph_;
  double center_ = 0.0, range_ = 0.0; // center and range of the data
  VectorXd f_; // data scaled to the range -1/2 … 1/2; 0 at unused vertices
  ScaledMesh scaled_; // the mesh scaled to size 1
  std::vector<Index> fixed_; // fixed vertices, then the additional unknown, whose index is #V
  VectorXd fixed_values_;
  VectorXd data_diagonal_; // diagonal of the data term in the quadratic form
  bool keep_values_ = false;
  Index constant_parts_ = 0;
  std::unique_ptr<BoxQp> solver_;
  std::vector<Index> rank_;
  int floods_ = 0;
  BoxQpSolution solution_;
  std::vector<std::string> warnings_;
};

Status Smoothing::check() const
{
  const MonotoneSmoothingOptions& o = this->options_;
  const Index n = this->domain_.points.rows();
  if (o.order != 2 && o.order != 3)
  {
    return Status::invalid_input("the order of monotone smoothing must be 2 or 3");
  }
  if (!(o.tolerance > 0.0 && o.tolerance < 1.0) || o.maximum_iterations < 1)
  {
    return Status::invalid_input(
      "the tolerance must be between 0 and 1, and the number of iterations at least 1");
  }
  if (!(o.data_weight >= 0.0 && std::isfinite(o.data_weight)))
  {
    return Status::invalid_input("the data weight must be 0 or more");
  }
  if (!(o.persistence >= 0.0 && o.persistence < 1.0) || o.extrema_count < 0)
  {
    return Status::invalid_input(
      "the persistence must be at least 0 and less than 1, and the number of extrema 0 or more");
  }
  if (!(o.epsilon >= 0.0 && o.epsilon <= 1.0) || o.rebuilds < 0)
  {
    return Status::invalid_input(
      "epsilon must be between 0 and 1, and the number of rebuilds 0 or more");
  }
  Status status = check_domain(this->domain_);
  if (status.ok() && this->data_.size() != n)
  {
    return Status::invalid_input("there are " + std::to_string(this->data_.size()) +
      " data values, but " + std::to_string(n) + " vertices");
  }
  if (status.ok() && !o.extrema.empty() && static_cast<Index>(o.extrema.size()) != n)
  {
    return Status::invalid_input("the list of extrema has " + std::to_string(o.extrema.size()) +
      " entries, but there are " + std::to_string(n) + " vertices");
  }
  return status;
}

void Smoothing::remove_degenerate()
{
  this->measurable_ = this->domain_;
  this->measurable_.triangles = measurable_triangles(this->domain_);
  const Index n = this->domain_.points.rows();
  this->components_ = connected_components(this->measurable_);
  this->used_.resize(static_cast<std::size_t>(n));
  for (Index v = 0; v < n; ++v)
  {
    this->used_[v] = this->components_.component_of_vertex[v] >= 0;
  }
  const auto unused = std::count(this->used_.begin(), this->used_.end(), 0);
  if (unused > 0)
  {
    this->warnings_.push_back(
      vertex_phrase(static_cast<std::size_t>(unused), unused == 1 ? "is" : "are") +
      " not part of any element with an area or volume; their values do not change");
  }
  this->is_included_ = this->used_;
  this->graph_ = vertex_graph(this->measurable_);
}

/// Compute f_, the data scaled to a range of 1.
/// @return false if the data are constant.
bool Smoothing::scale_data()
{
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (Index v = 0; v < this->data_.size(); ++v)
  {
    if (this->used_[v])
    {
      low = std::min(low, this->data_[v]);
      high = std::max(high, this->data_[v]);
    }
  }
  this->center_ = 0.5 * low + 0.5 * high;
  this->range_ = high - low;
  this->f_ = VectorXd::Zero(this->data_.size());
  for (Index v = 0; v < this->data_.size() && this->range_ > 0.0; ++v)
  {
    this->f_[v] = this->used_[v] ? (this->data_[v] - this->center_) / this->range_ : 0.0;
  }
  return this->range_ > 0.0;
}

/// Choose the data's most persistent extrema. Listed maxima can separate a region from the rest of
/// the mesh, for example if a listed vertex is the only connection. Such a region also needs a
/// minimum, so its lowest vertex is added to the list. The same applies to regions that listed
/// minima separate.
void Smoothing::choose_extrema()
{
  ExtremaList& list = this->result_.list;
  list.assign(this->used_.size(), 0);
  const std::vector<char> none(this->used_.size(), 0);
  const Index count = this->options_.extrema_count;
  const std::vector<Extremum> found =
    interior_extrema(this->graph_, this->f_, none, count > 0 ? 0.0 : this->options_.persistence);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const bool is_global = found[i].persistence >= 1.0;
    if (this->is_included_[found[i].vertex] &&
      (is_global || count == 0 || static_cast<Index>(i) < count))
    {
      list[found[i].vertex] = found[i].maximum ? 1 : -1;
    }
  }
  for (bool changed = true; changed;)
  {
    changed = false;
    for (const int kind : { -1, 1 })
    {
      for (const auto& part : parts_without_extremum(this->graph_, this->is_included_, list, kind))
      {
        const Index most = *std::max_element(part.begin(), part.end(),
          [&](Index a, Index b) { return kind * this->f_[a] < kind * this->f_[b]; });
        list[most] = static_cast<signed char>(kind);
        changed = true;
      }
    }
  }
}

/// Check that the list has a maximum and a minimum in every part that is not constant (see
/// parts_without_extremum).
Status Smoothing::check_extrema()
{
  const ExtremaList& list = this->result_.list;
  for (const int kind : { -1, 1 })
  {
    for (const auto& part : parts_without_extremum(this->graph_, this->is_included_, list, kind))
    {
      const char* missing_kind = kind > 0 ? "maximum" : "minimum";
      const char* other = kind > 0 ? "minima" : "maxima";
      const Index c = this->components_.component_of_vertex[part.front()];
      bool lacks_extremum = true;
      for (std::size_t v = 0; v < list.size() && lacks_extremum; ++v)
      {
        lacks_extremum = this->components_.component_of_vertex[v] != c || list[v] * kind <= 0;
      }
      return Status::invalid_input(lacks_extremum
          ? "the list of extrema has no " + std::string(missing_kind) +
            " in the connected part of vertex " + std::to_string(part.front()) + ", only " + other
          : "the list of extrema has no " + std::string(missing_kind) + " among " +
            vertex_phrase(part.size(), "that the listed ") + other +
            " separate from the rest; the first such vertex is " + std::to_string(part.front()));
    }
  }
  return {};
}

Status Smoothing::find_extrema()
{
  ExtremaList& list = this->result_.list;
  const auto n = static_cast<Index>(this->used_.size());
  std::vector<double> low(static_cast<std::size_t>(this->components_.count), 1.0);
  std::vector<double> high(low.size(), -1.0);
  std::vector<char> listed(low.size(), 0);
  list = this->options_.extrema;
  for (Index v = 0; v < n; ++v)
  {
    const Index c = this->components_.component_of_vertex[v];
    if (c < 0 && !list.empty() && list[v] != 0)
    {
      return Status::invalid_input("the list of extrema contains vertex " + std::to_string(v) +
        ", which is not part of any element with an area or volume");
    }
    if (c >= 0)
    {
      low[c] = std::min(low[c], this->f_[v]);
      high[c] = std::max(high[c], this->f_[v]);
      listed[c] = listed[c] || (!list.empty() && list[v] != 0);
    }
  }
  const bool has_list = !list.empty();
  if (has_list && std::count(listed.begin(), listed.end(), 1) == 0)
  {
    return Status::invalid_input("the list of extrema is empty");
  }
  for (Index v = 0; v < n; ++v)
  {
    const Index c = this->components_.component_of_vertex[v];
    this->is_included_[v] = c >= 0 && (has_list ? listed[c] != 0 : low[c] < high[c]);
  }
  for (std::size_t c = 0; c < low.size(); ++c)
  {
    this->constant_parts_ += has_list ? !listed[c] : !(low[c] < high[c]);
  }
  if (has_list && this->constant_parts_ > 0)
  {
    this->warnings_.push_back(std::to_string(this->constant_parts_) +
      (this->constant_parts_ == 1 ? " connected part has" : " connected parts have") +
      " no extremum in the list; the result is constant there");
  }
  if (!has_list)
  {
    this->choose_extrema();
  }
  return this->check_extrema();
}

/// Scale the mesh to size 1 (see monotone_smoothing). Unlike the diagonal of the bounding box, this
/// size does not change when the mesh is rotated. The size affects the result, because it
/// determines the balance of smoothness and data.
void Smoothing::scale_to_size()
{
  this->scaled_ = scale_mesh(this->measurable_, this->used_);
  const VectorXd& mass = this->scaled_.mass;
  Vec3 centroid = Vec3::Zero();
  for (Index v = 0; v < mass.size(); ++v)
  {
    centroid += this->used_[v] ? Vec3(mass[v] * this->scaled_.points.row(v)) : Vec3::Zero();
  }
  centroid /= mass.sum();
  double sum = 0.0;
  for (Index v = 0; v < mass.size(); ++v)
  {
    const Vec3 from = Vec3(this->scaled_.points.row(v)) - centroid;
    sum += this->used_[v] ? mass[v] * from.squaredNorm() : 0.0;
  }
  const double size = std::sqrt(12.0 * sum / mass.sum());
  const int dimension = this->measurable_.is_volume() ? 3 : 2;
  this->scaled_.diagonal *= size;
  this->scaled_.stiffness *= std::pow(size, 2 - dimension);
  this->scaled_.mass_unit *= std::pow(size, -dimension);
}

/// Assemble the quadratic form, including the additional unknown, and collect the given values.
void Smoothing::assemble()
{
  const Index n = this->data_.size();
  const int k = this->options_.order;
  this->scale_to_size();
  // The quadratic form is the scaled mesh's energy times mass_unit^(k - 1), so the data term is
  // multiplied by the same factor.
  this->data_diagonal_ =
    this->options_.data_weight * std::pow(this->scaled_.mass_unit, k) * this->scaled_.mass;
  const SparseMatrix q = harmonic_energy(this->scaled_.stiffness, this->scaled_.mass, k);
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(static_cast<std::size_t>(q.nonZeros() + 3 * n + 1));
  for (int j = 0; j < q.outerSize(); ++j)
  {
    for (SparseMatrix::InnerIterator it(q, j); it; ++it)
    {
      entries.emplace_back(static_cast<int>(it.row()), j, it.value());
    }
  }
  const int constant_id = static_cast<int>(n);
  for (int v = 0; v < constant_id; ++v)
  {
    entries.emplace_back(v, v, this->data_diagonal_[v]);
    entries.emplace_back(v, constant_id, -this->data_diagonal_[v] * this->f_[v]);
    entries.emplace_back(constant_id, v, -this->data_diagonal_[v] * this->f_[v]);
  }
  entries.emplace_back(constant_id, constant_id, this->data_diagonal_.dot(this->f_.cwiseAbs2()));
  SparseMatrix form(n + 1, n + 1);
  form.setFromTriplets(entries.begin(), entries.end());

  VectorXd sums = VectorXd::Zero(this->components_.count);
  VectorXd masses = VectorXd::Zero(this->components_.count);
  for (Index v = 0; v < n; ++v)
  {
    if (this->used_[v])
    {
      sums[this->components_.component_of_vertex[v]] += this->scaled_.mass[v] * this->f_[v];
      masses[this->components_.component_of_vertex[v]] += this->scaled_.mass[v];
    }
  }
  std::vector<double> values;
  for (Index v = 0; v < n; ++v)
  {
    if (!this->is_included_[v])
    {
      const Index c = this->components_.component_of_vertex[v];
      this->fixed_.push_back(v);
      values.push_back(c < 0 ? 0.0 : sums[c] / masses[c]);
    }
    else if (this->keep_values_ && this->result_.list[v] != 0)
    {
      this->fixed_.push_back(v);
      values.push_back(this->f_[v]);
    }
  }
  this->fixed_.push_back(n);
  values.push_back(1.0);
  this->fixed_values_ = Eigen::Map<VectorXd>(values.data(), static_cast<Index>(values.size()));
  this->solver_ = std::make_unique<BoxQp>(form, this->fixed_,
    BoxQpOptions{
      this->options_.tolerance, this->options_.maximum_iterations, this->options_.solver });
}

/// Estimate the minimum energy: the energy without pairs, plus the increase of the data term that
/// results from satisfying the pairs. (If the minimizer without pairs is close to the data, the
/// energy without pairs would be a far too small estimate.)
double Smoothing::expected_energy(
  const BoxQpColumn& column, const BoxQpSolution& unconstrained) const
{
  VectorXd ordered = unconstrained.w;
  for (const OrderedPair& pair :
    sort_pairs_by_order(column.pairs, topological_order(column.pairs, ordered.size())))
  {
    ordered[pair.high] = std::max(ordered[pair.high], ordered[pair.low] + pair.minimum_difference);
  }
  const VectorXd moved = (ordered - unconstrained.w).head(this->data_diagonal_.size());
  return unconstrained.certificate.energy + 0.5 * this->data_diagonal_.dot(moved.cwiseAbs2());
}

/// Compute the values of the guide (see SmoothingGuide). The result has the same order as these
/// values, as far as the list of extrema allows.
Status Smoothing::guide_values(const VectorXd& unconstrained, VectorXd& values)
{
  values = unconstrained.head(this->data_.size());
  if (this->options_.guide == SmoothingGuide::unconstrained)
  {
    return {};
  }
  std::vector<Index> given_vertices;
  std::vector<double> given_values;
  for (std::size_t v = 0; v < this->used_.size(); ++v)
  {
    const bool maximum = this->result_.list[v] > 0;
    if (this->result_.list[v] != 0 || !this->is_included_[v])
    {
      given_vertices.push_back(static_cast<Index>(v));
      given_values.push_back(
        this->keep_values_ ? this->f_[static_cast<Index>(v)] : double(maximum));
    }
  }
  FreeSystem harmonic(
    positive_stiffness(this->scaled_.stiffness, this->graph_, this->is_included_), given_vertices);
  Status status = harmonic.factor(this->context_, this->options_.solver);
  if (status.ok())
  {
    const Eigen::MatrixXd boundary =
      Eigen::Map<VectorXd>(given_values.data(), static_cast<Index>(given_values.size()));
    values = harmonic.minimizers(boundary).col(0);
  }
  return status;
}

/// Repeat rebuilds: sort the vertices by the values of the last result, compute the ordered pairs
/// from this order, and solve again. Stop when a rebuild decreases the energy by less than 0.01 %.
void Smoothing::rebuild(BoxQpColumn& column, BoxQpSolution& best)
{
  for (int round = 0; round < this->options_.rebuilds && best.status.ok(); ++round)
  {
    const ProgressRange range(this->context_, 0.4 + 0.6 * round / this->options_.rebuilds,
      0.4 + 0.6 * (round + 1) / this->options_.rebuilds);
    std::vector<Index> rank = this->rank_;
    update_order(best.w, rank);
    std::vector<OrderedPair> pairs =
      pairs_from_order(this->graph_, this->result_.list, rank, this->options_.epsilon);
    const bool is_converged =
      std::equal(pairs.begin(), pairs.end(), column.pairs.begin(), column.pairs.end(),
        [](const OrderedPair& a, const OrderedPair& b)
        { return a.low == b.low && a.high == b.high; });
    if (is_converged)
    {
      return;
    }
    column.pairs = std::move(pairs);
    column.start = best.w;
    column.energy = best.certificate.energy;
    const BoxQpSolution next = this->solver_->solve(this->context_, column);
    this->result_.iterations += next.iterations;
    this->context_.add_seconds("factor", next.factor_seconds);
    this->context_.add_seconds("solve", next.solve_seconds);
    if (!next.status.ok() || !(next.certificate.energy <= best.certificate.energy))
    {
      return;
    }
    const double gain = best.certificate.energy - next.certificate.energy;
    best = next;
    this->rank_ = std::move(rank);
    this->record_energy(best);
    constexpr double least_gain = 1e-4;
    if (gain < least_gain * best.certificate.energy)
    {
      return;
    }
  }
}

/// Append the energy of a solution: the sum of the two integrals in monotone_smoothing(). The
/// quadratic form is half of this sum times mass_unit^(order - 1).
void Smoothing::record_energy(const BoxQpSolution& solution)
{
  this->result_.energies.push_back(2.0 * solution.certificate.energy /
    std::pow(this->scaled_.mass_unit, this->options_.order - 1));
}

Status Smoothing::solve()
{
  const Index n = this->data_.size();
  BoxQpColumn column;
  column.fixed_values = this->fixed_values_;
  const double infinity = std::numeric_limits<double>::infinity();
  column.bounds.lower = VectorXd::Constant(n + 1, -infinity);
  column.bounds.upper = VectorXd::Constant(n + 1, infinity);
  std::vector<BoxQpSolution> unconstrained =
    this->solver_->solve_unbounded(this->context_, { column });
  if (this->context_.canceled())
  {
    return Status::canceled();
  }
  BoxQpSolution& best = unconstrained.front();
  VectorXd values;
  Status status = this->guide_values(best.w, values);
  if (!status.ok())
  {
    return status;
  }
  this->floods_ = order_with_extrema(
    this->context_, this->graph_, this->is_included_, this->result_.list, values, this->rank_);
  if (this->context_.canceled())
  {
    return Status::canceled();
  }
  if (this->floods_ == 0)
  {
    return Status::failure(StatusCode::internal_error,
      "no ordering of the vertices with exactly the listed extrema was found; change the list");
  }
  column.pairs =
    pairs_from_order(this->graph_, this->result_.list, this->rank_, this->options_.epsilon);
  const Index infeasible = find_infeasible_vertex(column, this->fixed_, n + 1);
  if (infeasible >= 0)
  {
    return Status::invalid_input(
      "the values at the extrema cannot be kept without additional extrema (conflict at vertex " +
      std::to_string(infeasible) + "); turn off keep_values, or list other extrema");
  }
  const bool ordered = std::all_of(column.pairs.begin(), column.pairs.end(),
    [&](const OrderedPair& pair)
    { return best.w[pair.low] + pair.minimum_difference <= best.w[pair.high]; });
  if (!ordered)
  {
    const ProgressRange range(this->context_, 0.1, this->options_.rebuilds > 0 ? 0.4 : 1.0);
    column.energy = this->expected_energy(column, best);
    best = this->solver_->solve(this->context_, column);
    this->result_.iterations = best.iterations;
    this->context_.add_seconds("factor", best.factor_seconds);
    this->context_.add_seconds("solve", best.solve_seconds);
    if (!best.status.usable())
    {
      return best.status;
    }
    this->record_energy(best);
    this->rebuild(column, best);
  }
  else
  {
    this->record_energy(best);
  }
  this->solution_ = std::move(best);
  return this->context_.canceled() ? Status::canceled() : Status();
}

/// Convert the result to the data's unit, and compute its extrema and the report.
void Smoothing::finish(Status& status)
{
  const Index n = this->data_.size();
  MonotoneSmoothingResult& result = this->result_;
  const VectorXd w = this->solution_.w.head(n);
  result.certificate = this->solution_.certificate;
  result.analyses = this->solver_->analyses();
  result.values = this->data_;
  double largest = 0.0;
  double squares = 0.0;
  double mass = 0.0;
  for (Index v = 0; v < n; ++v)
  {
    const bool kept = this->keep_values_ && result.list[v] != 0;
    if (this->used_[v] && !kept)
    {
      result.values[v] = this->center_ + this->range_ * w[v];
    }
    if (this->used_[v])
    {
      largest = std::max(largest, std::abs(w[v] - this->f_[v]));
      squares += this->scaled_.mass[v] * (w[v] - this->f_[v]) * (w[v] - this->f_[v]);
      mass += this->scaled_.mass[v];
    }
  }
  // The values at kept extrema are exact; all other values are rounded. Restore the order, because
  // a rounded neighbor could be above a kept maximum or below a kept minimum.
  if (this->keep_values_)
  {
    std::vector<char> is_free(static_cast<std::size_t>(n));
    for (Index v = 0; v < n; ++v)
    {
      is_free[v] = this->is_included_[v] && result.list[v] == 0;
    }
    const std::vector<OrderedPair> pairs =
      pairs_from_order(this->graph_, result.list, this->rank_, 0.0);
    enforce_order(sort_pairs_by_order(pairs, topological_order(pairs, n)), is_free,
      VectorXd::Constant(n, std::numeric_limits<double>::infinity()), result.values);
  }
  // Listed extrema and vertices in constant parts do not count as spurious extrema.
  std::vector<char> exempt(static_cast<std::size_t>(n));
  // Equal values are ordered by rank, so that a listed vertex is the extremum of its plateau.
  VectorXd strict = w;
  std::vector<std::int64_t> vertices;
  std::vector<std::string> kinds;
  std::vector<double> values, data, persistences;
  for (Index v = 0; v < n; ++v)
  {
    exempt[v] = result.list[v] != 0 || !this->is_included_[v];
    strict[v] += this->rank_[v] >= 0 ? 1e-12 * double(this->rank_[v]) / double(n) : 0.0;
  }
  result.spurious = interior_extrema(this->graph_, w, exempt);
  std::vector<double> persistence(static_cast<std::size_t>(n), 0.0);
  for (const Extremum& e :
    interior_extrema(this->graph_, strict, std::vector<char>(exempt.size(), 0), 0.0))
  {
    persistence[e.vertex] = std::max(persistence[e.vertex], e.persistence);
  }
  for (Index v = 0; v < n; ++v)
  {
    if (result.list[v] != 0)
    {
      result.extrema.push_back({ v, result.list[v] > 0, result.values[v], persistence[v] });
      vertices.push_back(v);
      kinds.emplace_back(result.list[v] > 0 ? "maximum" : "minimum");
      values.push_back(result.values[v]);
      data.push_back(this->data_[v]);
      persistences.push_back(persistence[v]);
    }
  }
  const double unit = std::pow(this->scaled_.mass_unit, this->options_.order - 1);
  const double distance = this->options_.data_weight * squares * this->scaled_.mass_unit;
  Report& report = status.report;
  report.set("counts.floods", this->floods_);
  report.set("kkt_residual", result.certificate.kkt_residual);
  report.set("relative_gap", result.certificate.relative_gap);
  report.set("order_violation", result.certificate.order_violation);
  report.set("iterations", result.iterations);
  report.set("energy.total", 2.0 * result.certificate.energy / unit);
  report.set("energy.data", distance);
  report.set("energy.smoothness", 2.0 * result.certificate.energy / unit - distance);
  report.set("rounds[].energy", result.energies);
  report.set("largest_difference", this->range_ * largest);
  report.set("rms_difference", this->range_ * std::sqrt(squares / mass));
  report.set("interior_extrema", static_cast<std::int64_t>(result.spurious.size()));
  report.set("extrema[].vertex", vertices);
  report.set("extrema[].kind", kinds);
  report.set("extrema[].value", values);
  report.set("extrema[].data", data);
  report.set("extrema[].persistence", persistences);
  const double tolerance = this->options_.tolerance;
  if (!(std::max(result.certificate.relative_gap, result.certificate.kkt_residual) <= tolerance))
  {
    status.code = StatusCode::not_converged;
    status.message = "the smoothed data " +
      certificate_message(
        result.certificate.relative_gap, result.certificate.kkt_residual, tolerance);
  }
}

Status Smoothing::run()
{
  this->result_ = {};
  Status status = this->check();
  if (!status.ok())
  {
    return status;
  }
  this->keep_values_ = this->options_.keep_values || this->options_.data_weight == 0.0;
  this->remove_degenerate();
  for (Index v = 0; v < this->data_.size(); ++v)
  {
    if (this->used_[v] && !std::isfinite(this->data_[v]))
    {
      return Status::invalid_input(
        "the data value of vertex " + std::to_string(v) + " is not a finite number");
    }
  }
  const bool varies = this->scale_data();
  if (varies && !std::isfinite(this->range_))
  {
    return Status::invalid_input("the range of the data exceeds double precision");
  }
  status.report.set(
    "method", this->options_.order == 2 ? "monotone-smoothing" : "monotone-smoothing-triharmonic");
  status.report.set("counts.vertices", this->data_.size());
  status.report.set(this->measurable_.is_volume() ? "counts.tets" : "counts.triangles",
    this->measurable_.element_count());
  status.report.set("counts.components", this->components_.count);
  if (!varies)
  {
    this->result_.values = this->data_;
    this->result_.list.assign(this->used_.size(), 0);
    this->warnings_.emplace_back("the data are constant and were not smoothed");
    status.warnings = this->warnings_;
    return status;
  }
  {
    const Phase phase(this->context_, "extrema", 0.0, 0.05);
    status.report.set("counts.data_extrema",
      static_cast<std::int64_t>(
        interior_extrema(this->graph_, this->f_, std::vector<char>(this->used_.size(), 0)).size()));
    Status listed = this->find_extrema();
    if (!listed.ok())
    {
      return listed;
    }
  }
  const ExtremaList& list = this->result_.list;
  status.report.set("extrema_from",
    !this->options_.extrema.empty()      ? "list"
      : this->options_.extrema_count > 0 ? "count"
                                         : "persistence");
  status.report.set(
    "counts.maxima", static_cast<std::int64_t>(std::count(list.begin(), list.end(), 1)));
  status.report.set(
    "counts.minima", static_cast<std::int64_t>(std::count(list.begin(), list.end(), -1)));
  if (this->constant_parts_ > 0)
  {
    status.report.set("counts.constant_components", this->constant_parts_);
  }
  this->assemble();
  status.report.set("data_length",
    this->options_.data_weight > 0.0
      ? this->scaled_.diagonal * std::pow(this->options_.data_weight, -0.5 / this->options_.order)
      : 0.0);
  Status solved;
  {
    const ProgressRange range(this->context_, 0.05, 0.15);
    solved = this->solver_->prepare(this->context_);
  }
  if (solved.ok())
  {
    const Phase phase(this->context_, "smoothing", 0.15, 0.98);
    solved = this->solve();
  }
  if (!solved.usable())
  {
    return solved;
  }
  this->finish(status);
  const std::string slow_blas = SparseSolver::blas_warning();
  if (!slow_blas.empty())
  {
    this->warnings_.push_back(slow_blas);
  }
  status.warnings = this->warnings_;
  return status;
}
} // namespace

Status monotone_smoothing(ExecutionContext& context, const Domain& domain, const VectorXd& data,
  const MonotoneSmoothingOptions& options, MonotoneSmoothingResult& result)
{
  WorkingFrame frame;
  Status status = choose_working_frame(domain, "the mesh", frame);
  if (!status.ok())
  {
    return status;
  }
  if (frame.is_identity())
  {
    return Smoothing(context, domain, data, options, result).run();
  }
  Domain framed = domain;
  framed.points = frame.to_frame(framed.points);
  framed.embedded_points = frame.to_frame(framed.embedded_points);
  status = Smoothing(context, framed, data, options, result).run();
  frame.convert_report(status.report, "data_length", 1);
  return status;
}

} // namespace bindpose

// Checks and transfer of the optional terms (see weight_terms.h). The checks need only the terms.
// Contradictions of a term with a handle or with another term are found when the columns are made
// (column_groups.cpp).
#include "weights/weight_terms.h"

#include "transfer/transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace bindpose
{

namespace
{
Status check_matrix(const Eigen::MatrixXd& values, const std::string& array_name,
  Index vertex_count, const Handles& handles)
{
  const auto m = static_cast<Index>(handles.size());
  if (values.size() == 0)
  {
    return {};
  }
  if (values.rows() != vertex_count || values.cols() != m)
  {
    return Status::invalid_input("the " + array_name +
      " must have one row per vertex and one column per handle (" + std::to_string(vertex_count) +
      " x " + std::to_string(m) + "), not " + std::to_string(values.rows()) + " x " +
      std::to_string(values.cols()));
  }
  for (Index v = 0; v < vertex_count; ++v)
  {
    for (Index j = 0; j < m; ++j)
    {
      if (std::isinf(values(v, j)))
      {
        return Status::invalid_input("the " + array_name + " of handle '" + handles[j].name +
          "' are infinite at vertex " + std::to_string(v));
      }
    }
  }
  return {};
}

Status check_pins(const Eigen::MatrixXd& pinned, const Handles& handles)
{
  constexpr double tolerance = 1e-9;
  for (Index v = 0; v < pinned.rows(); ++v)
  {
    double sum = 0.0;
    double least = 0.0;
    bool all = true;
    for (Index j = 0; j < pinned.cols(); ++j)
    {
      const bool is_free = std::isnan(pinned(v, j));
      all = all && !is_free;
      sum += is_free ? 0.0 : pinned(v, j);
      least = is_free ? least : std::min(least, pinned(v, j));
    }
    if (all && std::abs(sum - 1.0) > tolerance)
    {
      return Status::invalid_input("the pinned weights of vertex " + std::to_string(v) +
        " sum to " + std::to_string(sum) + " and the weights of all " +
        std::to_string(handles.size()) + " handles are pinned, so the sum cannot be 1");
    }
    if (sum > 1.0 + tolerance && !(least < 0.0))
    {
      return Status::invalid_input("the pinned weights of vertex " + std::to_string(v) +
        " sum to " + std::to_string(sum) + ", more than 1");
    }
  }
  return {};
}

Status check_mirror(const std::vector<Index>& mirror, Index vertex_count)
{
  if (!mirror.empty() && static_cast<Index>(mirror.size()) != vertex_count)
  {
    return Status::invalid_input("there are " + std::to_string(mirror.size()) +
      " mirror vertices, but " + std::to_string(vertex_count) + " vertices");
  }
  for (std::size_t v = 0; v < mirror.size(); ++v)
  {
    const Index other = mirror[v];
    if (other < -1 || other >= vertex_count)
    {
      return Status::invalid_input("the mirror vertex " + std::to_string(other) + " of vertex " +
        std::to_string(v) + " does not exist");
    }
    if (other >= 0 && mirror[other] != static_cast<Index>(v))
    {
      return Status::invalid_input("vertex " + std::to_string(v) + " is mirrored to vertex " +
        std::to_string(other) + ", but that vertex is mirrored to " +
        std::to_string(mirror[other]));
    }
  }
  return {};
}

/// Find the mirror vertices for a mirror plane (see WeightTerms::mirror_normal).
std::vector<Index> mirror_of_plane(const Points& points, const Vec3& origin, const Vec3& normal)
{
  const double diagonal = bounding_box(points).diagonal();
  const double tolerance = 1e-5 * diagonal;
  const double cell = std::max(2.0 * tolerance, 1e-300);
  const Vec3 unit = normal.normalized();
  using Key = std::array<long long, 3>;
  const auto key = [&](const Vec3& p) -> Key {
    return { std::llround(p[0] / cell), std::llround(p[1] / cell), std::llround(p[2] / cell) };
  };
  const Vec3 center = bounding_box(points).center();
  std::map<Key, std::vector<Index>> cells;
  for (Index v = 0; v < points.rows(); ++v)
  {
    cells[key(points.row(v).transpose() - center)].push_back(v);
  }
  std::vector<Index> nearest(static_cast<std::size_t>(points.rows()), -1);
  for (Index v = 0; v < points.rows(); ++v)
  {
    const Vec3 p = points.row(v);
    const Vec3 image = p - 2.0 * unit.dot(p - origin) * unit;
    const Key at = key(image - center);
    double best = tolerance;
    for (int k = 0; k < 27; ++k)
    {
      const auto found =
        cells.find({ at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1 });
      if (found == cells.end())
      {
        continue;
      }
      for (const Index other : found->second)
      {
        const double distance = (points.row(other).transpose() - image).norm();
        if (distance < best)
        {
          best = distance;
          nearest[v] = other;
        }
      }
    }
  }
  std::vector<Index> mirror(nearest.size(), -1);
  for (std::size_t v = 0; v < nearest.size(); ++v)
  {
    mirror[v] = nearest[v] >= 0 && nearest[nearest[v]] == static_cast<Index>(v) ? nearest[v] : -1;
  }
  return mirror;
}

/// Append mirror entries for inserted vertices. An inserted vertex b is the mirror vertex of an
/// inserted vertex a if the corners of b's element are the mirror vertices of the corners of a's
/// element, with equal barycentric coordinates.
void extend_mirror(const HandleInsertion& mesh, std::vector<Index>& mirror)
{
  constexpr double tolerance = 1e-9;
  const auto original = static_cast<Index>(mirror.size());
  using Corners = std::vector<std::pair<Index, double>>;
  const auto corners = [&](const InsertedVertex& vertex, bool mirrored)
  {
    Corners result;
    for (int k = 0; k < 4; ++k)
    {
      if (vertex.parents[k] >= 0 && vertex.barycentric[k] > tolerance)
      {
        result.emplace_back(
          mirrored ? mirror[vertex.parents[k]] : vertex.parents[k], vertex.barycentric[k]);
      }
    }
    std::sort(result.begin(), result.end());
    return result;
  };
  std::vector<Corners> corner_lists;
  for (const InsertedVertex& vertex : mesh.inserted)
  {
    corner_lists.push_back(corners(vertex, false));
  }
  std::vector<Index> found;
  for (const InsertedVertex& vertex : mesh.inserted)
  {
    const Corners image = corners(vertex, true);
    const auto is_image = [&](const Corners& other)
    {
      return std::equal(image.begin(), image.end(), other.begin(), other.end(),
        [](const auto& a, const auto& b)
        { return a.first == b.first && std::abs(a.second - b.second) <= tolerance; });
    };
    const auto at = std::find_if(corner_lists.begin(), corner_lists.end(), is_image);
    found.push_back(at == corner_lists.end() ? -1 : original + (at - corner_lists.begin()));
  }
  mirror.insert(mirror.end(), found.begin(), found.end());
}

Eigen::MatrixXd extend_matrix(const HandleInsertion& mesh, const Eigen::MatrixXd& values)
{
  if (values.size() == 0)
  {
    return values;
  }
  const Index original = values.rows();
  Eigen::MatrixXd result(original + static_cast<Index>(mesh.inserted.size()), values.cols());
  result.topRows(original) = values;
  for (std::size_t i = 0; i < mesh.inserted.size(); ++i)
  {
    const InsertedVertex& vertex = mesh.inserted[i];
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(values.cols());
    for (int k = 0; k < 4; ++k)
    {
      if (vertex.parents[k] >= 0 && vertex.barycentric[k] > 1e-12)
      {
        row += vertex.barycentric[k] * values.row(vertex.parents[k]);
      }
    }
    result.row(original + static_cast<Index>(i)) = row;
  }
  return result;
}
} // namespace

std::pair<double, double> WeightTerms::bounds_of(Index handle) const
{
  return this->handle_bounds.size() > 0
    ? std::make_pair(this->handle_bounds(handle, 0), this->handle_bounds(handle, 1))
    : std::make_pair(0.0, 1.0);
}

std::pair<double, double> WeightTerms::bounds_of(Index handle, Index vertex) const
{
  const auto value_or = [&](const Eigen::MatrixXd& values, double fallback)
  {
    return values.size() > 0 && !std::isnan(values(vertex, handle)) ? values(vertex, handle)
                                                                    : fallback;
  };
  const auto [low, high] = this->bounds_of(handle);
  return { value_or(this->lower, low), value_or(this->upper, high) };
}

bool WeightTerms::has_bounds() const
{
  return this->lower.size() > 0 || this->upper.size() > 0 || this->handle_bounds.size() > 0;
}

bool WeightTerms::any() const
{
  return this->rigidity.size() > 0 || !this->rigid_sets.empty() || this->has_bounds() ||
    this->pinned.size() > 0 || this->has_mirror();
}

double rigidity_unit(int order)
{
  constexpr double unit = 1e4; // (diagonal / 100)^-2 for a mesh of diagonal 1
  return std::pow(unit, order - 1);
}

Status check_terms(const WeightTerms& terms, Index vertex_count, const Handles& handles)
{
  const auto m = static_cast<Index>(handles.size());
  if (terms.rigidity.size() > 0 && terms.rigidity.size() != vertex_count)
  {
    return Status::invalid_input("there are " + std::to_string(terms.rigidity.size()) +
      " values of rigidity, but " + std::to_string(vertex_count) + " vertices");
  }
  for (Index v = 0; v < terms.rigidity.size(); ++v)
  {
    if (!(terms.rigidity[v] >= 0.0 && terms.rigidity[v] <= 1e12))
    {
      return Status::invalid_input("the rigidity of vertex " + std::to_string(v) + " is " +
        std::to_string(terms.rigidity[v]) + "; it must be from 0 to 1e12");
    }
  }
  if (!terms.rigid_sets.empty() && static_cast<Index>(terms.rigid_sets.size()) != vertex_count)
  {
    return Status::invalid_input("there are " + std::to_string(terms.rigid_sets.size()) +
      " labels of rigid sets, but " + std::to_string(vertex_count) + " vertices");
  }
  if (terms.handle_bounds.size() > 0 &&
    (terms.handle_bounds.rows() != m || terms.handle_bounds.cols() != 2))
  {
    return Status::invalid_input("there are bounds for " +
      std::to_string(terms.handle_bounds.rows()) + " handles, but " + std::to_string(m) +
      " handles");
  }
  for (Index j = 0; j < terms.handle_bounds.rows(); ++j)
  {
    const double low = terms.handle_bounds(j, 0);
    const double high = terms.handle_bounds(j, 1);
    if (!(std::isfinite(low) && std::isfinite(high) && low <= high))
    {
      return Status::invalid_input("the bounds of handle '" + handles[j].name + "' are " +
        std::to_string(low) + " and " + std::to_string(high) +
        "; they must be finite, and the lower bound must not exceed the upper bound");
    }
  }
  Status status = check_matrix(terms.lower, "lower bounds", vertex_count, handles);
  status = status.ok() ? check_matrix(terms.upper, "upper bounds", vertex_count, handles) : status;
  status =
    status.ok() ? check_matrix(terms.pinned, "pinned weights", vertex_count, handles) : status;
  status = status.ok() ? check_pins(terms.pinned, handles) : status;
  if (status.ok() && !terms.mirror_normal.isZero() &&
    !(terms.mirror_normal.allFinite() && terms.mirror_origin.allFinite()))
  {
    status = Status::invalid_input("the normal and origin of the mirror plane must be finite");
  }
  return status.ok() ? check_mirror(terms.mirror, vertex_count) : status;
}

WeightTerms extend_terms(const WeightTerms& terms, const HandleInsertion& mesh)
{
  WeightTerms result = terms;
  result.rigidity = extend_matrix(mesh, terms.rigidity);
  result.rigid_sets = extend_labels(mesh, terms.rigid_sets);
  result.lower = extend_matrix(mesh, terms.lower);
  result.upper = extend_matrix(mesh, terms.upper);
  result.pinned = extend_matrix(mesh, terms.pinned);
  if (!terms.mirror.empty())
  {
    extend_mirror(mesh, result.mirror);
  }
  else if (!terms.mirror_normal.isZero())
  {
    result.mirror = mirror_of_plane(mesh.domain.points, terms.mirror_origin, terms.mirror_normal);
  }
  return result;
}

bool has_vertex_terms(const WeightTerms& terms)
{
  return !terms.rigid_sets.empty() || terms.lower.size() > 0 || terms.upper.size() > 0 ||
    terms.pinned.size() > 0 || !terms.mirror.empty();
}

Status transfer_terms(ExecutionContext& context, const WeightTerms& terms, const Domain& surface,
  const Points& points, const std::vector<Index>& original, WeightTerms& transferred,
  Index& dropped_count)
{
  transferred = terms;
  if (terms.rigidity.size() > 0)
  {
    const Weights painted = terms.rigidity;
    Weights transferred_rigidity;
    TransferCounts counts;
    const Status status =
      transfer(context, surface, painted, points, {}, transferred_rigidity, counts);
    if (!status.ok())
    {
      return status;
    }
    transferred.rigidity = transferred_rigidity.col(0);
  }
  std::vector<Index> mesh_vertex(static_cast<std::size_t>(surface.points.rows()), -1);
  for (std::size_t v = 0; v < original.size(); ++v)
  {
    if (original[v] >= 0)
    {
      mesh_vertex[original[v]] = static_cast<Index>(v);
    }
  }
  const auto has_values = [&](const Eigen::MatrixXd& values, Index v)
  { return values.size() > 0 && !values.row(v).array().isNaN().all(); };
  dropped_count = 0;
  for (Index v = 0; v < surface.points.rows(); ++v)
  {
    const bool set = !terms.rigid_sets.empty() && terms.rigid_sets[v] > 0;
    const bool mirrored = !terms.mirror.empty() && terms.mirror[v] >= 0;
    dropped_count += mesh_vertex[v] < 0 &&
      (set || mirrored || has_values(terms.lower, v) || has_values(terms.upper, v) ||
        has_values(terms.pinned, v));
  }
  const Index count = points.rows();
  for (Eigen::MatrixXd* values : { &transferred.lower, &transferred.upper, &transferred.pinned })
  {
    if (values->size() > 0)
    {
      const Eigen::MatrixXd of_surface = *values;
      values->setConstant(count, of_surface.cols(), std::nan(""));
      for (Index v = 0; v < count; ++v)
      {
        if (original[v] >= 0)
        {
          values->row(v) = of_surface.row(original[v]);
        }
      }
    }
  }
  if (!terms.rigid_sets.empty())
  {
    transferred.rigid_sets.assign(static_cast<std::size_t>(count), 0);
    for (Index v = 0; v < count; ++v)
    {
      transferred.rigid_sets[v] = original[v] >= 0 ? terms.rigid_sets[original[v]] : 0;
    }
  }
  if (!terms.mirror.empty())
  {
    transferred.mirror.assign(static_cast<std::size_t>(count), -1);
    for (Index v = 0; v < count; ++v)
    {
      const Index image = original[v] >= 0 ? terms.mirror[original[v]] : -1;
      transferred.mirror[v] = image >= 0 ? mesh_vertex[image] : -1;
    }
  }
  return {};
}

std::vector<Index> mirrored_handles(
  const WeightTerms& terms, const HandleConstraints& constraints, Index handle_count)
{
  std::vector<Index> partner(static_cast<std::size_t>(handle_count), -1);
  if (terms.mirror.empty())
  {
    return partner;
  }
  std::vector<Index> constraint_row(constraints.roles.size(), -1);
  for (std::size_t i = 0; i < constraints.vertices.size(); ++i)
  {
    constraint_row[constraints.vertices[i]] = static_cast<Index>(i);
  }
  // Report whether every nonzero given value of column a equals the value of column b at the mirror
  // vertex.
  const auto image = [&](Index a, Index b)
  {
    bool any = false;
    for (std::size_t i = 0; i < constraints.vertices.size(); ++i)
    {
      const double value = constraints.values(static_cast<Index>(i), a);
      const Index other = terms.mirror[constraints.vertices[i]];
      if (value == 0.0)
      {
        continue;
      }
      if (other < 0 || constraint_row[other] < 0 ||
        std::abs(constraints.values(constraint_row[other], b) - value) > 1e-12)
      {
        return false;
      }
      any = true;
    }
    return any;
  };
  for (Index a = 0; a < handle_count; ++a)
  {
    for (Index b = 0; b < handle_count && partner[a] < 0; ++b)
    {
      if (image(a, b) && image(b, a))
      {
        partner[a] = b;
      }
    }
  }
  return partner;
}

} // namespace bindpose

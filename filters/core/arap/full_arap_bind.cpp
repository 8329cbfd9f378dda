// Bind time of full as-rigid-as-possible: selects the elements that have an energy, and sets up the
// sums that map displacements to covariances and rotations to forces.
#include "arap/full_arap.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bindpose
{

namespace
{
/// An element is flat if its largest cotangent exceeds this value. Flat elements are left out of
/// the energy, because their energy would be round-off.
constexpr double maximum_cotangent = 1e7;

/// Return the unit of an element's cotangent weights: 1 for a triangle, the length of the longest
/// edge for a tet.
double weight_unit(PointsView, const TrianglesView&, Index)
{
  return 1.0;
}
double weight_unit(PointsView points, const TetsView& tets, Index e)
{
  double square = 0.0;
  for (const auto& edge : tet_edges)
  {
    square =
      std::max(square, (points.row(tets(e, edge[0])) - points.row(tets(e, edge[1]))).squaredNorm());
  }
  return std::sqrt(square);
}

Triangles to_owned(const TrianglesView& triangles)
{
  return triangles;
}
Tets to_owned(const TetsView& tets)
{
  return tets;
}

const char* element_word(const TetsView&)
{
  return "tet";
}
const char* element_word(const TrianglesView&)
{
  return "triangle";
}

/// Some vertices are used by flat elements only. Return for each of them the neighbor that it moves
/// with, and -1 for all other vertices.
template <typename Elements>
std::vector<Index> leaders(const Elements& elements, const std::vector<Index>& part_of_vertex)
{
  std::vector<Index> leader(part_of_vertex.size(), -1);
  for (bool changed = true; changed;)
  {
    changed = false;
    for (Index e = 0; e < elements.rows(); ++e)
    {
      Index followed_vertex = -1;
      for (Index k = 0; k < elements.cols() && followed_vertex < 0; ++k)
      {
        const Index v = elements(e, k);
        followed_vertex = part_of_vertex[v] >= 0 ? v : leader[v];
      }
      for (Index k = 0; k < elements.cols() && followed_vertex >= 0; ++k)
      {
        const Index v = elements(e, k);
        if (part_of_vertex[v] < 0 && leader[v] < 0)
        {
          leader[v] = followed_vertex;
          changed = true;
        }
      }
    }
  }
  return leader;
}
} // namespace

void FullArap::set_covariance(const SparseMatrix& covariance)
{
  const Index groups = this->groups_.count, n = this->rest_.rows();
  this->vertex_terms_ = this->group_terms_ = Terms();
  this->vertex_terms_.begin.assign(static_cast<std::size_t>(n) + 1, 0);
  this->group_terms_.begin.assign(static_cast<std::size_t>(groups) + 1, 0);
  const auto terms = static_cast<std::size_t>(covariance.nonZeros() / 3);
  for (Terms* t : { &this->vertex_terms_, &this->group_terms_ })
  {
    t->item.resize(terms);
    t->b.resize(3 * terms);
  }
  // A column of the covariance matrix stores one vector b (see Terms) for each group to which the
  // vertex contributes: first the x coordinates of all these vectors, then y, then z.
  Index at = 0;
  for (Index v = 0; v < n; ++v)
  {
    const Index first = covariance.outerIndexPtr()[v];
    const Index count = (covariance.outerIndexPtr()[v + 1] - first) / 3;
    for (Index t = 0; t < count; ++t, ++at)
    {
      this->vertex_terms_.item[at] = covariance.innerIndexPtr()[first + t];
      for (Index i = 0; i < 3; ++i)
      {
        this->vertex_terms_.b[3 * at + i] = covariance.valuePtr()[first + i * count + t];
      }
      this->group_terms_.begin[this->vertex_terms_.item[at] + 1] += 1;
    }
    this->vertex_terms_.begin[v + 1] = at;
  }
  std::vector<Index>& begin = this->group_terms_.begin;
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Index> next(begin.begin(), begin.end() - 1);
  this->stride_ = (groups + 7) / 8 * 8;
  this->rest_covariance_.assign(static_cast<std::size_t>(9 * this->stride_), 0.0);
  const Vec3 middle = bounding_box(this->rest_).center();
  for (Index v = 0; v < n; ++v)
  {
    const Vec3 p = this->rest_.row(v).transpose() - middle;
    for (Index t = this->vertex_terms_.begin[v]; t < this->vertex_terms_.begin[v + 1]; ++t)
    {
      const Index k = this->vertex_terms_.item[t];
      const Index to = next[k]++;
      this->group_terms_.item[to] = static_cast<int>(v);
      for (Index i = 0; i < 3; ++i)
      {
        const double b = this->vertex_terms_.b[3 * t + i];
        this->group_terms_.b[3 * to + i] = b;
        for (Index j = 0; j < 3; ++j)
        {
          this->rest_covariance_[(3 * i + j) * this->stride_ + k] += b * p[j];
        }
      }
    }
  }
}

template <typename Elements>
Status FullArap::bind_elements(ExecutionContext& context, PointsView points,
  const Elements& elements, const Handles& handles, const FullArapOptions& options)
{
  *this = FullArap();
  Status status = check_mesh_and_handles(points, elements, handles);
  WorkingFrame frame;
  if (status.ok())
  {
    status = WorkingFrame::choose(points, elements, "the mesh", frame);
  }
  if (!status.ok())
  {
    return status;
  }
  if (!frame.is_identity())
  {
    status = this->bind_elements(
      context, frame.to_frame(points), elements, to_frame(frame, handles), options);
    this->frame_ = frame;
    this->posed_ = points;
    return status;
  }
  constexpr bool tets = Elements::ColsAtCompileTime == 4;
  this->handles_ = handles;
  this->rest_ = points;

  // Keep the elements that are not flat, in their input order.
  auto regular_elements = to_owned(elements);
  Index count = 0;
  {
    Phase phase(context, "elements", 0.0, 0.3);
    const auto c = cotangent_weights(points, elements);
    for (Index e = 0; e < elements.rows(); ++e)
    {
      const double largest = c.row(e).cwiseAbs().maxCoeff();
      if (largest > 0.0 && largest <= maximum_cotangent * weight_unit(points, elements, e))
      {
        regular_elements.row(count++) = elements.row(e);
      }
    }
    if (count == 0)
    {
      return Status::invalid_input(std::string("the mesh cannot be deformed because no ") +
        element_word(elements) + (tets ? " has a volume" : " has an area"));
    }
    if (count < elements.rows())
    {
      const Index flat_count = elements.rows() - count;
      status.warnings.push_back(std::to_string(flat_count) + " of " +
        std::to_string(elements.rows()) + " " + element_word(elements) +
        "s are too flat and do not contribute to the energy");
      regular_elements.conservativeResize(count, Eigen::NoChange);
    }
    this->parts_ = connected_components(points.rows(), regular_elements);
    this->leader_ = count < elements.rows()
      ? leaders(elements, this->parts_.component_of_vertex)
      : std::vector<Index>(static_cast<std::size_t>(points.rows()), -1);
  }
  const Elements view = regular_elements;
  const Eigen::RowVector3d middle = points.colwise().mean();
  this->radius_ = std::sqrt((points.rowwise() - middle).rowwise().squaredNorm().mean());
  if (context.canceled())
  {
    return Status::canceled();
  }
  {
    Phase phase(context, "grips", 0.3, 0.6);
    Status grip_status = this->grips_.find(points, view, this->parts_, handles, options.region_ids);
    if (!grip_status.ok())
    {
      return grip_status;
    }
    status.warnings.insert(
      status.warnings.end(), grip_status.warnings.begin(), grip_status.warnings.end());
  }
  Phase phase(context, "energy", 0.6, 1.0);
  const ArapEnergy energy = resolve_energy(options.energy, tets);
  this->groups_.energy = energy;
  this->groups_.count = energy == ArapEnergy::elements ? count : points.rows();
  std::vector<Index>& label =
    energy == ArapEnergy::elements ? this->groups_.group_of_element : this->groups_.group_of_vertex;
  label.resize(static_cast<std::size_t>(this->groups_.count));
  std::iota(label.begin(), label.end(), Index(0));
  this->group_vertices_.assign(static_cast<std::size_t>(this->groups_.count), { -1, -1, -1, -1 });
  for (Index k = 0; k < this->groups_.count; ++k)
  {
    this->group_vertices_[k][0] = static_cast<int>(k);
    for (Index corner = 0; energy == ArapEnergy::elements && corner < view.cols(); ++corner)
    {
      this->group_vertices_[k][corner] = static_cast<int>(view(k, corner));
    }
  }
  Index ignored_edges = 0;
  this->stiffness_ = arap_stiffness(points, view, energy, &ignored_edges);
  if (ignored_edges > 0)
  {
    status.warnings.push_back(ignored_edges_warning(ignored_edges));
  }
  if (context.canceled())
  {
    return Status::canceled();
  }
  this->set_covariance(covariance_matrix(points, view, this->groups_));
  const Points centered = points.rowwise() - bounding_box(points).center().transpose();
  this->rest_energy_ = 0.5 * (centered.array() * (this->stiffness_ * centered).array()).sum();
  this->covariance_ = this->rotations_ = this->rest_covariance_;
  this->rotation_deltas_.assign(static_cast<std::size_t>(9 * this->groups_.count), 0.0);
  this->posed_ = points;
  if (context.canceled())
  {
    return Status::canceled();
  }
  status.report.set("counts.vertices", points.rows());
  status.report.set(tets ? "counts.tets" : "counts.triangles", elements.rows());
  status.report.set("counts.handles", handles.size());
  status.report.set("counts.rotations", this->groups_.count);
  status.report.set("method", to_string(energy, tets));
  return status;
}

Status FullArap::bind(ExecutionContext& context, PointsView points, TrianglesView triangles,
  const Handles& handles, const FullArapOptions& options)
{
  return this->bind_elements(context, points, triangles, handles, options);
}

Status FullArap::bind(ExecutionContext& context, PointsView points, TetsView tets,
  const Handles& handles, const FullArapOptions& options)
{
  return this->bind_elements(context, points, tets, handles, options);
}

} // namespace bindpose

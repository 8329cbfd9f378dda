// As-rigid-as-possible energies for groups of vertices or elements that share a rotation.
//
// Every energy is a weighted sum over edges. One or more groups contribute to the term of an edge,
// each with a fraction; the fractions sum to one. If a group contributes several times, its
// fractions are added.
// - Elements: the sum runs over the edges of each element, with the element's cotangent weights.
//   Only the group of the element contributes.
// - Spokes and rims: the sum runs over the same edges with the same weights. The groups of the
//   element's vertices contribute with one third each (triangle) or one quarter each (tet).
// - Spokes: the sum runs over the edges of the mesh, with their weights from the stiffness matrix.
//   The groups of the two ends contribute with one half each.
#include "arap/arap_energy.h"

#include "base/most_frequent.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace bindpose
{

namespace
{
constexpr int triangle_edges[3][2] = { { 1, 2 }, { 2, 0 }, { 0, 1 } };

constexpr const int (&edges_of(const TrianglesView&))[3][2]
{
  return triangle_edges;
}
constexpr const int (&edges_of(const TetsView&))[6][2]
{
  return tet_edges;
}

/// The groups that contribute to an element or edge, and their fractions, which sum to one.
template <int Corners>
struct GroupWeights
{
  std::array<Index, Corners> group;
  std::array<double, Corners> fraction;
  int count = 0;

  void add(Index g, double s)
  {
    for (int i = 0; i < this->count; ++i)
    {
      if (this->group[i] == g)
      {
        this->fraction[i] += s;
        return;
      }
    }
    this->group[this->count] = g;
    this->fraction[this->count] = s;
    ++this->count;
  }
};

template <typename Elements, int Corners>
GroupWeights<Corners> make_group_weights(
  const Elements& elements, Index e, const RotationGroups& groups)
{
  GroupWeights<Corners> group_weights;
  if (groups.energy == ArapEnergy::elements)
  {
    group_weights.add(groups.group_of_element[static_cast<std::size_t>(e)], 1.0);
    return group_weights;
  }
  for (int k = 0; k < Corners; ++k)
  {
    group_weights.add(
      groups.group_of_vertex[static_cast<std::size_t>(elements(e, k))], 1.0 / Corners);
  }
  return group_weights;
}

/// Return for each vertex the most frequent label among its elements; -1 if it has no element.
template <typename Elements>
std::vector<Index> labels_around(
  const Elements& elements, const std::vector<Index>& group_of_element, std::size_t vertices)
{
  // Start of each vertex's labels. The array is shifted by two entries for the counting sort.
  std::vector<Index> begin(vertices + 2, 0);
  for (Index e = 0; e < elements.rows(); ++e)
  {
    for (Index k = 0; k < elements.cols(); ++k)
    {
      begin[static_cast<std::size_t>(elements(e, k)) + 2] += 1;
    }
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Index> labels(static_cast<std::size_t>(elements.size()));
  for (Index e = 0; e < elements.rows(); ++e)
  {
    for (Index k = 0; k < elements.cols(); ++k)
    {
      labels[begin[static_cast<std::size_t>(elements(e, k)) + 1]++] =
        group_of_element[static_cast<std::size_t>(e)];
    }
  }
  std::vector<Index> group_of_vertex(vertices, -1);
  for (std::size_t v = 0; v < vertices; ++v)
  {
    if (begin[v] < begin[v + 1])
    {
      group_of_vertex[v] = most_frequent(labels.begin() + begin[v], labels.begin() + begin[v + 1]);
    }
  }
  return group_of_vertex;
}

template <typename Elements, int Corners>
RotationGroups make_groups(
  ArapEnergy energy, const Elements& elements, Index count, std::vector<Index> vertex_labels)
{
  RotationGroups groups;
  groups.energy = energy;
  groups.count = count;
  groups.group_of_vertex = std::move(vertex_labels);
  if (energy != ArapEnergy::elements)
  {
    return groups;
  }
  groups.group_of_element.resize(static_cast<std::size_t>(elements.rows()));
  std::vector<Index> fresh(static_cast<std::size_t>(count), -1);
  groups.count = 0;
  for (Index e = 0; e < elements.rows(); ++e)
  {
    std::array<Index, Corners> labels;
    for (int k = 0; k < Corners; ++k)
    {
      labels[k] = groups.group_of_vertex[static_cast<std::size_t>(elements(e, k))];
    }
    Index& name = fresh[static_cast<std::size_t>(most_frequent(labels.begin(), labels.end()))];
    if (name < 0)
    {
      name = groups.count++;
    }
    groups.group_of_element[static_cast<std::size_t>(e)] = name;
  }
  groups.group_of_vertex =
    labels_around(elements, groups.group_of_element, groups.group_of_vertex.size());
  return groups;
}

/// An edge of the mesh. Its weight is the sum of the cotangent weights of the elements at the edge.
/// Only edges with a positive weight are stored.
struct Spoke
{
  Index i, j;
  double weight;
};

/// Let d be the smaller of the stiffness matrix's diagonal entries at the two vertices of an edge.
/// The weight of the edge is ignored as round-off if |weight| <= weight_tolerance * d.
constexpr double weight_tolerance = 1e-12;

std::vector<Spoke> spokes_of(const SparseMatrix& stiffness, Index* ignored_edges)
{
  std::vector<Spoke> spokes;
  const Eigen::VectorXd diagonal = stiffness.diagonal();
  Index negative = 0;
  for (Index j = 0; j < stiffness.cols(); ++j)
  {
    for (SparseMatrix::InnerIterator it(stiffness, j); it && it.row() < j; ++it)
    {
      const double weight = -it.value();
      const double threshold = weight_tolerance * std::min(diagonal[it.row()], diagonal[j]);
      if (weight > threshold)
      {
        spokes.push_back({ it.row(), j, weight });
      }
      negative += weight < -threshold;
    }
  }
  if (ignored_edges)
  {
    *ignored_edges = negative;
  }
  return spokes;
}

template <typename Elements>
SparseMatrix make_stiffness(
  PointsView rest, const Elements& elements, ArapEnergy energy, Index* ignored_edges)
{
  SparseMatrix stiffness = stiffness_matrix(rest, elements);
  if (ignored_edges)
  {
    *ignored_edges = 0;
  }
  if (energy != ArapEnergy::spokes)
  {
    return stiffness;
  }
  std::vector<Eigen::Triplet<double, int>> entries;
  for (const Spoke& spoke : spokes_of(stiffness, ignored_edges))
  {
    const int i = static_cast<int>(spoke.i), j = static_cast<int>(spoke.j);
    entries.emplace_back(i, j, -spoke.weight);
    entries.emplace_back(j, i, -spoke.weight);
    entries.emplace_back(i, i, spoke.weight);
    entries.emplace_back(j, j, spoke.weight);
  }
  SparseMatrix positive(stiffness.rows(), stiffness.cols());
  positive.setFromTriplets(entries.begin(), entries.end());
  return positive;
}

/// Return the groups at the ends of an edge, each with its fraction of the edge.
GroupWeights<2> make_group_weights(const Spoke& spoke, const RotationGroups& groups)
{
  GroupWeights<2> group_weights;
  group_weights.add(groups.group_of_vertex[static_cast<std::size_t>(spoke.i)], 0.5);
  group_weights.add(groups.group_of_vertex[static_cast<std::size_t>(spoke.j)], 0.5);
  return group_weights;
}

SparseMatrix spokes_covariance(
  PointsView rest, const std::vector<Spoke>& spokes, const RotationGroups& groups)
{
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(spokes.size() * 12);
  for (const Spoke& spoke : spokes)
  {
    const Vec3 edge = spoke.weight * (rest.row(spoke.i) - rest.row(spoke.j)).transpose();
    const GroupWeights<2> group_weights = make_group_weights(spoke, groups);
    for (int s = 0; s < group_weights.count; ++s)
    {
      for (int i = 0; i < 3; ++i)
      {
        const auto row = static_cast<int>(i * groups.count + group_weights.group[s]);
        entries.emplace_back(row, static_cast<int>(spoke.i), group_weights.fraction[s] * edge[i]);
        entries.emplace_back(row, static_cast<int>(spoke.j), -group_weights.fraction[s] * edge[i]);
      }
    }
  }
  SparseMatrix matrix(3 * groups.count, rest.rows());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

double spokes_energy(PointsView rest, const std::vector<Spoke>& spokes,
  const RotationGroups& groups, PointsView posed, const std::vector<Eigen::Matrix3d>& rotations)
{
  double sum = 0.0;
  for (const Spoke& spoke : spokes)
  {
    const Vec3 edge = (rest.row(spoke.i) - rest.row(spoke.j)).transpose();
    const Vec3 moved = (posed.row(spoke.i) - posed.row(spoke.j)).transpose();
    const GroupWeights<2> group_weights = make_group_weights(spoke, groups);
    for (int s = 0; s < group_weights.count; ++s)
    {
      const Eigen::Matrix3d& rotation = rotations[static_cast<std::size_t>(group_weights.group[s])];
      sum +=
        0.5 * group_weights.fraction[s] * spoke.weight * (moved - rotation * edge).squaredNorm();
    }
  }
  return sum;
}

template <typename Elements, int Corners>
SparseMatrix make_covariance(
  PointsView rest, const Elements& elements, const RotationGroups& groups)
{
  if (groups.energy == ArapEnergy::spokes)
  {
    return spokes_covariance(rest, spokes_of(stiffness_matrix(rest, elements), nullptr), groups);
  }
  const auto& edges = edges_of(elements);
  const auto c = cotangent_weights(rest, elements);
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(static_cast<std::size_t>(elements.rows()) * Corners * 4);
  for (Index e = 0; e < elements.rows(); ++e)
  {
    // b_i = sum over j of c_ij (v_i - v_j), with cotangent weights c_ij and rest positions v. The
    // outer product of b_i and the posed vertex i is the contribution of vertex i to the covariance
    // S of this element.
    Vec3 b[Corners];
    std::fill(b, b + Corners, Vec3::Zero());
    for (Index k = 0; k < c.cols(); ++k)
    {
      const int i = edges[k][0], j = edges[k][1];
      const Vec3 edge = (rest.row(elements(e, i)) - rest.row(elements(e, j))).transpose();
      b[i] += c(e, k) * edge;
      b[j] -= c(e, k) * edge;
    }
    const auto group_weights = make_group_weights<Elements, Corners>(elements, e, groups);
    for (int s = 0; s < group_weights.count; ++s)
    {
      for (int corner = 0; corner < Corners; ++corner)
      {
        for (int i = 0; i < 3; ++i)
        {
          entries.emplace_back(static_cast<int>(i * groups.count + group_weights.group[s]),
            static_cast<int>(elements(e, corner)), group_weights.fraction[s] * b[corner][i]);
        }
      }
    }
  }
  SparseMatrix matrix(3 * groups.count, rest.rows());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <typename Elements, int Corners>
double sum_energy(PointsView rest, const Elements& elements, const RotationGroups& groups,
  PointsView posed, const std::vector<Eigen::Matrix3d>& rotations)
{
  if (groups.energy == ArapEnergy::spokes)
  {
    return spokes_energy(
      rest, spokes_of(stiffness_matrix(rest, elements), nullptr), groups, posed, rotations);
  }
  const auto& edges = edges_of(elements);
  const auto c = cotangent_weights(rest, elements);
  double sum = 0.0;
  for (Index e = 0; e < elements.rows(); ++e)
  {
    const auto group_weights = make_group_weights<Elements, Corners>(elements, e, groups);
    for (int s = 0; s < group_weights.count; ++s)
    {
      const Eigen::Matrix3d& rotation = rotations[static_cast<std::size_t>(group_weights.group[s])];
      for (Index k = 0; k < c.cols(); ++k)
      {
        const Index i = elements(e, edges[k][0]), j = elements(e, edges[k][1]);
        const Vec3 edge = (rest.row(i) - rest.row(j)).transpose();
        const Vec3 moved = (posed.row(i) - posed.row(j)).transpose();
        sum += 0.5 * group_weights.fraction[s] * c(e, k) * (moved - rotation * edge).squaredNorm();
      }
    }
  }
  return sum;
}
} // namespace

const char* to_string(ArapEnergy energy, bool tets)
{
  switch (resolve_energy(energy, tets))
  {
    case ArapEnergy::spokes_and_rims:
      return "spokes_and_rims";
    case ArapEnergy::spokes:
      return "spokes";
    default:
      return tets ? "tetrahedra" : "triangles";
  }
}

ArapEnergy resolve_energy(ArapEnergy energy, bool tets)
{
  if (energy != ArapEnergy::automatic)
  {
    return energy;
  }
  return tets ? ArapEnergy::elements : ArapEnergy::spokes_and_rims;
}

SparseMatrix arap_stiffness(
  PointsView rest, TrianglesView triangles, ArapEnergy energy, Index* ignored_edges)
{
  return make_stiffness(rest, triangles, energy, ignored_edges);
}

SparseMatrix arap_stiffness(PointsView rest, TetsView tets, ArapEnergy energy, Index* ignored_edges)
{
  return make_stiffness(rest, tets, energy, ignored_edges);
}

std::string ignored_edges_warning(Index ignored_edges)
{
  if (ignored_edges == 0)
  {
    return {};
  }
  return std::to_string(ignored_edges) +
    (ignored_edges == 1
        ? " edge has a negative cotangent weight (obtuse angles opposite to it)"
        : " edges have negative cotangent weights (obtuse angles opposite to them)") +
    ", which the energy 'spokes' ignores; the energy 'spokes-and-rims' uses all edges";
}

RotationGroups rotation_groups(
  ArapEnergy energy, TrianglesView triangles, Index count, std::vector<Index> vertex_labels)
{
  return make_groups<TrianglesView, 3>(energy, triangles, count, std::move(vertex_labels));
}

RotationGroups rotation_groups(
  ArapEnergy energy, TetsView tets, Index count, std::vector<Index> vertex_labels)
{
  return make_groups<TetsView, 4>(energy, tets, count, std::move(vertex_labels));
}

SparseMatrix covariance_matrix(
  PointsView rest, TrianglesView triangles, const RotationGroups& groups)
{
  return make_covariance<TrianglesView, 3>(rest, triangles, groups);
}

SparseMatrix covariance_matrix(PointsView rest, TetsView tets, const RotationGroups& groups)
{
  return make_covariance<TetsView, 4>(rest, tets, groups);
}

double arap_energy(PointsView rest, TrianglesView triangles, const RotationGroups& groups,
  PointsView posed, const std::vector<Eigen::Matrix3d>& rotations)
{
  return sum_energy<TrianglesView, 3>(rest, triangles, groups, posed, rotations);
}

double arap_energy(PointsView rest, TetsView tets, const RotationGroups& groups, PointsView posed,
  const std::vector<Eigen::Matrix3d>& rotations)
{
  return sum_energy<TetsView, 4>(rest, tets, groups, posed, rotations);
}

} // namespace bindpose

// Every energy here is a sum over elements, a group's share of the element, and the element's edges
// with their cotangent weights. Elements: one group has the whole share. Spokes and rims: each
// vertex' group has one third (triangle) or one quarter (tet); equal groups are added up first.
#include "pose/arap_energy.h"

#include <algorithm>
#include <array>

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

/// The groups that an element's edges belong to, with their shares, which sum to one.
template <int Corners>
struct Shares
{
  std::array<Index, Corners> group;
  std::array<double, Corners> share;
  int count = 0;

  void add(Index g, double s)
  {
    for (int i = 0; i < this->count; ++i)
    {
      if (this->group[i] == g)
      {
        this->share[i] += s;
        return;
      }
    }
    this->group[this->count] = g;
    this->share[this->count] = s;
    ++this->count;
  }
};

template <typename Elements, int Corners>
Shares<Corners> shares_of(const Elements& elements, Index e, const RotationGroups& groups)
{
  Shares<Corners> shares;
  if (groups.energy == ArapEnergy::elements)
  {
    shares.add(groups.of_element[static_cast<std::size_t>(e)], 1.0);
    return shares;
  }
  for (int k = 0; k < Corners; ++k)
  {
    shares.add(groups.of_vertex[static_cast<std::size_t>(elements(e, k))], 1.0 / Corners);
  }
  return shares;
}

template <typename Elements, int Corners>
RotationGroups make_groups(
  ArapEnergy energy, const Elements& elements, Index count, std::vector<Index> vertex_labels)
{
  RotationGroups groups;
  groups.energy = energy;
  groups.count = count;
  groups.of_vertex = std::move(vertex_labels);
  if (energy != ArapEnergy::elements)
  {
    return groups;
  }
  groups.of_element.resize(static_cast<std::size_t>(elements.rows()));
  std::vector<Index> fresh(static_cast<std::size_t>(count), -1);
  groups.count = 0;
  for (Index e = 0; e < elements.rows(); ++e)
  {
    std::array<Index, Corners> labels;
    for (int k = 0; k < Corners; ++k)
    {
      labels[k] = groups.of_vertex[static_cast<std::size_t>(elements(e, k))];
    }
    std::sort(labels.begin(), labels.end());
    Index best = labels[0];
    std::ptrdiff_t most = 0;
    for (const Index label : labels)
    {
      const std::ptrdiff_t votes = std::count(labels.begin(), labels.end(), label);
      if (votes > most)
      {
        most = votes;
        best = label;
      }
    }
    Index& name = fresh[static_cast<std::size_t>(best)];
    if (name < 0)
    {
      name = groups.count++;
    }
    groups.of_element[static_cast<std::size_t>(e)] = name;
  }
  return groups;
}

template <typename Elements, int Corners>
SparseMatrix make_covariance(
  PointsView rest, const Elements& elements, const RotationGroups& groups)
{
  const auto& edges = edges_of(elements);
  const auto c = cotangent_weights(rest, elements);
  std::vector<Eigen::Triplet<double, int>> entries;
  entries.reserve(static_cast<std::size_t>(elements.rows()) * Corners * 4);
  for (Index e = 0; e < elements.rows(); ++e)
  {
    // b_i = sum_j c_ij (v_i - v_j): what vertex i of this element contributes to S.
    Vec3 b[Corners];
    std::fill(b, b + Corners, Vec3::Zero());
    for (Index k = 0; k < c.cols(); ++k)
    {
      const int i = edges[k][0], j = edges[k][1];
      const Vec3 edge = (rest.row(elements(e, i)) - rest.row(elements(e, j))).transpose();
      b[i] += c(e, k) * edge;
      b[j] -= c(e, k) * edge;
    }
    const auto shares = shares_of<Elements, Corners>(elements, e, groups);
    for (int s = 0; s < shares.count; ++s)
    {
      for (int corner = 0; corner < Corners; ++corner)
      {
        for (int i = 0; i < 3; ++i)
        {
          entries.emplace_back(static_cast<int>(i * groups.count + shares.group[s]),
            static_cast<int>(elements(e, corner)), shares.share[s] * b[corner][i]);
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
  const auto& edges = edges_of(elements);
  const auto c = cotangent_weights(rest, elements);
  double sum = 0.0;
  for (Index e = 0; e < elements.rows(); ++e)
  {
    const auto shares = shares_of<Elements, Corners>(elements, e, groups);
    for (int s = 0; s < shares.count; ++s)
    {
      const Eigen::Matrix3d& rotation = rotations[static_cast<std::size_t>(shares.group[s])];
      for (Index k = 0; k < c.cols(); ++k)
      {
        const Index i = elements(e, edges[k][0]), j = elements(e, edges[k][1]);
        const Vec3 edge = (rest.row(i) - rest.row(j)).transpose();
        const Vec3 moved = (posed.row(i) - posed.row(j)).transpose();
        sum += 0.5 * shares.share[s] * c(e, k) * (moved - rotation * edge).squaredNorm();
      }
    }
  }
  return sum;
}
} // namespace

const char* to_string(ArapEnergy energy, bool tets)
{
  if (energy == ArapEnergy::spokes_and_rims || (energy == ArapEnergy::automatic && !tets))
  {
    return "spokes_and_rims";
  }
  return tets ? "tetrahedra" : "triangles";
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

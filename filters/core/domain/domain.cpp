// Checks, components and adjacency of the mesh on which weights are solved (see domain.h).
#include "domain/domain.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace bindpose
{

Domain tet_domain(const TetMesh& mesh)
{
  Domain domain;
  domain.points = mesh.points;
  domain.tets = mesh.tets;
  return domain;
}

Status choose_working_frame(const Domain& domain, const std::string& subject, WorkingFrame& frame)
{
  return domain.is_volume()
    ? WorkingFrame::choose(domain.points, TetsView(domain.tets), subject, frame)
    : WorkingFrame::choose(domain.points, TrianglesView(domain.triangles), subject, frame);
}

Status check_domain(const Domain& domain)
{
  if (domain.element_count() == 0)
  {
    return Status::invalid_input("the mesh is empty: it has neither tets nor triangles");
  }
  Status status = domain.is_volume() ? check_mesh(domain.points, domain.tets)
                                     : check_mesh(domain.points, domain.triangles);
  if (!status.ok())
  {
    return status;
  }
  if (!domain.is_volume())
  {
    return surface_area(domain.points, domain.triangles) > 0.0
      ? status
      : Status::invalid_input("the surface has no area");
  }
  const Eigen::VectorXd volumes = tet_volumes(domain.points, domain.tets);
  Index first = -1;
  Index count = 0;
  for (Index t = 0; t < volumes.size(); ++t)
  {
    if (!(volumes[t] > 0.0))
    {
      first = first < 0 ? t : first;
      ++count;
    }
  }
  return count == 0
    ? status
    : Status::invalid_input(std::to_string(count) + " of " + std::to_string(volumes.size()) +
        " tets have a volume that is not positive; the first is tet " + std::to_string(first));
}

const char* element_name(const Domain& domain)
{
  return domain.is_volume() ? "tet" : "triangle";
}

namespace
{
bool has_area(const Domain& domain, Index triangle)
{
  const Vec3 a = domain.points.row(domain.triangles(triangle, 0));
  const Vec3 b = domain.points.row(domain.triangles(triangle, 1));
  const Vec3 c = domain.points.row(domain.triangles(triangle, 2));
  return (b - a).cross(c - a).norm() > 0.0;
}
} // namespace

std::vector<char> measurable_elements(const Domain& domain)
{
  std::vector<char> result(static_cast<std::size_t>(domain.element_count()), 1);
  for (Index t = 0; t < domain.element_count() && !domain.is_volume(); ++t)
  {
    result[t] = has_area(domain, t);
  }
  return result;
}

Triangles measurable_triangles(const Domain& domain)
{
  Triangles result(domain.triangles.rows(), 3);
  Index count = 0;
  for (Index t = 0; t < domain.triangles.rows(); ++t)
  {
    if (has_area(domain, t))
    {
      result.row(count++) = domain.triangles.row(t);
    }
  }
  result.conservativeResize(count, 3);
  return result;
}

Components connected_components(const Domain& domain)
{
  const Index n = domain.points.rows();
  return domain.is_volume() ? connected_components(n, domain.tets)
                            : connected_components(n, measurable_triangles(domain));
}

double mean_edge_length(const Domain& domain, Index element)
{
  const int corners = domain.corners();
  const Index* ids = domain.element(element);
  double sum = 0.0;
  for (int i = 0; i < corners; ++i)
  {
    for (int j = i + 1; j < corners; ++j)
    {
      sum += (domain.points.row(ids[i]) - domain.points.row(ids[j])).norm();
    }
  }
  return sum / (corners * (corners - 1) / 2);
}

bool is_flat(PointsView points, double diagonal, Vec3& normal)
{
  const Vec3 center = points.colwise().mean();
  const Points centered = points.rowwise() - center.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(centered.transpose() * centered);
  normal = axes.eigenvectors().col(0);
  constexpr double flatness_tolerance = 1e-9;
  return (centered * normal).cwiseAbs().maxCoeff() <= flatness_tolerance * diagonal;
}

VertexGraph vertex_graph(const Domain& domain)
{
  const Index vertex_count = domain.points.rows();
  const int corners = domain.corners();
  std::vector<std::pair<Index, Index>> edges;
  edges.reserve(static_cast<std::size_t>(domain.element_count() * corners * (corners - 1)));
  for (Index e = 0; e < domain.element_count(); ++e)
  {
    const Index* ids = domain.element(e);
    for (int i = 0; i < corners; ++i)
    {
      for (int j = 0; j < corners; ++j)
      {
        if (ids[i] != ids[j])
        {
          edges.emplace_back(ids[i], ids[j]);
        }
      }
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  VertexGraph graph;
  graph.begin.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
  graph.neighbors.reserve(edges.size());
  for (const auto& [from, to] : edges)
  {
    graph.begin[from + 1] += 1;
    graph.neighbors.push_back(to);
  }
  for (Index v = 0; v < vertex_count; ++v)
  {
    graph.begin[v + 1] += graph.begin[v];
  }
  return graph;
}

} // namespace bindpose

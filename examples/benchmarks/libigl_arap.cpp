#include "libigl_arap.h"

#include <igl/arap_dof.h>
#include <igl/lbs_matrix.h>
#include <igl/partition.h>

#include <ctime>
#include <memory>
#include <vector>

namespace
{
struct Bound
{
  igl::ArapDOFData<Eigen::MatrixXd, float> data;
  Eigen::VectorXd targets;
  Eigen::MatrixXd rest, transforms;
};
std::unique_ptr<Bound> bound;
} // namespace

extern "C" __attribute__((visibility("default"))) void libigl_arap_bind(
  const LibiglMesh* mesh, int clusters, int held, const int* at, const double* targets)
{
  const int n = mesh->vertices, m = mesh->handles;
  constexpr int rows = Eigen::RowMajor;
  const Eigen::MatrixXd points =
    Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, rows>>(mesh->points, n, 3);
  const Eigen::MatrixXi triangles = Eigen::Map<const Eigen::Matrix<int, Eigen::Dynamic, 3, rows>>(
    mesh->corners, mesh->triangles, 3);
  const Eigen::MatrixXd weights = Eigen::Map<const Eigen::MatrixXd>(mesh->weights, n, m);
  bound = std::make_unique<Bound>();
  Eigen::MatrixXd blend;
  igl::lbs_matrix_column(points, weights, blend);
  Eigen::VectorXi groups, seeds;
  Eigen::VectorXd distances;
  igl::partition(weights, clusters, groups, seeds, distances);
  bound->data.energy = igl::ARAP_ENERGY_TYPE_SPOKES;
  bound->data.print_timings = false;
  bound->data.effective_dim = 3;
  igl::arap_dof_precomputation(points, triangles, blend, groups, bound->data);

  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < held; ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      for (int j = 0; j < blend.cols(); ++j)
      {
        entries.emplace_back(3 * i + c, j, blend(at[i] + c * n, j));
      }
    }
  }
  Eigen::SparseMatrix<double> constraints(3 * held, blend.cols());
  constraints.setFromTriplets(entries.begin(), entries.end());
  igl::arap_dof_recomputation(Eigen::VectorXi(), constraints, bound->data);
  bound->targets = Eigen::Map<const Eigen::VectorXd>(targets, 3 * held);
  bound->rest = Eigen::MatrixXd::Zero(12 * m, 1);
  for (int c = 0; c < 3; ++c)
  {
    bound->rest.block(3 * m * c + m * c, 0, m, 1).setOnes();
  }
}

extern "C" __attribute__((visibility("default"))) double libigl_arap_seconds(
  int solves, int iterations)
{
  const std::clock_t start = std::clock();
  for (int i = 0; i < solves; ++i)
  {
    igl::arap_dof_update(
      bound->data, bound->targets, bound->rest, iterations, 0.0, bound->transforms);
  }
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

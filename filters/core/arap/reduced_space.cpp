// Bind time of reduced as-rigid-as-possible: the mesh's stiffness L and covariance sums K are
// projected once on the skinning space V' = V + M D. Column block j of M is w_j ((x - c_j) / s_j,
// 1), with a separate coordinate frame per column of weights. With one frame for all columns, the
// matrices would be ill-conditioned: the coordinates would be nearly constant over the vertices of
// a handle that moves a small part of the mesh.
#include "arap/reduced_space.h"

#include "arap/skinning_eigenmodes.h"
#include "arap/weight_clusters.h"
#include "base/parallel.h"
#include "linear/dense_product.h"

#include <Eigen/LU>

#include <cmath>
#include <numeric>

namespace bindpose
{

namespace
{
/// Number of row ranges ("strips") of the mesh whose partial sums are added in order. It affects
/// the round-off of the sums; the number of threads does not.
constexpr Index strips = 16;
constexpr Index rows_per_block = 256;
/// A pivot within this distance of a vertex is treated as the vertex; in bounding-box diagonals.
constexpr double pivot_tolerance = 1e-9;
/// A pivot within this distance of a triangle is on the triangle; in bounding-box diagonals.
constexpr double on_surface = 1e-6;

/// Compute barycentric coordinates in a tet. Return false if the point is outside or the tet is
/// flat.
bool locate(
  PointsView points, const TetsView& tets, Index e, const Vec3& p, double, Eigen::Vector4d& lambda)
{
  const Vec3 d = points.row(tets(e, 3));
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k)
  {
    edges.col(k) = points.row(tets(e, k)).transpose() - d;
  }
  if (edges.determinant() == 0.0)
  {
    return false;
  }
  lambda.head<3>() = edges.inverse() * (p - d);
  lambda[3] = 1.0 - lambda.head<3>().sum();
  return lambda.allFinite() && lambda.minCoeff() >= -1e-9;
}

/// Project p onto the plane of a triangle, and compute the barycentric coordinates of the
/// projection. Return false if the projection is outside the triangle or if p is too far from the
/// plane.
bool locate(PointsView points, const TrianglesView& triangles, Index e, const Vec3& p,
  double diagonal, Eigen::Vector4d& lambda)
{
  const Vec3 a = points.row(triangles(e, 0)), b = points.row(triangles(e, 1)),
             c = points.row(triangles(e, 2));
  const Vec3 n = (b - a).cross(c - a);
  const double area2 = n.squaredNorm();
  if (area2 == 0.0 || std::abs(n.dot(p - a)) > on_surface * diagonal * std::sqrt(area2))
  {
    return false;
  }
  lambda << n.dot((b - p).cross(c - p)) / area2, n.dot((c - p).cross(a - p)) / area2,
    n.dot((a - p).cross(b - p)) / area2, 0.0;
  return lambda.allFinite() && lambda.minCoeff() >= -1e-9;
}

const char* element_key(const TetsView&)
{
  return "counts.tets";
}
const char* element_key(const TrianglesView&)
{
  return "counts.triangles";
}
} // namespace

void ReducedSpace::basis_row(const double* weights, const Vec3& point, double* row) const
{
  for (Index j = 0; j < this->columns; ++j)
  {
    const double w = weights[j];
    const auto i = static_cast<std::size_t>(j);
    const double f = w / this->sizes[i];
    row[4 * j] = f * (point[0] - this->centers[i][0]);
    row[4 * j + 1] = f * (point[1] - this->centers[i][1]);
    row[4 * j + 2] = f * (point[2] - this->centers[i][2]);
    row[4 * j + 3] = w;
  }
}

template <typename Elements>
void ReducedSpace::find_pivots(PointsView points, const Elements& elements, WeightsView weights)
{
  const auto count = static_cast<Index>(this->handles.size());
  this->pivot_rows = Eigen::MatrixXd::Zero(2 * count, 4 * this->columns);
  Eigen::RowVectorXd row(4 * this->columns);
  std::vector<Index> unlocated_ends;
  const auto end_position = [&](Index end) -> const Vec3&
  {
    const Handle& handle = this->handles[static_cast<std::size_t>(end % count)];
    return end < count ? handle.head : handle.tail;
  };
  for (Index end = 0; end < 2 * count; ++end)
  {
    const Handle& handle = this->handles[static_cast<std::size_t>(end % count)];
    if (end >= count && handle.kind != HandleKind::bone)
    {
      continue;
    }
    // Default, used if the pivot is not on the mesh: the pivot moves with the handle's own
    // transform.
    Eigen::VectorXd unit = Eigen::VectorXd::Unit(this->columns, end % count);
    this->basis_row(unit.data(), end_position(end), row.data());
    this->pivot_rows.row(end) = row;
    if (handle.kind == HandleKind::region)
    {
      continue; // a region moves as one body, so its pivot needs no point of the mesh
    }
    Index nearest = 0;
    const double distance = std::sqrt((points.rowwise() - end_position(end).transpose())
                                        .rowwise()
                                        .squaredNorm()
                                        .minCoeff(&nearest));
    if (distance <= pivot_tolerance * this->diagonal)
    {
      const Vec3 vertex_point = points.row(nearest);
      this->basis_row(weights.row(nearest).data(), vertex_point, row.data());
      this->pivot_rows.row(end) = row;
      continue;
    }
    unlocated_ends.push_back(end);
  }
  constexpr int corners = Elements::ColsAtCompileTime;
  for (Index e = 0; e < elements.rows() && !unlocated_ends.empty(); ++e)
  {
    Box box;
    for (int k = 0; k < corners; ++k)
    {
      box.add(points.row(elements(e, k)).transpose());
    }
    const double margin = on_surface * this->diagonal;
    for (std::size_t i = 0; i < unlocated_ends.size(); ++i)
    {
      const Vec3 p = end_position(unlocated_ends[i]);
      Eigen::Vector4d lambda;
      if (((p - box.lower).array() < -margin).any() || ((p - box.upper).array() > margin).any() ||
        !locate(points, elements, e, p, this->diagonal, lambda))
      {
        continue;
      }
      this->pivot_rows.row(unlocated_ends[i]).setZero();
      for (int k = 0; k < corners; ++k)
      {
        const Vec3 vertex_point = points.row(elements(e, k));
        this->basis_row(weights.row(elements(e, k)).data(), vertex_point, row.data());
        this->pivot_rows.row(unlocated_ends[i]) += lambda[k] * row;
      }
      unlocated_ends.erase(unlocated_ends.begin() + static_cast<std::ptrdiff_t>(i));
      --i;
    }
  }
}

bool ReducedSpace::project_stiffness(ExecutionContext& context, PointsView points,
  const SparseMatrix& stiffness_matrix, WeightsView weights)
{
  const Index n = points.rows(), size = 4 * this->columns;
  const Index strip = (n + strips - 1) / strips;
  std::vector<Weights> sums(static_cast<std::size_t>(strips));
  std::vector<Eigen::VectorXd> squares(static_cast<std::size_t>(strips));
  // M is computed in blocks of rows, because the whole matrix would be the largest object in
  // memory.
  const bool done = parallel_for(context, strips, 1,
    [&](Index s, Index)
    {
      Weights& sum = sums[static_cast<std::size_t>(s)];
      Eigen::VectorXd& square = squares[static_cast<std::size_t>(s)];
      sum = Weights::Zero(size, size);
      square = Eigen::VectorXd::Zero(size);
      Weights m(rows_per_block, size), lm(rows_per_block, size);
      Eigen::RowVectorXd row(size);
      for (Index begin = s * strip; begin < std::min(n, (s + 1) * strip); begin += rows_per_block)
      {
        if (context.canceled())
        {
          return;
        }
        const Index rows = std::min(std::min(n, (s + 1) * strip) - begin, rows_per_block);
        lm.setZero();
        for (Index r = 0; r < rows; ++r)
        {
          const Index v = begin + r;
          this->basis_row(weights.row(v).data(), points.row(v).transpose(), m.row(r).data());
          for (SparseMatrix::InnerIterator it(stiffness_matrix, v); it; ++it)
          {
            this->basis_row(
              weights.row(it.row()).data(), points.row(it.row()).transpose(), row.data());
            lm.row(r) += it.value() * row;
          }
        }
        add_product({ m.data(), size, rows, 1, size }, { lm.data(), rows, size, size, 1 },
          sum.data(), size, true);
        square += m.topRows(rows).colwise().squaredNorm().transpose();
      }
    });
  if (!done || context.canceled())
  {
    return false;
  }
  Eigen::VectorXd square = squares[0];
  for (std::size_t s = 1; s < sums.size(); ++s)
  {
    sums[0] += sums[s];
    sums[s].resize(0, 0);
    square += squares[s];
  }
  this->stiffness = Eigen::MatrixXd(sums[0].selfadjointView<Eigen::Lower>());
  // A column is empty if the displacements that it causes are invisible: their root mean square is
  // at most 1e-12 bounding-box diagonals.
  const double count = static_cast<double>(std::max<Index>(n, 1));
  this->basis_scale =
    (square / count)
      .unaryExpr([](double mean) { return mean > 1e-24 ? 1.0 / std::sqrt(mean) : 0.0; });
  return true;
}

void ReducedSpace::project_mass(
  PointsView points, const Eigen::VectorXd& masses, WeightsView weights)
{
  const Index size = 4 * this->columns;
  this->mass = Eigen::MatrixXd::Zero(size, size);
  this->mass_sums = Eigen::VectorXd::Zero(size);
  Weights m(rows_per_block, size);
  for (Index begin = 0; begin < points.rows(); begin += rows_per_block)
  {
    const Index rows = std::min(points.rows() - begin, rows_per_block);
    for (Index r = 0; r < rows; ++r)
    {
      const Index v = begin + r;
      this->basis_row(weights.row(v).data(), points.row(v).transpose(), m.row(r).data());
      this->mass_sums += masses[v] * m.row(r).transpose();
      m.row(r) *= std::sqrt(masses[v]);
    }
    this->mass.selfadjointView<Eigen::Lower>().rankUpdate(m.topRows(rows).transpose());
  }
  this->mass.triangularView<Eigen::StrictlyUpper>() = this->mass.transpose();
}

void ReducedSpace::project_covariance(
  PointsView points, const SparseMatrix& covariance_matrix, WeightsView weights, Index handle_count)
{
  const Index clusters = this->groups.count;
  this->stride = (clusters + 7) / 8 * 8;
  this->covariance = Eigen::MatrixXd::Zero(3 * clusters, 4 * this->columns);
  // `product` is row-major, because the loop below adds to whole rows. After the loop it is copied
  // to the column-major member `covariance`.
  Weights product = Weights::Zero(3 * clusters, 4 * this->columns);
  this->cluster_weights = Eigen::MatrixXd::Zero(clusters, handle_count);
  this->rest_covariance.assign(static_cast<std::size_t>(9 * this->stride), 0.0);
  Eigen::VectorXd cluster_mass = Eigen::VectorXd::Zero(clusters);
  Eigen::RowVectorXd row(4 * this->columns);
  const Vec3 middle = bounding_box(points).center();
  for (Index v = 0; v < points.rows(); ++v)
  {
    const Vec3 p = points.row(v);
    this->basis_row(weights.row(v).data(), p, row.data());
    for (SparseMatrix::InnerIterator it(covariance_matrix, v); it; ++it)
    {
      const Index i = it.row() / clusters, k = it.row() % clusters;
      product.row(it.row()) += it.value() * row;
      for (int j = 0; j < 3; ++j)
      {
        this->rest_covariance[static_cast<std::size_t>((3 * i + j) * this->stride + k)] +=
          it.value() * (p[j] - middle[j]);
      }
      // The sum of squared entries measures the influence of a vertex on a cluster, independently
      // of the coordinate frame.
      const double square = it.value() * it.value();
      this->cluster_weights.row(k) += square * weights.row(v).head(handle_count).cwiseAbs();
      cluster_mass[k] += square;
    }
  }
  this->covariance = product;
  for (Index k = 0; k < clusters; ++k)
  {
    if (cluster_mass[k] > 0.0)
    {
      this->cluster_weights.row(k) /= cluster_mass[k];
    }
  }
}

template <typename Elements>
Status ReducedSpace::bind(ExecutionContext& context, PointsView points, const Elements& elements,
  WeightsView weights, const Handles& input_handles, const ReducedArapOptions& options)
{
  *this = ReducedSpace();
  Status status = check_mesh_and_handles(points, elements, input_handles);
  WorkingFrame own_frame;
  if (status.ok())
  {
    status = WorkingFrame::choose(points, elements, "the mesh", own_frame);
  }
  if (!status.ok())
  {
    return status;
  }
  if (!own_frame.is_identity())
  {
    status = this->bind(context, own_frame.to_frame(points), elements, weights,
      to_frame(own_frame, input_handles), options);
    this->frame = own_frame;
    return status;
  }
  if (weights.rows() != points.rows())
  {
    return Status::invalid_input("the weights have " + std::to_string(weights.rows()) +
      " rows, but there are " + std::to_string(points.rows()) + " vertices");
  }
  if (weights.cols() != static_cast<Index>(input_handles.size()))
  {
    return Status::invalid_input("the weights have " + std::to_string(weights.cols()) +
      " columns, but there are " + std::to_string(input_handles.size()) + " handles");
  }
  {
    Phase phase(context, "copy_weights", 0.0, 0.1);
    status = this->skinning.bind(context, weights, options.skinning);
    if (!status.ok())
    {
      return status;
    }
  }
  this->handles = input_handles;
  this->diagonal = bounding_box(points).diagonal();
  const Eigen::RowVector3d middle = points.colwise().mean();
  this->radius = std::sqrt((points.rowwise() - middle).rowwise().squaredNorm().mean());
  const auto handle_count = static_cast<Index>(input_handles.size());
  std::string empty_names;
  for (Index j = 0; j < handle_count; ++j)
  {
    if (weights.col(j).isZero(0.0))
    {
      empty_names +=
        (empty_names.empty() ? "'" : ", '") + input_handles[static_cast<std::size_t>(j)].name + "'";
    }
  }
  if (!empty_names.empty())
  {
    status.warnings.push_back(
      "these handles have no effect because all their weights are zero: " + empty_names);
  }

  Weights all = weights;
  Clusters clusters;
  const bool tets = Elements::ColsAtCompileTime == 4;
  const ArapEnergy energy = resolve_energy(options.energy, tets);
  Index ignored_edges = 0;
  const SparseMatrix laplacian = arap_stiffness(points, elements, energy, &ignored_edges);
  if (ignored_edges > 0)
  {
    status.warnings.push_back(ignored_edges_warning(ignored_edges));
  }
  const bool modes = options.extra_weights > 0 && options.extra_kind == ExtraWeights::eigenmodes;
  const Eigen::VectorXd masses =
    modes || options.mass ? lumped_mass(points, elements) : Eigen::VectorXd();
  {
    Phase phase(context, "clusters", 0.1, 0.5);
    if (options.extra_weights > 0)
    {
      Weights extra;
      if (modes)
      {
        Eigenmodes found;
        const Status solved = skinning_eigenmodes(
          context, laplacian, masses, handle_vertices(weights), options.extra_weights, found);
        if (!solved.usable())
        {
          return solved;
        }
        extra = std::move(found.modes);
      }
      else
      {
        extra = spline_bumps(context, weights, options.extra_weights);
      }
      all.resize(weights.rows(), weights.cols() + extra.cols());
      all << weights, extra;
      const Status bind_status = this->skinning.bind(context, all, options.skinning);
      if (!bind_status.ok())
      {
        return bind_status;
      }
    }
    const Index cluster_count = options.clusters > 0 ? options.clusters : 4 * all.cols();
    if (cluster_count >= points.rows())
    {
      clusters.count = points.rows();
      clusters.cluster_of_row.resize(static_cast<std::size_t>(points.rows()));
      std::iota(clusters.cluster_of_row.begin(), clusters.cluster_of_row.end(), Index(0));
    }
    else if (!cluster_rows(context, weights, cluster_count, clusters))
    {
      return Status::canceled();
    }
    this->groups =
      rotation_groups(energy, elements, clusters.count, std::move(clusters.cluster_of_row));
    if (cluster_count >= points.rows() && energy == ArapEnergy::elements)
    {
      this->groups.count = elements.rows();
      this->groups.group_of_element.resize(static_cast<std::size_t>(elements.rows()));
      std::iota(
        this->groups.group_of_element.begin(), this->groups.group_of_element.end(), Index(0));
    }
    status.report.set("method", to_string(energy, tets));
  }

  Phase phase(context, "project", 0.5, 1.0);
  this->columns = all.cols();
  for (Index j = 0; j < this->columns; ++j)
  {
    const Eigen::VectorXd w = all.col(j).cwiseAbs();
    const double total = w.sum();
    Vec3 center =
      total > 0.0 ? Vec3(points.transpose() * w / total) : bounding_box(points).center();
    const double standard_deviation = total > 0.0
      ? std::sqrt((points.rowwise() - center.transpose()).rowwise().squaredNorm().dot(w) / total)
      : 0.0;
    this->centers.push_back(center);
    this->sizes.push_back(standard_deviation > 1e-9 * this->diagonal
        ? standard_deviation
        : std::max(this->diagonal, 1e-300));
  }
  {
    if (!this->project_stiffness(context, points, laplacian, all))
    {
      return Status::canceled();
    }
    const Points centered = points.rowwise() - bounding_box(points).center().transpose();
    this->rest_energy = 0.5 * (centered.array() * (laplacian * centered).array()).sum();
  }
  if (options.mass)
  {
    this->project_mass(points, masses, all);
  }
  this->project_covariance(
    points, covariance_matrix(points, elements, this->groups), all, handle_count);
  this->find_pivots(points, elements, all);
  if (context.canceled())
  {
    return Status::canceled();
  }
  status.report.set("counts.vertices", Report::Value(std::int64_t(points.rows())));
  status.report.set(element_key(elements), Report::Value(std::int64_t(elements.rows())));
  status.report.set("counts.handles", Report::Value(std::int64_t(handle_count)));
  status.report.set("counts.clusters", Report::Value(std::int64_t(this->groups.count)));
  status.report.set(
    "counts.extra_weights", Report::Value(std::int64_t(this->columns - handle_count)));
  return status;
}

template Status ReducedSpace::bind(ExecutionContext& context, PointsView points,
  const TrianglesView& elements, WeightsView weights, const Handles& handles,
  const ReducedArapOptions& options);
template Status ReducedSpace::bind(ExecutionContext& context, PointsView points,
  const TetsView& elements, WeightsView weights, const Handles& handles,
  const ReducedArapOptions& options);

Eigen::Matrix<double, 4, 3> ReducedSpace::block_of(const Affine& transform, Index column) const
{
  const auto j = static_cast<std::size_t>(column);
  const Eigen::Matrix3d linear = transform.leftCols<3>() - Eigen::Matrix3d::Identity();
  Eigen::Matrix<double, 4, 3> block;
  block.topRows<3>() = this->sizes[j] * linear.transpose();
  block.row(3) = (linear * this->centers[j] + transform.col(3)).transpose();
  return block;
}

Affine ReducedSpace::affine_of(
  const Eigen::Ref<const Eigen::Matrix<double, 4, 3>>& block, Index column) const
{
  const auto j = static_cast<std::size_t>(column);
  const Eigen::Matrix3d linear = block.topRows<3>().transpose() / this->sizes[j];
  Affine transform;
  transform.leftCols<3>() = Eigen::Matrix3d::Identity() + linear;
  transform.col(3) = block.row(3).transpose() - linear * this->centers[j];
  return transform;
}

std::vector<Affine> ReducedSpace::transforms_of(const Rows& d, const Pose& pose) const
{
  std::vector<Affine> transforms;
  for (Index j = 0; j < this->columns; ++j)
  {
    const auto h = static_cast<std::size_t>(j);
    transforms.push_back(h < pose.size() && constrains_transform(pose[h].mode)
        ? pose[h].transform
        : from_frame(this->frame, this->affine_of(d.middleRows<4>(4 * j), j)));
  }
  return transforms;
}

} // namespace bindpose

// Creates the triangles of balls, bones and gizmo parts. A ball is a subdivided icosahedron,
// created once. A tube is a circle swept along a path without twist. A bone is an octahedron with
// the head, four corners around the axis near the head, and the tail. Each of its 8 faces has its
// own three corners, so that the shading is flat.
#include "handle_shapes.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace bindpose
{
namespace
{
struct Ball
{
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
};

Ball make_ball(int levels)
{
  const double t = 0.5 * (1.0 + std::sqrt(5.0));
  Ball ball;
  ball.vertices = { { -1, t, 0 }, { 1, t, 0 }, { -1, -t, 0 }, { 1, -t, 0 }, { 0, -1, t },
    { 0, 1, t }, { 0, -1, -t }, { 0, 1, -t }, { t, 0, -1 }, { t, 0, 1 }, { -t, 0, -1 },
    { -t, 0, 1 } };
  ball.triangles = { { 0, 11, 5 }, { 0, 5, 1 }, { 0, 1, 7 }, { 0, 7, 10 }, { 0, 10, 11 },
    { 1, 5, 9 }, { 5, 11, 4 }, { 11, 10, 2 }, { 10, 7, 6 }, { 7, 1, 8 }, { 3, 9, 4 }, { 3, 4, 2 },
    { 3, 2, 6 }, { 3, 6, 8 }, { 3, 8, 9 }, { 4, 9, 5 }, { 2, 4, 11 }, { 6, 2, 10 }, { 8, 6, 7 },
    { 9, 8, 1 } };
  for (int level = 0; level < levels; ++level)
  {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b)
    {
      const auto key = std::minmax(a, b);
      const auto found = middles.find(key);
      if (found != middles.end())
      {
        return found->second;
      }
      ball.vertices.push_back(ball.vertices[a] + ball.vertices[b]);
      return middles[key] = static_cast<int>(ball.vertices.size()) - 1;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : ball.triangles)
    {
      const int ab = middle(a, b);
      const int bc = middle(b, c);
      const int ca = middle(c, a);
      finer.insert(finer.end(), { { a, ab, ca }, { b, bc, ab }, { c, ca, bc }, { ab, bc, ca } });
    }
    ball.triangles = finer;
    for (Eigen::Vector3d& vertex : ball.vertices)
    {
      vertex.normalize();
    }
  }
  return ball;
}
} // namespace

long long HandleShapes::add_vertex(
  const Eigen::Vector3d& position, const Eigen::Vector3d& normal, const Color& color)
{
  for (int k = 0; k < 3; ++k)
  {
    this->points_.push_back(static_cast<float>(position[k]));
    this->normals_.push_back(static_cast<float>(normal[k]));
    this->colors_.push_back(
      static_cast<unsigned char>(std::lround(255.0 * std::clamp(color[k], 0.0, 1.0))));
  }
  return static_cast<long long>(this->points_.size() / 3) - 1;
}

void HandleShapes::add_ball(const Eigen::Vector3d& center, double radius, const Color& color)
{
  static const Ball balls[2] = { make_ball(1), make_ball(2) };
  const Ball& ball = balls[this->fine_];
  const auto first = static_cast<long long>(this->points_.size() / 3);
  for (const Eigen::Vector3d& vertex : ball.vertices)
  {
    this->add_vertex(center + radius * vertex, vertex, color);
  }
  for (const auto& triangle : ball.triangles)
  {
    for (const int corner : triangle)
    {
      this->triangles_.push_back(first + corner);
    }
  }
}

void HandleShapes::add_bone(const Eigen::Vector3d& head, const Eigen::Vector3d& tail,
  double half_width, const Color& color, double margin)
{
  const double length = (tail - head).norm();
  if (!(length > 0.0))
  {
    return;
  }
  const Eigen::Vector3d axis = (tail - head) / length;
  const Eigen::Vector3d u = axis.unitOrthogonal();
  const Eigen::Vector3d v = axis.cross(u);
  const Eigen::Vector3d waist = head + 0.125 * length * axis;
  const double w = half_width + margin;
  const Eigen::Vector3d ends[2] = { head - margin * axis, tail + 2.0 * margin * axis };
  const Eigen::Vector3d corners[4] = { waist + w * u, waist + w * v, waist - w * u, waist - w * v };
  for (int side = 0; side < 4; ++side)
  {
    const Eigen::Vector3d& a = corners[side];
    const Eigen::Vector3d& b = corners[(side + 1) % 4];
    for (const bool at_tail : { false, true })
    {
      const Eigen::Vector3d& first = at_tail ? a : b;
      const Eigen::Vector3d& second = at_tail ? b : a;
      const Eigen::Vector3d& third = ends[at_tail ? 1 : 0];
      this->add_triangle(first, second, third, color);
    }
  }
}

void HandleShapes::add_triangle(
  const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Color& color)
{
  const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
  for (const Eigen::Vector3d* corner : { &a, &b, &c })
  {
    this->triangles_.push_back(this->add_vertex(*corner, normal, color));
  }
}

void HandleShapes::add_tube(
  const std::vector<Eigen::Vector3d>& path, double radius, const Color& color)
{
  constexpr int sides = 10;
  const std::size_t count = path.size();
  if (count < 2)
  {
    return;
  }
  const bool closed = count > 3 && path.front() == path.back();
  const auto direction = [&](std::size_t i)
  {
    const Eigen::Vector3d& before = i > 0 ? path[i - 1] : closed ? path[count - 2] : path[0];
    const Eigen::Vector3d& after = i + 1 < count ? path[i + 1] : closed ? path[1] : path[i];
    return Eigen::Vector3d((after - before).normalized());
  };
  Eigen::Vector3d u = direction(0).unitOrthogonal();
  std::vector<long long> rings;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Eigen::Vector3d tangent = direction(i);
    u = (u - tangent * tangent.dot(u)).normalized();
    const Eigen::Vector3d v = tangent.cross(u);
    for (int side = 0; side < sides; ++side)
    {
      const double angle = 2.0 * EIGEN_PI * side / sides;
      const Eigen::Vector3d normal = std::cos(angle) * u + std::sin(angle) * v;
      rings.push_back(this->add_vertex(path[i] + radius * normal, normal, color));
    }
  }
  for (std::size_t i = 0; i + 1 < count; ++i)
  {
    for (int side = 0; side < sides; ++side)
    {
      const long long a = rings[i * sides + side];
      const long long b = rings[i * sides + (side + 1) % sides];
      const long long c = rings[(i + 1) * sides + side];
      const long long d = rings[(i + 1) * sides + (side + 1) % sides];
      this->triangles_.insert(this->triangles_.end(), { a, b, d, a, d, c });
    }
  }
  for (const bool end : { false, true })
  {
    if (closed)
    {
      break;
    }
    const std::size_t i = end ? count - 1 : 0;
    const Eigen::Vector3d normal = (end ? 1.0 : -1.0) * direction(i);
    const long long center = this->add_vertex(path[i], normal, color);
    for (int side = 0; side < sides; ++side)
    {
      const long long a = rings[i * sides + side];
      const long long b = rings[i * sides + (side + 1) % sides];
      this->triangles_.insert(this->triangles_.end(), { center, end ? a : b, end ? b : a });
    }
  }
}

void HandleShapes::add_cone(
  const Eigen::Vector3d& base, const Eigen::Vector3d& tip, double radius, const Color& color)
{
  constexpr int sides = 20;
  const Eigen::Vector3d axis = (tip - base).normalized();
  const Eigen::Vector3d u = axis.unitOrthogonal();
  const Eigen::Vector3d v = axis.cross(u);
  const double slope = radius / (tip - base).norm();
  const auto around = [&](double side)
  {
    const double angle = 2.0 * EIGEN_PI * side / sides;
    return Eigen::Vector3d(std::cos(angle) * u + std::sin(angle) * v);
  };
  const auto normal_at = [&](double side)
  { return Eigen::Vector3d((around(side) + slope * axis).normalized()); };
  const long long center = this->add_vertex(base, -axis, color);
  for (int side = 0; side < sides; ++side)
  {
    const Eigen::Vector3d a = base + radius * around(side);
    const Eigen::Vector3d b = base + radius * around(side + 1);
    const long long corners[5] = { this->add_vertex(a, normal_at(side), color),
      this->add_vertex(b, normal_at(side + 1), color),
      this->add_vertex(tip, normal_at(side + 0.5), color), this->add_vertex(a, -axis, color),
      this->add_vertex(b, -axis, color) };
    this->triangles_.insert(this->triangles_.end(),
      { corners[0], corners[1], corners[2], center, corners[4], corners[3] });
  }
}

void HandleShapes::add_box(const Eigen::Vector3d& center, const Eigen::Matrix3d& frame,
  const Eigen::Vector3d& half, const Color& color)
{
  for (int k = 0; k < 3; ++k)
  {
    const Eigen::Vector3d u = half[(k + 1) % 3] * frame.col((k + 1) % 3);
    const Eigen::Vector3d v = half[(k + 2) % 3] * frame.col((k + 2) % 3);
    const Eigen::Vector3d w = half[k] * frame.col(k);
    for (const bool up : { false, true })
    {
      const Eigen::Vector3d middle = up ? Eigen::Vector3d(center + w) : center - w;
      const Eigen::Vector3d a = middle - u - v;
      const Eigen::Vector3d b = middle + u - v;
      const Eigen::Vector3d c = middle + u + v;
      const Eigen::Vector3d d = middle - u + v;
      this->add_triangle(a, up ? b : c, up ? c : b, color);
      this->add_triangle(a, up ? c : d, up ? d : c, color);
    }
  }
}

vtkSmartPointer<vtkPolyData> HandleShapes::polydata() const
{
  const auto count = static_cast<vtkIdType>(this->points_.size() / 3);
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(count);
  std::copy(this->points_.begin(), this->points_.end(), coordinates->GetPointer(0));
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(count);
  std::copy(this->normals_.begin(), this->normals_.end(), normals->GetPointer(0));
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Colors");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(count);
  std::copy(this->colors_.begin(), this->colors_.end(), colors->GetPointer(0));
  const auto triangles = static_cast<vtkIdType>(this->triangles_.size() / 3);
  vtkNew<vtkTypeInt64Array> offsets;
  offsets->SetNumberOfValues(triangles + 1);
  for (vtkIdType t = 0; t <= triangles; ++t)
  {
    offsets->SetValue(t, 3 * t);
  }
  vtkNew<vtkTypeInt64Array> connectivity;
  connectivity->SetNumberOfValues(3 * triangles);
  std::copy(this->triangles_.begin(), this->triangles_.end(), connectivity->GetPointer(0));

  auto result = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  vtkNew<vtkCellArray> cells;
  cells->SetData(offsets, connectivity);
  result->SetPoints(points);
  result->SetPolys(cells);
  result->GetPointData()->SetNormals(normals);
  result->GetPointData()->SetScalars(colors);
  return result;
}

} // namespace bindpose

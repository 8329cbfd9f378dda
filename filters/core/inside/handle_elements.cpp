// Sampling of handles at intervals of a local edge length. A line is divided into segments of equal
// length relative to the local edge length. A triangle is bisected at its longest edge until that
// edge is short enough; the samples are the midpoints of the bisected edges.
#include "inside/handle_elements.h"

#include "geometry/line_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace bindpose
{

namespace
{
constexpr double maximum = 1000.0; // maximum number of samples on a line

class Sampler
{
public:
  Sampler(const Points& points, const std::function<double(const Vec3&)>& length) : length_(length)
  {
    for (Index i = 0; i < points.rows(); ++i)
    {
      this->add(points.row(i));
    }
    this->chosen_ = static_cast<Index>(this->list_.size());
  }

  void line(const Vec3& a, const Vec3& b)
  {
    const double segment_length = (b - a).norm();
    if (!(segment_length > 0.0))
    {
      return;
    }
    const auto length = [&](double t)
    { return std::max(this->length_(a + t * (b - a)) / segment_length, 1.0 / maximum); };
    const auto pieces = [](double lengths)
    { return std::max(2, static_cast<int>(std::ceil(lengths))); };
    for (const double cut : line_cuts(0.0, 1.0, length, pieces))
    {
      this->add(a + cut * (b - a));
    }
  }

  void triangle(const Vec3& a, const Vec3& b, const Vec3& c)
  {
    const double shortest = std::max({ (a - b).norm(), (b - c).norm(), (c - a).norm() }) / maximum;
    std::vector<std::array<Vec3, 3>> left{ { a, b, c } };
    while (!left.empty())
    {
      const std::array<Vec3, 3> corners = left.back();
      left.pop_back();
      int longest = 0;
      const auto edge = [&](int k) { return (corners[(k + 1) % 3] - corners[k]).norm(); };
      for (int k = 1; k < 3; ++k)
      {
        longest = edge(k) > edge(longest) ? k : longest;
      }
      const Vec3& from = corners[longest];
      const Vec3& to = corners[(longest + 1) % 3];
      const Vec3& apex = corners[(longest + 2) % 3];
      const Vec3 middle = 0.5 * (from + to);
      if (edge(longest) <= std::max(shortest, this->length_(middle)))
      {
        continue;
      }
      this->add(middle);
      left.push_back({ from, middle, apex });
      left.push_back({ middle, to, apex });
    }
  }

  HandleSamples result() const
  {
    HandleSamples samples;
    samples.handle_point_count = this->chosen_;
    samples.points.resize(static_cast<Index>(this->list_.size()), 3);
    for (std::size_t i = 0; i < this->list_.size(); ++i)
    {
      samples.points.row(static_cast<Index>(i)) = this->list_[i];
    }
    return samples;
  }

private:
  void add(const Vec3& p)
  {
    if (this->added_positions_.insert({ p.x(), p.y(), p.z() }).second)
    {
      this->list_.push_back(p);
    }
  }

  const std::function<double(const Vec3&)>& length_;
  std::vector<Vec3> list_;
  Index chosen_ = 0;
  std::set<std::array<double, 3>> added_positions_;
};

template <typename Matrix>
Status check_ids(const Matrix& ids, Index count, const char* id_kind)
{
  for (Index i = 0; i < ids.rows(); ++i)
  {
    for (Index k = 0; k < ids.cols(); ++k)
    {
      if (ids(i, k) < 0 || ids(i, k) >= count)
      {
        return Status::invalid_input(std::string("handle ") + id_kind + " " + std::to_string(i) +
          " references point " + std::to_string(ids(i, k)) + ", but there are " +
          std::to_string(count) + " points");
      }
    }
  }
  return {};
}
} // namespace

Status check_handle_elements(const HandleElements& handle_elements)
{
  if (!handle_elements.points.allFinite())
  {
    return Status::invalid_input("a handle has a coordinate that is not finite");
  }
  Status status = check_ids(handle_elements.segments, handle_elements.points.rows(), "segment");
  return status.ok()
    ? check_ids(handle_elements.triangles, handle_elements.points.rows(), "triangle")
    : status;
}

HandleSamples sample_handle_elements(
  const HandleElements& handle_elements, const std::function<double(const Vec3&)>& length)
{
  Sampler sampler(handle_elements.points, length);
  for (Index s = 0; s < handle_elements.segments.rows(); ++s)
  {
    sampler.line(handle_elements.points.row(handle_elements.segments(s, 0)),
      handle_elements.points.row(handle_elements.segments(s, 1)));
  }
  for (Index t = 0; t < handle_elements.triangles.rows(); ++t)
  {
    sampler.triangle(handle_elements.points.row(handle_elements.triangles(t, 0)),
      handle_elements.points.row(handle_elements.triangles(t, 1)),
      handle_elements.points.row(handle_elements.triangles(t, 2)));
  }
  return sampler.result();
}

} // namespace bindpose

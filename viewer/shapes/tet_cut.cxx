// Selects the tets on one side of a plane and their visible faces. A face is visible if exactly one
// of its one or two tets is kept. Faces of neighboring tets are matched once, by sorting them by
// their vertices. A new plane then costs one pass over tet centers and one over faces.
#include "shapes/tet_cut.h"

#include <algorithm>

namespace bindpose
{
namespace
{
// Face k is opposite vertex k and oriented to point away from it.
constexpr int face_corners[4][3] = { { 1, 2, 3 }, { 0, 3, 2 }, { 0, 1, 3 }, { 0, 2, 1 } };
} // namespace

TetCut::TetCut(PointsView points, TetsView tets)
{
  struct Entry
  {
    std::array<Index, 3> key;
    Index at; // 4 * tet + index of the face in the tet
  };
  std::vector<Entry> entries;
  entries.reserve(4 * static_cast<std::size_t>(tets.rows()));
  this->centers_.resize(tets.rows(), 3);
  for (Index t = 0; t < tets.rows(); ++t)
  {
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < 4; ++k)
    {
      sum += points.row(tets(t, k)).transpose();
      std::array<Index, 3> key{ tets(t, face_corners[k][0]), tets(t, face_corners[k][1]),
        tets(t, face_corners[k][2]) };
      std::sort(key.begin(), key.end());
      entries.push_back({ key, 4 * t + k });
    }
    this->centers_.row(t) = 0.25 * sum.transpose();
  }
  std::sort(entries.begin(), entries.end(),
    [](const Entry& a, const Entry& b) { return a.key != b.key ? a.key < b.key : a.at < b.at; });
  // The other tet of each face; -1 if there is none, or if more than two tets share the face.
  std::vector<Index> other(entries.size(), -1);
  for (std::size_t i = 0, j = 0; i < entries.size(); i = j)
  {
    for (j = i + 1; j < entries.size() && entries[j].key == entries[i].key; ++j)
    {
    }
    if (j == i + 2)
    {
      other[entries[i].at] = entries[i + 1].at / 4;
      other[entries[i + 1].at] = entries[i].at / 4;
    }
  }
  for (std::size_t at = 0; at < other.size(); ++at)
  {
    const auto t = static_cast<Index>(at / 4);
    if (other[at] < t && other[at] >= 0)
    {
      continue; // the face is already stored as a facet of the other tet
    }
    const int* k = face_corners[at % 4];
    this->facets_.push_back({ { tets(t, k[0]), tets(t, k[1]), tets(t, k[2]) }, t, other[at] });
  }
  this->keep_all();
}

void TetCut::keep_all()
{
  this->kept_count_ = this->centers_.rows();
  this->kept_.assign(static_cast<std::size_t>(this->kept_count_), 1);
  this->find_faces();
}

void TetCut::keep_behind(const Vec3& origin, const Vec3& normal)
{
  const double at = origin.dot(normal);
  this->kept_count_ = 0;
  for (Index t = 0; t < this->centers_.rows(); ++t)
  {
    const double* c = this->centers_.data() + 3 * t;
    this->kept_[t] = c[0] * normal[0] + c[1] * normal[1] + c[2] * normal[2] <= at;
    this->kept_count_ += this->kept_[t];
  }
  this->find_faces();
}

void TetCut::find_faces()
{
  std::vector<Index> corners[2];
  FaceSet* const parts[2] = { &this->boundary_faces_, &this->exposed_faces_ };
  for (FaceSet* part : parts)
  {
    part->tets.clear();
  }
  for (const Facet& facet : this->facets_)
  {
    const bool first = this->kept_[facet.tet];
    const bool second = facet.other >= 0 && this->kept_[facet.other];
    if (first == second)
    {
      continue;
    }
    const int part = facet.other < 0 ? 0 : 1;
    parts[part]->tets.push_back(first ? facet.tet : facet.other);
    corners[part].push_back(facet.vertices[0]);
    corners[part].push_back(facet.vertices[first ? 1 : 2]);
    corners[part].push_back(facet.vertices[first ? 2 : 1]);
  }
  for (int part : { 0, 1 })
  {
    parts[part]->triangles = Eigen::Map<const Triangles>(
      corners[part].data(), static_cast<Index>(corners[part].size() / 3), 3);
  }
}

std::array<double, 2> TetCut::center_range(const Vec3& direction) const
{
  if (this->centers_.rows() == 0)
  {
    return { 0.0, 0.0 };
  }
  const Eigen::VectorXd coordinates = this->centers_ * direction;
  return { coordinates.minCoeff(), coordinates.maxCoeff() };
}

ShrunkTets shrink_tets(
  PointsView points, TetsView tets, const std::vector<char>& kept, double factor)
{
  ShrunkTets result;
  const auto count = static_cast<Index>(std::count(kept.begin(), kept.end(), 1));
  result.points.resize(4 * count, 3);
  result.triangles.resize(4 * count, 3);
  result.tets.resize(static_cast<std::size_t>(4 * count));
  result.vertices.resize(static_cast<std::size_t>(4 * count));
  Index row = 0;
  for (Index t = 0; t < tets.rows(); ++t)
  {
    if (!kept[t])
    {
      continue;
    }
    Eigen::RowVector3d center = Eigen::RowVector3d::Zero();
    for (int k = 0; k < 4; ++k)
    {
      center += 0.25 * points.row(tets(t, k));
    }
    for (int k = 0; k < 4; ++k)
    {
      result.points.row(row + k) = center + factor * (points.row(tets(t, k)) - center);
      result.vertices[row + k] = tets(t, k);
      result.tets[row + k] = t;
      for (int corner = 0; corner < 3; ++corner)
      {
        result.triangles(row + k, corner) = row + face_corners[k][corner];
      }
    }
    row += 4;
  }
  return result;
}

} // namespace bindpose

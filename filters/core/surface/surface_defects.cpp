// List defects in terms of the input's ids (see surface_defects.h). The repaired surface contains
// maps between its own ids and those of the input. Edges are examined with the input's orientation,
// because repair may have flipped triangles.
#include "surface/surface_defects.h"

#include <algorithm>
#include <array>
#include <limits>

namespace bindpose
{

namespace
{
class DefectLister
{
public:
  DefectLister(PointsView points, TrianglesView triangles, const RepairedSurface& repaired)
    : points_(points), triangles_(triangles), repaired_(repaired),
      components_(connected_components(repaired.points.rows(), repaired.triangles)),
      id_(static_cast<std::size_t>(points.rows()), -1)
  {
    for (std::size_t v = 0; v < repaired.original_vertices.size(); ++v)
    {
      this->id_[repaired.original_vertices[v]] = static_cast<Index>(v);
    }
  }

  std::vector<DefectOccurrence> run()
  {
    this->vertices();
    this->edges();
    this->degenerate();
    this->duplicates();
    this->crossings();
    for (const auto& [t, inward_index] : this->repaired_.inward_triangles)
    {
      this->add(Defect::inward_component, this->repaired_.original_triangles[t]);
      this->occurrences_.back().inward_index = inward_index;
    }
    return std::move(this->occurrences_);
  }

private:
  /// Return the vertex of the repaired surface for an input vertex, or -1 if no repaired triangle
  /// uses it.
  Index welded(Index input_vertex) const
  {
    return this->id_[this->repaired_.representative_of_vertex[input_vertex]];
  }

  Index component_of(Index input_vertex) const
  {
    const Index v = this->welded(input_vertex);
    return v < 0 ? -1 : this->components_.component_of_vertex[v];
  }

  void add(Defect defect, Index triangle, Index crossed_triangle = -1)
  {
    DefectOccurrence occurrence;
    occurrence.defect = defect;
    occurrence.triangle = triangle;
    occurrence.crossed_triangle = crossed_triangle;
    for (int k = 0; k < 3; ++k)
    {
      occurrence.vertices.push_back(this->triangles_(triangle, k));
      occurrence.component =
        std::max(occurrence.component, this->component_of(occurrence.vertices.back()));
    }
    this->occurrences_.push_back(std::move(occurrence));
  }

  void vertices()
  {
    std::vector<char> used(static_cast<std::size_t>(this->points_.rows()), 0);
    for (Index k = 0; k < this->triangles_.size(); ++k)
    {
      used[this->triangles_.data()[k]] = 1;
    }
    for (const Defect defect : { Defect::duplicate_vertex, Defect::unreferenced_vertex })
    {
      for (Index v = 0; v < this->points_.rows(); ++v)
      {
        if (defect == Defect::duplicate_vertex ? this->repaired_.representative_of_vertex[v] != v
                                               : !used[v])
        {
          this->occurrences_.push_back({ defect, { v }, -1, -1, this->component_of(v), -1 });
        }
      }
    }
  }

  void edges()
  {
    Triangles input_orientation(this->repaired_.triangles.rows(), 3);
    for (Index t = 0; t < input_orientation.rows(); ++t)
    {
      for (int k = 0; k < 3; ++k)
      {
        input_orientation(t, k) =
          this->welded(this->triangles_(this->repaired_.original_triangles[t], k));
      }
    }
    const std::vector<Edge> edges = mesh_edges(input_orientation);
    for (const Defect defect :
      { Defect::boundary_edge, Defect::nonmanifold_edge, Defect::misoriented_edge })
    {
      for (const Edge& edge : edges)
      {
        const bool has_defect = defect == Defect::boundary_edge ? edge.triangle_count == 1
          : defect == Defect::nonmanifold_edge
          ? edge.triangle_count >= 3
          : edge.triangle_count == 2 && edge.net_direction != 0;
        if (has_defect)
        {
          this->occurrences_.push_back({ defect,
            { this->repaired_.original_vertices[edge.a],
              this->repaired_.original_vertices[edge.b] },
            -1, -1, this->components_.component_of_vertex[edge.a], -1 });
        }
      }
    }
  }

  void degenerate()
  {
    Index next = 0; // index into `kept`, which is ascending
    const auto& kept = this->repaired_.original_triangles;
    for (Index t = 0; t < this->triangles_.rows(); ++t)
    {
      if (next < static_cast<Index>(kept.size()) && kept[next] == t)
      {
        ++next;
      }
      else
      {
        this->add(Defect::degenerate_triangle, t);
      }
    }
  }

  void duplicates()
  {
    struct Key
    {
      std::array<Index, 3> vertices;
      Index triangle;
    };
    std::vector<Key> keys;
    for (Index t = 0; t < this->repaired_.triangles.rows(); ++t)
    {
      const auto row = this->repaired_.triangles.row(t);
      keys.push_back({ { row[0], row[1], row[2] }, this->repaired_.original_triangles[t] });
      std::sort(keys.back().vertices.begin(), keys.back().vertices.end());
    }
    std::sort(keys.begin(), keys.end(),
      [](const Key& x, const Key& y)
      { return x.vertices != y.vertices ? x.vertices < y.vertices : x.triangle < y.triangle; });
    std::vector<Index> found;
    for (std::size_t i = 1; i < keys.size(); ++i)
    {
      if (keys[i].vertices == keys[i - 1].vertices)
      {
        found.push_back(keys[i].triangle);
      }
    }
    std::sort(found.begin(), found.end());
    for (const Index t : found)
    {
      this->add(Defect::duplicate_triangle, t);
    }
  }

  void crossings()
  {
    constexpr Index none = std::numeric_limits<Index>::max();
    std::vector<Index> first_crossed(
      static_cast<std::size_t>(this->repaired_.triangles.rows()), none);
    for (const auto& [s, t] : this->repaired_.crossings)
    {
      first_crossed[s] = std::min(first_crossed[s], t);
      first_crossed[t] = std::min(first_crossed[t], s);
    }
    for (std::size_t t = 0; t < first_crossed.size(); ++t)
    {
      if (first_crossed[t] != none)
      {
        this->add(Defect::self_intersection, this->repaired_.original_triangles[t],
          this->repaired_.original_triangles[first_crossed[t]]);
      }
    }
  }

  PointsView points_;
  TrianglesView triangles_;
  const RepairedSurface& repaired_;
  Components components_;
  std::vector<Index> id_; // id of an input vertex in the repaired surface, or -1
  std::vector<DefectOccurrence> occurrences_;
};
} // namespace

const char* to_string(Defect defect)
{
  constexpr const char* words[defect_kinds] = { "duplicate vertex", "unreferenced vertex",
    "boundary edge", "non-manifold edge", "misoriented edge", "degenerate triangle",
    "duplicate triangle", "crossing triangle", "inward component" };
  return words[static_cast<int>(defect)];
}

std::vector<DefectOccurrence> list_defects(
  PointsView points, TrianglesView triangles, const RepairedSurface& repaired)
{
  return DefectLister(points, triangles, repaired).run();
}

} // namespace bindpose

// Tets with duplicated nodes, made from connected atoms (see embedding_parts.h). These are steps 5
// to 7 of the method in embedding_tets.cpp. A part is a set of connected atoms in one tet. A copy
// of a node is a class of corners of such parts, found by union-find.
#include "embedding/embedding_parts.h"

#include "base/gather.h"
#include "base/parallel_sort.h"
#include "base/sort_unique.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <utility>

namespace bindpose
{

namespace
{
using Key = EmbeddingAtoms::Key;
using Id = EmbeddingAtoms::Id;

class EmbeddingBuilder
{
public:
  EmbeddingBuilder(ExecutionContext& context, PointsView points, const LatticeSurface& surface,
    const LatticeCover& cover, const EmbeddingAtoms& atoms, AtomConnections& connections,
    const MaterialProbes& probes)
    : points_(points), surface_(surface), cover_(cover), atoms_(atoms), connections_(connections),
      probes_(probes), context_(context)
  {
  }

  bool run(EmbeddingTets& result)
  {
    return this->find_parts() && this->join_corners() && this->probe_nodes() && this->write(result);
  }

private:
  // ---- Parts and copies of nodes ----

  bool find_parts()
  {
    const Id count = this->atoms_.count();
    this->part_of_atom_.assign(static_cast<std::size_t>(count), -1);
    for (Id atom = 0; atom < count; ++atom)
    {
      if (atom % atoms_per_check == 0 && this->context_.canceled())
      {
        return false;
      }
      if (!this->atoms_.is_inside(atom))
      {
        continue;
      }
      const Id root = this->connections_.within_tets.find(atom);
      if (root == atom)
      {
        this->part_of_atom_[atom] = static_cast<Id>(this->part_tets_.size());
        this->part_tets_.push_back(this->atoms_.tet_of(atom));
        this->part_volumes_.push_back(0.0);
      }
      this->part_of_atom_[atom] = this->part_of_atom_[root];
      this->part_volumes_[this->part_of_atom_[atom]] +=
        static_cast<double>(this->connections_.inside_volume[atom]);
    }
    this->corners_.reset(4 * this->part_tets_.size());
    return true;
  }

  /// Connect all atoms of a convex piece of material. Wherever the tets of two of these atoms have
  /// a node in common, the parts of the two atoms get the same copy of the node.
  template <typename AtomAt>
  void join_convex(Index count, const AtomAt& atom_at)
  {
    this->node_corners_.clear();
    for (Index i = 0; i < count; ++i)
    {
      const Id part = this->part_of_atom_[atom_at(i)];
      const auto& nodes = this->atoms_.nodes[this->part_tets_[part]];
      for (int k = 0; k < 4; ++k)
      {
        this->node_corners_.emplace_back(nodes[k], 4 * part + k);
      }
    }
    std::sort(this->node_corners_.begin(), this->node_corners_.end());
    for (std::size_t i = 1; i < this->node_corners_.size(); ++i)
    {
      if (this->node_corners_[i].first == this->node_corners_[i - 1].first)
      {
        this->corners_.unite(this->node_corners_[i].second, this->node_corners_[i - 1].second);
      }
    }
  }

  bool join_corners()
  {
    for (std::size_t i = 0; i < this->connections_.between_tets.size(); ++i)
    {
      if (i % atoms_per_check == 0 && this->context_.canceled())
      {
        return false;
      }
      const Id p = this->part_of_atom_[this->connections_.between_tets[i].first];
      const Id q = this->part_of_atom_[this->connections_.between_tets[i].second];
      const auto& nodes_of_p = this->atoms_.nodes[this->part_tets_[p]];
      const auto& nodes_of_q = this->atoms_.nodes[this->part_tets_[q]];
      for (int k = 0; k < 4; ++k)
      {
        for (int l = 0; l < 4; ++l)
        {
          if (nodes_of_p[k] == nodes_of_q[l])
          {
            this->corners_.unite(4 * p + k, 4 * q + l);
          }
        }
      }
    }
    const auto& first = this->cover_.first_piece;
    for (std::size_t f = 0; f + 1 < first.size(); ++f)
    {
      if (f % atoms_per_check == 0 && this->context_.canceled())
      {
        return false;
      }
      if (first[f + 1] - first[f] > 1)
      {
        this->join_convex(first[f + 1] - first[f],
          [&](Index i) { return this->atoms_.first_piece + static_cast<Id>(first[f] + i); });
      }
    }
    for (Id cube = 0; cube < static_cast<Id>(this->atoms_.full_cubes.size()); ++cube)
    {
      this->join_convex(EmbeddingAtoms::halves,
        [&](Index i) {
          return this->atoms_.first_full_atom + cube * EmbeddingAtoms::halves + static_cast<Id>(i);
        });
    }
    return true;
  }

  // ---- Probes ----

  /// A node, and one of the tet corners at this node: the index 4 * part + corner.
  using Corner = std::pair<Key, Id>;

  /// Test by probes (straight segments through the material) which copies of one node are
  /// connected. For each connection, append a pair of corners that identify the two copies; the
  /// caller unites the two corners.
  void probe_node(const Corner* begin, const Corner* end, const std::vector<Id>& roots,
    std::vector<std::pair<Id, Id>>& joined) const
  {
    std::vector<MaterialProbes::Side> sides;
    std::vector<Id> triangles;
    for (const Corner* c = begin; c != end; ++c)
    {
      const Id root = roots[c->second];
      auto side = std::find_if(sides.begin(), sides.end(),
        [&](const MaterialProbes::Side& other) { return other.root == root; });
      if (side == sides.end())
      {
        side = sides.insert(side, { root, {} });
      }
      const Id part = c->second / 4;
      for (Index i = this->first_of_part_[part]; i < this->first_of_part_[part + 1]; ++i)
      {
        const Id atom = this->atoms_of_part_[i];
        MaterialProbes::End probe_end{ this->atoms_.lattice_position(atom), Vec3::Zero() };
        if (atom >= this->atoms_.first_piece)
        {
          triangles.push_back(this->cover_.pieces[atom - this->atoms_.first_piece].triangle);
          const std::array<Vec3, 3> t = this->cover_.corners_of(triangles.back());
          probe_end.normal = (t[1] - t[0]).cross(t[2] - t[0]).stableNormalized();
        }
        side->ends.push_back(probe_end);
      }
    }
    this->probes_.connect(std::move(sides), std::move(triangles), joined);
  }

  bool probe_nodes()
  {
    const auto parts = static_cast<Id>(this->part_tets_.size());
    this->first_of_part_.assign(static_cast<std::size_t>(parts) + 1, 0);
    for (const Id part : this->part_of_atom_)
    {
      if (part >= 0)
      {
        ++this->first_of_part_[part + 1];
      }
    }
    std::partial_sum(
      this->first_of_part_.begin(), this->first_of_part_.end(), this->first_of_part_.begin());
    this->atoms_of_part_.resize(static_cast<std::size_t>(this->first_of_part_.back()));
    std::vector<Index> next(this->first_of_part_.begin(), this->first_of_part_.end() - 1);
    for (std::size_t atom = 0; atom < this->part_of_atom_.size(); ++atom)
    {
      if (this->part_of_atom_[atom] >= 0)
      {
        this->atoms_of_part_[next[this->part_of_atom_[atom]]++] = static_cast<Id>(atom);
      }
    }
    std::vector<Id> roots(4 * static_cast<std::size_t>(parts));
    std::vector<Corner> corners(roots.size());
    for (Id i = 0; i < 4 * parts; ++i)
    {
      roots[i] = this->corners_.find(i);
      corners[i] = { this->atoms_.nodes[this->part_tets_[i / 4]][i % 4], i };
    }
    if (!parallel_sort(this->context_, corners, std::less<>()))
    {
      return false;
    }
    // Maximum number of copies of a node that is tested by probes. More copies indicate a triangle
    // soup instead of a thin slice of material.
    constexpr std::size_t maximum_copies = 12;
    std::vector<Id> copies;
    // Ranges [begin, end) in `corners`, one for each node that is tested by probes.
    std::vector<std::pair<Index, Index>> node_ranges;
    for (std::size_t begin = 0; begin < corners.size();)
    {
      std::size_t end = begin;
      copies.clear();
      for (; end < corners.size() && corners[end].first == corners[begin].first; ++end)
      {
        copies.push_back(roots[corners[end].second]);
      }
      sort_unique(copies);
      if (copies.size() > 1 && copies.size() <= maximum_copies)
      {
        node_ranges.emplace_back(begin, end);
      }
      begin = end;
    }
    std::vector<std::pair<Id, Id>> joined;
    constexpr Index nodes_at_once = 16;
    if (!gather(
          this->context_, static_cast<Index>(node_ranges.size()), joined,
          [&](Index i, std::vector<std::pair<Id, Id>>& list)
          {
            this->probe_node(corners.data() + node_ranges[i].first,
              corners.data() + node_ranges[i].second, roots, list);
          },
          nodes_at_once))
    {
      return false;
    }
    for (const auto& [a, b] : joined)
    {
      this->corners_.unite(a, b);
    }
    return true;
  }

  // ---- The result ----

  bool write(EmbeddingTets& result)
  {
    // Parts of one lattice tet become one tet of the result if they have the same four copies of
    // nodes.
    struct Copy
    {
      Id tet;
      std::array<Id, 4> corners;
      Id part;
    };
    std::vector<Copy> copies(this->part_tets_.size());
    for (std::size_t p = 0; p < copies.size(); ++p)
    {
      copies[p].tet = this->part_tets_[p];
      copies[p].part = static_cast<Id>(p);
      for (int k = 0; k < 4; ++k)
      {
        copies[p].corners[k] = this->corners_.find(static_cast<Id>(4 * p + k));
      }
    }
    const auto are_equal = [](const Copy& a, const Copy& b)
    { return a.tet == b.tet && a.corners == b.corners; };
    if (!parallel_sort(this->context_, copies,
          [](const Copy& a, const Copy& b)
          { return a.tet != b.tet ? a.tet < b.tet : a.corners < b.corners; }))
    {
      return false;
    }
    // The vertices of the mesh. Each vertex is one copy of a node and is stored as a pair: the
    // node, and the root corner that identifies the copy.
    std::vector<std::pair<Key, Id>> vertices;
    std::vector<Index> tet_of_part(copies.size());
    std::vector<std::size_t> first_copy_of_tet;
    for (std::size_t i = 0; i < copies.size(); ++i)
    {
      if (i == 0 || !are_equal(copies[i - 1], copies[i]))
      {
        result.lattice_tets += i == 0 || copies[i - 1].tet != copies[i].tet ? 1 : 0;
        first_copy_of_tet.push_back(i);
        for (int k = 0; k < 4; ++k)
        {
          vertices.emplace_back(this->atoms_.nodes[copies[i].tet][k], copies[i].corners[k]);
        }
      }
      tet_of_part[copies[i].part] = static_cast<Index>(first_copy_of_tet.size()) - 1;
    }
    sort_unique(vertices);
    const auto vertex_count = static_cast<Index>(vertices.size());
    result.mesh.points.resize(vertex_count, 3);
    for (Index v = 0; v < vertex_count; ++v)
    {
      result.mesh.points.row(v) = this->cover_.lattice.node_point(vertices[v].first);
      result.duplicated_nodes += v > 0 && vertices[v].first == vertices[v - 1].first ? 1 : 0;
    }
    const auto tet_count = static_cast<Index>(first_copy_of_tet.size());
    result.mesh.tets.resize(tet_count, 4);
    result.inside_fractions = Eigen::VectorXd::Zero(tet_count);
    for (Index t = 0; t < tet_count; ++t)
    {
      const Copy& copy = copies[first_copy_of_tet[t]];
      for (int k = 0; k < 4; ++k)
      {
        const auto vertex = std::make_pair(this->atoms_.nodes[copy.tet][k], copy.corners[k]);
        result.mesh.tets(t, k) =
          std::lower_bound(vertices.begin(), vertices.end(), vertex) - vertices.begin();
      }
    }
    double inside_volume = 0.0;
    for (const Copy& copy : copies)
    {
      result.inside_fractions[tet_of_part[copy.part]] += this->part_volumes_[copy.part];
      inside_volume += this->part_volumes_[copy.part];
    }
    for (Index t = 0; t < tet_count; ++t)
    {
      const int number =
        2 * DisphenoidLattice::number_of(this->atoms_.tets[copies[first_copy_of_tet[t]].tet]);
      const int samples =
        this->atoms_.samples_of_half[number] + this->atoms_.samples_of_half[number + 1];
      result.inside_fractions[t] = std::min(1.0, result.inside_fractions[t] / samples);
    }
    // At this point, the fraction of a tet is its inside volume, in cells of the sub-grid, divided
    // by the number of samples in the tet. This number is 10 to 28, depending on the position of
    // the tet in the sub-grid; the mean is `samples_of_tet`. Fractions of 1 are correct. Smaller
    // fractions have a bias: plates aligned with the sub-grid would become too thick or too thin.
    // The total inside volume has no bias. Therefore the fractions below 1 are multiplied by one
    // factor, from 0.5 to 2, so that the sum of all fractions matches the total inside volume.
    constexpr double samples_of_tet = CubeSamples::samples_per_cube / 12.0;
    const double whole_tets = (result.inside_fractions.array() >= 1.0).count();
    const double cut = result.inside_fractions.sum() - whole_tets;
    if (cut > 0.0)
    {
      const double correction =
        std::clamp((inside_volume / samples_of_tet - whole_tets) / cut, 0.5, 2.0);
      for (double& fraction : result.inside_fractions)
      {
        fraction = fraction < 1.0 ? std::min(1.0, correction * fraction) : fraction;
      }
    }
    this->bind(tet_of_part, result);
    return true;
  }

  void bind(const std::vector<Index>& tet_of_part, EmbeddingTets& result)
  {
    // A point that no triangle uses is bound to the tet that contains it. If this tet has several
    // copies, the copy with the largest inside fraction is chosen.
    std::vector<Index> fullest(this->atoms_.tets.size(), -1);
    for (std::size_t p = 0; p < tet_of_part.size(); ++p)
    {
      Index& best = fullest[this->part_tets_[p]];
      const Index t = tet_of_part[p];
      if (best < 0 || result.inside_fractions[t] > result.inside_fractions[best])
      {
        best = t;
      }
    }
    PointBinding& binding = result.binding;
    binding.tets.assign(static_cast<std::size_t>(this->points_.rows()), -1);
    binding.coordinates.setZero(this->points_.rows(), 4);
    for (Index i = 0; i < this->points_.rows(); ++i)
    {
      const Id vertex = this->surface_.vertex_of_point[i];
      const Vec3 position = this->cover_.lattice.lattice_position(this->points_.row(i));
      if (vertex < 0 && !((position.array() >= 0.0).all() && (position.array() < 65535.0).all()))
      {
        continue;
      }
      const auto location = DisphenoidLattice::locate(position);
      Index tet = -1;
      if (vertex >= 0)
      {
        tet = tet_of_part[this->part_of_atom_[this->connections_.atom_of_vertex[vertex]]];
      }
      else
      {
        const Id at = this->atoms_.index_of_tet(location.tet);
        tet = at >= 0 ? fullest[at] : -1;
      }
      binding.tets[i] = tet;
      for (int k = 0; k < 4 && tet >= 0; ++k)
      {
        binding.coordinates(i, k) = location.coordinates[k];
      }
    }
  }

  PointsView points_;
  const LatticeSurface& surface_;
  const LatticeCover& cover_;
  const EmbeddingAtoms& atoms_;
  AtomConnections& connections_;
  const MaterialProbes& probes_;
  ExecutionContext& context_;

  std::vector<Id> part_of_atom_; // #atoms: the part that contains the atom; -1: outside
  std::vector<Id> part_tets_; // #parts: index of the part's tet in atoms_.tets
  std::vector<double> part_volumes_;
  std::vector<Index> first_of_part_; // #parts + 1: offsets into atoms_of_part_
  std::vector<Id> atoms_of_part_;
  DisjointSets<Id> corners_; // classes over 4 * part + corner; each class is one copy of a node
  std::vector<std::pair<Key, Id>> node_corners_;
};
} // namespace

bool make_embedding(ExecutionContext& context, PointsView points, const LatticeSurface& surface,
  const LatticeCover& cover, const EmbeddingAtoms& atoms, AtomConnections connections,
  const MaterialProbes& probes, EmbeddingTets& result)
{
  return EmbeddingBuilder(context, points, surface, cover, atoms, connections, probes).run(result);
}

} // namespace bindpose

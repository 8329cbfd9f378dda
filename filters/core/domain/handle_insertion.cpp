// This file splits elements so that samples of handles become vertices (see handle_insertion.h).
// The same method is used for samples inside a tet, a face or an edge. Let S be the corners of the
// smallest simplex that contains the sample. Every element whose corners include all of S is
// replaced by one child for each vertex s in S. The child has the corners of the element, but with
// the new vertex instead of s. Children keep the orientation of the element and fill the element
// exactly.
//
// To locate a later sample, the original element that contains it is found in a search tree, then
// the child that contains it, and so on. The search tree of the original elements is built only
// once.
#include "domain/handle_insertion.h"

#include "base/sort_unique.h"
#include "geometry/line_pieces.h"
#include "geometry/simplex_locator.h"
#include "inside/handle_elements.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

namespace bindpose
{

namespace
{
struct Element
{
  std::array<Index, 4> ids{ -1, -1, -1, -1 };
  Index root = -1; // index of the original element that contains this element
  // The elements into which this element was split; empty: it is part of the current mesh.
  std::vector<Index> children;
};

/// A point of a handle that must become a vertex. If the point is on an edge or face of a cage,
/// `handle` is -1, -2, … for the first, second, … such element.
struct Sample
{
  Vec3 position = Vec3::Zero();
  Index handle = 0;
  Index vertex = -1;
};

/// An edge or face of a cage with the positions of its corners. The third corner of an edge repeats
/// its second.
struct CageElementShape
{
  CageElement element;
  Vec3 corners[3];

  SimplexLocation nearest(const Vec3& p) const
  {
    return nearest_in_triangle(p, this->corners[0], this->corners[1], this->corners[2]);
  }
};

class Inserter
{
public:
  Inserter(const Domain& domain, const Handles& handles, const HandleInsertionOptions& options,
    HandleInsertion& result)
    : domain_(domain), handles_(handles), options_(options), result_(result),
      corners_(domain.corners())
  {
    this->locator_ = domain.is_volume()
      ? std::make_unique<SimplexLocator>(domain.points, domain.tets)
      : std::make_unique<SimplexLocator>(domain.points, domain.triangles);
    Box box;
    for (Index e = 0; e < domain.element_count(); ++e)
    {
      for (int k = 0; k < this->corners_; ++k)
      {
        box.add(domain.points.row(domain.element(e)[k]));
      }
    }
    this->diagonal_ = box.diagonal();
    this->result_.handles.assign(handles.size(), {});
  }

  Status run(ExecutionContext& context);

private:
  void copy_mesh();
  void add_bone_samples(
    Index handle, std::vector<Sample>& on_vertices, std::vector<Sample>& between_vertices);
  void add_cage_samples(std::vector<Sample>& on_vertices, std::vector<Sample>& between_vertices);
  void add_cage_vertex(Index number, Index vertex);
  HandlePlacement& placement_of(Index handle)
  {
    return handle < 0 ? this->on_cage_ : this->result_.handles[handle];
  }
  SimplexLocation root(const Vec3& p) const;
  bool is_in_located_element(Index v) const;
  SimplexLocation locate(const Vec3& p, Vec3& position) const;
  void constrain_corners(Sample& sample);
  void insert(Sample& sample, const std::vector<Sample>& earlier);
  Index split(const std::vector<Index>& span, const Vec3& position, Index root);
  void finish();
  Vec3 point(Index v) const { return this->points_[v]; }
  SimplexLocation nearest(const Element& element, const Vec3& p) const;

  const Domain& domain_;
  const Handles& handles_;
  const HandleInsertionOptions& options_;
  HandleInsertion& result_;
  int corners_;
  double diagonal_ = 0.0;
  std::unique_ptr<SimplexLocator> locator_;
  std::vector<Vec3> points_;
  std::vector<Element> elements_;
  // Elements at every vertex, including elements that were split.
  std::vector<std::vector<Index>> incident_;
  std::vector<CageElementShape> cage_;
  HandlePlacement on_cage_; // common placement of all samples on edges and faces of cages
  Index cage_samples_outside_ = 0;
};

void Inserter::copy_mesh()
{
  const Index vertex_count = this->domain_.points.rows();
  this->points_.reserve(static_cast<std::size_t>(vertex_count));
  for (Index v = 0; v < vertex_count; ++v)
  {
    this->points_.emplace_back(this->domain_.points.row(v));
  }
  this->elements_.resize(static_cast<std::size_t>(this->domain_.element_count()));
  this->incident_.resize(static_cast<std::size_t>(vertex_count));
  for (Index e = 0; e < this->domain_.element_count(); ++e)
  {
    this->elements_[e].root = e;
    for (int k = 0; k < this->corners_; ++k)
    {
      this->elements_[e].ids[k] = this->domain_.element(e)[k];
      this->incident_[this->domain_.element(e)[k]].push_back(e);
    }
  }
}

SimplexLocation Inserter::nearest(const Element& element, const Vec3& p) const
{
  const auto at = [&](int k) { return this->points_[element.ids[k]]; };
  return this->corners_ == 4 ? nearest_in_tet(p, at(0), at(1), at(2), at(3))
                             : nearest_in_triangle(p, at(0), at(1), at(2));
}

/// Return the original element that contains p. If no element contains p, return the nearest
/// element.
SimplexLocation Inserter::root(const Vec3& p) const
{
  const Index given_element = this->options_.element_of ? this->options_.element_of(p) : -1;
  if (given_element < 0)
  {
    return this->locator_->locate(p);
  }
  SimplexLocation at = this->nearest(this->elements_[given_element], p);
  at.element = given_element;
  return at;
}

/// Report whether the original vertex v is a corner of the element that root() returns for the
/// position of v. Where elements overlap, several vertices have the same position. The function
/// returns true for only one of these vertices.
bool Inserter::is_in_located_element(Index v) const
{
  if (!this->options_.element_of)
  {
    return true;
  }
  const Index* ids = this->domain_.element(this->root(this->points_[v]).element);
  return std::find(ids, ids + this->corners_, v) != ids + this->corners_;
}

/// Return the element of the current mesh that contains p, or the nearest element.
/// @param position set to the point nearest to p in the original element.
SimplexLocation Inserter::locate(const Vec3& p, Vec3& position) const
{
  SimplexLocation at = this->root(p);
  const double outside = at.distance;
  position.setZero();
  for (int k = 0; k < this->corners_; ++k)
  {
    position += at.barycentric[k] * this->points_[this->elements_[at.element].ids[k]];
  }
  while (!this->elements_[at.element].children.empty())
  {
    SimplexLocation best;
    best.distance = 1e300;
    for (const Index child : this->elements_[at.element].children)
    {
      SimplexLocation in_child = this->nearest(this->elements_[child], position);
      if (in_child.distance < best.distance)
      {
        best = in_child;
        best.element = child;
      }
    }
    at = best;
  }
  at.distance = outside;
  return at;
}

void Inserter::add_bone_samples(
  Index handle, std::vector<Sample>& on_vertices, std::vector<Sample>& between_vertices)
{
  const Vec3 head = this->handles_[handle].head;
  const Vec3 axis = this->handles_[handle].tail - head;
  const double length = axis.norm();
  // Positions of vertices that are already on the bone, as fractions of its length.
  std::vector<double> parameters{ 0.0, 1.0 };
  const double tolerance = 1e-7 * this->diagonal_;
  for (std::size_t v = 0; v < this->points_.size(); ++v)
  {
    const Vec3 d = this->points_[v] - head;
    const double t = d.dot(axis) / (length * length);
    if (t < -tolerance / length || t > 1.0 + tolerance / length ||
      (d - t * axis).norm() > tolerance || this->incident_[v].empty() ||
      !this->is_in_located_element(static_cast<Index>(v)))
    {
      continue;
    }
    this->result_.handles[handle].vertices.push_back(static_cast<Index>(v));
    on_vertices.push_back({ this->points_[v], handle, static_cast<Index>(v) });
    parameters.push_back(std::clamp(t, 0.0, 1.0));
  }
  std::sort(parameters.begin(), parameters.end());
  // A bone without a vertex between its ends gets at least one sample between its ends.
  const bool lacks_samples = std::none_of(parameters.begin(), parameters.end(),
    [&](double t) { return t * length > tolerance && (1.0 - t) * length > tolerance; });
  for (std::size_t i = 0; i + 1 < parameters.size(); ++i)
  {
    const double gap = parameters[i + 1] - parameters[i];
    if (gap * length <= tolerance)
    {
      continue;
    }
    const auto edge_at = [&](double t)
    {
      const SimplexLocation location = this->root(head + t * axis);
      const double edge = mean_edge_length(this->domain_, location.element);
      return std::max(this->options_.spacing * edge / length, 1e-3);
    };
    const auto pieces = [&](double edges)
    { return std::max(lacks_samples ? 2 : 1, static_cast<int>(std::lround(edges))); };
    for (const double cut : line_cuts(parameters[i], parameters[i + 1], edge_at, pieces))
    {
      between_vertices.push_back({ head + cut * axis, handle, -1 });
    }
  }
}

void Inserter::add_cage_vertex(Index number, Index vertex)
{
  const CageElementShape& shape = this->cage_[-1 - number];
  const SimplexLocation at = shape.nearest(this->points_[vertex]);
  CageVertex on_cage{ vertex, shape.element,
    { at.barycentric[0], at.barycentric[1], at.barycentric[2] } };
  if (shape.element[2] < 0)
  {
    on_cage.barycentric[1] += on_cage.barycentric[2];
    on_cage.barycentric[2] = 0.0;
  }
  this->result_.cage.push_back(on_cage);
}

void Inserter::add_cage_samples(
  std::vector<Sample>& on_vertices, std::vector<Sample>& between_vertices)
{
  const double tolerance = 1e-7 * this->diagonal_;
  for (const Handle& handle : this->handles_)
  {
    for (const CageElement& element : handle.cage)
    {
      const auto corner = [&](int k) { return this->handles_[element[k]].head; };
      const bool face = element[2] >= 0;
      this->cage_.push_back({ element, { corner(0), corner(1), corner(face ? 2 : 1) } });
    }
  }
  for (std::size_t i = 0; i < this->cage_.size(); ++i)
  {
    const CageElementShape& shape = this->cage_[i];
    const Index number = -1 - static_cast<Index>(i);
    const bool face = shape.element[2] >= 0;
    HandleElements handle_elements;
    handle_elements.points.resize(face ? 3 : 2, 3);
    for (Index k = 0; k < handle_elements.points.rows(); ++k)
    {
      handle_elements.points.row(k) = shape.corners[k];
    }
    handle_elements.segments.resize(face ? 3 : 1, 2);
    handle_elements.segments.row(0) << 0, 1;
    if (face)
    {
      handle_elements.segments.bottomRows(2) << 1, 2, 2, 0;
      handle_elements.triangles.resize(1, 3);
      handle_elements.triangles << 0, 1, 2;
    }
    const auto length = [&](const Vec3& p)
    {
      const double edge = mean_edge_length(this->domain_, this->root(p).element);
      return std::max(this->options_.spacing * edge, 1e-3 * this->diagonal_);
    };
    const std::size_t first = on_vertices.size();
    for (std::size_t v = 0; v < this->points_.size(); ++v)
    {
      if (!this->incident_[v].empty() && shape.nearest(this->points_[v]).distance <= tolerance &&
        this->is_in_located_element(static_cast<Index>(v)))
      {
        on_vertices.push_back({ this->points_[v], number, static_cast<Index>(v) });
        this->add_cage_vertex(number, static_cast<Index>(v));
      }
    }
    const HandleSamples samples = sample_handle_elements(handle_elements, length);
    for (Index k = samples.handle_point_count; k < samples.points.rows(); ++k)
    {
      const Vec3 position = samples.points.row(k);
      // No new sample is needed if a vertex on the cage element is within this distance of the
      // sample's position.
      const double minimum_distance = 0.75 * length(position);
      if (std::any_of(on_vertices.begin() + static_cast<std::ptrdiff_t>(first), on_vertices.end(),
            [&](const Sample& other)
            { return (other.position - position).norm() <= minimum_distance; }))
      {
        continue;
      }
      if (this->root(position).distance <= 1e-6 * this->diagonal_)
      {
        between_vertices.push_back({ position, number, -1 });
      }
      else
      {
        ++this->cage_samples_outside_;
      }
    }
  }
}

/// For option keep_mesh: assign to the handle those corners of the sample's element at which the
/// sample has a nonzero barycentric coordinate.
void Inserter::constrain_corners(Sample& sample)
{
  Vec3 position;
  const SimplexLocation at = this->locate(sample.position, position);
  HandlePlacement& placement = this->placement_of(sample.handle);
  placement.outside = std::max(placement.outside, at.distance);
  for (int k = 0; k < this->corners_; ++k)
  {
    if (at.barycentric[k] > 1e-6)
    {
      const Index v = this->elements_[at.element].ids[k];
      placement.vertices.push_back(v);
      if (sample.handle < 0)
      {
        this->add_cage_vertex(sample.handle, v);
      }
      placement.snap = std::max(placement.snap, (this->points_[v] - position).norm());
    }
  }
}

void Inserter::insert(Sample& sample, const std::vector<Sample>& earlier)
{
  HandlePlacement& placement = this->placement_of(sample.handle);
  Vec3 position;
  const SimplexLocation at = this->locate(sample.position, position);
  placement.outside = std::max(placement.outside, at.distance);
  // Samples at the same original position (before snapping) get the same vertex.
  for (const Sample& other : earlier)
  {
    if ((other.position - sample.position).norm() <= 1e-9 * this->diagonal_ && other.vertex >= 0)
    {
      sample.vertex = other.vertex;
      placement.vertices.push_back(sample.vertex);
      return;
    }
  }
  const Element& element = this->elements_[at.element];
  const auto used_by_other_handle = [&](Index v)
  {
    return std::any_of(earlier.begin(), earlier.end(),
      [&](const Sample& other) { return other.vertex == v && other.handle != sample.handle; });
  };
  std::vector<Index> span;
  Vec3 target = position;
  for (const double snap : { this->options_.snap, 1e-3, 1e-9 })
  {
    span.clear();
    double sum = 0.0;
    target.setZero();
    for (int k = 0; k < this->corners_; ++k)
    {
      if (at.barycentric[k] >= snap)
      {
        span.push_back(element.ids[k]);
        sum += at.barycentric[k];
        target += at.barycentric[k] * this->points_[element.ids[k]];
      }
    }
    target /= sum;
    if (span.size() > 1 || !used_by_other_handle(span[0]))
    {
      break;
    }
  }
  const double snap_distance = (target - position).norm();
  const double edge = mean_edge_length(this->domain_, element.root);
  placement.snap = std::max(placement.snap, snap_distance);
  this->result_.largest_snap =
    std::max(this->result_.largest_snap, edge > 0.0 ? snap_distance / edge : 0.0);
  sample.vertex = span.size() == 1 ? span[0] : this->split(span, target, element.root);
  placement.vertices.push_back(sample.vertex);
}

Index Inserter::split(const std::vector<Index>& span, const Vec3& position, Index root)
{
  const auto new_vertex = static_cast<Index>(this->points_.size());
  InsertedVertex inserted;
  const SimplexLocation in_root = [&]
  {
    const Index* ids = this->domain_.element(root);
    Element original;
    std::copy(ids, ids + this->corners_, original.ids.begin());
    return this->nearest(original, position);
  }();
  for (int k = 0; k < this->corners_; ++k)
  {
    inserted.parents[k] = this->domain_.element(root)[k];
    inserted.barycentric[k] = in_root.barycentric[k];
  }
  this->result_.inserted.push_back(inserted);
  this->points_.push_back(position);
  this->incident_.emplace_back();

  std::vector<Index> incident_elements;
  for (const Index e : this->incident_[span[0]])
  {
    const Element& element = this->elements_[e];
    const auto end = element.ids.begin() + this->corners_;
    const bool has_all = std::all_of(span.begin(), span.end(),
      [&](Index v) { return std::find(element.ids.begin(), end, v) != end; });
    if (element.children.empty() && has_all)
    {
      incident_elements.push_back(e);
    }
  }
  for (const Index e : incident_elements)
  {
    for (const Index v : span)
    {
      const auto child = static_cast<Index>(this->elements_.size());
      Element part;
      part.ids = this->elements_[e].ids;
      part.root = this->elements_[e].root;
      std::replace(part.ids.begin(), part.ids.begin() + this->corners_, v, new_vertex);
      for (int k = 0; k < this->corners_; ++k)
      {
        this->incident_[part.ids[k]].push_back(child);
      }
      this->elements_[e].children.push_back(child);
      this->elements_.push_back(std::move(part));
    }
  }
  return new_vertex;
}

void Inserter::finish()
{
  Domain& domain = this->result_.domain;
  domain.points.resize(static_cast<Index>(this->points_.size()), 3);
  for (Index v = 0; v < domain.points.rows(); ++v)
  {
    domain.points.row(v) = this->points_[v];
  }
  std::vector<Index> leaf_elements;
  for (std::size_t e = 0; e < this->elements_.size(); ++e)
  {
    if (this->elements_[e].children.empty())
    {
      leaf_elements.push_back(static_cast<Index>(e));
      this->result_.parent_element.push_back(this->elements_[e].root);
    }
  }
  const auto count = static_cast<Index>(leaf_elements.size());
  domain.tets.resize(this->corners_ == 4 ? count : 0, 4);
  domain.triangles.resize(this->corners_ == 4 ? 0 : count, 3);
  if (this->domain_.inside_fractions.size() > 0)
  {
    domain.inside_fractions.resize(count);
    for (Index e = 0; e < count; ++e)
    {
      domain.inside_fractions[e] = this->domain_.inside_fractions[this->result_.parent_element[e]];
    }
  }
  domain.embedded_points = this->domain_.embedded_points;
  // The ids in embedded_point_corners remain valid, because original vertices keep their ids.
  domain.embedded_point_corners = this->domain_.embedded_point_corners;
  Index* out = this->corners_ == 4 ? domain.tets.data() : domain.triangles.data();
  for (const Index e : leaf_elements)
  {
    out = std::copy_n(this->elements_[e].ids.begin(), this->corners_, out);
  }
  constexpr Index maximum = 4; // largest number of handles that the warning names
  Index count_outside = 0;
  std::string outside;
  for (std::size_t i = 0; i < this->handles_.size(); ++i)
  {
    HandlePlacement& placement = this->result_.handles[i];
    sort_unique(placement.vertices);
    if (placement.outside > 1e-6 * this->diagonal_ && ++count_outside <= maximum)
    {
      char distance[32];
      std::snprintf(distance, sizeof(distance), "%.3g", placement.outside);
      outside += (outside.empty() ? "'" : ", '") + this->handles_[i].name + "' by " + distance;
    }
  }
  if (this->cage_samples_outside_ > 0)
  {
    this->result_.warnings.push_back("the cage is outside the mesh at " +
      std::to_string(this->cage_samples_outside_) +
      " of its samples, which were ignored; if the cage surrounds the shape, use domain cage");
  }
  if (count_outside > maximum)
  {
    outside += " and " + std::to_string(count_outside - maximum) + " more";
  }
  if (!outside.empty())
  {
    this->result_.warnings.push_back(std::string("these handles were outside the ") +
      (domain.is_volume() ? "volume" : "surface") +
      " and were moved to its nearest point: " + outside);
  }
}

Status Inserter::run(ExecutionContext& context)
{
  this->copy_mesh();
  // Insert samples whose positions the user has chosen (points, cage vertices, bone ends) before
  // samples whose positions along a bone or cage are arbitrary.
  std::vector<Sample> samples;
  std::vector<Sample> ends;
  std::vector<Sample> between_vertices;
  std::vector<Sample> earlier; // samples that already have a vertex
  for (std::size_t i = 0; i < this->handles_.size(); ++i)
  {
    const Handle& handle = this->handles_[i];
    const auto at = static_cast<Index>(i);
    if (handle.ownership == Ownership::none)
    {
      continue;
    }
    if (handle.kind == HandleKind::point || handle.kind == HandleKind::cage_vertex)
    {
      samples.push_back({ handle.head, at, -1 });
    }
    else if (handle.kind == HandleKind::bone)
    {
      ends.push_back({ handle.head, at, -1 });
      ends.push_back({ handle.tail, at, -1 });
      this->add_bone_samples(at, earlier, between_vertices);
    }
    if (context.canceled())
    {
      return Status::canceled();
    }
  }
  this->add_cage_samples(earlier, between_vertices);
  samples.insert(samples.end(), ends.begin(), ends.end());
  samples.insert(samples.end(), between_vertices.begin(), between_vertices.end());
  // Samples that are exactly at a vertex come first. Otherwise a sample of another handle near such
  // a vertex could snap to the vertex first.
  std::stable_partition(samples.begin(), samples.end(),
    [&](const Sample& sample)
    {
      const SimplexLocation at = this->root(sample.position);
      return *std::max_element(at.barycentric.begin(), at.barycentric.end()) >= 1.0 - 1e-9;
    });
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    if (this->options_.keep_mesh)
    {
      this->constrain_corners(samples[i]);
    }
    else
    {
      this->insert(samples[i], earlier);
      earlier.push_back(samples[i]);
      if (samples[i].handle < 0)
      {
        this->add_cage_vertex(samples[i].handle, samples[i].vertex);
      }
    }
    context.progress(static_cast<double>(i) / static_cast<double>(samples.size()));
    if (context.canceled())
    {
      return Status::canceled();
    }
  }
  this->finish();
  return {};
}
} // namespace

std::vector<Index> extend_labels(const HandleInsertion& mesh, const std::vector<Index>& labels)
{
  if (labels.empty())
  {
    return {};
  }
  std::vector<Index> result = labels;
  for (const InsertedVertex& vertex : mesh.inserted)
  {
    Index common = -1;
    for (int k = 0; k < mesh.domain.corners(); ++k)
    {
      if (vertex.barycentric[k] > 1e-12)
      {
        const Index label = labels[vertex.parents[k]];
        common = common == -1 || common == label ? label : 0;
      }
    }
    result.push_back(common);
  }
  return result;
}

Status insert_handles(ExecutionContext& context, const Domain& domain, const Handles& handles,
  const HandleInsertionOptions& options, HandleInsertion& result)
{
  result = {};
  if (!(options.snap > 0.0 && options.snap < 0.25))
  {
    return Status::invalid_input("the snap fraction must be greater than 0 and less than 0.25");
  }
  if (!(options.spacing > 0.0 && options.spacing <= 1.0))
  {
    return Status::invalid_input("the spacing of samples must be greater than 0 and at most 1");
  }
  Status status = check_domain(domain);
  if (status.ok())
  {
    status = check_handles(handles);
  }
  return status.ok() ? Inserter(domain, handles, options, result).run(context) : status;
}

} // namespace bindpose

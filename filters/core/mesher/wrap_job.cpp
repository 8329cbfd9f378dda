// Alpha wrapping (Portaneri, Rouxel-Labbé, Hemmer, Cohen-Steiner, Alliez, Alpha Wrapping with an
// Offset, ACM Transactions on Graphics 41(4), 2022) by CGAL. Starting from outside, tets are
// removed from a Delaunay triangulation through every facet that is large enough for a ball of
// radius alpha. If the tet behind a facet touches the surface, a vertex is inserted at the distance
// `offset` from the surface instead. The method uses only distances to triangles. Therefore it ends
// for any input, and its result is closed.
#include "mesher/jobs.h"
#include "mesher/triangle_soup.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <vector>

namespace bindpose
{

namespace
{
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Reports progress from the number of inserted vertices. The final number is unknown. Progress is
/// about 1/2 when the number of vertices is the area of the surface divided by alpha^2.
class Progress : public CGAL::Alpha_wraps_3::internal::Wrapping_default_visitor
{
public:
  explicit Progress(double expected) : expected_(expected) {}

  template <typename Wrapper, typename VertexHandle>
  void after_Steiner_point_insertion(const Wrapper&, VertexHandle)
  {
    constexpr int report_interval = 512;
    if (++this->count_ % report_interval == 0)
    {
      const double done = static_cast<double>(this->count_);
      report_progress(0.95 * done / (done + this->expected_));
    }
  }

private:
  double expected_;
  std::int64_t count_ = 0;
};
} // namespace

std::string wrap(MesherData& data, const WrapJobOptions& options)
{
  const TriangleSoup<Kernel::Point_3> soup(data);
  if (!(options.alpha > 0.0) || !(options.offset > 0.0))
  {
    return "alpha and offset must be positive";
  }
  Progress progress(surface_area(data.points, data.triangles) / (options.alpha * options.alpha));
  Mesh mesh;
  CGAL::alpha_wrap_3(soup.points, soup.triangles, options.alpha, options.offset, mesh,
    CGAL::parameters::default_values(), CGAL::parameters::visitor(std::ref(progress)));

  data = MesherData();
  data.points.resize(static_cast<Index>(mesh.number_of_vertices()), 3);
  data.triangles.resize(static_cast<Index>(mesh.number_of_faces()), 3);
  for (const Mesh::Vertex_index v : mesh.vertices())
  {
    const Kernel::Point_3& p = mesh.point(v);
    data.points.row(static_cast<Index>(v.idx())) << p.x(), p.y(), p.z();
  }
  for (const Mesh::Face_index f : mesh.faces())
  {
    int k = 0;
    for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f)))
    {
      data.triangles(static_cast<Index>(f.idx()), k++) = static_cast<Index>(v.idx());
    }
  }
  return data.triangles.rows() > 0 ? std::string() : "the wrap is empty";
}

} // namespace bindpose

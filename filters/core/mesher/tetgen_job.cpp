// Tetrahedralization of a surface by TetGen. TetGen removes vertices that are unused or nearly
// coincide and renumbers the other vertices, but it never moves a vertex. Therefore input vertices
// are identified by their exact coordinates.
#include "mesher/jobs.h"

#include <tetgen.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <unordered_map>

namespace bindpose
{

namespace
{
using Key = std::array<double, 3>;

struct KeyHash
{
  std::size_t operator()(const Key& key) const
  {
    std::uint64_t h = 0x9e3779b97f4a7c15ull;
    for (double x : key)
    {
      x = x == 0.0 ? 0.0 : x; // replace -0 by 0
      std::uint64_t bits = 0;
      std::memcpy(&bits, &x, sizeof(bits));
      h = (h ^ bits) * 0xff51afd7ed558ccdull;
      h ^= h >> 32;
    }
    return h;
  }
};

Key key_of(const double* p)
{
  return { p[0], p[1], p[2] };
}

void set_facet(tetgenio::facet& facet, const Index* ids)
{
  facet.numberofpolygons = 1;
  facet.polygonlist = new tetgenio::polygon[1];
  facet.numberofholes = 0;
  facet.holelist = nullptr;
  facet.polygonlist[0].numberofvertices = 3;
  facet.polygonlist[0].vertexlist = new int[3];
  for (int k = 0; k < 3; ++k)
  {
    facet.polygonlist[0].vertexlist[k] = static_cast<int>(ids[k]);
  }
}

void fill_input(const Points& points, const Triangles& triangles, tetgenio& in)
{
  in.firstnumber = 0;
  in.numberofpoints = static_cast<int>(points.rows());
  in.pointlist = new REAL[static_cast<std::size_t>(points.size())];
  std::copy(points.data(), points.data() + points.size(), in.pointlist);
  in.numberoffacets = static_cast<int>(triangles.rows());
  in.facetlist = new tetgenio::facet[static_cast<std::size_t>(triangles.rows())];
  for (Index f = 0; f < triangles.rows(); ++f)
  {
    set_facet(in.facetlist[f], triangles.data() + 3 * f);
  }
}

void add_box(Points& points, Triangles& triangles)
{
  const Box box = bounding_box(points, triangles);
  const Vec3 margin = Vec3::Constant(0.1 * box.size().maxCoeff());
  const Vec3 lower = box.lower - margin;
  const Vec3 upper = box.upper + margin;
  const Index first = points.rows();
  points.conservativeResize(first + 8, 3);
  for (int v = 0; v < 8; ++v)
  {
    points.row(first + v) << (v & 1 ? upper : lower).x(), (v & 2 ? upper : lower).y(),
      (v & 4 ? upper : lower).z();
  }
  constexpr int faces[12][3] = { { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 }, { 0, 1, 5 },
    { 0, 5, 4 }, { 2, 6, 7 }, { 2, 7, 3 }, { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 } };
  const Index first_face = triangles.rows();
  triangles.conservativeResize(first_face + 12, 3);
  for (int f = 0; f < 12; ++f)
  {
    triangles.row(first_face + f) << first + faces[f][0], first + faces[f][1], first + faces[f][2];
  }
}

/// Run the steps of TetGen's ::tetrahedralize() except one. The omitted step follows the recovery
/// of the boundary. It would list all facets, which takes a third of the peak memory, and flip tets
/// to restore the Delaunay property where possible. The step is not needed, because vertices are
/// inserted and tets are improved later.
void run_steps(tetgenbehavior& behavior, tetgenio& in, tetgenio& out)
{
  clock_t unused = 0;
  tetgenmesh mesh;
  mesh.b = &behavior;
  mesh.in = &in;
  mesh.initializepools();
  mesh.transfernodes();
  exactinit(behavior.verbose, behavior.noexact, behavior.nostaticfilter, mesh.xmax - mesh.xmin,
    mesh.ymax - mesh.ymin, mesh.zmax - mesh.zmin);
  // Progress after each step, as a fraction of the total time, measured on scans and models for 3D
  // printing.
  constexpr double triangulated = 0.3, facets_found = 0.4, recovered = 0.7, carved = 0.85;
  mesh.incrementaldelaunay(unused);
  report_progress(triangulated);
  mesh.meshsurface();
  report_progress(facets_found);
  if (behavior.nobisect)
  {
    mesh.recoverboundary(unused);
  }
  else
  {
    mesh.constraineddelaunay(unused);
  }
  report_progress(recovered);
  mesh.carveholes();
  report_progress(carved);
  if (behavior.nobisect && mesh.subvertstack->objects > 0)
  {
    mesh.suppresssteinerpoints();
  }
  if (behavior.quality)
  {
    mesh.delaunayrefinement();
  }
  mesh.optimizemesh();
  if (mesh.dupverts > 0 || mesh.unuverts > 0)
  {
    mesh.jettisonnodes();
  }
  out.firstnumber = in.firstnumber;
  out.mesh_dim = in.mesh_dim;
  mesh.outnodes(&out);
  if (mesh.tetrahedrons->items > 0)
  {
    mesh.outelements(&out);
  }
}
} // namespace

std::string tetgen(MesherData& data, const TetgenOptions& options)
{
  Points points = data.points;
  Triangles triangles = data.triangles;
  if (options.box)
  {
    add_box(points, triangles);
  }
  tetgenio in, out;
  fill_input(points, triangles, in);
  std::string switches = options.switches + "Q";
  tetgenbehavior behavior;
  behavior.parse_commandline(switches.data());
  // Only exactly coplanar triangles form one facet, because TetGen may flip edges within a facet.
  behavior.facet_ang_tol = 180.0;
  run_steps(behavior, in, out);

  // Renumber the vertices: input vertices keep their ids, new vertices follow in TetGen's order.
  std::unordered_map<Key, Index, KeyHash> ids;
  ids.reserve(static_cast<std::size_t>(points.rows()));
  for (Index v = 0; v < points.rows(); ++v)
  {
    ids.emplace(key_of(points.data() + 3 * v), v);
  }
  std::vector<Index> id_of(static_cast<std::size_t>(out.numberofpoints));
  std::vector<Key> new_points;
  for (int v = 0; v < out.numberofpoints; ++v)
  {
    const Key key = key_of(out.pointlist + 3 * v);
    const auto entry = ids.find(key);
    id_of[v] =
      entry != ids.end() ? entry->second : points.rows() + static_cast<Index>(new_points.size());
    if (entry == ids.end())
    {
      new_points.push_back(key);
    }
  }
  data.points.resize(points.rows() + static_cast<Index>(new_points.size()), 3);
  data.points.topRows(points.rows()) = points;
  for (std::size_t v = 0; v < new_points.size(); ++v)
  {
    data.points.row(points.rows() + static_cast<Index>(v)) << new_points[v][0], new_points[v][1],
      new_points[v][2];
  }
  data.tets.resize(out.numberoftetrahedra, 4);
  for (Index t = 0; t < data.tets.rows(); ++t)
  {
    for (int k = 0; k < 4; ++k)
    {
      data.tets(t, k) = id_of[out.tetrahedronlist[t * out.numberofcorners + k]];
    }
  }
  // All tets have the same orientation because TetGen uses exact predicates. The sum of the volumes
  // is tested, because the volume of a single sliver may have the wrong sign in doubles.
  if (tet_volumes(data.points, data.tets).sum() < 0.0)
  {
    data.tets.col(0).swap(data.tets.col(1));
  }
  data.regions.clear();
  const int attributes = out.numberoftetrahedronattributes;
  if (attributes > 0 && out.tetrahedronattributelist)
  {
    data.regions.resize(static_cast<std::size_t>(out.numberoftetrahedra));
    for (int t = 0; t < out.numberoftetrahedra; ++t)
    {
      data.regions[t] =
        static_cast<Index>(out.tetrahedronattributelist[t * attributes + attributes - 1]);
    }
  }
  data.triangles.resize(0, 3);
  return data.tets.rows() > 0 ? std::string() : "TetGen created no tets";
}

} // namespace bindpose

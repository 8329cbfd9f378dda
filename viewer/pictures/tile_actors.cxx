// Creates the actors of each type of dataset. add_surface() draws all types of surfaces: smooth or
// flat triangles, colored by one value per point or cell. Values are interpolated first, and colors
// are looked up per pixel, so that bands and isolines agree.
#include "pictures/tile_actors.h"

#include "conversion.h"
#include "look_file.h"
#include "scene/curves.h"
#include "scene/defect_actors.h"
#include "scene/extrema.h"
#include "scene/volume.h"
#include "scene/volume_rendering.h"
#include "shapes/shaded_surface.h"
#include "shapes/surroundings.h"
#include "shapes/tet_cut.h"
#include "shapes/tet_slice.h"
#include "shapes/textured_surface.h"
#include "vtkHandleSetRepresentation.h"

#include "vtkActor.h"
#include "vtkCellData.h"
#include "vtkCellTypes.h"
#include "vtkDataSetSurfaceFilter.h"
#include "vtkDoubleArray.h"
#include "vtkExtractVOI.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkLightKit.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVolume.h"

#include <algorithm>
#include <cmath>

namespace bindpose
{
namespace
{
// Return a shallow copy of the data with the displayed values as its only array.
template <typename Data>
vtkSmartPointer<Data> with_color_values(Data* data, const Coloring& coloring)
{
  auto copy = vtkSmartPointer<Data>::New();
  copy->CopyStructure(data);
  bool on_points = true;
  if (const auto values = color_values(data, coloring, on_points))
  {
    if (on_points)
    {
      copy->GetPointData()->AddArray(values);
    }
    else
    {
      copy->GetCellData()->AddArray(values);
    }
  }
  return copy;
}

void color_by_values(vtkPolyDataMapper* mapper, vtkPolyData* data, const Coloring& coloring)
{
  const bool on_points = data->GetPointData()->HasArray(color_array_name) != 0;
  if (!on_points && !data->GetCellData()->HasArray(color_array_name))
  {
    mapper->ScalarVisibilityOff();
    return;
  }
  mapper->ScalarVisibilityOn();
  if (on_points)
  {
    mapper->SetScalarModeToUsePointFieldData();
  }
  else
  {
    mapper->SetScalarModeToUseCellFieldData();
  }
  mapper->SelectColorArray(color_array_name);
  mapper->SetColorModeToMapScalars();
  mapper->SetInterpolateScalarsBeforeMapping(on_points);
  mapper->SetLookupTable(coloring.map.table);
  mapper->UseLookupTableScalarRangeOn();
}

vtkSmartPointer<vtkActor> add_actor(
  vtkRenderer* renderer, vtkPolyData* data, const Coloring& coloring)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  color_by_values(mapper, data, coloring);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  use_surface_material(actor);
  if (mapper->GetScalarVisibility())
  {
    // More ambient light and less gloss make the colors readable.
    actor->GetProperty()->SetAmbient(0.32);
    actor->GetProperty()->SetDiffuse(0.74);
    actor->GetProperty()->SetSpecular(0.04);
  }
  renderer->AddActor(actor);
  return actor;
}

// Draw the surface with a depth offset behind lines that are on it. Otherwise parts of the lines
// would fail the depth test. The offset of the surface is not visible.
void draw_behind_lines(vtkActor* actor)
{
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  actor->GetMapper()->SetRelativeCoincidentTopologyPolygonOffsetParameters(2.0, 2.0);
}

void add_lines(vtkRenderer* renderer, vtkPolyData* data, const Rgb& color, double width)
{
  if (data->GetNumberOfLines() == 0)
  {
    return;
  }
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  set_color(actor->GetProperty(), color);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  renderer->AddActor(actor);
}

// Draw the colors of the map unchanged, without shading.
void disable_lighting(vtkActor* actor)
{
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetAmbient(0.0);
  actor->GetProperty()->SetDiffuse(1.0);
}

void use_edges(vtkActor* actor, const Rgb& color, double width)
{
  actor->GetProperty()->EdgeVisibilityOn();
  actor->GetProperty()->SetEdgeColor(color[0], color[1], color[2]);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
}

vtkSmartPointer<vtkActor> add_surface(vtkRenderer* renderer, vtkPolyData* surface,
  const PictureOptions& options, const Coloring& coloring, double scale)
{
  const ShadedSurface shaded(surface);
  if (shaded.polydata()->GetNumberOfPolys() == 0)
  {
    return nullptr;
  }
  const auto actor = add_actor(renderer, shaded.polydata(), coloring);
  draw_behind_lines(actor);
  if (options.edges)
  {
    use_edges(actor, palette::edges, 0.6 * scale);
  }
  if (options.isolines)
  {
    add_lines(renderer, contour_lines(shaded.polydata(), coloring.isolines), palette::line,
      isoline_width * scale);
  }
  return actor;
}

// Enable depth peeling, which draws intersecting translucent surfaces in the correct order.
void sort_by_depth(vtkRenderer* renderer)
{
  renderer->SetUseDepthPeeling(true);
  renderer->SetMaximumNumberOfPeels(8);
  renderer->SetOcclusionRatio(0.0);
}

void add_textured(vtkRenderer* renderer, vtkPolyData* surface, const FileLook& look,
  const PictureOptions& options, const Frame& frame, double scale)
{
  const TexturedSurface textured(look, to_points(surface).view());
  for (const auto& actor : textured.actors())
  {
    renderer->AddActor(actor);
  }
  if (options.edges)
  {
    // VTK draws no edges on surfaces with normal textures, and multiplies others by the texture.
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(textured.polydata());
    mapper->ScalarVisibilityOff();
    vtkNew<vtkActor> edges;
    edges->SetMapper(mapper);
    set_color(edges->GetProperty(), palette::edges);
    edges->GetProperty()->SetRepresentationToWireframe();
    edges->GetProperty()->LightingOff();
    edges->GetProperty()->SetLineWidth(static_cast<float>(0.6 * scale));
    renderer->AddActor(edges);
  }
  add_surroundings(renderer, Vec3::Unit(frame.up));
  if (look.surface.is_translucent())
  {
    sort_by_depth(renderer);
  }
}

void add_flat(vtkRenderer* renderer, vtkPolyData* faces, const Coloring& coloring, double scale)
{
  if (faces->GetNumberOfPolys() == 0)
  {
    return;
  }
  const ShadedSurface facets(faces, 0.01);
  const auto actor = add_actor(renderer, facets.polydata(), coloring);
  set_color(actor->GetProperty(), palette::cut);
  actor->GetProperty()->SetAmbient(0.3);
  use_edges(actor, palette::cut_edges, 0.7 * scale);
}

// Return the plane of cuts and slices.
Plane section_of(const Box& box, const PictureOptions& options, const Frame& frame)
{
  if (options.section_plane)
  {
    return *options.section_plane;
  }
  Plane plane;
  plane.origin = box.lower + options.section * box.size();
  plane.normal = Vec3::Unit(frame.depth);
  return plane;
}

// ---- Tets --------------------------------------------------------------------------------------

// Return a polydata with the faces, the grid's points and the displayed values. If there is one
// value per tet, face f gets the value of the tet owners[f].
vtkSmartPointer<vtkPolyData> face_polydata(
  vtkUnstructuredGrid* grid, const Triangles& faces, const std::vector<Index>& owners)
{
  vtkSmartPointer<vtkPolyData> data = to_polydata(Points(0, 3), faces);
  data->SetPoints(grid->GetPoints());
  data->GetPointData()->ShallowCopy(grid->GetPointData());
  if (auto* cell_values =
        vtkDoubleArray::SafeDownCast(grid->GetCellData()->GetArray(color_array_name)))
  {
    vtkNew<vtkDoubleArray> values;
    values->SetName(color_array_name);
    for (const Index owner : owners)
    {
      values->InsertNextValue(cell_values->GetValue(owner));
    }
    data->GetCellData()->AddArray(values);
  }
  return data;
}

void add_shrunk(vtkRenderer* renderer, vtkUnstructuredGrid* grid, const TetInput& input,
  const std::vector<char>& kept, double factor, const Coloring& coloring, double scale)
{
  const ShrunkTets shrunk = shrink_tets(input.points.view(), input.tets.view(), kept, factor);
  const auto data = face_polydata(grid, shrunk.triangles, shrunk.tets);
  data->SetPoints(to_vtk_points(shrunk.points));
  data->GetPointData()->Initialize();
  if (auto* point_values =
        vtkDoubleArray::SafeDownCast(grid->GetPointData()->GetArray(color_array_name)))
  {
    vtkNew<vtkDoubleArray> values;
    values->SetName(color_array_name);
    for (const Index vertex : shrunk.vertices)
    {
      values->InsertNextValue(point_values->GetValue(vertex));
    }
    data->GetPointData()->AddArray(values);
  }
  add_flat(renderer, data, coloring, scale);
}

// Cut the tets by the plane. Add the slice and the part of the boundary behind the plane. The slice
// is drawn without lighting, so that its colors are readable.
Status add_tet_slice(vtkRenderer* renderer, vtkUnstructuredGrid* grid, const TetInput& input,
  const Plane& plane, const PictureOptions& options, const Coloring& coloring, double scale,
  Index& drawn_tets, std::vector<char>& drawn_points)
{
  const std::vector<Index> crossed_tets = tets_at_plane(input, plane.origin, plane.normal);
  const auto cut = slice_tets(grid, plane.origin, plane.normal);
  if (cut->GetNumberOfPolys() == 0)
  {
    return Status::invalid_input("the section does not cross any tet");
  }
  drawn_tets += static_cast<Index>(crossed_tets.size());
  const auto actor = add_actor(renderer, cut, coloring);
  set_color(actor->GetProperty(), palette::cut);
  disable_lighting(actor);
  draw_behind_lines(actor);
  if (options.isolines)
  {
    add_lines(
      renderer, contour_lines(cut, coloring.isolines), palette::line, isoline_width * scale);
  }
  const TetCut tet_cut(input.points.view(), input.tets.view());
  const auto boundary_faces =
    face_polydata(grid, tet_cut.boundary_faces().triangles, tet_cut.boundary_faces().tets);
  add_surface(
    renderer, part_behind(boundary_faces, plane.origin, plane.normal), options, coloring, scale);
  const auto is_behind = [&](Index v)
  { return (input.points.view().row(v).transpose() - plane.origin).dot(plane.normal) <= 0.0; };
  for (Index i = 0; i < tet_cut.boundary_faces().triangles.size(); ++i)
  {
    const Index v = tet_cut.boundary_faces().triangles.data()[i];
    drawn_points[v] = is_behind(v);
  }
  for (const Index t : crossed_tets)
  {
    for (int k = 0; k < 4; ++k)
    {
      drawn_points[input.tets.view()(t, k)] = 1;
    }
  }
  return {};
}

Status add_tets(vtkRenderer* renderer, vtkUnstructuredGrid* grid, const TetInput& input,
  const PictureOptions& options, const Coloring& coloring, const Frame& frame, double scale,
  Index& drawn_tets, std::vector<char>& drawn_points)
{
  TetCut cut(input.points.view(), input.tets.view());
  if (options.cut)
  {
    const Plane plane = section_of(bounding_box(input.points.view()), options, frame);
    const bool faces_camera = view_direction(frame, options.view).dot(plane.normal) >= 0.0;
    const Vec3 normal = faces_camera ? plane.normal : Vec3(-plane.normal);
    if (options.slice)
    {
      return add_tet_slice(renderer, grid, input, { plane.origin, normal }, options, coloring,
        scale, drawn_tets, drawn_points);
    }
    cut.keep_behind(plane.origin, normal);
  }
  if (cut.kept_count() == 0)
  {
    return Status::invalid_input("the section removes all tets; move it toward the camera");
  }
  drawn_tets += cut.kept_count();
  if (options.shrink < 1.0)
  {
    for (Index t = 0; t < input.tets.view().rows(); ++t)
    {
      for (int k = 0; k < 4 && cut.kept()[t]; ++k)
      {
        drawn_points[input.tets.view()(t, k)] = 1;
      }
    }
    add_shrunk(renderer, grid, input, cut.kept(), options.shrink, coloring, scale);
    return {};
  }
  for (const TetCut::FaceSet* sides : { &cut.boundary_faces(), &cut.exposed_faces() })
  {
    for (Index i = 0; i < sides->triangles.size(); ++i)
    {
      drawn_points[sides->triangles.data()[i]] = 1;
    }
  }
  const auto boundary_faces =
    face_polydata(grid, cut.boundary_faces().triangles, cut.boundary_faces().tets);
  add_surface(renderer, boundary_faces, options, coloring, scale);
  add_flat(renderer, face_polydata(grid, cut.exposed_faces().triangles, cut.exposed_faces().tets),
    coloring, scale);
  return {};
}

// ---- Volumes -----------------------------------------------------------------------------------

// Return a slice of the image along an axis, or a cut by the section plane.
vtkSmartPointer<vtkPolyData> slice_faces(
  vtkImageData* image, const PictureOptions& options, const Frame& frame)
{
  if (options.section_plane && image->GetPointData()->HasArray(color_array_name) &&
    image->GetDataDimension() == 3)
  {
    return slice(
      image, color_array_name, options.section_plane->origin, options.section_plane->normal);
  }
  int extent[6];
  image->GetExtent(extent);
  const int axis = frame.depth;
  const int last = extent[2 * axis + 1] - extent[2 * axis];
  const int slice_index = extent[2 * axis] + static_cast<int>(std::lround(options.section * last));
  extent[2 * axis] = extent[2 * axis + 1] = slice_index;
  vtkNew<vtkExtractVOI> cut;
  cut->SetInputData(image);
  cut->SetVOI(extent);
  vtkNew<vtkDataSetSurfaceFilter> faces;
  faces->SetInputConnection(cut->GetOutputPort());
  faces->Update();
  return faces->GetOutput();
}

void add_slice(vtkRenderer* renderer, vtkImageData* image, const PictureOptions& options,
  const Coloring& coloring, const Frame& frame, double scale, bool with_shell)
{
  const auto faces = slice_faces(image, options, frame);
  const auto actor = add_actor(renderer, faces, coloring);
  disable_lighting(actor);
  draw_behind_lines(actor);
  if (coloring.kind != Coloring::Kind::winding)
  {
    return;
  }
  add_lines(renderer, contour_lines(faces, { 0.5 }), palette::line, 1.6 * scale);
  if (with_shell && image->GetDataDimension() == 3 &&
    image->GetPointData()->HasArray(color_array_name))
  {
    const auto shell = isosurface(image, color_array_name, 0.5);
    if (shell->GetNumberOfPolys() > 0)
    {
      const ShadedSurface shaded(shell);
      const auto translucent_actor = add_actor(renderer, shaded.polydata(), Coloring());
      translucent_actor->GetProperty()->SetOpacity(0.2);
    }
  }
}

void add_isosurfaces(vtkRenderer* renderer, vtkImageData* image, const PictureOptions& options,
  const Coloring& coloring)
{
  const auto [lowest, highest] =
    std::minmax_element(options.isosurfaces.begin(), options.isosurfaces.end());
  for (const double level : options.isosurfaces)
  {
    const auto surface = isosurface(image, color_array_name, level);
    const auto actor = add_actor(renderer, surface, Coloring());
    const Rgb color = color_of(coloring.map, level);
    set_color(actor->GetProperty(), color);
    // Make the surface slightly darker than the color of its level. Otherwise a white surface
    // (level 0.5) would not stand out from a white background.
    actor->GetProperty()->SetAmbient(0.14);
    actor->GetProperty()->SetDiffuse(0.76);
    const bool innermost = level == *highest || (level == *lowest && level < 0.0);
    if (!innermost)
    {
      actor->GetProperty()->SetOpacity(0.35);
      sort_by_depth(renderer);
    }
  }
}

// ---- Handles, lines, points --------------------------------------------------------------------

void add_handles(
  vtkRenderer* renderer, vtkPolyData* handles, const PictureOptions& options, double scale)
{
  vtkNew<vtkHandleSetRepresentation> representation;
  representation->SetHandles(handles);
  representation->SetRenderer(renderer);
  // A ball of 1.2 % of the picture's shorter side is readable at all picture sizes.
  const double pixels = std::clamp(0.012 * std::min(options.width, options.height), 3.0, 24.0);
  representation->SetPixelScale(scale * pixels / representation->GetPointSize());
  representation->SetShowLabels(options.handle_names);
  representation->VisibilityOn();
  renderer->AddViewProp(representation);
}

void add_lines_and_points(
  vtkRenderer* renderer, vtkPolyData* data, const Coloring& coloring, double scale)
{
  vtkNew<vtkPolyData> copy;
  copy->ShallowCopy(data);
  copy->SetPolys(nullptr);
  copy->SetStrips(nullptr);
  if (copy->GetNumberOfCells() == 0)
  {
    if (data->GetNumberOfCells() > 0)
    {
      return;
    }
    vtkNew<vtkCellArray> verts; // one vertex cell per point, to draw a dataset without cells
    for (vtkIdType v = 0; v < copy->GetNumberOfPoints(); ++v)
    {
      verts->InsertNextCell(1, &v);
    }
    copy->SetVerts(verts);
  }
  if (data->GetNumberOfCells() != copy->GetNumberOfCells())
  {
    // Remove the cell arrays, because they still contain values of removed cells.
    copy->GetCellData()->Initialize();
  }
  const auto actor = add_actor(renderer, copy, coloring);
  actor->GetProperty()->SetLineWidth(static_cast<float>(2.0 * scale));
  actor->GetProperty()->SetPointSize(static_cast<float>(4.0 * scale));
  disable_lighting(actor);
  if (!copy->GetPointData()->HasArray(color_array_name))
  {
    set_color(actor->GetProperty(), palette::line);
  }
}
} // namespace

bool is_handle_data(vtkDataSet* data)
{
  auto* polydata = vtkPolyData::SafeDownCast(data);
  return polydata && polydata->GetNumberOfPolys() == 0 &&
    (polydata->GetCellData()->HasArray("HandleKind") ||
      polydata->GetCellData()->HasArray("HandleName"));
}

namespace
{
bool shows_solids(const PictureOptions& options)
{
  return options.volume || !options.isosurfaces.empty();
}

void add_used_points(vtkDataSet* data, std::vector<Vec3>& positions)
{
  std::vector<bool> used(
    static_cast<std::size_t>(data->GetNumberOfPoints()), data->GetNumberOfCells() == 0);
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    data->GetCellPoints(cell, ids);
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
    {
      used[ids->GetId(k)] = true;
    }
  }
  for (std::size_t v = 0; v < used.size(); ++v)
  {
    if (used[v])
    {
      positions.emplace_back();
      data->GetPoint(static_cast<vtkIdType>(v), positions.back().data());
    }
  }
}

} // namespace

Points shown_points(
  const Tile& tile, const PictureOptions& options, const Coloring& coloring, const Frame* frame)
{
  std::vector<Vec3> positions;
  if (auto* image = vtkImageData::SafeDownCast(tile.data))
  {
    double bounds[6];
    image->GetBounds(bounds);
    if (shows_solids(options))
    {
      const Box box = occupied_box(
        with_color_values(image, coloring), color_array_name, options.isosurfaces, options.volume);
      for (int axis = 0; axis < 3; ++axis)
      {
        bounds[2 * axis] = box.lower[axis];
        bounds[2 * axis + 1] = box.upper[axis];
      }
    }
    else if (frame && !options.section_plane)
    {
      double* side = bounds + 2 * frame->depth;
      side[0] = side[1] = side[0] + options.section * (side[1] - side[0]);
    }
    for (int corner = 0; corner < 8; ++corner)
    {
      positions.emplace_back(
        bounds[corner & 1], bounds[2 + (corner >> 1 & 1)], bounds[4 + (corner >> 2 & 1)]);
    }
  }
  else if (tile.data && !is_handle_data(tile.data))
  {
    add_used_points(tile.data, positions);
  }
  for (const auto& data : tile.context)
  {
    add_used_points(data, positions);
  }
  vtkPolyData* handle_sets[2] = { tile.handles,
    is_handle_data(tile.data) ? vtkPolyData::SafeDownCast(tile.data) : nullptr };
  for (vtkPolyData* handles : handle_sets)
  {
    vtkNew<vtkHandleSetRepresentation> representation;
    representation->SetHandles(handles);
    for (vtkIdType cell = 0; handles && cell < handles->GetNumberOfCells(); ++cell)
    {
      positions.emplace_back();
      representation->GetPosedHead(cell, positions.back().data());
      positions.emplace_back();
      representation->GetPosedTail(cell, positions.back().data());
    }
  }
  Points points(static_cast<Index>(positions.size()), 3);
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    points.row(static_cast<Index>(i)) = positions[i].transpose();
  }
  return points;
}

namespace
{
// Return the radius of the tubes of curves: 0.25 % of the diagonal of the bounding box of all shown
// points. Such tubes are as readable as lines in a drawing.
double tube_radius(const Tile& tile, const PictureOptions& options, const Coloring& coloring)
{
  return 0.0025 * bounding_box(shown_points(tile, options, coloring)).diagonal();
}

void add_curves(vtkRenderer* renderer, vtkPolyData* data, double radius, double scale)
{
  for (const auto& actor : make_curves(data, radius, 1.5 * scale))
  {
    renderer->AddActor(actor);
  }
}

void add_defects(vtkRenderer* renderer, vtkPolyData* defects, double scale)
{
  for (const auto& actor : make_defects(defects, 2.5 * scale))
  {
    renderer->AddActor(actor);
  }
}

void add_context(vtkRenderer* renderer, vtkDataSet* data, double radius, double scale)
{
  if (is_defect_data(data))
  {
    add_defects(renderer, vtkPolyData::SafeDownCast(data), scale);
    return;
  }
  vtkNew<vtkDataSetSurfaceFilter> skin;
  vtkSmartPointer<vtkPolyData> surface = vtkPolyData::SafeDownCast(data);
  if (!surface)
  {
    skin->SetInputData(data);
    skin->Update();
    surface = skin->GetOutput();
  }
  add_curves(renderer, surface, radius, scale);
  const ShadedSurface shaded(surface);
  if (shaded.polydata()->GetNumberOfPolys() > 0)
  {
    const auto translucent_actor = add_actor(renderer, shaded.polydata(), Coloring());
    translucent_actor->GetProperty()->SetOpacity(0.25);
    sort_by_depth(renderer);
  }
}
} // namespace

Status add_tile(vtkRenderer* renderer, const Tile& tile, const PictureOptions& options,
  const Coloring& coloring, const std::vector<Extremum>& extrema, const Frame& frame, double scale,
  DrawnCounts& drawn_counts)
{
  // For tets, one flag per point: 1 for the points of drawn faces and for the corners of shrunk or
  // sliced tets. Only extrema at these points are drawn. For all other datasets the list is empty,
  // and all extrema are drawn.
  std::vector<char> drawn_points;
  if (auto* image = vtkImageData::SafeDownCast(tile.data))
  {
    const auto values = with_color_values(image, coloring);
    if (options.volume)
    {
      renderer->AddVolume(make_winding_volume(values, color_array_name, scale));
    }
    if (!options.isosurfaces.empty())
    {
      add_isosurfaces(renderer, values, options, coloring);
    }
    if (!shows_solids(options))
    {
      add_slice(renderer, values, options, coloring, frame, scale, tile.context.empty());
    }
  }
  else if (is_handle_data(tile.data))
  {
    add_handles(renderer, vtkPolyData::SafeDownCast(tile.data), options, scale);
  }
  else if (is_defect_data(tile.data) && coloring.kind == Coloring::Kind::none)
  {
    add_defects(renderer, vtkPolyData::SafeDownCast(tile.data), scale);
  }
  else if (is_curve_data(tile.data) && coloring.kind == Coloring::Kind::none)
  {
    add_curves(
      renderer, vtkPolyData::SafeDownCast(tile.data), tube_radius(tile, options, coloring), scale);
  }
  else if (auto* polydata = vtkPolyData::SafeDownCast(tile.data))
  {
    const auto surface = with_color_values(polydata, coloring);
    const bool is_textured = tile.look && !tile.defects && coloring.kind == Coloring::Kind::none;
    if (is_textured)
    {
      add_textured(renderer, surface, *tile.look, options, frame, scale);
    }
    const auto actor =
      is_textured ? nullptr : add_surface(renderer, surface, options, coloring, scale);
    if (actor && tile.defects)
    {
      // Make the surface translucent, because most defects are inside or behind it.
      actor->GetProperty()->SetOpacity(0.4);
      sort_by_depth(renderer);
    }
    add_lines_and_points(renderer, surface, coloring, scale);
  }
  else if (tile.data)
  {
    TetInput tets;
    auto* grid = vtkUnstructuredGrid::SafeDownCast(tile.data);
    if (grid && to_tets(grid, tets).ok())
    {
      drawn_points.assign(static_cast<std::size_t>(grid->GetNumberOfPoints()), 0);
      const Status status = add_tets(renderer, with_color_values(grid, coloring), tets, options,
        coloring, frame, scale, drawn_counts.tets, drawn_points);
      if (!status.ok())
      {
        return status;
      }
    }
    else
    {
      vtkNew<vtkDataSetSurfaceFilter> faces;
      auto copy = vtkSmartPointer<vtkDataSet>::Take(tile.data->NewInstance());
      copy->CopyStructure(tile.data);
      bool on_points = true;
      if (const auto values = color_values(tile.data, coloring, on_points))
      {
        if (on_points)
        {
          copy->GetPointData()->AddArray(values);
        }
        else
        {
          copy->GetCellData()->AddArray(values);
        }
      }
      faces->SetInputData(copy);
      faces->Update();
      add_surface(renderer, faces->GetOutput(), options, coloring, scale);
      add_lines_and_points(renderer, faces->GetOutput(), coloring, scale);
    }
  }
  if (!extrema.empty())
  {
    const double radius = 4.0 * tube_radius(tile, options, coloring);
    drawn_counts.extrema += add_extrema(renderer, tile.data, extrema, drawn_points, radius);
  }
  for (const auto& data : tile.context)
  {
    add_context(renderer, data, tube_radius(tile, options, coloring), scale);
  }
  if (tile.defects)
  {
    add_defects(renderer, tile.defects, scale);
  }
  if (tile.handles)
  {
    add_handles(renderer, tile.handles, options, scale);
  }
  return Status();
}

void add_lights(vtkRenderer* renderer)
{
  vtkNew<vtkLightKit> kit;
  kit->SetKeyLightIntensity(0.78);
  kit->SetKeyLightWarmth(0.56);
  kit->SetKeyLightAngle(46.0, 26.0);
  kit->SetKeyToFillRatio(3.0);
  kit->SetFillLightWarmth(0.44);
  kit->SetKeyToHeadRatio(1.9);
  kit->SetHeadLightWarmth(0.5);
  kit->SetKeyToBackRatio(3.6);
  kit->AddLightsToRenderer(renderer);
  // This ambient color affects only volume renderings. VTK's CPU ray casting uses the ambient
  // colors of the lights; surfaces use the ambient coefficient of their property instead.
  renderer->GetLights()->InitTraversal();
  vtkLight* first = renderer->GetLights()->GetNextItem();
  const double full = 1.0 / first->GetIntensity();
  first->SetAmbientColor(full, full, full);
}

} // namespace bindpose

#ifndef bindpose_shapes_textured_surface_h
#define bindpose_shapes_textured_surface_h

#include "geometry/mesh.h"
#include "look_file.h"

#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <memory>
#include <vector>

class vtkActor;
class vtkPolyData;

namespace bindpose
{

class LookTextures;
class ShadedSurface;

/// A surface that is drawn with the materials, textures and vertex colors of a file. The renderer
/// needs add_surroundings(), and must sort by depth if SurfaceLook::is_translucent(). The materials
/// are drawn as glTF 2.0 defines them, by VTK's physically based rendering, with these limits:
/// - an occlusion texture has an effect only if it is in the picture of metallic and roughness;
/// - a texture is repeated in the same way in both directions;
/// - normal textures are inverted in one direction where the texture is mirrored.
class TexturedSurface
{
public:
  /// @param look the look, with at least one triangle
  /// @param rest points of the surface at rest, look.surface.point_count x 3
  TexturedSurface(const FileLook& look, PointsView rest);
  ~TexturedSurface();

  /// One actor for each material.
  const std::vector<vtkSmartPointer<vtkActor>>& actors() const { return this->actors_; }
  /// The drawn triangles of all materials.
  vtkPolyData* polydata() const;

  /// Set the positions of the surface's points. The cost is O(#points + #triangles).
  void move(PointsView points);

private:
  void take_positions(PointsView points);
  void add_coordinates(const SurfaceLook& surface);
  void add_colors(const SurfaceLook& surface);
  void add_material(const SurfaceLook& surface, Index material, const std::vector<Index>& triangles,
    LookTextures& textures);
  vtkSmartPointer<vtkPolyData> part_of(const std::vector<Index>& triangles) const;
  void update_tangents();

  std::vector<Index> points_; ///< point of the surface for each vertex of the look
  Points positions_; ///< temporary: positions of the vertices of the look
  std::unique_ptr<ShadedSurface> shaded_;
  std::vector<vtkSmartPointer<vtkActor>> actors_;
  std::vector<Index> bumpy_triangles_; ///< triangles whose material has a normal texture
  vtkNew<vtkFloatArray> tangents_; ///< tangents of the drawn points; empty without normal textures
};

} // namespace bindpose

#endif

#ifndef bindpose_look_surface_look_h
#define bindpose_look_surface_look_h

#include "geometry/mesh.h"

#include <string>
#include <vector>

namespace bindpose
{

/// A picture on a surface.
struct LookTexture
{
  enum class Wrap
  {
    repeat,
    mirror,
    clamp
  };
  int image = -1; ///< index into SurfaceLook::images; -1: no texture
  Wrap wrap = Wrap::repeat; ///< what is drawn outside of the coordinates 0 to 1
  bool interpolates = true; ///< false: each pixel of the picture is a square of one color
};

/// A picture, as the bytes of a file.
struct LookImage
{
  std::string bytes; ///< empty: not readable
  std::string format; ///< png, jpg, bmp, tif or tga
};

/// A material as glTF 2.0 defines it. Colors are linear values.
struct LookMaterial
{
  enum class Alpha
  {
    opaque,
    mask, ///< parts with an opacity below alpha_cutoff are not drawn, others are opaque
    blend
  };
  std::string name;
  Eigen::Vector4d base_color = Eigen::Vector4d::Ones(); ///< red, green, blue and opacity
  LookTexture base_color_texture; ///< multiplied with base_color
  double metallic = 1.0; ///< 0: plastic, 1: metal
  double roughness = 1.0; ///< 0: mirror, 1: dull
  LookTexture metallic_roughness_texture; ///< green: roughness; blue: metallic
  LookTexture occlusion_texture; ///< red: how much ambient light reaches the surface
  double occlusion_strength = 1.0;
  LookTexture normal_texture;
  double normal_scale = 1.0;
  Vec3 emission = Vec3::Zero();
  LookTexture emission_texture; ///< multiplied with `emission`
  Alpha alpha = Alpha::opaque;
  double alpha_cutoff = 0.5;
  bool is_double_sided = false; ///< false: back sides are not drawn
  bool is_unlit = false; ///< draw base_color without lighting
};

/// The materials, textures and vertex colors of a surface. The vertices of the look are those of
/// the file: where textures have a seam, several of them belong to one point of the surface.
struct SurfaceLook
{
  Index point_count = 0; ///< number of points of the surface
  std::vector<Index> points; ///< #L, point of the surface for each vertex of the look
  Triangles triangles; ///< #T x 3, vertices of the look
  std::vector<Index> triangle_materials; ///< #T, index into `materials`, or -1
  /// #L x 2, texture coordinates; the origin is at the lower left. (0, 0) for vertices without
  /// coordinates.
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> coordinates;
  /// #L x 4, linear values from 0 to 1, multiplied with the base color. 0 rows: no colors.
  Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> colors;
  std::vector<LookMaterial> materials;
  std::vector<LookImage> images;

  /// Report whether the look adds no color to the shape: no vertex colors, and no material with a
  /// texture, emission, or a base color other than white. Metallic and roughness are ignored.
  bool is_plain() const;
  /// Report whether a material of a triangle is translucent.
  bool is_translucent() const;
};

} // namespace bindpose

#endif

#include "look/surface_look.h"

#include <algorithm>
#include <iterator>

namespace bindpose
{

namespace
{
bool is_white(const LookMaterial& material)
{
  const LookTexture* textures[] = { &material.base_color_texture,
    &material.metallic_roughness_texture, &material.occlusion_texture, &material.normal_texture,
    &material.emission_texture };
  return material.base_color.isOnes() && material.emission.isZero() &&
    std::all_of(std::begin(textures), std::end(textures),
      [](const LookTexture* texture) { return texture->image < 0; });
}
} // namespace

bool SurfaceLook::is_plain() const
{
  return this->colors.rows() == 0 &&
    std::all_of(this->triangle_materials.begin(), this->triangle_materials.end(),
      [&](Index material) { return material < 0 || is_white(this->materials[material]); });
}

bool SurfaceLook::is_translucent() const
{
  return std::any_of(this->triangle_materials.begin(), this->triangle_materials.end(),
    [&](Index material)
    { return material >= 0 && this->materials[material].alpha == LookMaterial::Alpha::blend; });
}

} // namespace bindpose

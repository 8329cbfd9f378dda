// VTK's shader for physically based rendering uses the alpha of a texture in place of the opacity
// of the property, and no emission without a texture. Replacements in the shader and a white
// texture give the results that glTF 2.0 defines.
#include "shapes/look_material.h"

#include "weight_uses/weighted_colors.h"

#include "vtkActor.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkProperty.h"
#include "vtkShaderProperty.h"
#include "vtkTexture.h"
#include "vtkUniforms.h"
#include "vtkUnsignedCharArray.h"

#include <string>

namespace bindpose
{

vtkTexture* LookTextures::texture(const LookTexture& from, bool is_color)
{
  vtkImageData* picture =
    from.image < 0 ? nullptr : this->look_.pictures.at(static_cast<std::size_t>(from.image)).Get();
  if (!picture)
  {
    return nullptr;
  }
  vtkSmartPointer<vtkTexture>& texture =
    this->textures_[{ from.image, from.wrap, from.interpolates, is_color }];
  if (!texture)
  {
    texture = vtkSmartPointer<vtkTexture>::New();
    texture->SetInputData(picture);
    texture->SetColorModeToDirectScalars();
    texture->SetInterpolate(from.interpolates);
    texture->SetMipmap(from.interpolates);
    texture->SetWrap(from.wrap == LookTexture::Wrap::clamp ? vtkTexture::ClampToEdge
        : from.wrap == LookTexture::Wrap::mirror           ? vtkTexture::MirroredRepeat
                                                           : vtkTexture::Repeat);
    texture->SetUseSRGBColorSpace(is_color);
  }
  return texture;
}

vtkTexture* LookTextures::white()
{
  if (!this->white_)
  {
    vtkNew<vtkUnsignedCharArray> pixels;
    pixels->SetNumberOfComponents(3);
    pixels->SetNumberOfTuples(4);
    pixels->Fill(255);
    vtkNew<vtkImageData> picture;
    picture->SetDimensions(2, 2, 1);
    picture->GetPointData()->SetScalars(pixels);
    this->white_ = vtkSmartPointer<vtkTexture>::New();
    this->white_->SetInputData(picture);
    this->white_->SetColorModeToDirectScalars();
    this->white_->UseSRGBColorSpaceOn();
  }
  return this->white_;
}

namespace
{
void apply_unlit(LookTextures& textures, const LookMaterial& material, vtkActor* actor)
{
  vtkProperty* property = actor->GetProperty();
  property->LightingOff();
  property->SetColor(from_linear_light(material.base_color[0]),
    from_linear_light(material.base_color[1]), from_linear_light(material.base_color[2]));
  actor->SetTexture(textures.texture(material.base_color_texture, false));
}

void apply_lit(LookTextures& textures, const LookMaterial& material, vtkActor* actor)
{
  vtkProperty* property = actor->GetProperty();
  property->SetInterpolationToPBR();
  property->SetColor(material.base_color[0], material.base_color[1], material.base_color[2]);
  property->SetMetallic(material.metallic);
  property->SetRoughness(material.roughness);
  if (vtkTexture* texture = textures.texture(material.base_color_texture, true))
  {
    property->SetBaseColorTexture(texture);
  }
  const LookTexture& surface = material.metallic_roughness_texture;
  const bool has_occlusion =
    surface.image >= 0 && surface.image == material.occlusion_texture.image;
  property->SetOcclusionStrength(has_occlusion ? material.occlusion_strength : 0.0);
  if (vtkTexture* texture = textures.texture(surface, false))
  {
    property->SetORMTexture(texture);
  }
  if (vtkTexture* texture = textures.texture(material.normal_texture, false))
  {
    property->SetNormalTexture(texture);
    property->SetNormalScale(material.normal_scale);
  }
  const bool has_texture = material.emission_texture.image >= 0;
  vtkTexture* emission =
    has_texture ? textures.texture(material.emission_texture, true) : textures.white();
  if (emission && !material.emission.isZero())
  {
    property->SetEmissiveTexture(emission);
    property->SetEmissiveFactor(material.emission[0], material.emission[1], material.emission[2]);
  }
}

/// Apply the alpha mode. The opacity of a pixel is the product of the opacities of material, vertex
/// color and texture.
void apply_alpha(const LookMaterial& material, bool has_colors, vtkActor* actor)
{
  vtkShaderProperty* shader = actor->GetShaderProperty();
  std::string code;
  const bool is_replaced = !material.is_unlit &&
    actor->GetProperty()->GetTexture("albedoTex") != nullptr; // the alpha of the texture alone
  if (is_replaced && material.alpha != LookMaterial::Alpha::opaque)
  {
    shader->GetFragmentCustomUniforms()->SetUniformf(
      "lookOpacity", static_cast<float>(material.base_color[3]));
    code += has_colors ? "  gl_FragData[0].a *= vertexColorVSOutput.a;\n"
                       : "  gl_FragData[0].a *= lookOpacity;\n";
  }
  if (material.alpha == LookMaterial::Alpha::mask)
  {
    shader->GetFragmentCustomUniforms()->SetUniformf(
      "lookCutoff", static_cast<float>(material.alpha_cutoff));
    code += "  if (gl_FragData[0].a < lookCutoff) discard;\n";
  }
  if (material.alpha != LookMaterial::Alpha::blend)
  {
    code += "  gl_FragData[0].a = 1.0;\n";
  }
  shader->AddFragmentShaderReplacement(
    "//VTK::TCoord::Impl", true, "//VTK::TCoord::Impl\n" + code, false);
}
} // namespace

void apply_material(
  LookTextures& textures, const LookMaterial& material, bool has_colors, vtkActor* actor)
{
  if (material.is_unlit)
  {
    apply_unlit(textures, material, actor);
  }
  else
  {
    apply_lit(textures, material, actor);
  }
  apply_alpha(material, has_colors, actor);
  vtkProperty* property = actor->GetProperty();
  property->SetBackfaceCulling(!material.is_double_sided);
  if (material.alpha != LookMaterial::Alpha::opaque && !has_colors)
  {
    property->SetOpacity(material.base_color[3]);
  }
  if (material.alpha == LookMaterial::Alpha::blend)
  {
    actor->ForceTranslucentOn();
  }
  else
  {
    actor->ForceOpaqueOn();
  }
}

} // namespace bindpose

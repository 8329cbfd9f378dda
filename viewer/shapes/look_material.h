#ifndef bindpose_shapes_look_material_h
#define bindpose_shapes_look_material_h

#include "look_file.h"

#include "vtkSmartPointer.h"
#include "vtkTexture.h"

#include <map>
#include <tuple>

class vtkActor;

namespace bindpose
{

/// The textures of a look. Materials share them, so that each picture is on the graphics card once.
class LookTextures
{
public:
  /// @param look must outlive this object
  explicit LookTextures(const FileLook& look) : look_(look) {}

  /// Return a texture, or null if there is none or its picture could not be read.
  /// @param is_color whether the pixels are colors of sRGB that the shader needs as linear values
  vtkTexture* texture(const LookTexture& from, bool is_color);
  /// Return a white texture.
  vtkTexture* white();

private:
  const FileLook& look_;
  /// By image, LookTexture::Wrap, interpolation and is_color.
  std::map<std::tuple<int, LookTexture::Wrap, bool, bool>, vtkSmartPointer<vtkTexture>> textures_;
  vtkSmartPointer<vtkTexture> white_;
};

/// Apply a material of a look to an actor. Textures whose picture could not be read are left out.
/// @param has_colors whether the mapper of the actor has vertex colors, which contain the base
/// color and are linear values, or values of sRGB if the material is unlit
void apply_material(
  LookTextures& textures, const LookMaterial& material, bool has_colors, vtkActor* actor);

} // namespace bindpose

#endif

// The look of every format is read from a glTF document. For OBJ and PLY files, and for formats
// that assimp reads, asset_file.h makes the document.
#include "look_file.h"

#include "asset_file.h"
#include "file_kind.h"
#include "gltf/gltf_scene_meshes.h"
#include "gltf/gltf_skin_parts.h"
#include "look/gltf_look.h"
#include "picture_bytes.h"

#include "vtkImageData.h"
#include "vtkImageShrink3D.h"
#include "vtkImageWrapPad.h"
#include "vtkNew.h"

#include <algorithm>
#include <utility>

namespace bindpose
{

namespace
{
constexpr int largest_side = 8192; // pixels; graphics drivers refuse larger textures
constexpr vtkIdType most_pixels = vtkIdType(1) << 28; // of all pictures together: about 1 GB

/// Return a picture whose sides are at most largest_side.
vtkSmartPointer<vtkImageData> shrink(vtkImageData* picture)
{
  const int* size = picture->GetDimensions();
  const int factor = (std::max(size[0], size[1]) + largest_side - 1) / largest_side;
  if (factor <= 1)
  {
    return picture;
  }
  vtkNew<vtkImageShrink3D> shrink;
  shrink->SetInputData(picture);
  shrink->SetShrinkFactors(std::min(factor, size[0]), std::min(factor, size[1]), 1);
  shrink->MeanOn();
  shrink->Update();
  return shrink->GetOutput();
}

/// Return a picture with at least two columns and rows, because VTK does not draw single columns
/// and rows correctly.
vtkSmartPointer<vtkImageData> widen(vtkImageData* picture)
{
  const int* size = picture->GetDimensions();
  if (size[0] > 1 && size[1] > 1)
  {
    return picture;
  }
  vtkNew<vtkImageWrapPad> repeat;
  repeat->SetInputData(picture);
  repeat->SetOutputWholeExtent(0, std::max(size[0], 2) - 1, 0, std::max(size[1], 2) - 1, 0, 0);
  repeat->Update();
  return repeat->GetOutput();
}

/// Decode the images.
Status read_pictures(ExecutionContext& context, const std::string& path, FileLook& look)
{
  Status status;
  std::vector<LookImage>& images = look.surface.images;
  look.pictures.resize(images.size());
  vtkIdType all_pixels = 0;
  for (std::size_t k = 0; k < images.size(); ++k)
  {
    auto& [bytes, format] = images[k];
    if (bytes.empty())
    {
      continue;
    }
    vtkSmartPointer<vtkImageData> pixels;
    const Status picture =
      decode_picture(context, path + ": picture " + std::to_string(k), bytes, format, pixels);
    bytes = std::string();
    if (picture.code == StatusCode::canceled)
    {
      return picture;
    }
    if (!picture.ok())
    {
      status.warnings.push_back(picture.message);
      continue;
    }
    const vtkSmartPointer<vtkImageData> drawn = widen(shrink(pixels));
    all_pixels += drawn->GetNumberOfPoints();
    if (all_pixels > most_pixels)
    {
      status.warnings.push_back(path + ": picture " + std::to_string(k) +
        " and all after it are not drawn because the pictures have more than " +
        std::to_string(most_pixels) + " pixels");
      return status;
    }
    look.pictures[k] = drawn;
  }
  return status;
}
} // namespace

Status read_look_file(ExecutionContext& context, const std::string& path, FileLook& look)
{
  look = FileLook();
  Status status = check_extension(path, asset_extensions());
  if (!status.ok())
  {
    return status;
  }
  const bool is_polygon_file = is_listed(file_extension(path), "obj ply");
  const bool is_gltf = is_listed(file_extension(path), "glb gltf");
  const auto read = [&](const GltfContent& content, Status& found)
  {
    if (is_gltf)
    {
      const GltfAccessors accessors(content.model, content.bytes.size());
      const GltfSkinParts skin = find_skin_parts(content.model, accessors);
      look.surface = read_gltf_look(content, skin.parts, skin.vertices, found.warnings);
    }
    else
    {
      const GltfSceneMeshes scene = read_gltf_scene(content.model, content.bytes.size(), found);
      look.surface = read_gltf_look(content, scene.parts, scene.points.rows(), found.warnings);
    }
  };
  if (is_gltf)
  {
    status = read_gltf_file(context, path, read);
  }
  else
  {
    AssetBytes asset;
    status = read_asset_bytes(context, path, asset);
    if (status.ok())
    {
      Status parsed = read_gltf_bytes(path, std::move(asset.bytes), read);
      parsed.warnings.insert(
        parsed.warnings.begin(), status.warnings.begin(), status.warnings.end());
      status = std::move(parsed);
    }
    if (status.ok() && is_polygon_file)
    {
      SurfaceLook& surface = look.surface;
      std::transform(surface.points.begin(), surface.points.end(), surface.points.begin(),
        [&](Index vertex) { return asset.points.at(static_cast<std::size_t>(vertex)); });
      surface.point_count = asset.point_count;
    }
  }
  if (status.ok())
  {
    const Status pictures = read_pictures(context, path, look);
    status.warnings.insert(
      status.warnings.end(), pictures.warnings.begin(), pictures.warnings.end());
    status.code = pictures.code;
    status.message = pictures.message;
  }
  if (!status.ok())
  {
    look = FileLook();
  }
  return status;
}

} // namespace bindpose

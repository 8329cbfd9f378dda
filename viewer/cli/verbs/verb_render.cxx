// Implements bindpose render FILE… -o OUT.png, which renders images with the library
// bindpose_scene. VTK 9.1 ends the process if there is no X server, even for offscreen rendering.
// Without an X server the program therefore runs itself again under xvfb-run.
#include "cli/interrupt.h"
#include "cli/session.h"
#include "cli/under_xvfb.h"
#include "cli/verbs/verbs.h"

#include "file_kind.h"
#include "helper/scratch_folder.h"
#include "io/atomic_file.h"
#include "io/text_scanner.h"
#include "look_file.h"
#include "pictures/display.h"
#include "pictures/picture.h"
#include "pictures/sequence_file.h"
#include "pictures/video_file.h"
#include "scene/categories.h"

#include "vtkAssetReader.h"
#include "vtkDataSet.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSurfaceDefects.h"

#include <cstdio>
#include <cstdlib>
#include <memory>

#include <unistd.h>

namespace bindpose::cli
{

namespace
{
/// Split a text at commas; empty parts are kept.
std::vector<std::string> split_at_commas(const std::string& text)
{
  std::vector<std::string> parts(1);
  for (const char c : text)
  {
    if (c == ',')
    {
      parts.emplace_back();
    }
    else
    {
      parts.back() += c;
    }
  }
  return parts;
}

/// Parse two numbers with a separator between them, such as "AxB".
bool parse_pair(const std::string& text, char separator, double& first, double& second)
{
  const std::size_t separator_offset = text.find(separator);
  return separator_offset != std::string::npos &&
    parse_number(text.substr(0, separator_offset), first) &&
    parse_number(text.substr(separator_offset + 1), second);
}

bool parse_vector(const std::string& text, Vec3& vector)
{
  const std::vector<std::string> words = split_at_commas(text);
  return words.size() == 3 && parse_number(words[0], vector[0]) &&
    parse_number(words[1], vector[1]) && parse_number(words[2], vector[2]);
}

/// Parse --section: a fraction, a plane perpendicular to an axis, a plane given by a normal and a
/// point, or the word none.
bool read_section(Session& session, PictureOptions& options)
{
  const std::string text = session.arguments().text("section");
  if (text == "none")
  {
    options.cut = false;
    return true;
  }
  if (parse_number(text, options.section))
  {
    return true;
  }
  Plane plane;
  const std::size_t separator_offset = text.find('@');
  double coordinate = 0.0;
  if (text.size() > 2 && text[0] >= 'x' && text[0] <= 'z' && text[1] == '=' &&
    parse_number(text.substr(2), coordinate))
  {
    plane.normal = Vec3::Unit(text[0] - 'x');
    plane.origin = coordinate * plane.normal;
  }
  else if (separator_offset == std::string::npos ||
    !parse_vector(text.substr(0, separator_offset), plane.normal) ||
    !parse_vector(text.substr(separator_offset + 1), plane.origin))
  {
    return session.invalid("--section '" + text +
      "' is not valid: expected none, a number from 0 to 1, or a plane such as x=0.2 or "
      "1,0,0@0.2,0,0");
  }
  options.section_plane = plane;
  return true;
}

ColorBy color_by(const std::string& word)
{
  return word == "winding-number" ? ColorBy::winding_number
    : word == "label"             ? ColorBy::label
    : word == "quality"           ? ColorBy::quality
    : word == "rung"              ? ColorBy::method
    : word == "handle"            ? ColorBy::handle
    : word == "row-sum"           ? ColorBy::row_sum
    : word == "rotation-cluster"  ? ColorBy::rotation_cluster
    : word == "rotation"          ? ColorBy::rotation
                                  : ColorBy::array;
}

bool read_options(Session& session, PictureOptions& options)
{
  const Arguments& arguments = session.arguments();
  double width = 0;
  double height = 0;
  if (!parse_pair(arguments.text("size"), 'x', width, height) || !(width >= 1 && width <= 1e6) ||
    !(height >= 1 && height <= 1e6))
  {
    return session.invalid("--size '" + arguments.text("size") +
      "' is not valid: expected width and height in pixels, such as 1200x900");
  }
  options.width = static_cast<int>(width);
  options.height = static_cast<int>(height);
  if (arguments.has("range") &&
    !parse_pair(arguments.text("range"), ',', options.range[0], options.range[1]))
  {
    return session.invalid(
      "--range '" + arguments.text("range") + "' is not valid: expected two numbers, such as 0,1");
  }
  options.array = arguments.text("array");
  options.component = arguments.text("component");
  options.color_by = color_by(arguments.text("color"));
  if (options.color_by != ColorBy::array && (!options.array.empty() || !options.component.empty()))
  {
    return session.invalid(
      "--color " + arguments.text("color") + " cannot be combined with --array or --component");
  }
  options.extrema = arguments.has("extrema");
  const bool needs_weights =
    !options.component.empty() || options.extrema || arguments.has("minus");
  if (options.array.empty() && options.color_by == ColorBy::array && needs_weights)
  {
    options.array = "Weights"; // --component, --extrema and --minus use Weights by default
  }
  if (arguments.has("isosurface"))
  {
    for (const std::string& word : split_at_commas(arguments.text("isosurface")))
    {
      options.isosurfaces.emplace_back();
      if (!parse_number(word, options.isosurfaces.back()))
      {
        return session.invalid("--isosurface '" + arguments.text("isosurface") +
          "' is not valid: expected numbers separated by commas, such as 0.25,0.5");
      }
    }
  }
  options.volume = arguments.has("volume");
  options.columns = arguments.integer("columns");
  options.scale = arguments.integer("scale");
  options.title = arguments.text("title");
  options.edges = arguments.has("edges");
  options.handle_names = arguments.has("handle-names");
  options.slice = arguments.has("slice");
  options.shrink = arguments.number("shrink");
  options.view.up = arguments.text("up");
  options.view.azimuth = arguments.number("azimuth");
  options.view.elevation = arguments.number("elevation");
  options.view.zoom = arguments.number("zoom");
  return read_section(session, options);
}

vtkSmartPointer<vtkPolyData> defects_of(Session& session, vtkDataSet* surface)
{
  vtkNew<vtkSurfaceDefects> defects;
  defects->SetInputData(0, surface);
  return session.run(defects, "defects", 0.0, 1.0, Merge::nothing)
    ? vtkPolyData::SafeDownCast(defects->GetOutput())
    : nullptr;
}

/// Compute the defects of every surface for --defects. Add the defects of drawn datasets to their
/// tiles, and those of --context datasets to the context of all tiles.
bool add_defects(Session& session, std::vector<Tile>& tiles)
{
  bool any = false;
  const auto is_surface = [](vtkDataSet* data)
  {
    auto* polydata = vtkPolyData::SafeDownCast(data);
    return polydata && polydata->GetNumberOfPolys() + polydata->GetNumberOfStrips() > 0 &&
      !is_defect_data(data);
  };
  // defects of the context datasets; all tiles have the same context
  std::vector<vtkSmartPointer<vtkDataSet>> context_defects;
  for (const auto& data : tiles.front().context)
  {
    if (is_surface(data))
    {
      context_defects.push_back(defects_of(session, data));
      if (!context_defects.back())
      {
        return false;
      }
    }
  }
  for (Tile& tile : tiles)
  {
    tile.context.insert(tile.context.end(), context_defects.begin(), context_defects.end());
    if (is_surface(tile.data))
    {
      any = true;
      tile.defects = defects_of(session, tile.data);
      if (!tile.defects)
      {
        return false;
      }
    }
  }
  return any || !context_defects.empty() ||
    session.invalid("--defects needs a surface; add one with --context SURFACE");
}

/// Read the materials, textures and vertex colors of the meshes, unless the picture has other
/// colors.
bool add_looks(Session& session, const std::vector<std::string>& files,
  const PictureOptions& options, std::vector<Tile>& tiles)
{
  const Arguments& arguments = session.arguments();
  const bool has_colors = !options.array.empty() || options.color_by != ColorBy::array;
  if (arguments.has("look") && (has_colors || arguments.has("defects") || arguments.has("plain")))
  {
    return session.invalid("--look cannot be combined with --plain, --defects, --array, --color, "
                           "--component, --minus or "
                           "--extrema");
  }
  if (has_colors || arguments.has("defects") || arguments.has("plain"))
  {
    return true;
  }
  const std::string common = arguments.text("look");
  std::shared_ptr<const FileLook> look;
  for (std::size_t k = 0; k < tiles.size(); ++k)
  {
    auto* mesh = vtkPolyData::SafeDownCast(tiles[k].data);
    const std::string& file = common.empty() ? files[k] : common;
    if (!mesh || mesh->GetNumberOfPolys() == 0 ||
      (common.empty() && !is_listed(file_extension(file), vtkAssetReader::GetFileExtensions())))
    {
      continue;
    }
    if (!look || common.empty())
    {
      const auto found = std::make_shared<FileLook>();
      ExecutionContext context({}, interrupted);
      const Status status = read_look_file(context, file, *found);
      for (const std::string& warning : status.warnings)
      {
        session.warn(warning);
      }
      if (!status.ok() && (!common.empty() || status.code == StatusCode::canceled))
      {
        return session.fail(status);
      }
      if (!status.ok())
      {
        session.warn("the materials and textures of the mesh are not drawn: " + status.message);
      }
      look = found;
    }
    if (look->surface.is_plain())
    {
      continue;
    }
    if (look->surface.point_count != mesh->GetNumberOfPoints())
    {
      return session.invalid(files[k] + " has " + std::to_string(mesh->GetNumberOfPoints()) +
        " points, but the mesh of " + file + " has " + std::to_string(look->surface.point_count) +
        "; --look needs the file of the undeformed mesh");
    }
    tiles[k].look = look;
  }
  return common.empty() || look || session.invalid("--look needs a FILE with triangles");
}

/// List the files to draw. A sequence (.pvd) is replaced by the files of at most --frames evenly
/// spaced frames. Without --frames, a video uses all frames, and an image at most 12.
bool list_files(Session& session, bool is_video, std::vector<std::string>& files,
  std::vector<std::string>& labels, double& rate)
{
  const Arguments& arguments = session.arguments();
  const std::vector<std::string>& named_files = arguments.list("FILE");
  const auto maximum_frames = static_cast<std::size_t>(arguments.integer("frames"));
  for (const std::string& file : named_files)
  {
    if (file_extension(file) != "pvd")
    {
      files.push_back(file);
      labels.emplace_back();
      continue;
    }
    if (named_files.size() > 1)
    {
      return session.invalid(file + " is a sequence and must be the only FILE");
    }
    Sequence sequence;
    const Status status = read_collection(file, sequence);
    if (!status.ok())
    {
      return session.fail(status);
    }
    rate = frames_per_second(sequence);
    const std::size_t count = sequence.files.size();
    for (const std::size_t k : evenly_spaced(count,
           maximum_frames > 0 ? maximum_frames
             : is_video       ? count
                              : 12))
    {
      char label[40];
      std::snprintf(label, sizeof(label), "%.4g s", sequence.times[k]);
      files.push_back(sequence.files[k]);
      labels.emplace_back(label);
    }
  }
  if (arguments.has("fps"))
  {
    rate = arguments.number("fps");
  }
  return (rate > 0.0 && rate <= 1000.0) ||
    session.invalid("the sequence has " + std::to_string(rate) +
      " frames per second; expected more than 0 and at most 1000 (see --fps)");
}

/// Render one image per tile, all with the same view and color range, then run ffmpeg. The images
/// are in a temporary folder, which is removed in all cases.
Status render_video(Session& session, std::vector<Tile> tiles, const PictureOptions& base_options,
  double rate, const std::string& output)
{
  const ScratchFolder folder("frames");
  if (folder.path().empty())
  {
    return Status::failure(StatusCode::unavailable, folder.error());
  }
  PictureOptions options = base_options;
  for (Tile& tile : tiles)
  {
    tile.label.clear(); // the label contains the time, which differs in each image
  }
  options.undrawn_tiles = tiles;
  Status status;
  for (std::size_t k = 0; k < tiles.size(); ++k)
  {
    if (interrupted())
    {
      return Status::canceled();
    }
    session.show(0.9 * static_cast<double>(k) / static_cast<double>(tiles.size()), "render");
    status =
      render_to_png({ tiles[k] }, options, frame_file(folder.path(), static_cast<int>(k)), false);
    if (!status.ok())
    {
      return status;
    }
  }
  AtomicFile file;
  Status written = file.open(output, session.arguments().has("overwrite"));
  if (written.ok())
  {
    session.show(0.9, "ffmpeg");
    ExecutionContext context({}, interrupted);
    written = write_video(context, folder.path(), rate, file.temporary());
  }
  if (written.ok())
  {
    written = file.commit();
  }
  if (!written.ok())
  {
    return written;
  }
  status.report.set("counts.frames", tiles.size());
  status.report.set("frames_per_second", rate);
  return status;
}
} // namespace

void run_render(Session& session)
{
  const Arguments& arguments = session.arguments();
  const std::string output = arguments.text("output");
  PictureOptions options;
  const bool is_video = is_listed(file_extension(output), video_extensions);
  std::vector<std::string> files;
  std::vector<std::string> times;
  double rate = 24.0;
  if (!session.check_output(output, "png " + std::string(video_extensions)) ||
    !read_options(session, options) || !list_files(session, is_video, files, times, rate))
  {
    return;
  }
  if (arguments.has("transparent"))
  {
    if (is_video)
    {
      session.invalid("--transparent needs a .png output");
      return;
    }
    options.background = Background::transparent;
  }
  if (const Status status = check_ffmpeg(); is_video && !status.ok())
  {
    session.fail(status); // fail now, before the expensive work
    return;
  }
  session.ignore_losses();
  std::vector<Tile> tiles;
  for (const std::string& file : files)
  {
    Tile tile;
    tile.label = times[tiles.size()];
    tile.data = session.read_any(file);
    if (!tile.data)
    {
      return;
    }
    tiles.push_back(tile);
  }
  if (arguments.has("labels"))
  {
    const std::vector<std::string> labels = split_at_commas(arguments.text("labels"));
    if (labels.size() > tiles.size())
    {
      session.invalid("--labels has " + std::to_string(labels.size()) +
        " labels, but the picture has only " + std::to_string(tiles.size()) +
        (tiles.size() == 1 ? " tile" : " tiles"));
      return;
    }
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      tiles[i].label = labels[i];
    }
  }
  for (const std::string& file : arguments.list("context"))
  {
    const auto context = session.read(file);
    if (!context)
    {
      return;
    }
    for (Tile& tile : tiles)
    {
      tile.context.push_back(context);
    }
  }
  if (arguments.has("minus"))
  {
    options.subtracted_data = session.read(arguments.text("minus"));
    if (!options.subtracted_data)
    {
      return;
    }
  }
  if (!add_looks(session, files, options, tiles))
  {
    return;
  }
  if (arguments.has("defects") && !add_defects(session, tiles))
  {
    return;
  }
  if (arguments.has("handles"))
  {
    const auto handles = session.read_handles(arguments.text("handles"), tiles.front().data);
    if (!handles)
    {
      return;
    }
    for (Tile& tile : tiles)
    {
      tile.handles = handles;
    }
  }
  if (!can_render())
  {
    run_again_under_xvfb(arguments.command_line);
    session.fail(Status::failure(StatusCode::unavailable, no_display_message()));
    return;
  }
  if (interrupted())
  {
    session.fail(Status::canceled());
    return;
  }
  Status status = is_video ? render_video(session, tiles, options, rate, output)
                           : render_to_png(tiles, options, output, arguments.has("overwrite"));
  session.report().merge(status.report);
  for (const std::string& warning : status.warnings)
  {
    session.warn(warning);
  }
  if (!status.ok())
  {
    session.fail(status);
  }
}

} // namespace bindpose::cli

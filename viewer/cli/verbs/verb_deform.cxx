// Implements bindpose deform MESH_WITH_WEIGHTS --handles H --pose POSE.json. A single pose gives
// one file. A sequence, expressions in time and a dynamic body give numbered files and a .pvd file
// for ParaView, or one animated glTF file.
#include "cli/session.h"
#include "cli/set_options.h"
#include "cli/verbs/verbs.h"

#include "base/memory.h"
#include "file_kind.h"
#include "io/atomic_file.h"
#include "pictures/sequence_file.h"
#include "vtkFullARAP.h"
#include "vtkGLTFSkinWriter.h"
#include "vtkMovingLeastSquaresWarp.h"
#include "vtkPoseHandles.h"
#include "vtkReducedARAP.h"
#include "vtkReducedDynamics.h"
#include "vtkSkinningDeformation.h"
#include "vtkVariationalSurface.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataSet.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <functional>

namespace bindpose::cli
{

namespace
{
/// Make a filter of as-rigid-as-possible deformation.
template <typename Filter>
vtkSmartPointer<Filter> make_arap(const Arguments& arguments)
{
  auto arap = vtkSmartPointer<Filter>::New();
  set_arap_options(arguments, arap.Get());
  set_rotation_arrays_options(arguments, arap.Get());
  return arap;
}

vtkSmartPointer<vtkPoseAlgorithm> make_variational(const Arguments& arguments)
{
  auto surface = vtkSmartPointer<vtkVariationalSurface>::New();
  set_variational_options(arguments, surface.Get());
  return surface;
}

vtkSmartPointer<vtkPoseAlgorithm> make_reduced_arap(const Arguments& arguments)
{
  const auto arap = make_arap<vtkReducedARAP>(arguments);
  set_reduced_arap_bind_options(arguments, arap.Get());
  set_time_budget_options(arguments, arap.Get());
  return arap;
}

vtkSmartPointer<vtkReducedDynamics> make_dynamics(const Arguments& arguments)
{
  const auto dynamics = make_arap<vtkReducedDynamics>(arguments);
  set_reduced_arap_bind_options(arguments, dynamics.Get());
  set_dynamics_options(arguments, dynamics.Get());
  return dynamics;
}

vtkSmartPointer<vtkPoseAlgorithm> make_deformation(const Arguments& arguments)
{
  const std::string method = arguments.text("method");
  if (method == "mls")
  {
    auto warp = vtkSmartPointer<vtkMovingLeastSquaresWarp>::New();
    set_moving_least_squares_options(arguments, warp.Get());
    return warp;
  }
  if (method == "reduced-arap")
  {
    return make_reduced_arap(arguments);
  }
  if (method == "full-arap")
  {
    return make_arap<vtkFullARAP>(arguments);
  }
  if (method == "variational")
  {
    return make_variational(arguments);
  }
  auto skinning = vtkSmartPointer<vtkSkinningDeformation>::New();
  skinning->SetMethod(arguments.choice("method",
    { { "lbs", vtkSkinningDeformation::LINEAR_BLEND },
      { "dqs", vtkSkinningDeformation::DUAL_QUATERNION },
      { "stbs", vtkSkinningDeformation::STRETCHABLE_BONES },
      { "cor", vtkSkinningDeformation::CENTERS_OF_ROTATION } }));
  set_skinning_options(arguments, skinning.Get());
  return skinning;
}

bool is_rig(const std::string& path)
{
  return is_listed(file_extension(path), "glb gltf");
}

/// The frames of a deformation, from a pose file, from expressions in time or from a dynamic body.
struct Frames
{
  int count = 1;
  double per_second = 0.0;
  bool sequence = false; ///< true: several frames; false: a single pose
  std::function<bool(int)> deform; ///< computes a frame of the output; returns false if it failed
};

/// Write one glTF file. Linear blend skinning is stored as transforms of the joints: an animation
/// for several frames, the pose of the joints for a single frame. The frames of all other methods
/// are stored as morph targets, because joints cannot represent these methods.
void write_rig(Session& session, vtkDataSet* mesh, vtkPolyData* handles, vtkPoseHandles* pose,
  const Frames& frames, vtkBindposeAlgorithm* deformation, const std::string& output)
{
  const Arguments& arguments = session.arguments();
  const bool linear = arguments.text("method") == "lbs" && !arguments.has("dynamics");
  const std::string animation = arguments.text("gltf-animation");
  const bool morph = animation == "morph" || (animation == "auto" && !linear);
  const bool skinned = mesh->GetPointData()->GetArray("Weights") != nullptr;
  if (!morph && !skinned)
  {
    session.invalid("animated joints need the point array 'Weights', which the mesh does not have; "
                    "use --gltf-animation morph");
    return;
  }
  const bool is_static = linear && !morph && !frames.sequence;
  // A glTF file is written as a whole, so all frames and the buffer of the file are in memory at
  // the same time.
  const double points = static_cast<double>(mesh->GetNumberOfPoints());
  const double frame_bytes = points * 3.0 * (sizeof(double) + sizeof(float));
  const Status memory = check_memory("an animation of " + std::to_string(frames.count) + " frames",
    is_static ? 0.0 : frames.count * frame_bytes, 0);
  if (!memory.ok())
  {
    session.fail(memory);
    return;
  }
  vtkNew<vtkGLTFSkinWriter> writer;
  writer->SetInputData(0, mesh);
  if (skinned)
  {
    writer->SetHandlesData(is_static ? vtkPolyData::SafeDownCast(pose->GetOutput()) : handles);
  }
  for (int k = 0; k < frames.count && !is_static; ++k)
  {
    if (!frames.deform(k))
    {
      return;
    }
    auto copy = vtk::TakeSmartPointer(deformation->GetOutput()->NewInstance());
    copy->ShallowCopy(deformation->GetOutput());
    writer->AddFrameData(copy);
  }
  writer->SetFramesPerSecond(frames.per_second);
  writer->SetAnimation(morph ? vtkGLTFSkinWriter::MORPH : vtkGLTFSkinWriter::JOINTS);
  writer->SetMaximumInfluences(arguments.integer("gltf-maximum-influences"));
  writer->SetFileName(output.c_str());
  if (session.write_rig(writer))
  {
    session.report().set("counts.frames", frames.count);
  }
}

/// Compute a fair surface with vtkVariationalSurface. Points that are marked in the mesh's array
/// Fixed keep their positions.
void run_fairing(Session& session, const std::string& output, const std::string& extensions)
{
  const Arguments& arguments = session.arguments();
  if (is_rig(output))
  {
    session.invalid("--fair without handles cannot write .glb or .gltf; write .vtp");
    return;
  }
  const auto mesh = session.read(arguments.text("MESH_WITH_WEIGHTS"));
  if (!mesh || !session.check_output(output, extensions))
  {
    return;
  }
  const vtkSmartPointer<vtkPoseAlgorithm> surface = make_variational(arguments);
  set_pose_options(arguments, surface.Get());
  surface->SetInputData(0, mesh);
  if (session.run(surface, "fair", 0.0, 1.0, Merge::all))
  {
    session.write(surface->GetOutput(), output);
  }
}
} // namespace

void run_deform(Session& session)
{
  const Arguments& arguments = session.arguments();
  const std::string output = arguments.text("output");
  const std::string extensions = "vtp vtu vtk ply stl obj off mesh glb gltf";
  const Status extension_status = check_extension(output, extensions);
  if (!extension_status.ok())
  {
    session.fail(extension_status);
    return;
  }
  const bool fair = arguments.text("method") == "variational" && arguments.has("fair");
  if (fair && !arguments.has("handles") && !arguments.has("pose") && !arguments.has("dynamics"))
  {
    run_fairing(session, output, extensions);
    return;
  }
  for (const char* option : { "handles", "pose" })
  {
    if (!arguments.has(option))
    {
      session.invalid(std::string("--") + option +
        " is required (only --method variational --fair works without --handles and --pose)");
      return;
    }
  }
  const auto mesh = session.read(arguments.text("MESH_WITH_WEIGHTS"));
  const auto handles = mesh ? session.read_handles(arguments.text("handles"), mesh) : nullptr;
  if (!handles)
  {
    return;
  }
  vtkNew<vtkPoseHandles> pose;
  pose->SetInputData(0, handles);
  pose->SetFileName(arguments.text("pose").c_str());
  if (!session.run(pose, "pose", 0.0, 0.0, Merge::nothing))
  {
    return;
  }
  for (const char* key : { "motion", "handles_without_joint[]", "joints_without_handle[]" })
  {
    if (const Report::Value* value = pose->GetReport().find(key))
    {
      session.report().set(key, *value);
    }
  }
  // The number of frames of a sequence is in its file. For expressions and dynamic bodies, the
  // option --frames specifies the number.
  const bool dynamic = arguments.has("dynamics");
  const int file_frames = pose->GetNumberOfFrames(), requested_frames = arguments.integer("frames");
  const bool has_motion = dynamic || (file_frames == 1 && pose->GetHasExpressions());
  if (requested_frames > 0 && !has_motion)
  {
    session.invalid("--frames needs a pose with expressions in t, or --dynamics");
    return;
  }
  const double time_step = arguments.number("time-step");
  Frames frames;
  frames.count = requested_frames > 0 ? requested_frames : file_frames;
  frames.per_second = has_motion ? 1.0 / time_step : pose->GetFramesPerSecond();
  frames.sequence = pose->GetSequence() || requested_frames > 0;
  const bool is_numbered = frames.sequence && !is_rig(output);
  std::vector<std::string> files{ output };
  if (is_numbered)
  {
    files.clear();
    for (int frame = 0; frame < frames.count; ++frame)
    {
      files.push_back(numbered_file(output, frame));
    }
  }
  const std::string pvd = collection_file(output);
  for (const std::string& file : files)
  {
    if (!session.check_output(file, extensions))
    {
      return;
    }
  }
  if (is_numbered && !session.check_output(pvd, "pvd"))
  {
    return;
  }
  vtkSmartPointer<vtkReducedDynamics> body;
  if (dynamic)
  {
    body = make_dynamics(arguments);
  }
  const vtkSmartPointer<vtkPoseAlgorithm> deformation =
    dynamic ? vtkSmartPointer<vtkPoseAlgorithm>(body) : make_deformation(arguments);
  set_pose_options(arguments, deformation.Get());
  // Suppress the error events of `pose`, because the deformation filter downstream reports the same
  // errors.
  vtkNew<vtkCallbackCommand> error_suppressor;
  error_suppressor->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  pose->AddObserver(vtkCommand::ErrorEvent, error_suppressor);
  deformation->SetInputData(0, mesh);
  deformation->SetInputConnection(1, pose->GetOutputPort());
  frames.deform = [&](int frame)
  {
    if (dynamic)
    {
      body->SetStep(frame); // the body requests the poses of all time steps up to this frame
    }
    else if (has_motion)
    {
      pose->SetTime(frame * time_step);
    }
    else
    {
      pose->SetFrame(frame);
    }
    const double begin = static_cast<double>(frame) / frames.count;
    const double end = static_cast<double>(frame + 1) / frames.count;
    return (dynamic || session.run(pose, "pose", begin, begin, Merge::nothing)) &&
      session.run(deformation, "deform", begin, end, Merge::all);
  };
  if (is_rig(output))
  {
    write_rig(session, mesh, handles, pose, frames, deformation, output);
    return;
  }
  std::int64_t iterations = 0;
  std::vector<AtomicFile> written_files(files.size());
  for (std::size_t i = 0; i < files.size() && !session.failed(); ++i)
  {
    if (frames.deform(static_cast<int>(i)))
    {
      iterations += static_cast<std::int64_t>(session.report().number("iterations", 0));
      session.write_uncommitted(deformation->GetOutput(), files[i], written_files[i]);
    }
  }
  // Commit all files at the end, so that a sequence is written completely or not at all. Until
  // then, existing files of the same names are kept.
  for (std::size_t i = 0; i < written_files.size() && !session.failed(); ++i)
  {
    session.commit(written_files[i]);
  }
  if (session.failed() ||
    (is_numbered && !session.write_text(format_collection(files, frames.per_second), pvd)))
  {
    return;
  }
  session.report().set("counts.frames", frames.count);
  if (session.report().find("iterations"))
  {
    session.report().set("iterations", iterations);
  }
}

} // namespace bindpose::cli

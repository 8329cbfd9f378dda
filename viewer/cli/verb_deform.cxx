// bindpose deform MESH_WITH_WEIGHTS --handles H --pose POSE.json: one pose gives one file, a
// sequence, expressions in time or a body that moves numbered files and a .pvd that ParaView plays,
// or one animated glTF file.
#include "cli/session.h"
#include "cli/verbs.h"

#include "file_kind.h"
#include "io/atomic_file.h"
#include "scene/sequence_file.h"
#include "vtkFullARAP.h"
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

#include <cmath>
#include <cstdio>
#include <functional>

namespace bindpose::cli
{

namespace
{
int energy_of(const std::string& word)
{
  return word == "spokes-and-rims" ? vtkReducedARAP::SPOKES_AND_RIMS
    : word == "spokes"             ? vtkReducedARAP::SPOKES
    : word == "tetrahedra"         ? vtkReducedARAP::TETRAHEDRA
    : word == "triangles"          ? vtkReducedARAP::TRIANGLES
                                   : vtkReducedARAP::AUTO;
}

/// What full and reduced as-rigid-as-possible have in common.
template <typename Filter>
vtkSmartPointer<Filter> make_arap(const Arguments& arguments)
{
  auto arap = vtkSmartPointer<Filter>::New();
  arap->SetEnergy(energy_of(arguments.text("energy")));
  arap->SetTolerance(arguments.number("tolerance"));
  arap->SetRotationArrays(arguments.has("rotation-arrays"));
  if (arguments.integer("iterations") > 0)
  {
    arap->SetMaximumIterations(arguments.integer("iterations"));
  }
  return arap;
}

vtkSmartPointer<vtkPoseAlgorithm> make_variational(const Arguments& arguments)
{
  auto surface = vtkSmartPointer<vtkVariationalSurface>::New();
  const std::string boundary = arguments.text("boundary"), tangents = arguments.text("tangents");
  surface->SetOrder(arguments.integer("order"));
  surface->SetBoundary(boundary == "tangent" ? vtkVariationalSurface::TANGENT
      : boundary == "curve"                  ? vtkVariationalSurface::CURVE
                                             : vtkVariationalSurface::REGION);
  surface->SetTangentSource(tangents == "given" ? vtkVariationalSurface::GIVEN
      : tangents == "clamped"                   ? vtkVariationalSurface::CLAMPED
                                                : vtkVariationalSurface::SURROUNDINGS);
  surface->SetFair(arguments.has("fair"));
  return surface;
}

/// What reduced as-rigid-as-possible and its dynamics have in common.
template <typename Filter>
vtkSmartPointer<Filter> make_reduced(const Arguments& arguments)
{
  auto arap = make_arap<Filter>(arguments);
  arap->SetNumberOfExtraWeights(arguments.integer("extra-weights"));
  arap->SetExtraWeights(arguments.text("extra-kind") == "eigenmodes" ? vtkReducedARAP::EIGENMODES
                                                                     : vtkReducedARAP::BUMPS);
  return arap;
}

vtkSmartPointer<vtkPoseAlgorithm> make_reduced_arap(const Arguments& arguments)
{
  const auto arap = make_reduced<vtkReducedARAP>(arguments);
  arap->SetTimeBudget(arguments.number("budget-us"));
  return arap;
}

vtkSmartPointer<vtkReducedDynamics> make_dynamics(const Arguments& arguments)
{
  const auto dynamics = make_reduced<vtkReducedDynamics>(arguments);
  dynamics->SetTimeStep(arguments.number("time-step"));
  dynamics->SetDensity(arguments.number("density"));
  dynamics->SetStiffness(arguments.number("stiffness"));
  dynamics->SetDamping(arguments.number("damping"));
  return dynamics;
}

/// "X,Y,Z"; false for anything else.
bool to_vector(const std::string& text, double (&vector)[3])
{
  int end = 0;
  return std::sscanf(text.c_str(), "%lf,%lf,%lf%n", &vector[0], &vector[1], &vector[2], &end) ==
    3 &&
    end == static_cast<int>(text.size()) && std::isfinite(vector[0]) && std::isfinite(vector[1]) &&
    std::isfinite(vector[2]);
}

vtkSmartPointer<vtkPoseAlgorithm> make_deformation(const Arguments& arguments)
{
  const std::string method = arguments.text("method");
  if (method == "mls")
  {
    auto warp = vtkSmartPointer<vtkMovingLeastSquaresWarp>::New();
    warp->SetExponent(arguments.number("exponent"));
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
  skinning->SetMethod(method == "dqs" ? vtkSkinningDeformation::DUAL_QUATERNION
      : method == "stbs"              ? vtkSkinningDeformation::STRETCHABLE_BONES
      : method == "cor"               ? vtkSkinningDeformation::CENTERS_OF_ROTATION
                                      : vtkSkinningDeformation::LINEAR_BLEND);
  skinning->SetSinglePrecision(arguments.has("single-precision"));
  skinning->SetMaximumInfluences(arguments.integer("influences"));
  skinning->SetSmallestWeight(arguments.number("smallest-weight"));
  const std::string edges = arguments.text("pseudo-edges");
  skinning->SetPseudoEdges(edges == "none" ? vtkSkinningDeformation::NO_PSEUDO_EDGES
      : edges == "auto"                    ? vtkSkinningDeformation::AUTOMATIC_PSEUDO_EDGES
                                           : vtkSkinningDeformation::GIVEN_PSEUDO_EDGES);
  skinning->SetPseudoEdgeStretch(arguments.has("pseudo-edge-stretch"));
  return skinning;
}

bool is_rig(const std::string& path)
{
  return is_listed(file_extension(path), "glb gltf");
}

/// The frames of a pose file, of expressions in time or of a body that moves.
struct Frames
{
  int count = 1;
  double per_second = 0.0;
  bool sequence = false; ///< else one pose
  std::function<bool(int)> deform; ///< makes one the deformation's output; false: it failed
};

/// One glTF file. Linear blends pose the joints, a frame or, of a single pose, how they stand; what
/// other methods do no joints can: each frame is a morph target.
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
    session.invalid("joints need weights, and the mesh has no point array 'Weights': take "
                    "--gltf-animation morph");
    return;
  }
  const bool stands = linear && !morph && !frames.sequence;
  std::vector<vtkSmartPointer<vtkDataSet>> posed_meshes;
  for (int k = 0; k < frames.count && !stands; ++k)
  {
    if (!frames.deform(k))
    {
      return;
    }
    auto copy = vtk::TakeSmartPointer(deformation->GetOutput()->NewInstance());
    copy->ShallowCopy(deformation->GetOutput());
    posed_meshes.push_back(copy);
  }
  auto* posed = vtkPolyData::SafeDownCast(pose->GetOutput());
  if (session.write_rig(mesh,
        !skinned   ? nullptr
          : stands ? posed
                   : handles,
        posed_meshes, frames.per_second, morph, output))
  {
    session.report().set("counts.frames", frames.count);
  }
}
/// A surface made anew between the points that its array Fixed holds.
void run_fairing(Session& session, const std::string& output, const std::string& endings)
{
  const Arguments& arguments = session.arguments();
  if (is_rig(output))
  {
    session.invalid("a fair surface without handles is no rig: write .vtp");
    return;
  }
  const auto mesh = session.read(arguments.text("MESH_WITH_WEIGHTS"));
  if (!mesh || !session.check_output(output, endings))
  {
    return;
  }
  const vtkSmartPointer<vtkPoseAlgorithm> surface = make_variational(arguments);
  surface->SetStretchLimit(arguments.number("stretch-limit"));
  surface->SetStretchArray(arguments.has("stretch-array"));
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
  const std::string endings = "vtp vtu vtk ply stl obj off mesh glb gltf";
  const Status ending = check_extension(output, endings);
  if (!ending.ok())
  {
    session.fail(ending);
    return;
  }
  const bool fair = arguments.text("method") == "variational" && arguments.has("fair");
  if (fair && !arguments.has("handles") && !arguments.has("pose") && !arguments.has("dynamics"))
  {
    run_fairing(session, output, endings);
    return;
  }
  for (const char* needed : { "handles", "pose" })
  {
    if (!arguments.has(needed))
    {
      session.invalid(std::string("--") + needed +
        " is required; only --method variational --fair does without handles and pose");
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
  // Frames are those of a sequence; of expressions and of a body that moves, as many as asked for.
  const bool dynamic = arguments.has("dynamics");
  const int given = pose->GetNumberOfFrames(), asked = arguments.integer("frames");
  const bool moves = dynamic || (given == 1 && pose->GetHasExpressions());
  if (asked > 0 && !moves)
  {
    session.invalid("--frames is for poses with expressions in t and for --dynamics");
    return;
  }
  const double time_step = arguments.number("time-step");
  if (moves && !(std::isfinite(time_step) && time_step > 0.0))
  {
    session.invalid("--time-step must be a number above 0");
    return;
  }
  Frames frames;
  frames.count = asked > 0 ? asked : given;
  frames.per_second = moves ? 1.0 / time_step : pose->GetFramesPerSecond();
  frames.sequence = pose->GetSequence() || asked > 0;
  const bool numbers = frames.sequence && !is_rig(output);
  std::vector<std::string> files{ output };
  if (numbers)
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
    if (!session.check_output(file, endings))
    {
      return;
    }
  }
  if (numbers && !session.check_output(pvd, "pvd"))
  {
    return;
  }
  vtkSmartPointer<vtkReducedDynamics> body;
  if (dynamic)
  {
    double gravity[3];
    if (!to_vector(arguments.text("gravity"), gravity))
    {
      session.invalid("--gravity '" + arguments.text("gravity") +
        "' must be three numbers with commas between, as in 0,-9.81,0");
      return;
    }
    body = make_dynamics(arguments);
    body->SetGravity(gravity);
  }
  const vtkSmartPointer<vtkPoseAlgorithm> deformation =
    dynamic ? vtkSmartPointer<vtkPoseAlgorithm>(body) : make_deformation(arguments);
  deformation->SetStretchLimit(arguments.number("stretch-limit"));
  deformation->SetStretchArray(arguments.has("stretch-array"));
  // What goes wrong with a pose on the way, the filter behind it says as well.
  vtkNew<vtkCallbackCommand> quiet;
  quiet->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  pose->AddObserver(vtkCommand::ErrorEvent, quiet);
  deformation->SetInputData(0, mesh);
  deformation->SetInputConnection(1, pose->GetOutputPort());
  frames.deform = [&](int frame)
  {
    if (dynamic)
    {
      body->SetStep(frame); // asks for the poses of all times up to its own
    }
    else if (moves)
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
  std::vector<AtomicFile> written(files.size());
  for (std::size_t i = 0; i < files.size() && !session.failed(); ++i)
  {
    if (frames.deform(static_cast<int>(i)))
    {
      iterations += static_cast<std::int64_t>(session.report().number("iterations", 0));
      session.write_uncommitted(deformation->GetOutput(), files[i], written[i]);
    }
  }
  // A sequence is there whole or not at all, and what it replaces stays until then.
  for (std::size_t i = 0; i < written.size() && !session.failed(); ++i)
  {
    session.commit(written[i]);
  }
  if (session.failed() ||
    (numbers && !session.write_text(format_collection(files, frames.per_second), pvd)))
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

// bindpose deform MESH_WITH_WEIGHTS --handles H --pose POSE.json: one pose gives one file, a
// sequence numbered files and a .pvd that ParaView plays.
#include "cli/session.h"
#include "cli/verbs.h"

#include "file_kind.h"
#include "io/atomic_file.h"
#include "vtkFullARAP.h"
#include "vtkMovingLeastSquaresWarp.h"
#include "vtkPoseHandles.h"
#include "vtkReducedARAP.h"
#include "vtkSkinningDeformation.h"

#include "vtkDataSet.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <cstdio>

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
vtkSmartPointer<vtkPoseAlgorithm> make_arap(const Arguments& arguments)
{
  auto arap = vtkSmartPointer<Filter>::New();
  arap->SetEnergy(energy_of(arguments.text("energy")));
  arap->SetTolerance(arguments.number("tolerance"));
  if (arguments.integer("iterations") > 0)
  {
    arap->SetMaximumIterations(arguments.integer("iterations"));
  }
  return arap;
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
    return make_arap<vtkReducedARAP>(arguments);
  }
  if (method == "full-arap")
  {
    return make_arap<vtkFullARAP>(arguments);
  }
  auto skinning = vtkSmartPointer<vtkSkinningDeformation>::New();
  skinning->SetMethod(method == "dqs" ? vtkSkinningDeformation::DUAL_QUATERNION
      : method == "stbs"              ? vtkSkinningDeformation::STRETCHABLE_BONES
      : method == "cor"               ? vtkSkinningDeformation::CENTERS_OF_ROTATION
                                      : vtkSkinningDeformation::LINEAR_BLEND);
  const std::string edges = arguments.text("pseudo-edges");
  skinning->SetPseudoEdges(edges == "none" ? vtkSkinningDeformation::NO_PSEUDO_EDGES
      : edges == "auto"                    ? vtkSkinningDeformation::AUTOMATIC_PSEUDO_EDGES
                                           : vtkSkinningDeformation::GIVEN_PSEUDO_EDGES);
  skinning->SetPseudoEdgeStretch(arguments.has("pseudo-edge-stretch"));
  return skinning;
}

std::string without_ending(const std::string& path)
{
  return path.substr(0, path.size() - file_extension(path).size() - 1);
}

/// OUT_0007.vtp
std::string numbered(const std::string& path, int frame)
{
  char number[16];
  std::snprintf(number, sizeof(number), "_%04d.", frame);
  return without_ending(path) + number + file_extension(path);
}

/// ParaView's collection of the frames with their times.
std::string collection(const std::vector<std::string>& files, double frames_per_second)
{
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
                     "  <Collection>\n";
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    const double time = static_cast<double>(i) / (frames_per_second > 0 ? frames_per_second : 1.0);
    char seconds[40];
    std::snprintf(seconds, sizeof(seconds), "%.9g", time);
    const std::string name = files[i].substr(files[i].find_last_of('/') + 1);
    text += std::string("    <DataSet timestep=\"") + seconds + "\" file=\"" + name + "\"/>\n";
  }
  return text + "  </Collection>\n</VTKFile>\n";
}
} // namespace

void run_deform(Session& session)
{
  const Arguments& arguments = session.arguments();
  const std::string output = arguments.text("output");
  const std::string endings = "vtp vtu vtk ply stl obj off mesh";
  const Status ending = check_extension(output, endings);
  if (!ending.ok())
  {
    session.fail(ending);
    return;
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
  const int frames = pose->GetNumberOfFrames();
  std::vector<std::string> files{ output };
  if (frames > 1)
  {
    files.clear();
    for (int frame = 0; frame < frames; ++frame)
    {
      files.push_back(numbered(output, frame));
    }
  }
  const std::string pvd = without_ending(output) + ".pvd";
  for (const std::string& file : files)
  {
    if (!session.check_output(file, endings))
    {
      return;
    }
  }
  if (frames > 1 && !session.check_output(pvd, "pvd"))
  {
    return;
  }
  const auto deformation = make_deformation(arguments);
  deformation->SetStretchLimit(arguments.number("stretch-limit"));
  deformation->SetStretchArray(arguments.has("stretch-array"));
  deformation->SetInputData(0, mesh);
  deformation->SetInputConnection(1, pose->GetOutputPort());
  std::int64_t iterations = 0;
  std::vector<AtomicFile> written(files.size());
  for (std::size_t i = 0; i < files.size() && !session.failed(); ++i)
  {
    const double begin = static_cast<double>(i) / static_cast<double>(files.size());
    const double end = static_cast<double>(i + 1) / static_cast<double>(files.size());
    pose->SetFrame(static_cast<int>(i));
    if (session.run(pose, "pose", begin, begin, Merge::nothing) &&
      session.run(deformation, "deform", begin, end, Merge::all))
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
    (frames > 1 && !session.write_text(collection(files, pose->GetFramesPerSecond()), pvd)))
  {
    return;
  }
  session.report().set("counts.frames", frames);
  if (session.report().find("iterations"))
  {
    session.report().set("iterations", iterations);
  }
}

} // namespace bindpose::cli

// Session files restore the work bit by bit, on this machine and on another one. A broken session
// gives an error message.
#include "work_test.h"

#include "document/opened_file.h"
#include "document/session.h"
#include "document/work_inputs.h"

#include "support/files.h"
#include "support/handles.h"

#include "vtkFieldData.h"
#include "vtkFloatArray.h"

#include <nlohmann/json.hpp>

#include <QDir>
#include <QFile>
#include <QUndoStack>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace bindpose;
using nlohmann::json;
using test::fingerprint;
using testing::HasSubstr;

namespace
{
const char* const mesh_text = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n"
                              "3 1 2 3\n";

QString text(const std::string& path)
{
  return QString::fromStdString(path);
}

Session read(const std::string& path)
{
  Session session;
  const Status status = read_session(text(path), session);
  EXPECT_TRUE(status.ok()) << status.message;
  return session;
}

void write(const std::string& path, const Session& session)
{
  const Status status = SessionFile().write(text(path), session);
  ASSERT_TRUE(status.ok()) << status.message;
}

/// Return work in which every part has content.
Work full_work()
{
  Document document;
  test::open_bound_document(document);
  Pose pose = document.pose();
  for (std::size_t k = 0; k < pose.size(); ++k)
  {
    for (int c = 0; c < 12; ++c)
    {
      pose[k].transform.data()[c] = std::cos(1.0 + 12.0 * k + c) / 3.0;
    }
    pose[k].stretch = 1.0 / 3.0;
    pose[k].twist << -0.0, 1e-310; // neither value may become 0 in the file
  }
  pose[1].mode = HandleMode::position;
  document.set_pose(pose, "pose");
  vtkNew<vtkFloatArray> size;
  size->SetName("Size");
  size->SetNumberOfTuples(3);
  size->FillValue(0.1F);
  document.handle_data()->GetCellData()->AddArray(size);
  document.commit_handles("size");
  StoredPoses stored_poses;
  stored_poses.library.store("wave “hello”", NamedPose(document.handles(), pose));
  stored_poses.keys.set(1.0 / 7.0, NamedPose(document.handles(), pose));
  document.set_stored_poses(stored_poses, "keep");
  document.set_option("pose.method", 2);
  document.set_option("tets.shrink", 1.0 / 3.0);
  document.set_option("weights.bands", false);
  // This handle is moved after the bind.
  document.handle_data()->GetPoints()->SetPoint(0, 0.1, 0.2, -0.7);
  document.commit_handles("move");
  return document.work();
}

/// Return an unbound session with handles and a pose. The session refers to a mesh file.
Session session_with_file(const test::Folder& folder)
{
  const std::string mesh = folder.write("corner.off", mesh_text);
  Document document;
  TriangleMesh corner;
  corner.points = Points::Zero(4, 3);
  corner.points(1, 0) = corner.points(2, 1) = corner.points(3, 2) = 1.0;
  corner.triangles.resize(4, 3);
  corner.triangles << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
  document.set_mesh(to_polydata(corner.points, corner.triangles), "corner.off",
    Source{ text(mesh), checksum_of(text(mesh)) });
  document.set_handles(to_polydata(test::three_handles()), "handles");
  Session session;
  session.work = document.work();
  return session;
}
} // namespace

TEST(Sessions, AreReadBackToTheLastBit)
{
  const test::Folder folder;
  Session session;
  session.work = full_work();
  session.view.panel = 2;
  session.view.camera.emplace();
  session.view.camera->position = { 0.1, 1.0 / 3.0, 1e-300 };
  session.view.camera->angle = 22.5;
  session.view.camera->parallel = true;
  write(folder / "a.bindpose", session);
  const Session back = read(folder / "a.bindpose");
  EXPECT_EQ(fingerprint(back.work), fingerprint(session.work));
  EXPECT_TRUE(back.notes.isEmpty());
  EXPECT_EQ(back.view.panel, 2);
  ASSERT_TRUE(back.view.camera);
  EXPECT_EQ(back.view.camera->position, session.view.camera->position);
  EXPECT_EQ(back.view.camera->angle, 22.5);
  EXPECT_TRUE(back.view.camera->parallel);
  // The document that was read equals the document that was saved. The document is bound, and its
  // rebind_reason() names the change since the last bind.
  Document before;
  before.replace(session.work);
  Document after;
  after.replace(back.work);
  EXPECT_TRUE(after.is_bound());
  EXPECT_EQ(fingerprint(after), fingerprint(before));
  EXPECT_EQ(after.rebind_reason(), "Since the last bind, 1 handle was moved.");
  EXPECT_FALSE(after.is_changed(true));
  EXPECT_EQ(after.history()->count(), 0);
}

TEST(Sessions, WordsOfChoicesNeverChange)
{
  // Session files contain these words; older files contain indices into these lists. Neither the
  // words nor their order may change.
  const std::pair<const char*, const char*> expected[] = {
    { "bind.domain", "auto volume embedding cage surface" },
    { "pose.method", "lbs dqs reduced-arap stbs cor full-arap variational" },
    { "pose.endpoints", "projection joints bounded" },
    { "pose.pseudo_edges", "none given auto" },
    { "pose.energy", "auto spokes-and-rims elements spokes" },
    { "pose.extra_kind", "bumps eigenmodes" },
    { "pose.rotations", "none clusters angles" },
    { "pose.order", "membrane thin-plate third-order" },
    { "pose.boundary", "region curve tangent" },
    { "pose.compared", "none lbs dqs reduced-arap stbs cor full-arap variational" },
    { "pose.ghost", "over beside distance" },
    { "motion.down", "x y z" },
    { "weights.what", "weights row-sums difference" },
    { "weights.raw", "normalized raw" },
    { "weights.orientation", "x y z free" },
    { "tets.method", "auto cdt remesh embed wrap ftetwild hull" },
    { "tets.colors", "plain winding-number label quality method" },
    { "tets.orientation", "x y z free" },
    { "volume.samples", "coarse medium fine" },
    { "volume.orientation", "x y z free" },
    { "volume.surface_look", "solid see-through edges hidden" },
  };
  for (const auto& [key, words] : expected)
  {
    ASSERT_TRUE(find_option(key)) << key;
    QStringList found;
    for (const OptionChoice& choice : find_option(key)->choices)
    {
      found << choice.word;
    }
    EXPECT_EQ(found.join(' ').toStdString(), words) << key;
  }
}

TEST(Sessions, ChoicesAreWordsInTheFile)
{
  const test::Folder folder;
  Session session;
  session.work = full_work();
  write(folder / "a.bindpose", session);
  const std::string file = folder.read("a.bindpose");
  EXPECT_THAT(file, testing::HasSubstr(R"("pose.method": "reduced-arap")"));
  EXPECT_THAT(file, testing::HasSubstr(R"("bind.domain": "auto")"));
  for (const OptionInfo& option : option_table())
  {
    const bool is_choice = option.initial.type() == QVariant::Int && option.highest < 100;
    EXPECT_EQ(option.choices.size(), is_choice ? std::size_t(option.highest) + 1 : 0u)
      << option.key;
  }
}

TEST(Sessions, AnEmptyOneComesBack)
{
  const test::Folder folder;
  Session session;
  session.work = Document().work();
  write(folder / "a.bindpose", session);
  EXPECT_EQ(fingerprint(read(folder / "a.bindpose").work), fingerprint(session.work));
  EXPECT_EQ(folder.number_of_files(), 1u);
}

TEST(Sessions, CertificatesAndRawWeightsAreKept)
{
  const test::Folder folder;
  Session session;
  session.work = full_work();
  vtkNew<vtkDoubleArray> gaps;
  gaps->SetName("WeightsRelativeGap");
  gaps->InsertNextValue(1.0 / 3.0);
  session.work.surface->GetFieldData()->AddArray(gaps);
  write(folder / "a.bindpose", session);
  const Session opened = read(folder / "a.bindpose");
  vtkDataArray* back = opened.work.surface->GetFieldData()->GetArray("WeightsRelativeGap");
  ASSERT_NE(back, nullptr);
  EXPECT_EQ(back->GetComponent(0, 0), 1.0 / 3.0);
}

TEST(Sessions, AnotherFolderOpensTheSameWork)
{
  const test::Folder folder;
  std::filesystem::create_directories(folder / "here/meshes");
  const std::string mesh = folder.write("here/meshes/corner.off", mesh_text);
  Session session = session_with_file(folder);
  session.work.mesh_source = Source{ text(mesh), checksum_of(text(mesh)) };
  write(folder / "here/work.bindpose", session);
  EXPECT_THAT(folder.read("here/work.bindpose"), HasSubstr("\"meshes/corner.off\""));
  EXPECT_THAT(folder.read("here/work.bindpose"), Not(HasSubstr(folder.path())));
  std::filesystem::create_directories(folder / "far");
  std::filesystem::rename(folder / "here", folder / "far/away");
  const Session back = read(folder / "far/away/work.bindpose");
  EXPECT_TRUE(back.notes.isEmpty()) << back.notes.join(' ').toStdString();
  EXPECT_TRUE(back.missing_inputs.empty());
  ASSERT_NE(back.work.surface, nullptr);
  EXPECT_EQ(back.work.surface->GetNumberOfPoints(), 4);
  EXPECT_EQ(back.work.mesh_source.path, text(folder / "far/away/meshes/corner.off"));
  EXPECT_EQ(back.work.mesh_source.checksum, session.work.mesh_source.checksum);

  // If the folder of a session is moved, the session still finds its companion files.
  Session bound;
  bound.work = full_work();
  std::filesystem::create_directories(folder / "one");
  write(folder / "one/b.bindpose", bound);
  std::filesystem::rename(folder / "one", folder / "two");
  EXPECT_EQ(fingerprint(read(folder / "two/b.bindpose").work), fingerprint(bound.work));
}

TEST(Sessions, OpenWithoutAMissingInputAndSaySo)
{
  const test::Folder folder;
  write(folder / "a.bindpose", session_with_file(folder));
  std::filesystem::remove(folder / "corner.off");
  const Session back = read(folder / "a.bindpose");
  EXPECT_EQ(back.work.surface, nullptr);
  ASSERT_NE(back.work.handles, nullptr);
  ASSERT_EQ(back.missing_inputs.size(), 1u);
  EXPECT_EQ(back.missing_inputs[0].role, "mesh");
  EXPECT_EQ(back.missing_inputs[0].path, text(folder / "corner.off"));
  ASSERT_EQ(back.notes.size(), 1);
  EXPECT_EQ(back.notes[0], "corner.off is missing; the session was opened without it.");
  // A file that can no longer be read counts as missing.
  folder.write("corner.off", "OFF\n4 4");
  EXPECT_EQ(read(folder / "a.bindpose").notes.size(), 1);
  EXPECT_EQ(read(folder / "a.bindpose").missing_inputs.size(), 1u);
}

TEST(Sessions, SayWhenAnInputHasChanged)
{
  const test::Folder folder;
  write(folder / "a.bindpose", session_with_file(folder));
  std::string other = mesh_text;
  other.replace(other.find("1 0 0"), 5, "2 0 0");
  folder.write("corner.off", other);
  const Session back = read(folder / "a.bindpose");
  ASSERT_EQ(back.notes.size(), 1);
  EXPECT_EQ(back.notes[0], "corner.off has changed since the session was saved.");
  EXPECT_EQ(back.work.surface->GetPoint(1)[0], 2.0);
  EXPECT_TRUE(back.missing_inputs.empty());
}

TEST(Sessions, ABoundSurfaceDoesNotNeedItsInput)
{
  const test::Folder folder;
  Document document;
  document.replace(session_with_file(folder).work);
  test::bind(document, 0.0);
  Session session;
  session.work = document.work();
  write(folder / "a.bindpose", session);
  std::filesystem::remove(folder / "corner.off");
  const Session back = read(folder / "a.bindpose");
  EXPECT_EQ(fingerprint(back.work), fingerprint(session.work));
  ASSERT_EQ(back.notes.size(), 1);
  EXPECT_THAT(back.notes[0].toStdString(), HasSubstr("saved with the session"));
  EXPECT_TRUE(back.missing_inputs.empty());
}

TEST(Sessions, ADamagedCompanionCostsItsWeightsOnly)
{
  const test::Folder folder;
  Document document;
  document.replace(session_with_file(folder).work);
  test::bind(document, 0.0);
  Session session;
  session.work = document.work();
  write(folder / "a.bindpose", session);
  for (const bool there : { true, false })
  {
    for (const QString& name : QDir(text(folder.path())).entryList({ "a.surface-*" }, QDir::Files))
    {
      const std::string path = folder / name.toStdString();
      if (there)
      {
        std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
      }
      else
      {
        std::filesystem::remove(path);
      }
    }
    const Session back = read(folder / "a.bindpose");
    ASSERT_EQ(back.notes.size(), 1);
    EXPECT_THAT(back.notes[0].toStdString(), HasSubstr("bind again"));
    Document opened;
    opened.replace(back.work);
    EXPECT_FALSE(opened.is_bound());
    EXPECT_NE(opened.surface(), nullptr); // the surface is read from its own file
    EXPECT_NE(opened.handle_data(), nullptr);
  }
}

TEST(Sessions, OnlyTheirOwnCompanionsGo)
{
  const test::Folder folder;
  folder.write("a.surface-important.vtp", "mine");
  folder.write("b.surface-0123456789ab.vtp", "of another session");
  folder.write("a.surface-0123456789ab.vtp", "of the last save");
  Session session;
  session.work = full_work();
  write(folder / "a.bindpose", session);
  EXPECT_EQ(folder.read("a.surface-important.vtp"), "mine");
  EXPECT_EQ(folder.read("b.surface-0123456789ab.vtp"), "of another session");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.surface-0123456789ab.vtp"));
}

TEST(Sessions, ThatCannotBeWrittenLeaveTheLastOne)
{
  const test::Folder folder;
  Session session;
  session.work = full_work();
  EXPECT_THAT(
    SessionFile().write("/no/such/folder/a.bindpose", session).message, HasSubstr("cannot write"));
  write(folder / "a.bindpose", session);
  const std::string before = folder.read("a.bindpose");
  std::filesystem::create_directory(folder / "b.bindpose");
  EXPECT_FALSE(SessionFile().write(text(folder / "b.bindpose"), session).ok());
  EXPECT_EQ(folder.read("a.bindpose"), before);
}

TEST(Sessions, KeepEveryMode)
{
  const test::Folder folder;
  for (int mode = 0; mode < 5; ++mode)
  {
    Document document;
    test::open_bound_document(document);
    Pose pose = document.pose();
    for (std::size_t k = 0; k < pose.size(); ++k)
    {
      const bool bone = document.handles()[k].kind == HandleKind::bone;
      pose[k].mode = bone ? static_cast<HandleMode>(mode) : HandleMode::free;
    }
    document.set_pose(pose, "pose");
    StoredPoses stored_poses;
    stored_poses.library.store("kept", NamedPose(document.handles(), pose));
    document.set_stored_poses(stored_poses, "keep");
    Session session;
    session.work = document.work();
    const std::string path = folder / ("mode" + std::to_string(mode) + ".bindpose");
    write(path, session);
    const Work back = read(path).work;
    const Pose stored_pose = back.stored_poses->library.entries().front().pose.for_handles(
      document.handles(), Pose(pose.size()));
    ASSERT_EQ(back.pose.size(), pose.size());
    for (std::size_t k = 0; k < pose.size(); ++k)
    {
      EXPECT_EQ(back.pose[k].mode, pose[k].mode) << mode;
      EXPECT_EQ(stored_pose[k].mode, pose[k].mode) << mode;
    }
  }
}

/// This text is an example of a file of version 1. All later versions must be able to read it.
TEST(Sessions, SchemaOneIsRead)
{
  const test::Folder folder;
  folder.write("corner.off", mesh_text);
  folder.write("old.bindpose", R"({
  "bindpose": {"schema": 1}, "name": "corner.off",
  "inputs": {"mesh": {"path": "corner.off", "sha256": "00"}},
  "companions": {},
  "handles": {"points_type": "double", "points": [[0, 0, 0], [0.5, 0.25, 1]],
    "vertices": [[0], [1]], "lines": [], "polygons": [],
    "cell_arrays": [
      {"name": "HandleName", "type": "text", "components": 1, "values": ["a", "b"]},
      {"name": "HandleKind", "type": "int32", "components": 1, "values": [0, 0]}]},
  "bound_handles": null,
  "pose": [
    {"mode": "full", "transform": [1,0,0,0, 0,1,0,0, 0,0,1,0], "stretch": 1, "twist": [0, 0]},
    {"mode": "free", "transform": [1,0,0,2, 0,1,0,0, 0,0,1,0], "stretch": 1, "twist": [0, 0]}],
  "poses": {},
  "options": {"pose.method": 1, "tets.colours": 3, "of.another.version": "x"},
  "view": {"panel": 0, "camera": null}
})");
  const Session session = read(folder / "old.bindpose");
  EXPECT_EQ(session.work.surface->GetNumberOfPoints(), 4);
  ASSERT_EQ(session.work.pose.size(), 2u);
  EXPECT_EQ(session.work.pose[1].mode, HandleMode::free);
  EXPECT_EQ(session.work.pose[1].transform(0, 3), 2.0);
  EXPECT_EQ(session.work.options["pose.method"].toInt(), 1) << "an integer of an earlier version";
  EXPECT_EQ(session.work.options["tets.colors"].toInt(), 3) << "a former key";
  EXPECT_EQ(session.work.options["tets.shrink"].toDouble(), 1.0);
  EXPECT_EQ(session.work.options["volume.place"].toDouble(), 0.5);
  EXPECT_EQ(session.work.options["volume.normal"], QVariant(QVariantList{ 0.0, 0.0, 1.0 }));
}

TEST(Sessions, BrokenOnesGiveOneSentence)
{
  const test::Folder folder;
  Session session;
  session.work = full_work();
  write(folder / "good.bindpose", session);
  const json good = json::parse(folder.read("good.bindpose"));
  const auto expect_refused = [&](const std::string& contents, const char* what)
  {
    SCOPED_TRACE(what);
    folder.write("bad.bindpose", contents);
    Session result;
    result.work.name = "untouched";
    const Status status = read_session(text(folder / "bad.bindpose"), result);
    EXPECT_FALSE(status.ok());
    EXPECT_THAT(status.message, HasSubstr("bad.bindpose cannot be opened: "));
    EXPECT_THAT(status.message, Not(HasSubstr("\n")));
    EXPECT_LT(status.message.size(), 200u);
    EXPECT_EQ(result.work.name, "untouched");
    return status.message;
  };
  expect_refused("", "empty");
  expect_refused("no json", "no json");
  expect_refused("[]", "a list");
  expect_refused("null", "null");
  expect_refused(R"({"bindpose": 3})", "no schema");
  expect_refused(std::string(200000, '['), "deep");
  expect_refused(R"({"bindpose": {"schema": 1e999}})", "huge");
  EXPECT_THAT(expect_refused(R"({"bindpose": {"schema": 99}})", "newer"), HasSubstr("newer"));
  const std::string whole = good.dump();
  for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 97)
  {
    expect_refused(whole.substr(0, size), "cut");
  }
  // Replace one value of the file at a time: by a text, a number, an array, an object, true and
  // null.
  const auto flat = good.flatten();
  const std::vector<json> wrong_values = { json("text"), json(-7.5e300), json(json::array()),
    json(json::object()), json(true), json() };
  int tried = 0;
  for (const auto& [json_path, value] : flat.items())
  {
    for (const json& other : wrong_values)
    {
      json changed = good;
      changed[json::json_pointer(json_path)] = other;
      folder.write("maybe.bindpose", changed.dump());
      Session result;
      const Status status = read_session(text(folder / "maybe.bindpose"), result);
      ++tried;
      // Some of the changed files are valid, for example if both the old and the new value are
      // texts. The work that is read from a valid file must be usable.
      if (status.ok())
      {
        Document document;
        document.replace(result.work);
        EXPECT_TRUE(!document.handle_data() || document.pose().size() == document.handles().size());
      }
      else
      {
        EXPECT_THAT(status.message, Not(HasSubstr("\n"))) << json_path;
        EXPECT_LT(status.message.size(), 250u) << json_path;
      }
    }
  }
  EXPECT_GT(tried, 500);
  // A file without one of the top-level keys is refused.
  for (const auto& [key, value] : good.items())
  {
    json changed = good;
    changed.erase(key);
    EXPECT_THAT(expect_refused(changed.dump(), key.c_str()), HasSubstr(key));
  }
  const auto with_value = [&good](const char* json_path, const json& value)
  {
    json changed = good;
    changed[json::json_pointer(json_path)] = value;
    return changed.dump();
  };
  expect_refused(with_value("/pose/0/transform/3", json()), "a number that is not finite");
  expect_refused(with_value("/pose", json::array()), "another number of handles");
  expect_refused(with_value("/handles/points/0/0", json()), "a place that is not finite");
  expect_refused(with_value("/handles/vertices/0/0", 99), "a point that is not there");
  expect_refused(with_value("/handles/vertices/0/0", -1), "a negative point");
  expect_refused(with_value("/handles/cell_arrays/0/components", 1000000), "an array too large");
  expect_refused(with_value("/handles/cell_arrays/0/values", json::array()), "an array too short");
  expect_refused(with_value("/options/tets.shrink", 7), "an option out of range");
  expect_refused(with_value("/options/pose.method", "best"), "an unknown word of a choice");
  expect_refused(with_value("/options/tets.shrink", "1"), "a text for a number");
  expect_refused(with_value("/options/volume.normal", { "0", "0", "1" }), "texts for a direction");
  expect_refused(with_value("/options/volume.place", 1.5), "a place beyond the end");
  expect_refused(with_value("/options/volume.place", json()), "a place that is not finite");
  expect_refused(with_value("/options/volume.normal", { 0, 0, 2 }), "a direction that is too long");
  expect_refused(with_value("/options/volume.normal", { 0, 0, 0 }), "no direction");
  expect_refused(with_value("/options/volume.normal", { 0, 1 }), "a direction in a plane");
  expect_refused(with_value("/options/volume.normal", { 0, "up", 1 }), "a direction in words");
  expect_refused(with_value("/options/volume.normal", 1), "a number for a direction");
  expect_refused(with_value("/view/camera/angle", 0), "a camera that sees nothing");
  EXPECT_FALSE(
    [&]
    {
      Session result;
      return read_session("/no/such/file.bindpose", result).ok();
    }());
}

TEST(PoseFiles, OfTheWindowSayWhatTheyCannotHold)
{
  const test::Folder folder;
  const Handles handles = { test::point_handle("hand", Vec3(1, 0, 0)) };
  Pose pose(1);
  EXPECT_TRUE(write_poses({ pose }, handles, folder / "plain.json").warnings.empty());
  pose[0].transform(0, 1) = 0.5; // this is a shear
  const Status status = write_poses({ pose }, handles, folder / "sheared.json");
  EXPECT_TRUE(status.ok());
  ASSERT_EQ(status.warnings.size(), 1U);
  EXPECT_NE(status.warnings[0].find("'hand'"), std::string::npos);
  EXPECT_FALSE(write_poses({ pose }, handles, "/no/such/folder/pose.json").ok());
}

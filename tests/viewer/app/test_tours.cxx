// The tours of examples/tours, played by the program. All checks in the tours must pass. Some tests
// also scale pictures of the view down and compare them with the reference pictures in tours/.
#include "support/demo_meshes.h"
#include "support/files.h"

#include <nlohmann/json.hpp>

#include <QByteArray>
#include <QImage>
#include <QProcess>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

using namespace bindpose;

namespace
{
using Json = nlohmann::json;

constexpr int small_width = 200;
// Two pixels differ if a channel differs by more than this many of the 255 levels. Antialiasing
// differs by less between drivers.
constexpr int channel_tolerance = 24;
constexpr double maximum_difference = 0.01; // fraction of the pixels that may differ

struct Outcome
{
  int code = -1;
  QString error; ///< standard error of the program
  Json record;
  double seconds = 0.0;
};

/// Play a tour with the program and save its pictures in the folder.
Outcome play(const std::string& tour, const std::string& folder,
  const QStringList& extra_arguments = {}, const std::string& from = {})
{
  QProcess program;
  if (!from.empty())
  {
    program.setWorkingDirectory(QString::fromStdString(from));
  }
  program.start(BINDPOSE_PROGRAM,
    QStringList{ "view", "--play", QString::fromStdString(tour), "--screenshot-dir",
      QString::fromStdString(folder) } +
      extra_arguments);
  Outcome outcome;
  EXPECT_TRUE(program.waitForFinished(110000));
  outcome.code = program.exitStatus() == QProcess::NormalExit ? program.exitCode() : -1;
  for (const QByteArray& line : program.readAllStandardError().split('\n'))
  {
    // Ignore the messages of Qt itself, for example about displays without a window manager.
    const bool is_qt_message = line.startsWith("QStandardPaths") || line.startsWith("qt.qpa") ||
      line.startsWith("QGestureManager");
    if (!line.isEmpty() && !is_qt_message)
    {
      outcome.error += QString::fromUtf8(line) + '\n';
    }
  }
  if (std::filesystem::exists(folder + "/tour.json"))
  {
    std::ifstream file(folder + "/tour.json");
    outcome.record = Json::parse(file, nullptr, false);
    outcome.seconds = outcome.record.value("seconds", 0.0);
  }
  return outcome;
}

QImage scaled_down(const QImage& picture)
{
  return picture.convertToFormat(QImage::Format_RGB32)
    .scaledToWidth(small_width, Qt::SmoothTransformation);
}

/// Return the fraction of the pixels that differ by more than `channel_tolerance`, or 1 if the
/// sizes differ.
double difference(const QImage& a, const QImage& b)
{
  if (a.size() != b.size())
  {
    return 1.0;
  }
  long long different = 0;
  for (int y = 0; y < a.height(); ++y)
  {
    for (int x = 0; x < a.width(); ++x)
    {
      const QColor p = a.pixelColor(x, y), q = b.pixelColor(x, y);
      different += std::max({ std::abs(p.red() - q.red()), std::abs(p.green() - q.green()),
                     std::abs(p.blue() - q.blue()) }) > channel_tolerance;
    }
  }
  return static_cast<double>(different) / (static_cast<double>(a.width()) * a.height());
}

/// Compare a picture with its reference. BINDPOSE_BLESS=tours replaces the reference by the drawn
/// picture.
void expect_reference(const QImage& drawn, const std::string& name)
{
  const QString path = QString::fromStdString(BINDPOSE_TOUR_PICTURES + ("/" + name + ".png"));
  const char* update_baselines = std::getenv("BINDPOSE_BLESS");
  const QImage small = scaled_down(drawn);
  if (update_baselines && std::string(update_baselines) == "tours")
  {
    ASSERT_FALSE(testing::Test::HasFailure()) << "a picture of a failed tour is not blessed";
    ASSERT_TRUE(small.save(path)) << path.toStdString();
    return;
  }
  const QImage reference = QImage(path).convertToFormat(QImage::Format_RGB32);
  ASSERT_FALSE(reference.isNull()) << "there is no " << path.toStdString()
                                   << "; look at the tour's picture, then bless it "
                                      "(tests/README.md)";
  const double differing_fraction = difference(small, reference);
  std::printf("%s: %.2f %% of the pixels differ\n", name.c_str(), 100.0 * differing_fraction);
  if (differing_fraction > maximum_difference)
  {
    const QString actual =
      QString::fromStdString(BINDPOSE_TOUR_OUTPUT + ("/" + name + ".actual.png"));
    small.save(actual);
    ADD_FAILURE() << "the picture has changed: compare " << path.toStdString() << " with "
                  << actual.toStdString();
  }
}

struct TourCase
{
  const char* name;
  std::vector<const char*> pictures; ///< pictures to compare
  const char* demo_mesh = nullptr; ///< mesh of the Debian package libcgal-demo, or null
  std::vector<const char*> files = {}; ///< other files that the tour writes
};

std::ostream& operator<<(std::ostream& out, const TourCase& tour)
{
  return out << tour.name;
}

class Tours : public testing::TestWithParam<TourCase>
{
};
} // namespace

TEST_P(Tours, Play)
{
  const TourCase& tour = GetParam();
  const test::Folder folder;
  const std::string path = std::string(BINDPOSE_TOURS) + "/" + tour.name + ".json";
  std::string from = folder.path();
  if (tour.demo_mesh)
  {
    const std::string mesh = test::demo_mesh_path(tour.demo_mesh);
    ASSERT_FALSE(mesh.empty()) << "install the package libcgal-demo";
    from = std::filesystem::path(mesh).parent_path().string();
  }
  const std::string pictures = folder / "pictures";
  const Outcome outcome = play(path, pictures, {}, from);
  EXPECT_EQ(outcome.code, 0) << outcome.error.toStdString();
  EXPECT_TRUE(outcome.error.isEmpty()) << outcome.error.toStdString();
  ASSERT_TRUE(outcome.record.is_object());
  EXPECT_EQ(outcome.record["passed"], true);
  std::printf("%s: %d steps, %.1f s, first picture %.2f s after the start\n", tour.name,
    static_cast<int>(outcome.record["steps"].size()), outcome.seconds,
    outcome.record.value("first_picture_seconds", -1.0));
  for (const auto& [name, shot] : outcome.record["screenshots"].items())
  {
    const QImage picture(QString::fromStdString(pictures + "/" + name + ".png"));
    EXPECT_EQ(picture.width(), shot["width"]) << name;
    if (shot["values"].value("points", 0) > 0) // if there are no points, nothing is open
    {
      EXPECT_GT(shot["drawn_share"], 0.005) << name;
    }
    EXPECT_EQ(shot["values"].value("shape.finite", true), true) << name;
  }
  for (const char* file : tour.files)
  {
    std::error_code none;
    EXPECT_GT(std::filesystem::file_size(pictures + "/" + file, none), 100u) << file;
    EXPECT_FALSE(none) << file;
  }
  for (const char* name : tour.pictures)
  {
    expect_reference(QImage(QString::fromStdString(pictures + "/" + name + ".png")),
      std::string(tour.name) + "_" + name);
  }
}

INSTANTIATE_TEST_SUITE_P(Examples, Tours,
  testing::Values(TourCase{ "bend", { "opened", "bent" } },
    TourCase{ "volume", { "slice", "across", "isosurface" } },
    TourCase{ "tets", { "whole", "cut", "crinkle", "other_side" } },
    TourCase{ "weights", { "territories", "left_hand", "smooth" } },
    TourCase{ "compare", { "distance", "over", "beside" } },
    TourCase{ "keys", { "waving", "between" } }, TourCase{ "gizmo", { "moved", "turned" } },
    TourCase{ "rotations", { "clusters", "angles", "angles_again" } }, TourCase{ "refused", {} },
    TourCase{ "picture", { "flat", "bent", "over_picture" } }, TourCase{ "planar", { "posed" } },
    TourCase{ "undo", { "start", "one", "three" } }, TourCase{ "idle", {} },
    TourCase{ "panels", {} }, TourCase{ "auto_rig", {} }, TourCase{ "typed", {} },
    TourCase{ "domain", {} },
    TourCase{ "export", {}, nullptr, { "bent.ply", "rig.glb", "pose.json", "picture.png" } },
    TourCase{ "tutorial", {}, "elephant-with-holes.off" }),
  [](const testing::TestParamInfo<TourCase>& tour) { return std::string(tour.param.name); });

/// If the picture has twice as many pixels in each direction, the legend and its text keep their
/// size relative to the picture.
TEST(Scaled, ALegendIsAsLargeAtTwiceThePixels)
{
  const test::Folder folder;
  qputenv("QT_SCALE_FACTOR", "2");
  const Outcome outcome = play(BINDPOSE_TOURS "/weights.json", folder / "out");
  qunsetenv("QT_SCALE_FACTOR");
  ASSERT_EQ(outcome.code, 0) << outcome.error.toStdString();
  const QImage picture(QString::fromStdString(folder / "out/left_hand.png"));
  EXPECT_EQ(picture.size(), QSize(2 * 760, 2 * 560));
  const QImage reference(BINDPOSE_TOUR_PICTURES "/weights_left_hand.png");
  const QRect legend(
    0, reference.height() / 2, reference.width() / 4, reference.height() - reference.height() / 2);
  const double differing_fraction =
    difference(scaled_down(picture).copy(legend), scaled_down(reference).copy(legend));
  std::printf(
    "legend at twice the pixels: %.2f %% of the pixels differ\n", 100.0 * differing_fraction);
  EXPECT_LT(differing_fraction, 0.05);
}

/// The tutorial contains the texts and the steps of its tour in their order, and its pictures
/// exist.
TEST(Tutorial, TellsWhatItsTourDoes)
{
  std::ifstream file(BINDPOSE_TOURS "/tutorial.json");
  const Json tour = Json::parse(file);
  const std::string folder = BINDPOSE_TOURS "/../../viewer/";
  std::ifstream page_file(folder + "tutorial.md");
  const std::string page(
    (std::istreambuf_iterator<char>(page_file)), std::istreambuf_iterator<char>());
  std::size_t at = 0; // the texts must be in this order
  int text_count = 0;
  for (const Json& step : tour["steps"])
  {
    if (step.contains("say"))
    {
      ++text_count;
      at = page.find(step["say"].get<std::string>(), at);
      ASSERT_NE(at, std::string::npos) << step["say"] << "; run examples/tours/make_pictures.py";
    }
    if (step.contains("screenshot"))
    {
      const std::string picture = "pictures/" + step["screenshot"].get<std::string>() + ".png";
      at = page.find(picture, at);
      ASSERT_NE(at, std::string::npos) << picture;
      EXPECT_FALSE(QImage(QString::fromStdString(folder + picture)).isNull()) << picture;
    }
  }
  EXPECT_GE(text_count, 9);
}

TEST(Films, HaveAPictureForEveryMove)
{
  const test::Folder folder;
  const std::string tour = folder.write("t.json",
    R"({"tour": {"schema": 1, "size": [800, 600]}, "steps": [
      {"open": "data/figure.off"}, {"move": [0.5, 0.5]},
      {"film": "turn", "of": "view", "width": 120},
      {"drag": [0.1, 0.5], "to": [0.4, 0.5], "moves": 3},
      {"film": "end"}, {"move": [0.2, 0.5]}]})");
  const std::string pictures = folder / "pictures";
  const Outcome outcome = play(tour, pictures, {}, BINDPOSE_TOURS);
  ASSERT_EQ(outcome.code, 0) << outcome.error.toStdString();
  EXPECT_EQ(outcome.record["films"]["turn"], 3);
  QImage last;
  for (int frame = 0; frame < 3; ++frame)
  {
    const QImage picture(
      QString::fromStdString(pictures + "/turn_000" + std::to_string(frame) + ".png"));
    EXPECT_EQ(picture.width(), 120);
    EXPECT_NE(picture, last); // the view rotates
    last = picture;
  }
  EXPECT_FALSE(std::filesystem::exists(pictures + "/turn_0003.png"));
}

// ---- Failures ----------------------------------------------------------------------------------

namespace
{
/// Return the error message of a tour with these steps. The tour must fail.
std::string failure(
  const std::string& steps, int* code = nullptr, const QStringList& extra_arguments = {})
{
  const test::Folder folder;
  const std::string tour = folder.write(
    "wrong.json", R"({"tour": {"schema": 1, "size": [800, 600]}, "steps": [)" + steps + "]}");
  const Outcome outcome = play(tour, folder / "pictures", extra_arguments, BINDPOSE_TOURS);
  EXPECT_NE(outcome.code, 0);
  EXPECT_EQ(outcome.error.count('\n'), 1) << outcome.error.toStdString();
  if (code)
  {
    *code = outcome.code;
  }
  if (outcome.record.is_object())
  {
    EXPECT_EQ(outcome.record["passed"], false);
    EXPECT_NE(outcome.error.toStdString().find(outcome.record["message"].get<std::string>()),
      std::string::npos);
  }
  return outcome.error.trimmed().toStdString();
}
} // namespace

TEST(FailedTours, EndWithASentenceThatNamesTheStep)
{
  int code = 0;
  EXPECT_EQ(failure(R"({"open": "data/figure.off"}, {"check": "triangles", "is": 3})", &code),
    "bindpose view: tour 'wrong', step 2 (check 'triangles'): the value is 1554, expected 3.0");
  EXPECT_EQ(code, 2);
  EXPECT_EQ(failure(R"({"open": "no_such.off"})"),
    "bindpose view: tour 'wrong', step 1 (open 'no_such.off'): cannot open no_such.off: "
    "No such file or directory");
  EXPECT_EQ(failure(R"({"action": "edit.bind"})"),
    "bindpose view: tour 'wrong', step 1 (action 'edit.bind'): the menu entry 'edit.bind' is "
    "disabled");
  EXPECT_EQ(failure(R"({"action": "file.open"})"),
    "bindpose view: tour 'wrong', step 1 (action 'file.open'): the step opened the dialog "
    "'Open', which needs an answer");
  EXPECT_EQ(failure(R"({"click": {"handle": "nose"}})"),
    "bindpose view: tour 'wrong', step 1 (click): unknown handle 'nose'");
  EXPECT_EQ(failure(R"({"option": "pose.methd", "value": 1})"),
    "bindpose view: tour 'wrong', step 1 (option 'pose.methd'): unknown option 'pose.methd'");
  // If the camera is turned away from the shape, the view is empty.
  EXPECT_EQ(failure(R"({"open": "data/figure.off"}, {"drag": [0.5, 0.5], "to": [0.9, 0.5],
    "button": "middle"}, {"drag": [0.1, 0.5], "to": [0.9, 0.5], "button": "middle"},
    {"drag": [0.1, 0.5], "to": [0.9, 0.5], "button": "middle"}, {"screenshot": "gone"})"),
    "bindpose view: tour 'wrong', step 5 (screenshot 'gone'): the picture is empty");
}

TEST(FailedTours, ATimeLimitEndsThem)
{
  EXPECT_EQ(failure(R"({"wait": 60})", nullptr, { "--time-limit", "1" }),
    "bindpose view: tour 'wrong', step 1 (wait): the tour exceeded its time limit of 1 s");
}

TEST(FailedTours, NothingIsReplacedUnasked)
{
  const test::Folder folder;
  const std::string tour = folder.write("t.json",
    R"({"tour": {"schema": 1}, "steps": [{"open": "data/figure.off"}, {"screenshot": "one"}]})");
  const std::string pictures = folder / "pictures";
  ASSERT_EQ(play(tour, pictures, {}, BINDPOSE_TOURS).code, 0);
  const Outcome second_outcome = play(tour, pictures, {}, BINDPOSE_TOURS);
  EXPECT_EQ(second_outcome.code, 2);
  EXPECT_NE(second_outcome.error.indexOf("exists"), -1) << second_outcome.error.toStdString();
  EXPECT_EQ(play(tour, pictures, { "--overwrite" }, BINDPOSE_TOURS).code, 0);
}

// Exports of the menu File. The tests check when the menu entries are enabled, what the files
// contain, and which messages appear. An error message disappears when an export succeeds.
#include "opened_folders.h"
#include "window_test.h"

#include "app/handles/handle_commands.h"
#include "app/handles/handle_editing.h"
#include "app/parts/notice_bar.h"
#include "app/posing/key_strip.h"
#include "app/posing/posing.h"
#include "app/posing/sequence_export.h"
#include "app/window/exports.h"
#include "document/document.h"

#include "weights_arrays.h"

#include "support/files.h"
#include "support/meshes.h"

#include "vtkDoubleArray.h"
#include "vtkMeshFileReader.h"
#include "vtkPointData.h"

#include <QAction>
#include <QApplication>
#include <QDialog>
#include <QFileDialog>
#include <QImage>
#include <QLineEdit>
#include <QPushButton>
#include <QTimer>

#include <filesystem>

using namespace bindpose;
using test::OpenedFolders;
using test::to_qt;
using test::two_points;
using test::wait_for;

namespace
{
class ExportWindow : public test::WindowTest
{
protected:
  void open_mesh()
  {
    const TriangleMesh mesh = test::sphere(2);
    this->ball = to_polydata(mesh.points, mesh.triangles);
    ASSERT_TRUE(this->window.set_mesh(this->ball, "ball.off"));
  }
  void open_bound()
  {
    this->open_mesh();
    Handles handles;
    ASSERT_TRUE(to_handles(two_points(), handles).ok());
    Weights weights(this->ball->GetNumberOfPoints(), 2);
    for (Index v = 0; v < weights.rows(); ++v)
    {
      weights(v, 1) = 0.5 + 0.4 * this->ball->GetPoint(v)[2];
      weights(v, 0) = 1.0 - weights(v, 1);
    }
    this->ball->GetPointData()->AddArray(to_weights_array("Weights", weights, handles));
    ASSERT_TRUE(this->window.set_mesh(this->ball, "ball.off"));
    ASSERT_TRUE(this->window.set_handles(two_points(), "points"));
    ASSERT_TRUE(this->window.is_bound());
    this->render();
  }
  void bend()
  {
    Pose pose(2);
    pose[1].transform.col(3) = Vec3(0.25, 0, 0);
    this->window.document()->set_pose(pose, "bend");
    this->render();
  }
  bool enabled(const char* name)
  {
    const QAction* entry = this->user.action(name);
    EXPECT_NE(entry, nullptr) << name;
    return entry && entry->isEnabled();
  }
  /// Choose a menu entry and answer its dialogs, as a user does with the keyboard.
  void export_by_menu(const char* name, const std::string& path)
  {
    int answered = 0;
    QTimer watch;
    QObject::connect(&watch, &QTimer::timeout,
      [&]
      {
        QWidget* dialog = QApplication::activeModalWidget();
        if (auto* files = qobject_cast<QFileDialog*>(dialog))
        {
          files->findChild<QLineEdit*>("fileNameEdit")->setText(to_qt(path));
          static_cast<QDialog*>(files)->accept();
          ++answered;
        }
        else if (dialog)
        {
          for (QPushButton* button : dialog->findChildren<QPushButton*>())
          {
            if (button->isDefault())
            {
              button->click();
              break;
            }
          }
        }
      });
    watch.start(20);
    EXPECT_EQ(this->user.trigger(name), QString()) << name;
    EXPECT_EQ(answered, 1) << name;
  }
  QString bar_message() { return this->bar("export_bar")->message(); }
  void press(const QString& text)
  {
    for (QPushButton* button : this->bar("export_bar")->findChildren<QPushButton*>())
    {
      if (button->text() == text && button->isVisible())
      {
        button->click();
        return;
      }
    }
    ADD_FAILURE() << "no button " << text.toStdString();
  }

  app::tour::SimulatedUser user{ &this->window };
  vtkSmartPointer<vtkPolyData> ball;
  test::Folder folder;
};
} // namespace

TEST_F(ExportWindow, EachIsThereAsSoonAsItMakesSense)
{
  const auto all = [this]
  {
    QStringList names;
    for (const char* name : { "file.export_shape", "file.export_rig_glb", "file.export_pose",
           "file.export_picture", "file.export_film" })
    {
      if (this->enabled(name))
      {
        names << QString(name).mid(12);
      }
    }
    return names.join(' ');
  };
  EXPECT_EQ(all(), "picture");
  this->open_mesh();
  EXPECT_EQ(all(), "shape picture");
  ASSERT_TRUE(this->window.set_handles(two_points(), "points"));
  EXPECT_EQ(all(), "shape pose picture film");
  this->open_bound();
  EXPECT_EQ(all(), "shape rig_glb pose picture film");
}

TEST_F(ExportWindow, TheShapeIsExportedAsItIsShown)
{
  this->open_bound();
  this->bend();
  const std::string path = this->folder / "bent.ply";
  this->export_by_menu("file.export_shape", path);
  vtkNew<vtkMeshFileReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  auto* read = vtkPolyData::SafeDownCast(reader->GetOutput());
  ASSERT_NE(read, nullptr);
  const Points shown = to_points(this->window.shown()).view();
  ASSERT_EQ(read->GetNumberOfPoints(), shown.rows());
  EXPECT_LT((Points(to_points(read).view()) - shown).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_GT((shown - Points(to_points(this->ball.Get()).view())).cwiseAbs().maxCoeff(), 0.2);
  EXPECT_TRUE(this->bar_message().contains("bent.ply")) << this->bar_message().toStdString();
  EXPECT_EQ(this->window.error(), QString());
}

TEST_F(ExportWindow, TheRigHasTheSkinAndStandsAsTheHandlesDo)
{
  this->open_bound();
  this->bend();
  const std::string path = this->folder / "ball.glb";
  this->export_by_menu("file.export_rig_glb", path);
  app::window::MainWindow other;
  ASSERT_TRUE(other.open(to_qt(path))) << other.error().toStdString();
  EXPECT_TRUE(other.is_bound());
  ASSERT_EQ(other.document()->handles().size(), 2U);
  const Pose pose = other.document()->pose();
  EXPECT_LT((pose[1].transform.col(3) - Vec3(0.25, 0, 0)).norm(), 1e-6);
  // The window that has opened the exported rig shows the same shape as the exporting window.
  QApplication::processEvents();
  const Points here = to_points(this->window.shown()).view();
  const Points there = to_points(other.shown()).view();
  ASSERT_EQ(there.rows(), here.rows());
  EXPECT_LT((there - here).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_TRUE(this->bar_message().contains("ball.glb"));
  // A method that glTF does not support is reported.
  this->window.set_method(1);
  ASSERT_TRUE(this->part<app::window::Exports>()->save_rig(to_qt(path)));
  EXPECT_TRUE(this->bar_message().contains("linear blend skinning"))
    << this->bar_message().toStdString();
}

TEST_F(ExportWindow, PoseAndPictureAreExportedByTheMenu)
{
  this->open_bound();
  this->bend();
  this->export_by_menu("file.export_pose", this->folder / "bent.json");
  EXPECT_TRUE(std::filesystem::exists(this->folder / "bent.json"));
  EXPECT_TRUE(this->bar_message().contains("bent.json"));
  this->export_by_menu("file.export_picture", this->folder / "bent.png");
  EXPECT_FALSE(QImage(to_qt(this->folder / "bent.png")).isNull());
  EXPECT_TRUE(this->bar_message().contains("bent.png"));
}

TEST_F(ExportWindow, AFilmNeedsKeyFramesAndSaysSo)
{
  this->open_bound();
  EXPECT_FALSE(this->part<app::posing::KeyStrip>()->isVisible());
  EXPECT_EQ(this->user.trigger("file.export_film"), QString());
  EXPECT_TRUE(this->bar_message().contains("key frames")) << this->bar_message().toStdString();
  EXPECT_EQ(this->window.error(), QString());
  this->press("Show the timeline");
  EXPECT_TRUE(this->part<app::posing::KeyStrip>()->isVisible());
  EXPECT_EQ(this->bar_message(), QString());
  // Two key frames are enough for the export of an animation. The export of a pose file needs no
  // other program.
  EXPECT_EQ(this->user.press_key("K"), QString());
  this->user.scrub(0.25);
  this->bend();
  EXPECT_EQ(this->user.press_key("K"), QString());
  const std::string path = this->folder / "film.json";
  this->export_by_menu("file.export_film", path);
  ASSERT_TRUE(wait_for([this]
    { return !this->part<app::posing::PoseController>()->sequence_export()->is_running(); }));
  EXPECT_TRUE(std::filesystem::exists(path));
  EXPECT_TRUE(this->bar_message().contains("film.json")) << this->bar_message().toStdString();
  EXPECT_TRUE(this->bar_message().contains("7 frames"));
}

TEST_F(ExportWindow, TheFolderOfWhatWasWrittenIsOpened)
{
  this->open_mesh();
  ASSERT_TRUE(this->part<app::window::Exports>()->save_shape(to_qt(this->folder / "ball.obj")));
  EXPECT_TRUE(this->bar_message().contains("ball.obj"));
  OpenedFolders folders;
  this->press("Show in folder");
  ASSERT_EQ(folders.urls().size(), 1);
  EXPECT_EQ(std::filesystem::canonical(folders.urls()[0].toLocalFile().toStdString()),
    std::filesystem::canonical(std::filesystem::path(this->folder / "ball.obj").parent_path()));
  EXPECT_EQ(this->bar_message(), QString()) << "the bar has done its work";
}

TEST_F(ExportWindow, AnErrorLeavesWhenTheSameKindSucceeds)
{
  this->open_bound();
  EXPECT_FALSE(this->part<app::window::Exports>()->save_shape("/no/such/folder/ball.ply"));
  EXPECT_TRUE(this->window.error().contains("Cannot export")) << this->window.error().toStdString();
  EXPECT_EQ(this->bar_message(), QString());
  ASSERT_TRUE(this->part<app::window::Exports>()->save_shape(to_qt(this->folder / "ball.ply")));
  EXPECT_EQ(this->window.error(), QString());
  // If an action of another kind succeeds, the error message stays.
  EXPECT_FALSE(this->part<app::handles::HandleEditing>()->commands()->rename(0, "top"));
  const QString refused = this->window.error();
  EXPECT_FALSE(refused.isEmpty());
  ASSERT_TRUE(this->part<app::window::Exports>()->save_shape(to_qt(this->folder / "ball.ply")));
  this->bend();
  EXPECT_EQ(this->window.error(), refused);
  EXPECT_TRUE(this->part<app::handles::HandleEditing>()->commands()->rename(0, "foot"));
  EXPECT_EQ(this->window.error(), QString());
  // The first export of key frames cannot be written, the second one can.
  EXPECT_EQ(this->user.press_key("K"), QString());
  this->part<app::posing::PoseController>()->export_to("/no/such/folder/ball.json");
  ASSERT_TRUE(wait_for([this] { return !this->window.error().isEmpty(); }));
  this->part<app::posing::PoseController>()->export_to(to_qt(this->folder / "ball.json"));
  ASSERT_TRUE(wait_for(
    [this] { return !this->bar_message().isEmpty() && this->bar_message().contains("Wrote"); }));
  EXPECT_EQ(this->window.error(), QString());
}

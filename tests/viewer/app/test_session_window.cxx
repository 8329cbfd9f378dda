// Tests that the window preserves work: sessions, recovery after a crash, recent files, undo.
#include "app/weights/binding.h"
#include "columns.h"
#include "unclipped.h"
#include "window_test.h"

#include "app/handles/side_panel.h"
#include "app/parts/notice_bar.h"
#include "app/tets/tet_inspection.h"
#include "app/weights/weight_panel.h"
#include "app/window/window_sessions.h"
#include "document/autosave.h"
#include "document/document.h"
#include "document/recent_files.h"
#include "io/dmat.h"

#include "support/files.h"
#include "support/meshes.h"

#include "vtkCamera.h"
#include "vtkGLTFSkinWriter.h"
#include "vtkImageData.h"
#include "vtkMeshFileWriter.h"
#include "vtkPointData.h"
#include "vtkXMLImageDataWriter.h"
#include "vtkXMLPolyDataWriter.h"

#include <QAction>
#include <QCheckBox>
#include <QDir>
#include <QDropEvent>
#include <QElapsedTimer>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QProcess>
#include <QPushButton>
#include <QSettings>
#include <QThread>
#include <QTimer>
#include <QUndoStack>

using namespace bindpose;
using test::to_qt;
using test::two_points;

namespace
{
vtkSmartPointer<vtkPolyData> column_data(bool weights)
{
  const TriangleMesh mesh = test::column(2);
  return weights ? test::with_linear_weights(mesh) : to_polydata(mesh.points, mesh.triangles);
}

void write_mesh(vtkPolyData* mesh, const std::string& path)
{
  vtkNew<vtkMeshFileWriter> writer;
  writer->SetInputData(mesh);
  writer->SetFileName(path.c_str());
  writer->OverwriteOn();
  writer->Update();
  ASSERT_EQ(writer->GetStatus(), vtkBindposeAlgorithm::OK) << writer->GetStatusMessage();
}

class SessionWindow : public test::WindowTest
{
protected:
  SessionWindow()
  {
    qputenv("XDG_CONFIG_HOME", QByteArray::fromStdString(this->folder / "config"));
    qputenv("XDG_DATA_HOME", QByteArray::fromStdString(this->folder / "data"));
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, to_qt(this->folder / "config"));
    RecentFiles::clear();
  }

  /// Open a mesh with weights and handles from files.
  void open_files()
  {
    test::write_with<vtkXMLPolyDataWriter>(column_data(true), this->folder / "column.vtp");
    test::write_with<vtkXMLPolyDataWriter>(two_points(), this->folder / "points.vtp");
    ASSERT_TRUE(this->window.open(to_qt(this->folder / "column.vtp")));
    ASSERT_TRUE(this->window.open(to_qt(this->folder / "points.vtp")));
    ASSERT_TRUE(this->window.is_bound()) << this->window.error().toStdString();
    this->render();
  }

  static double maximum_z(vtkPolyData* data) { return data->GetBounds()[5]; }

  void pose()
  {
    Pose pose = this->window.document()->pose();
    pose[1].transform(2, 3) = 0.7;
    this->window.document()->set_pose(pose, "move top");
  }

  static QPushButton* button_of(QWidget* bar, const QString& text)
  {
    for (QPushButton* button : bar->findChildren<QPushButton*>())
    {
      if (button->text() == text && !button->isHidden())
      {
        return button;
      }
    }
    ADD_FAILURE() << "there is no button " << text.toStdString();
    return nullptr;
  }

  /// Close the window and answer the question about unsaved changes. Return true if the question
  /// was shown.
  bool close_and_answer(QMessageBox::StandardButton answer, bool* closed)
  {
    bool asked = false;
    QTimer::singleShot(0, &this->window,
      [&]
      {
        if (auto* question = qobject_cast<QMessageBox*>(QApplication::activeModalWidget()))
        {
          asked = true;
          question->button(answer)->click();
        }
      });
    *closed = this->window.close();
    QApplication::processEvents();
    return asked;
  }

  void drop(const std::string& path)
  {
    QMimeData data;
    data.setUrls({ QUrl::fromLocalFile(to_qt(path)) });
    QDragEnterEvent enter({ 10, 10 }, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&this->window, &enter);
    EXPECT_TRUE(enter.isAccepted());
    QDropEvent event({ 10, 10 }, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&this->window, &event);
  }

  QAction* menu_entry(const QString& prefix)
  {
    for (QAction* menu : this->window.menuBar()->actions())
    {
      for (QAction* entry : menu->menu()->actions())
      {
        if (entry->text().remove('&').startsWith(prefix))
        {
          return entry;
        }
      }
    }
    ADD_FAILURE() << "no entry " << prefix.toStdString();
    return nullptr;
  }

  test::Folder folder;
};
} // namespace

TEST_F(SessionWindow, ASessionOpensAsItWasSaved)
{
  this->open_files();
  this->pose();
  this->window.set_method(1);
  this->window.set_mode(0, 2);
  this->part<app::view::Viewport>()->renderer()->GetActiveCamera()->Azimuth(33);
  const double top = maximum_z(this->window.shown());
  double camera[3];
  this->part<app::view::Viewport>()->renderer()->GetActiveCamera()->GetPosition(camera);
  ASSERT_TRUE(
    this->part<app::window::WindowSessions>()->write(to_qt(this->folder / "work.bindpose")));

  app::window::MainWindow other;
  other.show();
  ASSERT_TRUE(other.open(to_qt(this->folder / "work.bindpose"))) << other.error().toStdString();
  EXPECT_TRUE(other.is_bound());
  EXPECT_EQ(maximum_z(other.shown()), top);
  EXPECT_EQ(other.document()->number("pose.method"), 1);
  EXPECT_EQ(other.document()->pose()[0].mode, HandleMode::free);
  EXPECT_EQ(other.document()->history()->count(), 0);
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_EQ(
      other.findChild<app::view::Viewport*>()->renderer()->GetActiveCamera()->GetPosition()[k],
      camera[k]);
  }
  EXPECT_TRUE(other.windowTitle().startsWith("work")) << other.windowTitle().toStdString();
}

TEST_F(SessionWindow, TheTitleMarksWhatIsNotSaved)
{
  this->open_files();
  EXPECT_TRUE(this->window.windowTitle().startsWith("column.vtp"));
  EXPECT_FALSE(this->window.isWindowModified()); // nothing has been changed yet
  this->pose();
  EXPECT_TRUE(this->window.isWindowModified());
  ASSERT_TRUE(
    this->part<app::window::WindowSessions>()->write(to_qt(this->folder / "work.bindpose")));
  EXPECT_FALSE(this->window.isWindowModified());
  EXPECT_TRUE(this->window.windowTitle().startsWith("work"));
  this->window.document()->history()->undo();
  EXPECT_TRUE(this->window.isWindowModified());
  this->window.document()->history()->redo();
  EXPECT_FALSE(this->window.isWindowModified());
}

TEST_F(SessionWindow, ClosingAsksWhenSomethingWouldBeLost)
{
  this->open_files();
  bool closed = false;
  this->pose();
  EXPECT_TRUE(this->close_and_answer(QMessageBox::Cancel, &closed));
  EXPECT_FALSE(closed);
  ASSERT_TRUE(
    this->part<app::window::WindowSessions>()->write(to_qt(this->folder / "work.bindpose")));
  this->window.set_mode(0, 1);
  EXPECT_TRUE(this->close_and_answer(QMessageBox::Save, &closed));
  EXPECT_TRUE(closed);
  Session saved;
  ASSERT_TRUE(read_session(to_qt(this->folder / "work.bindpose"), saved).ok());
  EXPECT_EQ(saved.work.pose[0].mode, HandleMode::position);
  this->window.show();
  // There are no unsaved changes.
  EXPECT_FALSE(this->close_and_answer(QMessageBox::Cancel, &closed));
  EXPECT_TRUE(closed);
  this->window.show();
  this->window.set_mode(0, 2);
  EXPECT_TRUE(this->close_and_answer(QMessageBox::Discard, &closed));
  EXPECT_TRUE(closed);
}

TEST_F(SessionWindow, WhoOnlyLooksIsNotAsked)
{
  this->open_files();
  this->window.document()->set_option("weights.bands", false);
  bool closed = false;
  EXPECT_FALSE(this->close_and_answer(QMessageBox::Cancel, &closed));
  EXPECT_TRUE(closed);
}

TEST_F(SessionWindow, ABrokenSessionLeavesTheWork)
{
  this->open_files();
  this->pose();
  vtkPolyData* before = this->window.shown();
  const int steps = this->window.document()->history()->count();
  const std::string path = this->folder.write("bad.bindpose", R"({"bindpose": {"schema": 1}})");
  EXPECT_FALSE(this->window.open(to_qt(path)));
  EXPECT_NE(this->window.error().indexOf("bad.bindpose cannot be opened"), -1)
    << this->window.error().toStdString();
  EXPECT_EQ(this->window.shown(), before);
  EXPECT_EQ(this->window.document()->history()->count(), steps);
  EXPECT_TRUE(this->window.is_bound());
}

TEST_F(SessionWindow, AMissingInputIsSaidAndCanBeLocated)
{
  write_mesh(column_data(false), this->folder / "column.off");
  ASSERT_TRUE(this->window.open(to_qt(this->folder / "column.off")));
  ASSERT_TRUE(this->window.set_handles(two_points(), "points"));
  ASSERT_TRUE(
    this->part<app::window::WindowSessions>()->write(to_qt(this->folder / "work.bindpose")));
  std::filesystem::rename(this->folder / "column.off", this->folder / "moved.off");
  ASSERT_TRUE(this->window.open(to_qt(this->folder / "work.bindpose")));
  EXPECT_EQ(
    this->bar("note_bar")->message(), "column.off is missing; the session was opened without it.");
  EXPECT_NE(button_of(this->bar("note_bar"), "Locate…"), nullptr);
  EXPECT_EQ(this->window.document()->surface(), nullptr);
  EXPECT_NE(this->window.document()->handle_data(), nullptr);
}

TEST_F(SessionWindow, PanelsFollowUndo)
{
  this->open_files();
  this->part<app::window::PanelColumn>()->show_panel(app::window::PanelColumn::weights);
  auto* isolines = this->find<QCheckBox>("Isolines");
  ASSERT_TRUE(isolines->isChecked());
  isolines->click();
  EXPECT_EQ(this->window.document()->history()->undoText(), "isolines");
  this->window.document()->history()->undo();
  EXPECT_TRUE(isolines->isChecked());
  this->window.document()->history()->redo();
  EXPECT_FALSE(isolines->isChecked());
  this->window.set_method(2);
  this->window.document()->history()->undo();
  this->window.document()->history()->undo();
  EXPECT_TRUE(isolines->isChecked());
  EXPECT_EQ(this->window.document()->number("pose.method"), 0);
}

TEST_F(SessionWindow, ABindIsOneStepAndIsBackedUpAtOnce)
{
  ASSERT_TRUE(this->window.set_mesh(column_data(false), "column"));
  ASSERT_TRUE(this->window.set_handles(two_points(), "points"));
  EXPECT_EQ(this->part<app::window::WindowSessions>()->autosave()->path(), "");
  this->part<app::weights::Binding>()->start();
  QElapsedTimer clock;
  clock.start();
  while (this->part<app::weights::Binding>()->is_running() && clock.elapsed() < 60000)
  {
    QApplication::processEvents(QEventLoop::AllEvents, 20);
  }
  ASSERT_TRUE(this->window.is_bound());
  EXPECT_EQ(this->window.document()->history()->undoText(), "bind");
  ASSERT_TRUE(this->part<app::window::WindowSessions>()->autosave()->wait().ok());
  Session backup;
  ASSERT_TRUE(
    read_session(this->part<app::window::WindowSessions>()->autosave()->path(), backup).ok());
  EXPECT_TRUE(backup.work.surface->GetPointData()->HasArray("Weights"));
  this->window.document()->history()->undo();
  EXPECT_FALSE(this->window.is_bound());
  this->window.document()->history()->redo();
  EXPECT_TRUE(this->window.is_bound());
}

TEST_F(SessionWindow, ARebindIsOfferedAndPosingGoesOn)
{
  this->open_files();
  EXPECT_EQ(this->bar("rebind_bar")->message(), "");
  this->window.document()->handle_data()->GetPoints()->SetPoint(0, 0, 0, -0.5);
  ASSERT_TRUE(this->window.document()->commit_handles("move at rest").ok());
  EXPECT_EQ(this->bar("rebind_bar")->message(), "Since the last bind, 1 handle was moved.");
  const double before = maximum_z(this->window.shown());
  this->pose();
  EXPECT_GT(maximum_z(this->window.shown()), before + 0.3);
  EXPECT_EQ(this->window.error(), "");
  this->window.document()->history()->undo();
  this->window.document()->history()->undo();
  EXPECT_EQ(this->bar("rebind_bar")->message(), "");
  this->window.document()->history()->redo();
  button_of(this->bar("rebind_bar"), "Bind again")->click();
  EXPECT_TRUE(this->part<app::weights::Binding>()->is_running());
  EXPECT_EQ(this->bar("rebind_bar")->message(), "");
  this->part<app::weights::Binding>()->cancel();
  while (this->part<app::weights::Binding>()->is_running())
  {
    QApplication::processEvents(QEventLoop::AllEvents, 20);
  }
  EXPECT_NE(this->bar("rebind_bar")->message(), ""); // a new bind is still offered
}

// ---- After a crash -----------------------------------------------------------------------------

TEST_F(SessionWindow, AKilledProgramsWorkIsOfferedAndRestored)
{
  test::write_with<vtkXMLPolyDataWriter>(column_data(true), this->folder / "column.vtp");
  test::write_with<vtkXMLPolyDataWriter>(two_points(), this->folder / "points.vtp");
  QProcess program;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert("BINDPOSE_AUTOSAVE_SECONDS", "0.3");
  program.setProcessEnvironment(environment);
  program.setProcessChannelMode(QProcess::ForwardedErrorChannel);
  program.start(BINDPOSE_PROGRAM,
    { "view", to_qt(this->folder / "column.vtp"), to_qt(this->folder / "points.vtp") });
  ASSERT_TRUE(program.waitForStarted());
  const QString root = to_qt(this->folder / "data/bindpose/recovery");
  const auto is_saved = [&root]
  {
    for (const QString& name : QDir(root).entryList(QDir::Dirs | QDir::NoDotAndDotDot))
    {
      Session session;
      if (read_session(root + '/' + name + "/work.bindpose", session).ok() && session.work.handles)
      {
        return true;
      }
    }
    return false;
  };
  QElapsedTimer clock;
  clock.start();
  while (!is_saved() && clock.elapsed() < 60000)
  {
    QThread::msleep(50);
  }
  ASSERT_TRUE(is_saved());
  this->part<app::window::WindowSessions>()->offer_recovery(root);
  EXPECT_EQ(this->bar("recovery_bar")->message(), ""); // the other program is still running
  program.kill();
  program.waitForFinished();

  this->part<app::window::WindowSessions>()->offer_recovery(root);
  EXPECT_NE(this->bar("recovery_bar")->message().indexOf("did not close properly"), -1);
  EXPECT_TRUE(this->window.is_empty()); // work is restored only after the user has agreed
  button_of(this->bar("recovery_bar"), "&Restore")->click();
  EXPECT_EQ(this->bar("recovery_bar")->message(), "");
  EXPECT_TRUE(this->window.is_bound()) << this->window.error().toStdString();
  EXPECT_EQ(this->window.document()->handles().size(), 2u);
  EXPECT_TRUE(this->window.isWindowModified());
  EXPECT_EQ(RecoveredWork::find(root), nullptr); // the backup now belongs to this window
}

TEST_F(SessionWindow, DiscardedWorkIsGoneAndTheNextIsOffered)
{
  const QString root = to_qt(this->folder / "recovery");
  for (const char* name : { "one", "two" })
  {
    QDir().mkpath(root + '/' + name);
    ASSERT_TRUE(SessionFile().write(root + '/' + name + "/work.bindpose", Session()).ok());
  }
  this->part<app::window::WindowSessions>()->offer_recovery(root);
  for (int left = 2; left > 0; --left)
  {
    EXPECT_EQ(QDir(root).entryList(QDir::Dirs | QDir::NoDotAndDotDot).size(), left);
    ASSERT_NE(this->bar("recovery_bar")->message(), "");
    button_of(this->bar("recovery_bar"), "Discard")->click();
  }
  EXPECT_EQ(this->bar("recovery_bar")->message(), "");
  EXPECT_TRUE(QDir(root).isEmpty());
}

// ---- Open anything -----------------------------------------------------------------------------

TEST_F(SessionWindow, EveryKindOfMeshCanBeDropped)
{
  const auto mesh = column_data(false);
  for (const char* extension : { "obj", "off", "ply", "stl", "vtp" })
  {
    SCOPED_TRACE(extension);
    const std::string path = this->folder / (std::string("shape.") + extension);
    write_mesh(mesh, path);
    this->drop(path);
    EXPECT_EQ(this->window.error(), "");
    ASSERT_NE(this->window.document()->surface(), nullptr);
    EXPECT_EQ(this->window.document()->surface()->GetNumberOfPolys(), mesh->GetNumberOfPolys());
    EXPECT_EQ(this->window.document()->work().mesh_source.path, to_qt(path));
    this->window.document()->history()->undo();
    EXPECT_EQ(this->window.document()->surface(), nullptr);
  }
}

TEST_F(SessionWindow, TetsRigsHandlesWeightsVolumesAndSessionsCanBeDropped)
{
  // This file is a rig, which contains mesh, weights and handles.
  vtkNew<vtkGLTFSkinWriter> rig;
  rig->SetInputData(0, column_data(true));
  rig->SetHandlesData(two_points());
  rig->SetFileName((this->folder / "rig.glb").c_str());
  ASSERT_EQ(rig->Write(), 1);
  this->drop(this->folder / "rig.glb");
  EXPECT_TRUE(this->window.is_bound()) << this->window.error().toStdString();
  // This file contains weights that fit the mesh.
  const Index points = this->window.document()->surface()->GetNumberOfPoints();
  Weights weights = Weights::Constant(points, 2, 0.5);
  ASSERT_TRUE(write_dmat(this->folder / "w.dmat", weights).ok());
  this->drop(this->folder / "w.dmat");
  EXPECT_EQ(this->window.error(), "");
  EXPECT_EQ(
    this->window.document()->surface()->GetPointData()->GetArray("Weights")->GetComponent(0, 0),
    0.5);
  ASSERT_TRUE(write_dmat(this->folder / "short.dmat", Weights(weights.topRows(5))).ok());
  this->drop(this->folder / "short.dmat");
  EXPECT_NE(this->window.error().indexOf("5 points and 2 handles"), -1)
    << this->window.error().toStdString();
  EXPECT_TRUE(this->window.is_bound());
  // This file contains handles.
  this->folder.write("h.tgf", "1 0 0 -0.9\n2 0 0 0.9\n#\n");
  this->drop(this->folder / "h.tgf");
  EXPECT_EQ(this->window.document()->handles().size(), 2u);
  // This file contains tets.
  this->folder.write("tet.mesh",
    "MeshVersionFormatted 1\nDimension 3\nVertices\n4\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
    "Tetrahedra\n1\n1 2 3 4 0\nEnd\n");
  this->drop(this->folder / "tet.mesh");
  EXPECT_EQ(this->window.error(), "");
  EXPECT_NE(this->window.document()->work().mesh_tets, nullptr);
  // This file is a session.
  ASSERT_TRUE(this->part<app::window::WindowSessions>()->write(to_qt(this->folder / "s.bindpose")));
  this->drop(this->folder / "s.bindpose");
  EXPECT_NE(this->window.document()->work().mesh_tets, nullptr);
  // This file has an unknown type.
  this->folder.write("x.txt", "words");
  this->drop(this->folder / "x.txt");
  EXPECT_NE(this->window.error(), "");
  EXPECT_NE(this->window.document()->work().mesh_tets, nullptr);
}

/// Write an image file that is red on the left and blue on the right. The area around both colors
/// is transparent.
std::string write_picture(const test::Folder& folder)
{
  QImage image(64, 48, QImage::Format_RGBA8888);
  image.fill(Qt::transparent);
  for (int y = 8; y < 40; ++y)
  {
    for (int x = 8; x < 56; ++x)
    {
      image.setPixelColor(x, y, x < 32 ? QColor(220, 20, 20) : QColor(20, 20, 220));
    }
  }
  EXPECT_TRUE(image.save(to_qt(folder / "flag.png")));
  return folder / "flag.png";
}

TEST_F(SessionWindow, APictureIsCutOutShownAndBent)
{
  this->drop(write_picture(this->folder));
  ASSERT_EQ(this->window.error(), "");
  ASSERT_NE(this->window.document()->surface(), nullptr);
  EXPECT_NE(this->bar("note_bar")->message().indexOf("cut out"), -1);
  const auto red = [](const QColor& c) { return c.red() > 180 && c.green() < 80 && c.blue() < 80; };
  const auto blue = [](const QColor& c)
  { return c.blue() > 180 && c.green() < 80 && c.red() < 80; };
  const QImage rest = this->picture();
  const int red_pixels = this->count(rest, red);
  EXPECT_GT(red_pixels, 5000);
  EXPECT_NEAR(this->count(rest, blue), red_pixels, 0.1 * red_pixels);
  EXPECT_TRUE(
    this->part<app::view::Viewport>()->renderer()->GetActiveCamera()->GetParallelProjection() != 0);
  const double* bounds = this->window.document()->surface()->GetBounds();
  EXPECT_NEAR(bounds[1] - bounds[0], 48, 2);
  // The texture moves with the shape: after a rotation by 180 degrees about the center, blue is on
  // the left.
  const auto middle_of_red = [&red](const QImage& image)
  {
    double sum = 0.0;
    int number = 0;
    for (int y = 0; y < image.height(); ++y)
    {
      for (int x = 0; x < image.width(); ++x)
      {
        sum += red(image.pixelColor(x, y)) ? x : 0;
        number += red(image.pixelColor(x, y));
      }
    }
    return sum / number;
  };
  this->folder.write("h.tgf", "1 31.5 23.5 0\n#\n");
  this->drop(this->folder / "h.tgf");
  const Index points = this->window.document()->surface()->GetNumberOfPoints();
  ASSERT_TRUE(this->window.document()->set_weights(Weights::Ones(points, 1), "ones").ok());
  Pose pose = this->window.document()->pose();
  pose[0].transform << -1, 0, 0, 63, 0, -1, 0, 47, 0, 0, 1, 0;
  this->window.document()->set_pose(pose, "turn");
  EXPECT_GT(middle_of_red(this->picture()), middle_of_red(rest) + 100);
  for (int step = 0; step < 3; ++step)
  {
    this->window.document()->history()->undo();
  }
  // The user can replace the cut-out shape by the whole rectangle of the image.
  button_of(this->bar("note_bar"), "Use the whole picture")->click();
  ASSERT_EQ(this->window.error(), "");
  const double* whole_bounds = this->window.document()->surface()->GetBounds();
  EXPECT_NEAR(whole_bounds[1] - whole_bounds[0], 64, 1e-6);
  this->window.document()->history()->undo();
  this->window.document()->history()->undo();
  EXPECT_FALSE(
    this->part<app::view::Viewport>()->renderer()->GetActiveCamera()->GetParallelProjection() != 0);
  // A session also restores the texture.
  this->window.document()->history()->redo();
  ASSERT_TRUE(
    this->part<app::window::WindowSessions>()->write(to_qt(this->folder / "flag.bindpose")));
  ASSERT_TRUE(this->window.open(to_qt(this->folder / "flag.bindpose")));
  EXPECT_GT(this->count(this->picture(), red), 5000);
}

TEST_F(SessionWindow, AnUncleanSurfaceIsToldAboutAndShown)
{
  const TriangleMesh mesh = test::open_cube();
  ASSERT_TRUE(this->window.set_mesh(to_polydata(mesh.points, mesh.triangles), "box"));
  QElapsedTimer clock;
  clock.start();
  while (this->bar("note_bar")->message().isEmpty() && clock.elapsed() < 20000)
  {
    QApplication::processEvents(QEventLoop::AllEvents, 20);
  }
  EXPECT_NE(this->bar("note_bar")->message().indexOf("4"), -1) // the four edges around the hole
    << this->bar("note_bar")->message().toStdString();
  button_of(this->bar("note_bar"), "Show where")->click();
  EXPECT_EQ(this->part<app::window::PanelColumn>()->shown_panel(), app::window::PanelColumn::tets);
  EXPECT_TRUE(this->part<app::tets::TetInspection>()->defect_view().is_shown());
}

TEST_F(SessionWindow, WhatAFileLosesIsToldAbout)
{
  const TriangleMesh mesh = test::open_cube();
  vtkNew<vtkGLTFSkinWriter> writer;
  writer->SetInputData(0, to_polydata(mesh.points, mesh.triangles));
  const std::string path = this->folder / "character.gltf";
  writer->SetFileName(path.c_str());
  ASSERT_EQ(writer->Write(), 1) << writer->GetStatusMessage();
  std::string file = this->folder.read("character.gltf");
  file.insert(file.find('{') + 1, R"("materials": [{"name": "skin"}, {"name": "cloth"}],)");
  this->folder.write("character.gltf", file);
  ASSERT_TRUE(this->window.open(to_qt(path))) << this->window.error().toStdString();
  const QString lost_message = "character.gltf: Bindpose does not keep 2 materials.";
  EXPECT_TRUE(this->bar("note_bar")->message().startsWith(lost_message))
    << this->bar("note_bar")->message().toStdString();
  // The search for defects ends later and adds its result to the message. The sentence about the
  // lost materials must stay at the beginning of the message.
  ASSERT_TRUE(
    test::wait_for([this] { return this->bar("note_bar")->message().contains("has defects"); }));
  EXPECT_TRUE(this->bar("note_bar")->message().startsWith(lost_message));
  // After another mesh is opened, the sentence about the lost materials disappears.
  const TriangleMesh other = test::open_cube();
  test::write_with<vtkXMLPolyDataWriter>(
    to_polydata(other.points, other.triangles), this->folder / "other.vtp");
  ASSERT_TRUE(this->window.open(to_qt(this->folder / "other.vtp")));
  EXPECT_FALSE(this->bar("note_bar")->message().contains("does not keep"));
}

TEST_F(SessionWindow, WeightsWithoutAMeshAreOneSentence)
{
  ASSERT_TRUE(write_dmat(this->folder / "w.dmat", Weights(Weights::Constant(3, 2, 0.5))).ok());
  EXPECT_FALSE(this->window.open(to_qt(this->folder / "w.dmat")));
  EXPECT_EQ(this->window.error(), "w.dmat contains weights; open the mesh and the handles first");
}

TEST_F(SessionWindow, RecentFilesAreListedAndMissingOnesGrayed)
{
  this->open_files();
  std::filesystem::remove(this->folder / "points.vtp");
  QMenu* recent = this->menu_entry("Open recent")->menu();
  Q_EMIT recent->aboutToShow();
  ASSERT_GE(recent->actions().size(), 3);
  EXPECT_TRUE(recent->actions()[0]->text().startsWith("points.vtp"));
  EXPECT_FALSE(recent->actions()[0]->isEnabled());
  EXPECT_TRUE(recent->actions()[1]->text().startsWith("column.vtp"));
  EXPECT_TRUE(recent->actions()[1]->isEnabled());
  const int steps = this->window.document()->history()->count();
  recent->actions()[1]->trigger();
  EXPECT_EQ(this->window.document()->history()->count(), steps + 1);
  EXPECT_EQ(RecentFiles::list().size(), 2);
  EXPECT_EQ(RecentFiles::list().front(), to_qt(this->folder / "column.vtp"));
  for (int k = 0; k < 20; ++k)
  {
    RecentFiles::add(QString("/file %1").arg(k));
  }
  EXPECT_EQ(RecentFiles::list().size(), RecentFiles::maximum_count);
}

TEST_F(SessionWindow, BarsAreNeverClippedAndNeverWidenTheWindow)
{
  this->window.resize(900, 600);
  QApplication::processEvents();
  for (app::parts::NoticeBar* bar :
    { this->bar("recovery_bar"), this->bar("note_bar"), this->bar("rebind_bar") })
  {
    bar->offer(QString("A sentence that is so long that no line of this window holds it, with a "
                       "name like %1 in it, and then some more of it.")
                 .arg(QString(80, 'x')),
      { { "Do it", [] {} } }, "Later");
  }
  this->render();
  EXPECT_EQ(this->window.width(), 900);
  for (app::parts::NoticeBar* bar :
    { this->bar("recovery_bar"), this->bar("note_bar"), this->bar("rebind_bar") })
  {
    test::expect_unclipped_buttons(bar);
    auto* label = bar->findChild<QLabel*>();
    EXPECT_LE(label->heightForWidth(label->width()), label->height());
  }
}

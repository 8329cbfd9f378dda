// Responsiveness and readability of the window: opening files renders the view at most four times,
// no operation blocks the window, and no text is clipped.
#include "unclipped.h"
#include "window_test.h"

#include "app/parts/elided_label.h"
#include "app/parts/notice_bar.h"
#include "app/parts/style.h"
#include "app/tour/tour_values.h"
#include "app/window/window_sessions.h"
#include "document/autosave.h"
#include "document/document.h"
#include "document/opened_file.h"

#include "support/files.h"
#include "support/meshes.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDoubleArray.h"
#include "vtkMeshFileWriter.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <QAbstractScrollArea>
#include <QCheckBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QMenu>
#include <QTimer>
#include <QToolButton>

#include <cstdio>
#include <filesystem>

using namespace bindpose;
using test::two_points;
using test::wait_for;

namespace
{
vtkSmartPointer<vtkPolyData> ball_with_equal_weights(int level, int columns)
{
  const TriangleMesh mesh = test::sphere(level);
  const auto data = to_polydata(mesh.points, mesh.triangles);
  vtkNew<vtkDoubleArray> array;
  array->SetName("Weights");
  array->SetNumberOfComponents(columns);
  array->SetNumberOfTuples(mesh.points.rows());
  array->Fill(1.0 / columns);
  data->GetPointData()->AddArray(array);
  return data;
}

class Screens : public test::WindowTest
{
protected:
  Screens()
  {
    qputenv("XDG_CONFIG_HOME", QByteArray::fromStdString(this->folder / "config"));
    qputenv("XDG_DATA_HOME", QByteArray::fromStdString(this->folder / "data"));
    this->observer_->SetClientData(&this->frames);
    this->observer_->SetCallback(
      [](vtkObject*, unsigned long, void* number, void*) { ++*static_cast<int*>(number); });
    this->part<app::view::Viewport>()->renderer()->AddObserver(
      vtkCommand::EndEvent, this->observer_);
  }
  ~Screens() override
  {
    this->part<app::view::Viewport>()->renderer()->RemoveObserver(this->observer_);
  }

  /// Open files of the tours, so that all panels have data.
  void open_everything()
  {
    for (const char* name : { "figure_weights.vtp", "figure.tgf", "figure_winding.vti" })
    {
      ASSERT_TRUE(this->window.open(QString(BINDPOSE_TOURS "/data/") + name)) << name;
    }
    ASSERT_TRUE(wait_for([this] { return app::tour::is_idle(&this->window); }));
  }

  static void expect_nothing_clipped(QWidget* in, const std::string& where)
  {
    SCOPED_TRACE(where);
    test::expect_unclipped_buttons(in);
    test::expect_unclipped_items(in);
    for (const QLabel* label : in->findChildren<QLabel*>())
    {
      if (!label->isVisible() || label->text().isEmpty() ||
        qobject_cast<const app::parts::ElidedLabel*>(label))
      {
        continue;
      }
      if (label->wordWrap())
      {
        EXPECT_LE(label->heightForWidth(label->width()), label->height())
          << label->text().toStdString();
      }
      else
      {
        EXPECT_LE(label->sizeHint().width(), label->width()) << label->text().toStdString();
      }
    }
    for (const QCheckBox* box : in->findChildren<QCheckBox*>())
    {
      EXPECT_TRUE(!box->isVisible() || box->sizeHint().width() <= box->width())
        << box->text().toStdString();
    }
    for (const QToolButton* tool : in->findChildren<QToolButton*>())
    {
      EXPECT_TRUE(!tool->isVisible() || tool->sizeHint().width() <= tool->width())
        << tool->text().toStdString();
    }
  }

  test::Folder folder;
  int frames = 0;

private:
  vtkNew<vtkCallbackCommand> observer_;
};
} // namespace

// ---- Response time -----------------------------------------------------------------------------

TEST_F(Screens, AnOpeningIsOnePictureHoweverOftenThePictureIsResized)
{
  ASSERT_TRUE(wait_for([this] { return app::tour::is_idle(&this->window); }));
  this->frames = 0;
  ASSERT_TRUE(this->window.set_mesh(ball_with_equal_weights(3, 2), "ball"));
  ASSERT_TRUE(this->window.set_handles(two_points(), "points"));
  EXPECT_EQ(this->frames, 0) << "drawn before the window is";
  QApplication::processEvents();
  EXPECT_GE(this->frames, 1);
  EXPECT_LE(this->frames, 2);
  // With software rendering, the view is rendered once more, with antialiased edges.
  ASSERT_TRUE(wait_for([this] { return app::tour::is_idle(&this->window); }));
  QElapsedTimer clock;
  clock.start();
  wait_for([&clock] { return clock.elapsed() > 700; });
  EXPECT_LE(this->frames, 4);
  const int frames_at_rest = this->frames;
  clock.restart();
  wait_for([&clock] { return clock.elapsed() > 700; });
  EXPECT_EQ(this->frames, frames_at_rest) << "a window that rests draws nothing";
}

TEST_F(Screens, WhatIsSeenAtRestHasSmoothEdges)
{
  ASSERT_TRUE(this->window.set_mesh(ball_with_equal_weights(3, 2), "ball"));
  QElapsedTimer clock;
  clock.start();
  wait_for([&clock] { return clock.elapsed() > 1000; });
  const QImage seen = this->part<app::view::Viewport>()->grabFramebuffer();
  EXPECT_EQ(seen, this->picture()); // picture() always renders with antialiasing
}

TEST_F(Screens, AFileThatIsReadIsNotReadAgain)
{
  const std::string path = this->folder / "ball.off";
  vtkNew<vtkMeshFileWriter> writer;
  writer->SetInputData(ball_with_equal_weights(2, 2));
  writer->SetFileName(path.c_str());
  writer->Update();
  OpenedFile file;
  ASSERT_TRUE(read_file(path, file).ok());
  file.checksum.wait();
  std::filesystem::remove(path);
  ASSERT_TRUE(this->window.open(QString::fromStdString(path), &file))
    << this->window.error().toStdString();
  EXPECT_EQ(this->window.document()->surface()->GetNumberOfPolys(), 20 * 16);
  EXPECT_EQ(this->window.document()->work().mesh_source.checksum.size(), 64);
}

/// Measures the times that viewer/developers.md states for 82,000 triangles and 20 handles: the
/// time to show the weights of a bind, and the times of a backup after the bind.
TEST_F(Screens, ABackupAfterABindDoesNotHoldTheWindow)
{
  Handles handles(20);
  for (std::size_t k = 0; k < handles.size(); ++k)
  {
    handles[k].name = "p" + std::to_string(k);
    handles[k].head = handles[k].tail = Vec3(0.4 * std::cos(k), 0.4 * std::sin(k), 0.01 * k);
  }
  const auto surface = ball_with_equal_weights(6, 20);
  surface->GetPointData()->RemoveArray("Weights");
  ASSERT_TRUE(this->window.set_mesh(surface, "ball"));
  ASSERT_TRUE(this->window.set_handles(to_polydata(handles), "points"));
  ASSERT_TRUE(wait_for([this] { return app::tour::is_idle(&this->window); }));
  this->window.document()->begin_bind();
  // Like the result of a bind, `bound` shares points and triangles with the input mesh and has an
  // additional array of weights.
  const auto bound = vtkSmartPointer<vtkPolyData>::New();
  bound->ShallowCopy(surface);
  bound->GetPointData()->AddArray(
    ball_with_equal_weights(6, 20)->GetPointData()->GetArray("Weights"));
  QElapsedTimer clock;
  clock.start();
  const double cpu = app::tour::thread_cpu_seconds();
  ASSERT_TRUE(this->window.document()->set_bound(bound, nullptr));
  const double shown = 1e-6 * static_cast<double>(clock.nsecsElapsed());
  const double shown_cpu = 1e3 * (app::tour::thread_cpu_seconds() - cpu);
  Autosave* autosave = this->part<app::window::WindowSessions>()->autosave();
  autosave->begin_save();
  EXPECT_TRUE(autosave->is_saving()) << "the caller goes on";
  double longest = 0.0;
  int event_loop_turns = 0;
  clock.restart();
  QTimer timer;
  QObject::connect(&timer, &QTimer::timeout,
    [&]
    {
      longest = std::max(longest, 1e-6 * static_cast<double>(clock.nsecsElapsed()));
      clock.restart();
      ++event_loop_turns;
    });
  timer.start(0);
  ASSERT_TRUE(wait_for([autosave] { return !autosave->is_saving(); }));
  std::printf("bound weights shown in %.1f ms (%.1f of a processor); backup %.1f ms of the window "
              "and %.1f ms beside it, "
              "longest turn of the window meanwhile %.1f ms\n",
    shown, shown_cpu, autosave->milliseconds(), autosave->writing_milliseconds(), longest);
  // Expect at least one turn of the event loop, even on a busy machine. On an idle machine there
  // are dozens of turns.
  EXPECT_GT(event_loop_turns, 0);
  Session backup;
  ASSERT_TRUE(read_session(autosave->path(), backup).ok());
  vtkDataArray* weights = backup.work.surface->GetPointData()->GetArray("Weights");
  ASSERT_NE(weights, nullptr);
  EXPECT_EQ(weights->GetNumberOfComponents(), 20);
  EXPECT_EQ(weights->GetComponent(7, 3), 1.0 / 20);
}

// ---- Texts -------------------------------------------------------------------------------------

TEST_F(Screens, NoLabelIsClippedInAnyPanel)
{
  this->open_everything();
  for (const app::parts::Appearance look :
    { app::parts::Appearance::light, app::parts::Appearance::dark })
  {
    app::parts::choose_appearance(*qApp, look);
    for (const QSize& size : { QSize(1280, 800), QSize(900, 700) })
    {
      this->resize(size);
      for (int panel = 0; panel < 4; ++panel)
      {
        this->part<app::window::PanelColumn>()->show_panel(panel);
        QApplication::processEvents();
        expect_nothing_clipped(
          &this->window, "panel " + std::to_string(panel) + " at " + std::to_string(size.width()));
      }
    }
  }
  app::parts::choose_appearance(*qApp, app::parts::Appearance::system);
}

TEST_F(Screens, TheStatusLineEndsInDotsWhereItHasNoRoomAndTheTipSaysAll)
{
  this->open_everything();
  this->window.set_method(2);
  ASSERT_TRUE(wait_for([this] { return app::tour::is_idle(&this->window); }));
  const app::parts::ElidedLabel* line = this->part<app::parts::ElidedLabel>();
  // The width is a floating-point number, because a text may end within a pixel of the available
  // space.
  const auto width = [line](const QString& text)
  { return QFontMetricsF(line->font()).horizontalAdvance(text); };
  for (const QSize& size : { QSize(1280, 800), QSize(900, 700) })
  {
    this->resize(size);
    const bool fits = width(line->text()) <= line->contentsRect().width();
    EXPECT_EQ(line->shown() == line->text(), fits);
    EXPECT_LE(qRound(width(line->shown())), line->contentsRect().width());
    EXPECT_TRUE(fits || line->shown().endsWith(QStringLiteral("…")));
    EXPECT_TRUE(fits || size.width() == 900) << line->text().toStdString();
  }
  app::parts::ElidedLabel small;
  small.setText("Reduced ARAP, 3 iterations");
  EXPECT_EQ(small.minimumSizeHint().width(), 0) << "a long sentence never widens the window";
  small.setFont(line->font());
  // Some of these widths differ from the width of the text by less than a pixel.
  for (int room = 40; room < 300; ++room)
  {
    small.resize(room, 20);
    EXPECT_EQ(small.shown() == small.text(), width(small.text()) <= room) << room;
    EXPECT_LE(qRound(width(small.shown())), room);
  }
  small.resize(static_cast<int>(width("Reduced ARAP, …")), 20);
  EXPECT_TRUE(small.shown().startsWith("Reduced") && small.shown().endsWith(QStringLiteral("…")))
    << small.shown().toStdString();
}

/// Every control has a tooltip or a text that explains it.
TEST_F(Screens, EveryButtonListAndFieldOfThePanelsHasATip)
{
  this->open_everything();
  QStringList widgets_without_tip;
  for (const QWidget* widget : this->part<app::window::PanelColumn>()->findChildren<QWidget*>())
  {
    const bool chooses = qobject_cast<const QComboBox*>(widget) ||
      qobject_cast<const QCheckBox*>(widget) || widget->objectName() == "segment";
    const bool own = !widget->objectName().startsWith("qt_");
    if (chooses && own && widget->toolTip().isEmpty())
    {
      const auto* button = qobject_cast<const QAbstractButton*>(widget);
      widgets_without_tip << QString(widget->metaObject()->className()) + ' ' +
          widget->objectName() + ' ' + (button ? button->text() : QString());
    }
  }
  EXPECT_TRUE(widgets_without_tip.isEmpty()) << widgets_without_tip.join("; ").toStdString();
}

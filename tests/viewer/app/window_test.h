#ifndef bindpose_tests_viewer_app_window_test_h
#define bindpose_tests_viewer_app_window_test_h

// Functions that operate the window like a user: Qt mouse events on the view, and buttons found by
// their texts.

#include "app/parts/notice_bar.h"
#include "app/tour/simulated_user.h"
#include "app/view/viewport.h"
#include "app/window/main_window.h"
#include "app/window/panel_column.h"

#include "conversion.h"

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include <QApplication>
#include <QImage>
#include <QMouseEvent>

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace bindpose::test
{

/// Call wait_until() with a time limit of one minute. @return Whether the condition became true.
template <typename Condition>
bool wait_for(const Condition& condition, int seconds = 60)
{
  return app::tour::wait_until(condition, seconds);
}

/// Convert a std::string to a QString.
inline QString to_qt(const std::string& text)
{
  return QString::fromStdString(text);
}

template <typename Writer>
void write_with(vtkDataSet* data, const std::string& path)
{
  vtkNew<Writer> writer;
  writer->SetInputData(data);
  writer->SetFileName(path.c_str());
  ASSERT_EQ(writer->Write(), 1) << path;
}

/// Return two point handles near the ends of a shape that extends from z = -1 to 1.
inline vtkSmartPointer<vtkPolyData> two_points()
{
  Handles handles(2);
  handles[0].name = "bottom";
  handles[0].head = handles[0].tail = Vec3(0, 0, -0.9);
  handles[1].name = "top";
  handles[1].head = handles[1].tail = Vec3(0, 0, 0.9);
  return to_polydata(handles);
}

/// Discards enter, leave and move events that come from the X server's own pointer. A window of
/// another test may appear under this pointer.
class PointerFilter : public QObject
{
public:
  bool eventFilter(QObject* watched, QEvent* event) override
  {
    const QEvent::Type type = event->type();
    return watched->isWindowType() && event->spontaneous() &&
      (type == QEvent::Enter || type == QEvent::Leave || type == QEvent::MouseMove);
  }
};

class WindowTest : public testing::Test
{
protected:
  WindowTest()
  {
    QApplication::instance()->installEventFilter(&this->pointer);
    this->window.show();
    QApplication::processEvents();
  }

  /// Return a part of the window by its type.
  template <typename Part>
  Part* part()
  {
    Part* found = this->window.findChild<Part*>();
    EXPECT_NE(found, nullptr) << Part::staticMetaObject.className();
    return found;
  }

  /// Return a bar above the 3D view by its name.
  app::parts::NoticeBar* bar(const QString& name)
  {
    return this->window.findChild<app::parts::NoticeBar*>(name);
  }

  /// Return the widget with this text. If several widgets have this text, return a visible one.
  template <typename Widget>
  Widget* find(const QString& text)
  {
    Widget* found = nullptr;
    for (Widget* widget : this->part<app::window::PanelColumn>()->findChildren<Widget*>())
    {
      if (widget->text() == text && (!found || widget->isVisible()))
      {
        found = widget;
      }
    }
    EXPECT_NE(found, nullptr) << "there is no " << text.toStdString();
    return found;
  }
  void render()
  {
    QApplication::processEvents();
    this->part<app::view::Viewport>()->renderWindow()->Render();
    QApplication::processEvents();
  }

  void resize(const QSize& size)
  {
    this->window.resize(size);
    this->render();
    EXPECT_EQ(this->window.size(), size);
  }

  /// Return the pixel at which the view shows a 3D position. Pixel (0, 0) is the upper left corner
  /// of the view.
  QPoint pixel(const Vec3& position)
  {
    vtkRenderer* renderer = this->part<app::view::Viewport>()->renderer();
    renderer->SetWorldPoint(position.x(), position.y(), position.z(), 1.0);
    renderer->WorldToDisplay();
    const double* d = renderer->GetDisplayPoint();
    return { static_cast<int>(d[0]),
      this->part<app::view::Viewport>()->height() - 1 - static_cast<int>(d[1]) };
  }

  void mouse(
    QEvent::Type type, const QPoint& position, Qt::MouseButton button, Qt::MouseButtons buttons)
  {
    app::view::Viewport* viewport = this->part<app::view::Viewport>();
    QMouseEvent event(
      type, position, viewport->mapToGlobal(position), button, buttons, Qt::NoModifier);
    QApplication::sendEvent(viewport, &event);
    QApplication::processEvents();
  }

  void hover(const QPoint& position)
  {
    this->mouse(QEvent::MouseMove, position, Qt::NoButton, Qt::NoButton);
  }

  void drag(const QPoint& from, const QPoint& to)
  {
    this->hover(from);
    this->mouse(QEvent::MouseButtonPress, from, Qt::LeftButton, Qt::LeftButton);
    for (int step = 1; step <= 5; ++step)
    {
      this->mouse(QEvent::MouseMove, from + (to - from) * step / 5, Qt::NoButton, Qt::LeftButton);
    }
    this->mouse(QEvent::MouseButtonRelease, to, Qt::LeftButton, Qt::NoButton);
    this->render();
  }

  QImage picture()
  {
    this->render();
    return this->part<app::view::Viewport>()->grabFramebuffer();
  }

  static int count(const QImage& image, const std::function<bool(const QColor&)>& which)
  {
    int result = 0;
    for (int y = 0; y < image.height(); ++y)
    {
      for (int x = 0; x < image.width(); ++x)
      {
        result += which(image.pixelColor(x, y));
      }
    }
    return result;
  }

  PointerFilter pointer;
  app::window::MainWindow window;
};

} // namespace bindpose::test

#endif

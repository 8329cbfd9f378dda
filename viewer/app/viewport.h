#ifndef viewport_h
#define viewport_h

#include <QVTKOpenGLNativeWidget.h>

#include "vtkNew.h"

#include <memory>

namespace bindpose
{
class ShadedSurface;
}
class vtkActor;
class vtkGenericOpenGLRenderWindow;
class vtkHandleSetWidget;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkRenderer;

/// The picture: one surface, shaded or coloured by a column of its weights, and the handles on
/// top, which the mouse drags.
class Viewport : public QVTKOpenGLNativeWidget
{
  Q_OBJECT

public:
  explicit Viewport(QWidget* parent = nullptr);
  ~Viewport() override;

  /// What is drawn; null: nothing. The camera stays.
  void set_surface(vtkPolyData* surface);
  /// The same surface with its points elsewhere: a pose.
  void move_surface(vtkPolyData* posed);
  void set_handles(vtkPolyData* handles);
  /// Column of the array Weights, named on the scalar bar; -1: plain shading.
  void show_column(int column, const QString& name);
  /// Looks at everything from the side that shows most of it.
  void reset_view();
  /// Draws soon; many calls, one picture.
  void refresh();
  /// Writes what is seen.
  bool save_picture(const QString& path);

  vtkHandleSetWidget* handle_widget() const { return this->handles_; }
  vtkRenderer* renderer() const { return this->renderer_; }

protected:
  void resizeEvent(QResizeEvent* event) override;

private:
  void draw_legend();

  vtkNew<vtkGenericOpenGLRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkPolyDataMapper> mapper_;
  vtkNew<vtkActor> actor_;
  vtkNew<vtkRenderer> legend_; // in front, to the left: the colour scale
  vtkNew<vtkHandleSetWidget> handles_;
  std::unique_ptr<bindpose::ShadedSurface> shaded_;
  QString column_name_;
  bool refresh_pending_ = false;
};

#endif

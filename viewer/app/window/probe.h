#ifndef app_window_probe_h
#define app_window_probe_h

#include "shapes/ray_cast.h"

#include <QObject>
#include <QStringList>

#include <functional>
#include <optional>

class QLabel;
class QMouseEvent;
class vtkPolyData;

namespace app::posing
{
class PoseController;
class RotationView;
} // namespace app::posing
namespace app::tets
{
class DefectView;
class TetView;
} // namespace app::tets
namespace app::view
{
class Viewport;
} // namespace app::view
namespace app::volume
{
class VolumeView;
} // namespace app::volume
namespace app::weights
{
class WeightView;
} // namespace app::weights

namespace app::window
{

/// Shows names and values of the object under the mouse, in a small label in a corner of the 3D
/// view.
/// - For the surface: its triangle, vertex and coordinates, the displayed weight, the handle with
///   the largest weight, a defect, and the distance from the shape of another method.
/// - For tets, slices, isosurfaces and clouds (volume renderings): the displayed values.
///
/// The label describes the nearest opaque object under the mouse. If there is none, it describes a
/// translucent object. Values are computed only when the mouse moves, and not while a button is
/// pressed.
class Probe : public QObject
{
  Q_OBJECT

public:
  struct Views
  {
    view::Viewport* viewport;
    volume::VolumeView* volume;
    tets::TetView* tets;
    weights::WeightView* weights;
    const tets::DefectView* defects;
    posing::PoseController* posing;
    const posing::RotationView* rotations;
    /// Returns the surface as drawn, posed or at rest; null if there is no surface.
    std::function<vtkPolyData*()> surface;
  };
  explicit Probe(const Views& views);

  /// Return the lines about a pixel in VTK's coordinates (from the lower left corner); empty if
  /// there is no object.
  QStringList read_at(int x, int y);
  /// Return the text of the label in one line.
  QString reading() const;
  QLabel* label() const { return this->label_; }
  /// Clear the label until the mouse moves, because the view has changed.
  void clear();
  /// Return the milliseconds that the last mouse move took.
  double milliseconds() const { return this->milliseconds_; }

  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  /// An object that the ray intersects, and the text about it.
  struct Hit
  {
    double distance = 0.0;
    QStringList lines;
  };
  using OptionalHit = std::optional<Hit>;
  OptionalHit surface(const bindpose::ViewRay& ray, bool other) const;
  OptionalHit tets(const bindpose::ViewRay& ray) const;
  OptionalHit weight_slice(const bindpose::ViewRay& ray) const;
  OptionalHit winding_slice(const bindpose::ViewRay& ray) const;
  OptionalHit isosurface(const bindpose::ViewRay& ray) const;
  OptionalHit cloud(const bindpose::ViewRay& ray) const;
  QString defect(const bindpose::ViewRay& ray) const;
  QStringList weights(vtkPolyData* shape, const bindpose::RayHit& hit) const;
  QString difference(const bindpose::RayHit& hit) const;

  void mouse_moved(const QMouseEvent& event);
  void show_lines(const QStringList& lines);
  void move_label_away(const QPoint& mouse);

  Views views_;
  QLabel* label_;
  QStringList lines_;
  double milliseconds_ = 0.0;
};

} // namespace app::window

#endif

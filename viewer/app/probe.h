#ifndef probe_h
#define probe_h

#include "scene/ray_cast.h"

#include <QObject>
#include <QStringList>

#include <functional>
#include <optional>

class DefectView;
class Posing;
class RotationView;
class QLabel;
class QMouseEvent;
class TetView;
class Viewport;
class VolumeView;
class WeightView;
class vtkPolyData;

/// What lies under the mouse, with names and numbers, on a small label in a corner of the picture:
/// of the surface its triangle, vertex and coordinates, the weight that is shown, the handle that
/// is the strongest there, a defect, and how far another method's shape is; of tets, slices,
/// isosurface and cloud what they show. What is seen in front is read; what is see-through counts
/// only where nothing solid is. Computed for moves of the mouse only, and not while a button is
/// held.
class Probe : public QObject
{
  Q_OBJECT

public:
  struct Views
  {
    Viewport* viewport;
    VolumeView* volume;
    TetView* tets;
    WeightView* weights;
    const DefectView* defects;
    Posing* posing;
    const RotationView* rotations;
    /// The surface as it is shown, posed or at rest; null without one.
    std::function<vtkPolyData*()> surface;
  };
  explicit Probe(const Views& views);

  /// At a pixel of VTK's (from the lower left); empty where nothing is.
  QStringList read_at(int x, int y);
  /// What the label says, in one line.
  QString reading() const;
  QLabel* label() const { return this->label_; }
  /// Something else is seen now: nothing is said until the mouse moves.
  void clear();
  /// What the last move took.
  double milliseconds() const { return this->milliseconds_; }

  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  /// A thing that the ray meets, and what there is to say about it.
  struct Found
  {
    double distance = 0.0;
    QStringList lines;
  };
  using Maybe = std::optional<Found>;
  Maybe surface(const bindpose::SightRay& ray, bool other) const;
  Maybe tets(const bindpose::SightRay& ray) const;
  Maybe weight_slice(const bindpose::SightRay& ray) const;
  Maybe winding_slice(const bindpose::SightRay& ray) const;
  Maybe isosurface(const bindpose::SightRay& ray) const;
  Maybe cloud(const bindpose::SightRay& ray) const;
  QString defect(const bindpose::SightRay& ray) const;
  QStringList weights(vtkPolyData* shape, const bindpose::SightHit& hit) const;
  QString difference(const bindpose::SightHit& hit) const;

  void mouse_moved(const QMouseEvent& event);
  void say(const QStringList& lines);
  void make_way(const QPoint& mouse);

  Views views_;
  QLabel* label_;
  QStringList lines_;
  double milliseconds_ = 0.0;
};

#endif

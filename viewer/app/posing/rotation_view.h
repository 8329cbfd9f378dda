#ifndef app_posing_rotation_view_h
#define app_posing_rotation_view_h

#include "geometry/mesh.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <QObject>
#include <QString>

#include <memory>

namespace bindpose
{
struct PoseRotations;
}

namespace app::view
{
class Viewport;
} // namespace app::view

namespace app::posing
{

class PosePanel;
class PoseController;

/// Shows the rotations of as-rigid-as-possible methods as colors on the shape. The panel selects
/// what the colors show: the clusters of points with the same rotation, or the angle of each
/// rotation.
class RotationView : public QObject
{
  Q_OBJECT

public:
  RotationView(view::Viewport* viewport, const PosePanel* panel, PoseController* posing);

  /// Set whether the pose panel is visible. While it is hidden, other views determine the colors of
  /// the surface.
  void set_active(bool active);
  /// Update the colors after a change of the pose, the method, the surface or the panel's choice.
  void update();
  /// Return a line of text about a point of the surface; empty if the colors do not show rotations.
  QString reading(bindpose::Index point) const;

private:
  void show_clusters(const bindpose::PoseRotations& found);
  void show_angles(const bindpose::PoseRotations& found);

  view::Viewport* viewport_;
  const PosePanel* panel_;
  PoseController* posing_;
  bool active_ = true;
  vtkSmartPointer<vtkDoubleArray> values_; ///< the displayed values; null: none
  /// The array PoseRotations::cluster_of_point from which values_ was computed.
  std::shared_ptr<const std::vector<bindpose::Index>> cluster_of_point_;
  double scale_ = 0.0; ///< upper end of the angle scale in degrees; 0: clusters are shown
  std::vector<bindpose::Vec3> axis_angles_; ///< axis times angle in degrees, one per rotation
};

} // namespace app::posing

#endif

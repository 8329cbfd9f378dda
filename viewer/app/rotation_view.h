#ifndef rotation_view_h
#define rotation_view_h

#include "base/mesh.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <QString>

#include <memory>

namespace bindpose
{
struct PoseRotations;
}
class PosePanel;
class Posing;
class Viewport;

/// What as-rigid-as-possible turns the shape by, in colours on it: the clusters of places that
/// share a rotation, or how far each is turned, as the panel asks for.
class RotationView
{
public:
  RotationView(Viewport* viewport, const PosePanel* panel, Posing* posing);

  /// Whether the panel is there; else others say what the surface is coloured by.
  void set_active(bool active);
  /// The pose, the method, the surface or what is asked for is another one.
  void update();
  /// At a point of the surface; empty when nothing is shown.
  QString reading(bindpose::Index point) const;

private:
  void show_clusters(const bindpose::PoseRotations& found);
  void show_angles(const bindpose::PoseRotations& found);

  Viewport* viewport_;
  const PosePanel* panel_;
  Posing* posing_;
  bool active_ = true;
  vtkSmartPointer<vtkDoubleArray> values_; ///< shown; null: nothing
  std::shared_ptr<const std::vector<bindpose::Index>> of_point_; ///< that they are of
  double scale_ = 0.0; ///< of angles, degrees; 0: clusters are shown
  std::vector<bindpose::Vec3> turns_; ///< of each rotation, axis times degrees
};

#endif

#ifndef handle_data_h
#define handle_data_h

#include "pose/pose.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <optional>
#include <string>
#include <vector>

class vtkPolyData;

namespace bindpose
{

/// The interactively editable properties of one cell of a handle dataset.
struct HandleRecord
{
  int kind = 0; ///< HandleKind; negative: not a handle but a bar (cage element or pseudo-edge)
  int mode = static_cast<int>(HandleMode::automatic); ///< HandleMode
  bool locked = false;
  vtkIdType parent = -1;
  Vec3 rest_head = Vec3::Zero(); ///< head of a bone, first point of a bar, or position
  /// Tail of a bone or second point of a bar; for all others equal to rest_head.
  Vec3 rest_tail = Vec3::Zero();
  Vec3 head = Vec3::Zero(); ///< posed head, or the head at rest if that was requested
  Vec3 tail = Vec3::Zero();
  Affine transform = identity_affine();
  double stretch = 1.0;
  Eigen::Vector2d twist = Eigen::Vector2d::Zero();
  /// Color from the array `Color`, 0 to 1; empty: the handle has no color.
  std::optional<Eigen::Vector3d> color;

  bool is_handle() const { return this->kind >= 0; }
  bool is_bone() const { return this->kind == static_cast<int>(HandleKind::bone); }
  bool is_free() const { return this->mode == static_cast<int>(HandleMode::free); }
  bool only_moves() const { return this->mode == static_cast<int>(HandleMode::position); }
};

/// Reads and writes the cell arrays of a handle dataset. Missing arrays have defaults.
class HandleData
{
public:
  void set(vtkPolyData* data);
  vtkPolyData* get() const;
  bool exists(vtkIdType cell) const;
  vtkIdType count() const;
  std::string name(vtkIdType cell) const;

  /// Return all cells. With at_rest, transforms and stretches are ignored.
  std::vector<HandleRecord> records(bool at_rest = false) const;
  /// Replace mode automatic in all records by the mode that the pose method uses instead. If the
  /// method computes rotations, resolve_automatic_modes() chooses this mode; otherwise this mode is
  /// full.
  static void resolve_modes(std::vector<HandleRecord>& records, bool finds_rotations);
  /// Return one cell, or a default-constructed HandleRecord if the cell does not exist.
  HandleRecord record(vtkIdType cell, bool at_rest = false) const;
  /// The ends of a bar. Cage elements end at their cage vertices, pseudo-edges at their points.
  struct Bar
  {
    vtkIdType cell;
    Vec3 from, to;
  };
  std::vector<Bar> bars(const std::vector<HandleRecord>& records) const;

  /// The pose of one cell, as a drag writes it.
  struct CellPose
  {
    Affine transform;
    double stretch;
    Eigen::Vector2d twist;
  };
  /// Write the poses of some cells. The array Transform is created if it is missing. Stretch and
  /// Twist are written if they exist or if a value differs from the rest pose. Other cells and
  /// arrays do not change.
  void set_poses(const std::vector<vtkIdType>& cells, const std::vector<CellPose>& poses);

private:
  vtkSmartPointer<vtkPolyData> data_;
};

} // namespace bindpose

#endif

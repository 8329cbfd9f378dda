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

/// One cell of a handle dataset as a hand sees it.
struct HandlePlace
{
  int kind = 0; ///< HandleKind; negative: a bar that is no handle
  int mode = static_cast<int>(HandleMode::automatic); ///< HandleMode
  bool locked = false;
  vtkIdType parent = -1;
  Vec3 rest_head = Vec3::Zero(); ///< of a bar, too: its first two points
  Vec3 rest_tail = Vec3::Zero(); ///< of anything but a bone and a bar: rest_head
  Vec3 head = Vec3::Zero(); ///< posed, or at rest when that was asked for
  Vec3 tail = Vec3::Zero();
  Affine transform = identity_affine();
  double stretch = 1.0;
  Eigen::Vector2d twist = Eigen::Vector2d::Zero();
  std::optional<Eigen::Vector3d> colour; ///< of the array `Color`, 0 to 1

  bool is_handle() const { return this->kind >= 0; }
  bool is_bone() const { return this->kind == static_cast<int>(HandleKind::bone); }
  bool is_free() const { return this->mode == static_cast<int>(HandleMode::free); }
  bool only_moves() const { return this->mode == static_cast<int>(HandleMode::position); }
};

/// Reads and writes the cell arrays of a handle dataset, with a default for whatever is missing.
class HandleData
{
public:
  void set(vtkPolyData* data);
  vtkPolyData* get() const;
  bool exists(vtkIdType cell) const;
  vtkIdType count() const;
  std::string name(vtkIdType cell) const;

  /// All cells. At rest: neither transforms nor stretches.
  std::vector<HandlePlace> places(bool at_rest = false) const;
  /// Replace mode automatic by what a method that finds rotations makes of it
  /// (with_found_rotations()), else by full.
  static void resolve_modes(std::vector<HandlePlace>& places, bool finds_rotations);
  /// One cell; a default one for a number that there is not.
  HandlePlace place(vtkIdType cell, bool at_rest = false) const;
  /// The ends of bars: cage elements go with their cage vertices, pseudo-edges with their points.
  struct Bar
  {
    vtkIdType cell;
    Vec3 from, to;
  };
  std::vector<Bar> bars(const std::vector<HandlePlace>& places) const;

  /// What a drag writes.
  struct CellPose
  {
    Affine transform;
    double stretch;
    Eigen::Vector2d twist;
  };
  /// Writes the pose of some cells: the array Transform, made when absent, and Stretch and Twist
  /// where they are there already or a number is not the rest's. Others stay.
  void set_poses(const std::vector<vtkIdType>& cells, const std::vector<CellPose>& poses);

private:
  vtkSmartPointer<vtkPolyData> data_;
};

} // namespace bindpose

#endif

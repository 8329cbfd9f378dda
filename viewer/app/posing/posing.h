#ifndef app_posing_posing_h
#define app_posing_posing_h

#include "app/posing/deformation.h"
#include "app/posing/pose_ghost.h"
#include "app/posing/stored_pose_manager.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <QObject>

#include <memory>
#include <optional>

namespace app::view
{
class Viewport;
} // namespace app::view

namespace app::posing
{

class BodyMotion;
class HandleFields;
class KeyStrip;
class PoseListWidget;
class PosePanel;
class SequenceExport;

/// Posing in the window. This class manages the shapes of the current method and of the method for
/// comparison, the simulated body, the stored poses and the playback of key frames. It also writes
/// the panels' texts about the pose.
///
/// This class reads the pose from the handle dataset, which the handle widget edits in place. To
/// change the pose, it emits pose_changed() and pose_step_requested(), so that the owner of the
/// undo history receives every change.
class PoseController : public QObject
{
  Q_OBJECT

public:
  struct Panels
  {
    PosePanel* pose;
    HandleFields* fields;
    PoseListWidget* poses;
    KeyStrip* strip;
  };
  PoseController(view::Viewport* viewport, const Panels& panels);
  ~PoseController() override;

  /// Set the data to pose; null: no data. The surface's weights are used only if `use_weights` is
  /// true.
  void set_data(
    vtkPolyData* surface, vtkUnstructuredGrid* tets, vtkPolyData* handles, bool use_weights);
  bool has_weights() const;
  /// Set the unit normal of a planar surface. The normal points to the eye. Empty: the surface is
  /// not planar. If a planar surface overlaps itself in a pose, the layers of the handles determine
  /// which part is in front. This function must be called before set_data().
  void set_plane(const std::optional<bindpose::Vec3>& normal) { this->plane_ = normal; }
  /// Report whether the method has all data that it needs.
  bool can_pose() const { return this->deformation_->can_pose(); }

  /// Update after the pose arrays of the handles have changed.
  void handles_moved();
  /// Update after the layers of the handles have changed.
  void layers_changed();
  /// Set the selected handles. The number fields show the values of the first one.
  void select_handles(const std::vector<int>& handles);
  /// Stop playback, because a drag begins.
  void drag_began();

  /// Return the surface at rest, from set_data().
  vtkPolyData* surface() const { return this->surface_; }
  /// Return the current shape: posed, or the surface at rest. All posed shapes of a surface are
  /// returned in the same object, whose points change.
  vtkPolyData* shape();
  /// Return the shape that draw() draws: normally shape(), but the surface at rest while
  /// inspect_at_rest() is in effect.
  vtkPolyData* displayed_shape()
  {
    return this->inspects_at_rest_ ? this->surface_.Get() : this->shape();
  }
  /// Draw displayed_shape() in the viewport, and update the ghost.
  void draw();
  /// Set whether the 3D view shows data that belongs to the shape at rest (tets, slices). draw()
  /// then draws the shape at rest, without the shape of the compared method. The pose is still
  /// computed.
  void inspect_at_rest(bool enabled);
  /// Report whether the 3D view shows the shape at rest, regardless of the pose.
  bool shows_rest() const
  {
    return this->inspects_at_rest_ || this->is_rest_view_ || this->edits_at_rest_;
  }
  /// Report whether the pose moves a handle, or the simulated body moves.
  bool is_posed() const;
  /// Set whether the shape is shown at rest, regardless of the pose. The posed shape is shown again
  /// when this class changes the pose, or when edit_at_rest() is called.
  void set_rest_view(bool rest);
  bool is_rest_view() const { return this->is_rest_view_; }
  bool edits_at_rest() const { return this->edits_at_rest_; }
  /// Set whether handles are edited at rest. The shape is then shown at rest, too.
  void edit_at_rest(bool enabled);
  /// Return a line of text about the last pose: its computing time and its result.
  QString reading() const;

  Deformation* deformation() const { return this->deformation_; }
  Deformation* compared_deformation() const { return this->compared_deformation_; }
  /// Return the points of the current method's shape, even if the 3D view shows another shape.
  const bindpose::Points& points() const;
  /// Return the rotations of the current method's shape; null if the method fits none.
  const bindpose::PoseRotations* rotations();
  /// Return the diagonal of the box around the shape at rest.
  double rest_diagonal() const { return this->surface_ ? this->surface_->GetLength() : 0.0; }
  PoseGhost* ghost() const { return this->ghost_.get(); }
  BodyMotion* motion() const { return this->motion_; }
  StoredPoseManager* pose_manager() const { return this->pose_manager_; }
  SequenceExport* sequence_export() const { return this->export_; }
  /// Report whether there are key frames or a recorded motion of the body.
  bool has_animation() const;
  /// Export the recorded motion of the body or, if there is none, the key frames. sequence_export()
  /// reports progress and result.
  void export_to(const QString& path);

  const bindpose::StoredPoses& stored_poses() const { return this->pose_manager_->stored_poses(); }

Q_SIGNALS:
  /// Emitted to request this pose of the handles.
  void pose_changed(const bindpose::Pose& pose);
  /// Emitted to request one undo step, named `step`, for all poses since the previous step.
  /// Consecutive steps with the same `merge` text become one step, until edit_ended() is emitted.
  void pose_step_requested(const QString& step, const QString& merge = {});
  void edit_ended();
  void stored_poses_changed(const QString& step);
  /// Emitted when the cell arrays of the handles have changed, to request an undo step named
  /// `step`.
  void handles_changed(const QString& step);
  /// Emitted when the shape or the text of reading() has changed. The window must then call draw().
  void moved();
  void failed(const QString& message);
  /// Emitted when a pose was applied without errors.
  void succeeded();

private:
  void connect_panel();
  void connect_pose_manager();
  bindpose::Pose pose() const;
  void update_automatic_modes();
  bindpose::PoseOptions compared_options() const;
  void options_changed();
  void comparison_changed();
  void show_comparison();
  void show_state();
  void show_difference();
  void follow_free_handles();
  void values_typed(int field);
  void layer_typed(double layer);
  void order_layers();
  void show_values();
  void change_pose(const bindpose::Pose& pose, const QString& step, const QString& merge = {});
  bindpose::Pose constraint_pose() const;
  void simulation_changed();
  bool has_motion() const;

  view::Viewport* viewport_;
  Panels panels_;
  Deformation* deformation_;
  Deformation* compared_deformation_;
  std::unique_ptr<PoseGhost> ghost_;
  StoredPoseManager* pose_manager_;
  BodyMotion* motion_;
  SequenceExport* export_;
  std::shared_ptr<const bindpose::PoseSource> source_;
  vtkSmartPointer<vtkPolyData> surface_, handles_, shape_;
  std::vector<bindpose::Index> cells_;
  int selected_ = -1; ///< the first selected handle; -1: none
  int selected_count_ = 0;
  std::optional<bindpose::Vec3> plane_;
  bool is_rest_view_ = false;
  bool edits_at_rest_ = false;
  bool inspects_at_rest_ = false; ///< true: data that belongs to the shape at rest is inspected
  /// The display mode that the panel requested at the last call of show_comparison().
  PoseGhost::DisplayMode requested_display_mode_ = PoseGhost::hidden;
  double drawing_microseconds_ = 0.0; ///< time that draw() took for points and normals
};

} // namespace app::posing

#endif

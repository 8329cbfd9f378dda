#ifndef posing_h
#define posing_h

#include "deformation.h"
#include "pose_ghost.h"
#include "pose_keeper.h"

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <QObject>

#include <memory>
#include <optional>

class BodyMotion;
class HandleFields;
class KeyStrip;
class PoseList;
class PosePanel;
class SequenceExport;
class Viewport;

/// All posing of the window: the method at work and the one to compare with, the body that moves by
/// itself, key frames that play, the poses that are kept, and what the panels say about it.
///
/// It reads the pose from the handle dataset, which the widget edits in place, and changes it only
/// through pose_changed() and pose_done(), so that whoever keeps the history sees every change.
class Posing : public QObject
{
  Q_OBJECT

public:
  struct Panels
  {
    PosePanel* pose;
    HandleFields* fields;
    PoseList* poses;
    KeyStrip* strip;
  };
  Posing(Viewport* viewport, const Panels& panels);
  ~Posing() override;

  /// What there is to bend; null: nothing. Weights of the surface count when they are wanted.
  void set_data(
    vtkPolyData* surface, vtkUnstructuredGrid* tets, vtkPolyData* handles, bool use_weights);
  bool has_weights() const;
  /// The surface lies in a plane across this, which points to the eye: where a pose makes it
  /// overlap itself, its handles' layers say what is in front. To be told before set_data().
  /// Nothing: it lies in none.
  void set_plane(const std::optional<bindpose::Vec3>& normal) { this->plane_ = normal; }
  /// The method has what it needs.
  bool can_pose() const { return this->main_->can_pose(); }

  /// The handles' pose arrays are others now.
  void handles_moved();
  /// The handles have other layers now.
  void layers_changed();
  /// Others are selected; the values of the first can be seen and typed.
  void select_handles(const std::vector<int>& handles);
  /// A drag begins; what plays stops.
  void drag_began();

  /// The surface at rest, of set_data().
  vtkPolyData* surface() const { return this->surface_; }
  /// As it is seen: posed, or at rest. The same object as long as the surface is.
  vtkPolyData* shape();
  /// What draw() draws: the shape, or the one at rest while something of that is inspected.
  vtkPolyData* seen() { return this->inspected_ ? this->surface_.Get() : this->shape(); }
  /// Bring the viewport's surface and its ghost to what is seen.
  void draw();
  /// Something that belongs to the shape at rest (tets, slices) is shown in the picture: draw()
  /// draws the shape at rest, without a comparison. The pose goes on.
  void inspect_at_rest(bool inspects);
  /// Whether the picture shows the shape at rest, whatever the pose.
  bool shows_rest() const { return this->inspected_ || this->at_rest_ || this->edits_at_rest_; }
  /// The pose moves some handle, or a body moves.
  bool is_posed() const;
  /// The shape at rest, whatever the pose, until the next drag.
  void look_at_rest(bool rest);
  bool looks_at_rest() const { return this->at_rest_; }
  bool edits_at_rest() const { return this->edits_at_rest_; }
  /// The same while rest handles are edited: they can be taken hold of.
  void edit_at_rest(bool edits);
  /// What the last pose took and came to, in a line.
  QString reading() const;

  Deformation* deformation() const { return this->main_; }
  Deformation* compared() const { return this->compared_; }
  /// Of the shape that the method at work gives, whether or not it is what is looked at.
  const bindpose::Points& points() const;
  /// What that shape is turned by; null where the method fits no rotations.
  const bindpose::PoseRotations* rotations();
  /// Of the box around the shape at rest.
  double rest_diagonal() const { return this->surface_ ? this->surface_->GetLength() : 0.0; }
  PoseGhost* ghost() const { return this->ghost_.get(); }
  BodyMotion* motion() const { return this->motion_; }
  PoseKeeper* keeper() const { return this->keeper_; }
  SequenceExport* sequence_export() const { return this->export_; }
  /// There are key frames, or a motion.
  bool has_animation() const;
  /// Write the key frames, or the motion, if there are some; sequence_export() reports progress and
  /// result.
  void export_to(const QString& path);

  const bindpose::PoseShelf& shelf() const { return this->keeper_->shelf(); }

Q_SIGNALS:
  /// The handles shall be in this pose; it is not done yet.
  void pose_changed(const bindpose::Pose& pose);
  /// Since the first pose_changed() this has happened: a step of the history.
  /// Successive steps with the same merge text are one step of the history, until edit_ended().
  void pose_done(const QString& step, const QString& merge = {});
  void edit_ended();
  void shelf_changed(const QString& step);
  /// The handles have other cell arrays now: a step of the history.
  void handles_changed(const QString& step);
  /// The shape is another one, or what is said of it: draw().
  void moved();
  void failed(const QString& sentence);
  /// A pose was applied, and nothing is wrong with it.
  void succeeded();

private:
  void connect_panel();
  void connect_keeper();
  bindpose::Pose pose() const;
  void show_what_is_held();
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
  bindpose::Pose holding_pose() const;
  void moves_changed();
  bool has_motion() const;

  Viewport* viewport_;
  Panels panels_;
  Deformation* main_;
  Deformation* compared_;
  std::unique_ptr<PoseGhost> ghost_;
  PoseKeeper* keeper_;
  BodyMotion* motion_;
  SequenceExport* export_;
  std::shared_ptr<const bindpose::PoseSource> source_;
  vtkSmartPointer<vtkPolyData> surface_, handles_, shape_;
  std::vector<bindpose::Index> cells_;
  int selected_ = -1; ///< the first of
  int selected_count_ = 0;
  std::optional<bindpose::Vec3> plane_;
  bool at_rest_ = false;
  bool edits_at_rest_ = false;
  bool inspected_ = false; ///< at rest
  PoseGhost::Place chosen_ = PoseGhost::hidden; ///< of the panel, when it was looked at last
  double drawing_microseconds_ = 0.0; ///< of draw(): points and normals
};

#endif

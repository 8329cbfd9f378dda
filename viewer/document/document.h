#ifndef document_document_h
#define document_document_h

#include "base/status.h"
#include "document/bound_columns.h"
#include "document/work.h"

#include <QObject>
#include <QUndoStack>

#include <vector>

class vtkDataArray;
class vtkDataSet;

/// What a window keeps: surface, handles, weights, pose, options and where they came from, with
/// their history. It has no widgets; views look at it, follow changed(), and edit through it.
///
/// Every edit is a step of history() with a name, and undo and redo give back the same work to the
/// last bit. Edits that do nothing make no step.
///
/// The handles are edited **in place**: a widget moves what handle_data() holds, as it likes, and
/// when it is done commit_pose() or commit_handles() makes one step of it; revert_handles() takes
/// back what was not committed.
///
/// Which weights pose the shape after handles have changed is told at BoundColumns. Another mesh
/// has the weights that came with it, or none.
class Document : public QObject
{
  Q_OBJECT

public:
  explicit Document(QObject* parent = nullptr);
  ~Document() override;

  const Work& work() const { return this->work_; }
  QUndoStack* history() const { return this->history_; }
  /// What is now is in a file, or nothing that a person has made.
  void set_saved();
  /// It is in no file, though it has no history: recovered work.
  void set_unsaved() { this->history_->resetClean(); }
  /// Whether there is more than at set_saved(). How things are looked at counts where `looks`.
  bool is_changed(bool looks) const;

  // ---- What there is ----
  /// At rest; with weights it has the columns of the handles, in their order. Null without a mesh.
  vtkPolyData* surface() const;
  /// Those that the weights were solved on, with the same columns; or null.
  vtkUnstructuredGrid* weighted_tets() const;
  /// The handles as they are now, pose arrays included; null without handles. The same object as
  /// long as the document lives.
  vtkPolyData* handle_data() const;
  const bindpose::Handles& handles() const { return this->handles_; }
  const std::vector<bindpose::Index>& handle_cells() const { return this->cells_; }
  /// Number of the handle with this cell of handle_data(); -1: none.
  int handle_of_cell(vtkIdType cell) const;
  /// Of handle_data(): during a drag not yet that of work().
  bindpose::Pose pose() const;
  bool is_bound() const;
  /// Why weights that came with the mesh are not used: one sentence, or empty.
  QString unused_weights() const { return this->unused_weights_; }
  /// What another bind is good for: one sentence, or empty.
  QString rebind_reason() const;
  QVariant option(const QString& key) const { return this->work_.options.value(key); }
  int number(const QString& key) const { return this->option(key).toInt(); }

  // ---- Opening ----
  /// A surface, or tets, whose skin is taken. invalid_input: not a surface; nothing changes.
  bindpose::Status set_mesh(vtkDataSet* mesh, const QString& name, const Source& source = {});
  /// Other handles, with the pose that their arrays tell.
  bindpose::Status set_handles(
    vtkPolyData* handles, const QString& name, const Source& source = {});
  /// Weights for the surface's points and the handles that are open; invalid_input otherwise.
  bindpose::Status set_weights(const bindpose::Weights& weights, const QString& name);
  /// A surface that was cut out of a picture (vtkPlanarShape), which it shows.
  bindpose::Status set_picture(
    vtkPolyData* shape, vtkImageData* picture, const QString& name, const Source& source = {});
  /// Null closes it. `step`: the name of the step, if it is not opened from a file.
  void set_volume(
    vtkImageData* volume, const QString& name, const Source& source = {}, const QString& step = {});
  void set_curves(vtkPolyData* curves, const QString& name, const Source& source = {});

  // ---- Handles and pose ----
  /// One step of what was changed in handle_data(): handles added, removed, renamed, recoloured,
  /// moved at rest. Steps of the same non-empty `merge` that follow each other become one. With a
  /// status that is not ok the handles cannot be used, and the change is taken back. All cells
  /// gone: there are no handles any more.
  bindpose::Status commit_handles(const QString& step, const QString& merge = {});
  /// The same when regions were painted, too: `labels`, one a vertex of the surface, become its
  /// point array RegionId.
  bindpose::Status commit_regions(vtkDataArray* labels, const QString& step);
  /// Another name for a handle, in the poses that are kept, too. invalid_input, one sentence, for a
  /// name that is empty or another handle's.
  bindpose::Status rename_handle(int handle, const QString& name);
  /// The same when only pose arrays were changed.
  void commit_pose(const QString& step, const QString& merge = {});
  /// Back to the last step, to the last bit.
  void revert_handles();
  /// The dataset to put the first handles into; commit_handles() makes them known.
  vtkPolyData* editable_handles() { return this->live_; }
  void set_pose(const bindpose::Pose& pose, const QString& step, const QString& merge = {});
  void set_mode(int handle, int mode);
  void back_to_rest();
  void set_key_poses(bindpose::PoseShelf poses, const QString& step, const QString& merge = {});

  // ---- Weights ----
  /// What is bound now: the surface and the handles that set_bound() and set_preview() will be
  /// about.
  void begin_bind();
  /// The handles of the bind that is going on.
  const bindpose::Handles& bound_handles() const { return this->binding_.handles; }
  /// The surface of the bind with weights for its handles, and what they were solved on (or null).
  /// False when that surface is no longer there: nothing changes.
  bool set_bound(vtkPolyData* surface, vtkUnstructuredGrid* tets);
  /// Weights to pose with meanwhile: no step, and gone with drop_preview() or set_bound().
  bool set_preview(vtkPolyData* surface);
  void drop_preview();
  bool has_preview() const { return this->preview_ != nullptr; }

  // ---- Options ----
  /// One step; of an option whose number is moved continuously the steps merge, until another step
  /// or end_merge(). What the table (options.h) does not allow is left.
  void set_option(const QString& key, const QVariant& value);
  /// One step of several that go together, named like the option `key`.
  void set_options(const Options& values, const QString& key);
  /// What the program itself chose: kept, but no step.
  void note_option(const QString& key, const QVariant& value);
  /// The next step begins anew, whatever it could be merged with.
  void end_merge() { ++this->merges_; }

  /// Another work, with a history of its own.
  void replace(const Work& work);

Q_SIGNALS:
  /// Undo or redo is about to change handles or pose: a drag ends now.
  void about_to_change();
  /// Which WorkParts are others now.
  void changed(int parts);
  /// One of the options is another now; after changed().
  void option_changed(const QString& key, const QVariant& value);

private:
  friend class Edit;

  /// What is already done in handle_data() when a step is made.
  enum class Live
  {
    to_be_written,
    is_there
  };
  void push(const QString& step, const Work& after, const QString& merge = {},
    Live live = Live::to_be_written);
  void become(const Work& work, Live live);
  void arrange();
  bindpose::Status take_live(Work& work);

  Work work_;
  Work saved_;
  QUndoStack* history_;
  vtkSmartPointer<vtkPolyData> live_; // handles, edited in place
  bindpose::Handles handles_; // of live_
  std::vector<bindpose::Index> cells_;
  vtkSmartPointer<vtkPolyData> surface_; // arranged
  vtkSmartPointer<vtkUnstructuredGrid> tets_;
  BoundColumns columns_;
  QString unused_weights_;
  vtkSmartPointer<vtkPolyData> preview_;
  struct Binding
  {
    vtkSmartPointer<vtkPolyData> surface;
    vtkSmartPointer<vtkPolyData> handle_data;
    bindpose::Handles handles;
  };
  Binding binding_;
  int merges_ = 0;
  bool in_history_ = false; ///< undo or redo is under way
};

#endif

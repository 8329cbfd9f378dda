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

/// The state of one window and its undo history: surface, handles, weights, pose, options and their
/// source files. A document has no widgets. Views read the document, update on changed(), and edit
/// through it.
///
/// Every edit is a named step of history(). Undo and redo restore the work bit for bit. An edit
/// without effect is not recorded.
///
/// The handles are edited **in place**: a widget changes handle_data() freely. Then commit_pose()
/// or commit_handles() records the changes as one step, or revert_handles() discards them.
///
/// After handles have changed, BoundColumns assigns the existing weights to them. If another mesh
/// is opened, its own weights are used, or none.
class Document : public QObject
{
  Q_OBJECT

public:
  explicit Document(QObject* parent = nullptr);
  ~Document() override;

  const Work& work() const { return this->work_; }
  QUndoStack* history() const { return this->history_; }
  /// Mark the current state as saved: it is in a file, or contains no edits by the user.
  void set_saved();
  /// Mark the current state as unsaved although the history is empty, for work recovered after a
  /// crash.
  void set_unsaved() { this->history_->resetClean(); }
  /// Report whether the work has changed since set_saved(). `include_options` states whether a
  /// change of options alone counts as a change.
  bool is_changed(bool include_options) const;

  // ---- State ----
  /// Return the surface at rest; null without a mesh. Its weights have one column per handle, in
  /// the order of the handles.
  vtkPolyData* surface() const;
  /// Return the tets on which the weights were solved; or null. The weights of the tets have the
  /// same columns as those of surface().
  vtkUnstructuredGrid* weighted_tets() const;
  /// Return the current handles with their pose arrays; null without handles. The object is the
  /// same as long as the document exists.
  vtkPolyData* handle_data() const;
  const bindpose::Handles& handles() const { return this->handles_; }
  const std::vector<bindpose::Index>& handle_cells() const { return this->cells_; }
  /// Return the index of the handle to which a cell of handle_data() belongs; -1: none.
  int handle_of_cell(vtkIdType cell) const;
  /// Return the pose of handle_data(). During a drag it differs from the pose of work().
  bindpose::Pose pose() const;
  bool is_bound() const;
  /// Return the reason why the mesh's own weights are not used: one sentence, or empty.
  QString unused_weights_reason() const { return this->unused_weights_reason_; }
  /// Return the reason why another bind is useful: one sentence, or empty.
  QString rebind_reason() const;
  QVariant option(const QString& key) const { return this->work_.options.value(key); }
  int number(const QString& key) const { return this->option(key).toInt(); }

  // ---- Opening files ----
  /// Open a surface, or tets and their boundary surface. On invalid_input (the dataset is neither a
  /// surface nor tets), nothing changes.
  /// @param look  materials, textures and vertex colors of the surface; null: none
  bindpose::Status set_mesh(vtkDataSet* mesh, const QString& name, const Source& source = {},
    std::shared_ptr<const bindpose::FileLook> look = nullptr);
  /// Open handles with the pose that is in their arrays.
  bindpose::Status set_handles(
    vtkPolyData* handles, const QString& name, const Source& source = {});
  /// Open weights for the surface's points and the open handles; return invalid_input if they do
  /// not fit.
  bindpose::Status set_weights(const bindpose::Weights& weights, const QString& name);
  /// Open a surface that was cut out of an image (vtkPlanarShape). The image becomes the texture of
  /// the surface.
  bindpose::Status set_picture(
    vtkPolyData* shape, vtkImageData* picture, const QString& name, const Source& source = {});
  /// Open a volume; null closes the open volume.
  /// @param step  name of the undo step, for a volume that is not from a file
  void set_volume(
    vtkImageData* volume, const QString& name, const Source& source = {}, const QString& step = {});
  void set_curves(vtkPolyData* curves, const QString& name, const Source& source = {});

  // ---- Handles and pose ----
  /// Record the changes of handle_data() as one step: handles added, removed, renamed, recolored,
  /// or moved at rest. Consecutive steps with the same non-empty `merge` become one step. If the
  /// handles are invalid, return a status that is not ok and revert the changes. If all cells were
  /// removed, the work has no handles.
  bindpose::Status commit_handles(const QString& step, const QString& merge = {});
  /// Record painted regions and the changes of handle_data() as one step. `labels`, one per vertex
  /// of the surface, become the surface's point array RegionId.
  bindpose::Status commit_regions(vtkDataArray* labels, const QString& step);
  /// Rename a handle, also in the stored poses. Return invalid_input, with one sentence, if the
  /// name is empty or belongs to another handle.
  bindpose::Status rename_handle(int handle, const QString& name);
  /// Record the changes of the pose arrays of handle_data() as one step. All other data of
  /// handle_data() must be unchanged.
  void commit_pose(const QString& step, const QString& merge = {});
  /// Restore the handles of the last step, bit for bit.
  void revert_handles();
  /// Return the dataset to which the first handles are added; commit_handles() makes them part of
  /// the work.
  vtkPolyData* editable_handles() { return this->edited_handles_; }
  void set_pose(const bindpose::Pose& pose, const QString& step, const QString& merge = {});
  void set_mode(int handle, int mode);
  void reset_to_rest();
  void set_stored_poses(
    bindpose::StoredPoses poses, const QString& step, const QString& merge = {});

  // ---- Weights ----
  /// Record the current surface and handles as those of the bind that begins. The next set_bound()
  /// and set_preview() refer to them.
  void begin_bind();
  /// Return the handles of the bind in progress.
  const bindpose::Handles& bound_handles() const { return this->binding_.handles; }
  /// Set the result of the bind: the surface with weights for bound_handles(), and the tets on
  /// which these weights were solved (or null). Preliminary weights are removed in all cases. If
  /// the surface of begin_bind() is no longer open, return false and change nothing else.
  bool set_bound(vtkPolyData* surface, vtkUnstructuredGrid* tets);
  /// Set preliminary weights that are used for posing until the bind ends. No undo step is
  /// recorded; drop_preview() and set_bound() remove the preliminary weights.
  bool set_preview(vtkPolyData* surface);
  void drop_preview();
  bool has_preview() const { return this->preview_ != nullptr; }

  // ---- Options ----
  /// Set an option as one undo step. Consecutive steps of one continuous option merge until
  /// end_merge() or a step of another option. Values that the table (options.h) does not allow are
  /// ignored.
  void set_option(const QString& key, const QVariant& value);
  /// Set several options as one undo step. The step has the same name as a change of option `key`.
  void set_options(const Options& values, const QString& key);
  /// Set an option that the program itself has chosen, without an undo step. Undo and redo of steps
  /// that change the same option do not restore this value (see has_step_of).
  void set_option_without_undo(const QString& key, const QVariant& value);
  /// Report whether a step of the history, undone or not, changes an option.
  bool has_step_of(const QString& key) const;
  /// Prevent the next undo step from merging with the previous one.
  void end_merge() { ++this->merge_group_; }

  /// Replace the work and begin a new history.
  void replace(const Work& work);

Q_SIGNALS:
  /// Emitted before handles or pose change, for example by undo; a drag in progress must end.
  void about_to_change();
  /// Emitted after the parts of the work in `parts` (a combination of WorkPart) have changed.
  void changed(int parts);
  /// Emitted after changed() for every option whose value has changed.
  void option_changed(const QString& key, const QVariant& value);

private:
  /// States whether handle_data() already contains the changes of a step.
  enum class HandleDataState
  {
    outdated,
    up_to_date
  };
  void push(const QString& step, const Work& after, const QString& merge = {},
    HandleDataState handle_state = HandleDataState::outdated);
  /// Apply an edit, its undo or its redo to the work.
  void apply(const Work& before, const Work& after, HandleDataState handle_state, bool in_history);
  void set_work(const Work& work, HandleDataState handle_state);
  void update_columns();
  bindpose::Status read_edited_handles(Work& work);

  Work work_;
  Work saved_;
  QUndoStack* history_;
  vtkSmartPointer<vtkPolyData> edited_handles_; // the handles, edited in place
  bindpose::Handles handles_; // edited_handles_ as handles of the kernels
  std::vector<bindpose::Index> cells_;
  // surface whose weights have one column per handle, in the order of the handles
  vtkSmartPointer<vtkPolyData> surface_;
  vtkSmartPointer<vtkUnstructuredGrid> tets_;
  BoundColumns columns_;
  QString unused_weights_reason_;
  vtkSmartPointer<vtkPolyData> preview_;
  struct Binding
  {
    vtkSmartPointer<vtkPolyData> surface;
    vtkSmartPointer<vtkPolyData> handle_data;
    bindpose::Handles handles;
  };
  Binding binding_;
  int merge_group_ = 0;
  bool in_history_ = false; ///< true during undo or redo
};

#endif

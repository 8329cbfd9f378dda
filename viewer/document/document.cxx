// The state of a window and its undo history. The work (mesh, handles, weights, pose, options) is a
// value. An edit creates a new value and pushes an undo step with the old and the new value. Views
// also need derived data: the kernels' handles, and the weights in the order of the handles. The
// derived data is computed whenever the work changes.
#include "document/document.h"

#include "document/edit.h"
#include "document/work_inputs.h"

#include "conversion.h"
#include "handle_edit_cells.h"

#include "vtkPointData.h"

#include <QUndoStack>

#include <algorithm>

using namespace bindpose;

namespace
{
constexpr int maximum_undo_steps = 1000;

vtkSmartPointer<vtkPolyData> copy_of(vtkPolyData* data)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->DeepCopy(data);
  return copy;
}

/// Name of the array with the region labels for which the weights were solved. A surface has this
/// array only if regions were painted after the solve.
const char* const bound_labels_name = "BoundRegionId";

vtkDataArray* labels_of(vtkPolyData* surface)
{
  return surface ? surface->GetPointData()->GetArray("RegionId") : nullptr;
}

/// Return a copy of the labels under another name. If there are no labels, return one zero per
/// tuple of `model_array`.
vtkSmartPointer<vtkDataArray> copy_of_labels(
  vtkDataArray* labels, vtkDataArray* model_array, const char* name)
{
  auto copy = vtkSmartPointer<vtkDataArray>::Take(model_array->NewInstance());
  if (labels)
  {
    copy->DeepCopy(labels);
  }
  else
  {
    copy->SetNumberOfTuples(model_array->GetNumberOfTuples());
    copy->Fill(0.0);
  }
  copy->SetName(name);
  return copy;
}

bool same_labels(vtkDataArray* a, vtkDataArray* b)
{
  const vtkIdType count = a ? a->GetNumberOfTuples() : b ? b->GetNumberOfTuples() : 0;
  for (vtkIdType v = 0; v < count && a != b; ++v)
  {
    if ((a ? a->GetComponent(v, 0) : 0.0) != (b ? b->GetComponent(v, 0) : 0.0))
    {
      return false;
    }
  }
  return true;
}
} // namespace

Document::Document(QObject* parent)
  : QObject(parent), history_(new QUndoStack(this)),
    edited_handles_(vtkSmartPointer<vtkPolyData>::New())
{
  this->history_->setUndoLimit(maximum_undo_steps);
  this->work_.options = initial_options();
  this->saved_ = this->work_;
}

Document::~Document()
{
  this->history_->clear(); // delete the steps first, because they refer to this document
}

void Document::set_saved()
{
  this->saved_ = this->work_;
  this->history_->setClean();
}

bool Document::is_changed(bool include_options) const
{
  const bool recovered = this->history_->cleanIndex() < 0;
  return !this->history_->isClean() &&
    (include_options || recovered || (differences(this->saved_, this->work_) & ~options_part));
}

vtkPolyData* Document::surface() const
{
  return this->surface_;
}

vtkUnstructuredGrid* Document::weighted_tets() const
{
  return this->tets_;
}

vtkPolyData* Document::handle_data() const
{
  return this->work_.handles ? this->edited_handles_.Get() : nullptr;
}

int Document::handle_of_cell(vtkIdType cell) const
{
  const auto found = std::find(this->cells_.begin(), this->cells_.end(), cell);
  return found == this->cells_.end() ? -1 : static_cast<int>(found - this->cells_.begin());
}

Pose Document::pose() const
{
  Pose pose;
  if (this->work_.handles)
  {
    to_pose(this->edited_handles_, this->handles_, this->cells_, pose);
  }
  return pose;
}

bool Document::is_bound() const
{
  return this->work_.handles && weights_of(this->surface_) && this->columns_.any();
}

QString Document::rebind_reason() const
{
  if (!this->work_.handles || !this->work_.surface || !this->work_.bound_handles)
  {
    return {};
  }
  if (!weights_of(this->surface_))
  {
    return tr("This mesh is not the one that was bound.");
  }
  const QString reason = this->columns_.reason();
  vtkDataArray* solved = this->work_.surface->GetPointData()->GetArray(bound_labels_name);
  const bool painted = solved && !same_labels(solved, labels_of(this->work_.surface));
  return reason.isEmpty() && painted ? tr("Regions were painted since the bind.") : reason;
}

// ---- Steps -------------------------------------------------------------------------------------

void Document::push(
  const QString& step, const Work& after, const QString& merge, HandleDataState handle_state)
{
  // Changes that views make during undo or redo are not pushed as steps. A pushed step would delete
  // the step that is being redone.
  if (this->in_history_ || differences(this->work_, after) == 0)
  {
    return;
  }
  const QString key =
    merge.isEmpty() ? QString() : merge + '#' + QString::number(this->merge_group_);
  const auto apply = [this, handle_state](const Work& from, const Work& to, bool in_history)
  { this->apply(from, to, in_history ? HandleDataState::outdated : handle_state, in_history); };
  this->history_->push(new Edit(step, this->work_, after, key, apply));
}

void Document::apply(
  const Work& before, const Work& after, HandleDataState handle_state, bool in_history)
{
  if (in_history)
  {
    Q_EMIT this->about_to_change();
  }
  Work work = this->work_;
  apply_edit(before, after, work);
  this->in_history_ = in_history;
  this->set_work(work, handle_state);
  this->in_history_ = false;
}

void Document::set_work(const Work& work, HandleDataState handle_state)
{
  const Work before = this->work_;
  const int parts = differences(before, work);
  this->work_ = work;
  if (parts & (mesh_part | weights_part))
  {
    this->preview_ = nullptr;
  }
  if (parts & (handles_part | handle_looks_part))
  {
    if (handle_state == HandleDataState::outdated)
    {
      if (work.handles)
      {
        this->edited_handles_->DeepCopy(work.handles);
      }
      else
      {
        this->edited_handles_->Initialize();
      }
    }
    this->handles_.clear();
    this->cells_.clear();
    if (work.handles)
    {
      to_handles(work.handles, this->handles_, &this->cells_);
    }
  }
  if (parts & (handles_part | handle_looks_part | pose_part) && work.handles &&
    handle_state == HandleDataState::outdated)
  {
    bindpose::set_pose(this->edited_handles_, this->cells_, work.pose);
  }
  if (parts & (mesh_part | weights_part | handles_part))
  {
    this->update_columns();
  }
  Q_EMIT this->changed(parts);
  if (parts & options_part)
  {
    for (auto option = work.options.begin(); option != work.options.end(); ++option)
    {
      if (before.options.value(option.key()) != option.value())
      {
        Q_EMIT this->option_changed(option.key(), option.value());
      }
    }
  }
}

/// Put the columns of the weights into the order of the handles.
void Document::update_columns()
{
  vtkPolyData* surface = this->preview_ ? this->preview_ : this->work_.surface;
  vtkDataArray* weights = weights_of(surface);
  this->surface_ = surface;
  this->tets_ = this->preview_ ? nullptr : this->work_.weighted_tets;
  this->columns_ = BoundColumns();
  this->unused_weights_reason_.clear();
  vtkPolyData* bound = this->preview_ ? this->binding_.handle_data : this->work_.bound_handles;
  if (!weights || !this->work_.handles)
  {
    return;
  }
  if (!bound)
  {
    weights_fit(weights, this->handles_, &this->unused_weights_reason_);
    return;
  }
  Handles handles;
  to_handles(bound, handles);
  if (weights->GetNumberOfComponents() == static_cast<int>(handles.size()))
  {
    this->columns_ = BoundColumns(handles, this->handles_);
  }
  if (this->columns_.any())
  {
    this->surface_ = vtkPolyData::SafeDownCast(this->columns_.reordered(surface));
    this->tets_ = vtkUnstructuredGrid::SafeDownCast(this->columns_.reordered(this->tets_));
    return;
  }
  weights_fit(weights, this->handles_, &this->unused_weights_reason_);
}

void Document::replace(const Work& work)
{
  Q_EMIT this->about_to_change();
  this->history_->clear();
  this->preview_ = nullptr;
  this->binding_ = Binding();
  this->set_work(work, HandleDataState::outdated);
  this->set_saved();
}

// ---- Opening files -----------------------------------------------------------------------------

Status Document::set_mesh(
  vtkDataSet* mesh, const QString& name, const Source& source, std::shared_ptr<const FileLook> look)
{
  Work after = this->work_;
  Status status = use_mesh(mesh, name, source, after);
  if (status.ok())
  {
    after.look = std::move(look);
    this->push(tr("open %1").arg(name), after);
  }
  return status;
}

Status Document::set_handles(vtkPolyData* data, const QString& name, const Source& source)
{
  Work after = this->work_;
  Status status = use_handles(data, source, after);
  if (status.ok())
  {
    this->push(tr("open handles %1").arg(name), after);
  }
  return status;
}

Status Document::set_weights(const Weights& weights, const QString& name)
{
  Work after = this->work_;
  Status status = use_weights(weights, name, after);
  if (status.ok())
  {
    this->push(tr("open weights %1").arg(name), after);
  }
  return status;
}

Status Document::set_picture(
  vtkPolyData* shape, vtkImageData* picture, const QString& name, const Source& source)
{
  Work after = this->work_;
  Status status = use_mesh(shape, name, Source(), after);
  if (status.ok())
  {
    after.picture = picture;
    after.picture_source = source;
    this->push(tr("open %1").arg(name), after);
  }
  return status;
}

void Document::set_volume(
  vtkImageData* volume, const QString& name, const Source& source, const QString& step)
{
  Work after = this->work_;
  after.volume = volume;
  after.volume_name = name;
  after.volume_source = source;
  this->push(!step.isEmpty() ? step
      : volume               ? tr("open volume %1").arg(name)
                             : tr("close the volume"),
    after);
}

void Document::set_curves(vtkPolyData* curves, const QString& name, const Source& source)
{
  Work after = this->work_;
  after.curves = curves;
  after.curve_source = source;
  this->push(tr("open curves %1").arg(name), after);
}

// ---- Handles and pose --------------------------------------------------------------------------

/// Set handles and pose of a work from handle_data(). Revert handle_data() if it is invalid.
Status Document::read_edited_handles(Work& work)
{
  work.handles = nullptr;
  work.pose.clear();
  if (this->edited_handles_->GetNumberOfCells() > 0)
  {
    Handles handles;
    std::vector<Index> cells;
    Status status = to_handles(this->edited_handles_, handles, &cells);
    if (status.ok())
    {
      status = to_pose(this->edited_handles_, handles, cells, work.pose);
    }
    if (!status.ok())
    {
      this->revert_handles();
      return status;
    }
    work.handles = copy_of(this->edited_handles_);
  }
  return {};
}

Status Document::commit_handles(const QString& step, const QString& merge)
{
  Work after = this->work_;
  Status status = this->read_edited_handles(after);
  if (status.ok())
  {
    this->push(step, after, merge, HandleDataState::up_to_date);
  }
  return status;
}

Status Document::commit_regions(vtkDataArray* labels, const QString& step)
{
  if (!this->work_.surface ||
    labels->GetNumberOfTuples() != this->work_.surface->GetNumberOfPoints())
  {
    this->revert_handles();
    return Status::invalid_input("region labels must have one value per vertex of the mesh");
  }
  Work after = this->work_;
  Status status = this->read_edited_handles(after);
  if (status.ok())
  {
    after.surface = vtkSmartPointer<vtkPolyData>::New();
    after.surface->ShallowCopy(this->work_.surface);
    vtkPointData* arrays = after.surface->GetPointData();
    if (arrays->GetArray("Weights") && !arrays->GetArray(bound_labels_name))
    {
      arrays->AddArray(copy_of_labels(labels_of(this->work_.surface), labels, bound_labels_name));
    }
    arrays->AddArray(copy_of_labels(labels, labels, "RegionId"));
    after.differs_from_file = true;
    this->push(step, after, {}, HandleDataState::up_to_date);
  }
  return status;
}

Status Document::rename_handle(int handle, const QString& name)
{
  Q_EMIT this->about_to_change();
  const std::string from = this->handles_[handle].name;
  const std::string to = name.toStdString();
  Status status = edit_handles(this->edited_handles_,
    [&](const Handles& before, EditedHandles& after)
    { return bindpose::rename_handle(before, handle, to, after); });
  Work after = this->work_;
  if (status.ok())
  {
    status = this->read_edited_handles(after);
  }
  if (!status.ok() || from == to)
  {
    return status;
  }
  if (after.stored_poses)
  {
    StoredPoses poses = *after.stored_poses;
    poses.library.rename_handle(from, to);
    poses.keys.rename_handle(from, to);
    after.stored_poses = std::make_shared<const StoredPoses>(std::move(poses));
  }
  this->push(
    tr("rename %1").arg(QString::fromStdString(from)), after, {}, HandleDataState::up_to_date);
  return status;
}

void Document::commit_pose(const QString& step, const QString& merge)
{
  Work after = this->work_;
  after.pose = this->pose();
  this->push(step, after, merge, HandleDataState::up_to_date);
}

void Document::revert_handles()
{
  if (this->work_.handles)
  {
    this->edited_handles_->DeepCopy(this->work_.handles);
    bindpose::set_pose(this->edited_handles_, this->cells_, this->work_.pose);
  }
  else
  {
    this->edited_handles_->Initialize();
  }
  Q_EMIT this->changed(handles_part | pose_part);
}

void Document::set_pose(const Pose& pose, const QString& step, const QString& merge)
{
  Q_EMIT this->about_to_change();
  if (pose.size() == this->handles_.size())
  {
    Work after = this->work_;
    after.pose = pose;
    this->push(step, after, merge);
  }
}

void Document::set_mode(int handle, int mode)
{
  Q_EMIT this->about_to_change();
  Pose after = this->pose();
  after[handle].mode = static_cast<HandleMode>(mode);
  this->set_pose(after, tr("mode of %1").arg(QString::fromStdString(this->handles_[handle].name)));
}

void Document::reset_to_rest()
{
  Q_EMIT this->about_to_change();
  Pose rest(this->handles_.size());
  const Pose before = this->pose();
  for (std::size_t k = 0; k < rest.size(); ++k)
  {
    rest[k].mode = before[k].mode;
  }
  this->set_pose(rest, tr("back to rest"));
}

void Document::set_stored_poses(StoredPoses poses, const QString& step, const QString& merge)
{
  Work after = this->work_;
  after.stored_poses = std::make_shared<const StoredPoses>(std::move(poses));
  this->push(step, after, merge);
}

// ---- Weights -----------------------------------------------------------------------------------

void Document::begin_bind()
{
  this->binding_.surface = this->work_.surface;
  this->binding_.handle_data = this->work_.handles;
  this->binding_.handles = this->handles_;
}

bool Document::set_bound(vtkPolyData* surface, vtkUnstructuredGrid* tets)
{
  this->drop_preview();
  if (!this->binding_.surface || !same_mesh(this->binding_.surface, this->work_.surface))
  {
    return false;
  }
  Work after = this->work_;
  after.surface = surface;
  surface->GetPointData()->RemoveArray(bound_labels_name);
  // Regions may have been painted while the bind was running. Keep both the labels of the bind and
  // the painted labels.
  vtkDataArray* current_labels = labels_of(this->work_.surface);
  if (current_labels && !same_labels(current_labels, labels_of(surface)))
  {
    surface->GetPointData()->AddArray(
      copy_of_labels(labels_of(surface), current_labels, bound_labels_name));
    surface->GetPointData()->AddArray(current_labels);
  }
  after.weighted_tets = tets;
  after.differs_from_file = true;
  after.bound_handles = this->binding_.handle_data;
  this->push(tr("bind"), after);
  return true;
}

bool Document::set_preview(vtkPolyData* surface)
{
  if (!this->binding_.surface || !same_mesh(this->binding_.surface, this->work_.surface))
  {
    return false;
  }
  this->preview_ = surface;
  this->update_columns();
  Q_EMIT this->changed(weights_part);
  return true;
}

void Document::drop_preview()
{
  if (this->preview_)
  {
    this->preview_ = nullptr;
    this->update_columns();
    Q_EMIT this->changed(weights_part);
  }
}

// ---- Options -----------------------------------------------------------------------------------

void Document::set_option(const QString& key, const QVariant& value)
{
  this->set_options({ { key, value } }, key);
}

void Document::set_options(const Options& values, const QString& key)
{
  Work after = this->work_;
  for (auto value = values.begin(); value != values.end(); ++value)
  {
    const OptionInfo* option = find_option(value.key());
    const QVariant checked = option ? checked_option(*option, value.value()) : QVariant();
    if (checked.isValid())
    {
      after.options[value.key()] = checked;
    }
  }
  if (const OptionInfo* step_option = find_option(key))
  {
    const bool is_continuous = step_option->initial.type() == QVariant::Double;
    this->push(tr(step_option->step), after, is_continuous ? key : QString());
  }
}

bool Document::has_step_of(const QString& key) const
{
  for (int i = 0; i < this->history_->count(); ++i)
  {
    if (static_cast<const Edit*>(this->history_->command(i))->changes_option(key))
    {
      return true;
    }
  }
  return false;
}

void Document::set_option_without_undo(const QString& key, const QVariant& value)
{
  const OptionInfo* option = find_option(key);
  const QVariant checked = option ? checked_option(*option, value) : QVariant();
  // Do not store a value that differs from the old value only by round-off. QVariant treats such
  // doubles as equal, and undo uses the same comparison, so undo would not restore the old value.
  if (checked.isValid() && checked != this->work_.options.value(key))
  {
    this->work_.options[key] = checked;
  }
}

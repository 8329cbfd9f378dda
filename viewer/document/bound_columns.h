#ifndef document_bound_columns_h
#define document_bound_columns_h

#include "handles/handles.h"

#include "vtkPointSet.h"
#include "vtkSmartPointer.h"

#include <QString>

#include <string>
#include <vector>

/// Assigns columns of weights to handles, so that the weights stay usable when handles change
/// after a bind:
/// - a handle gets the column of the bound handle with the same name and kind, even if it was
///   moved; a renamed handle gets the column of the bound handle at the same position;
/// - a handle without a column moves nothing;
/// - points that only a removed handle influenced stay at rest.
///
/// Another bind computes the weights of the current handles; reason() states why it is needed.
class BoundColumns
{
public:
  BoundColumns() = default;
  BoundColumns(const bindpose::Handles& bound, const bindpose::Handles& current);

  /// Report whether at least one handle has a column, so that posing is possible.
  bool any() const;
  /// Report whether the current handles are the bound handles in the same order, and no handle was
  /// added, moved or removed. Names may differ.
  bool exact() const { return this->exact_; }
  /// Return one sentence that counts the handles that are new, moved or removed; empty if there are
  /// none.
  QString reason() const;
  /// Return a copy of the dataset in which the columns of weights have the order and the names of
  /// the current handles. Return the dataset itself if exact() is true and the columns already have
  /// these names. If exact() is false, the copy has no optimality certificates.
  vtkSmartPointer<vtkPointSet> reordered(vtkPointSet* data) const;

private:
  std::vector<int> column_of_handle_; // column of each handle; -1: none
  std::vector<std::string> names_;
  int column_count_ = 0;
  int added_count_ = 0;
  int moved_count_ = 0;
  int removed_count_ = 0;
  bool same_names_ = true;
  bool exact_ = false;
};

/// Report whether the weights of a mesh file fit the handles: one column per handle, with equal
/// names if the columns are named. Otherwise set `mismatch` to one sentence.
bool weights_fit(
  vtkDataArray* weights, const bindpose::Handles& handles, QString* mismatch = nullptr);

#endif

#ifndef document_bound_columns_h
#define document_bound_columns_h

#include "weights/handles.h"

#include "vtkPointSet.h"
#include "vtkSmartPointer.h"

#include <QString>

#include <string>
#include <vector>

/// Which column of some weights each handle has. Handles may change after a bind, and the weights
/// stay usable:
/// - a handle has the column of the handle of its name and kind that was bound, or of the one in
///   its place when it was renamed, wherever it has been moved to;
/// - a handle without a column moves nothing;
/// - what a handle that is gone held stays at rest.
/// A bind makes it exact again: reason() says what for.
class BoundColumns
{
public:
  BoundColumns() = default;
  BoundColumns(const bindpose::Handles& bound, const bindpose::Handles& now);

  /// Whether there is a column to pose with.
  bool any() const;
  /// Whether the weights are those of the handles as they are, column by column.
  bool exact() const { return this->exact_; }
  /// One sentence about the handles that have changed; empty when exact.
  QString reason() const;
  /// The dataset with its columns in the order of the handles, named after them; itself when they
  /// are already. Certificates of columns are left out, where columns are.
  vtkSmartPointer<vtkPointSet> arranged(vtkPointSet* data) const;

private:
  std::vector<int> column_of_; // -1: none
  std::vector<std::string> names_;
  int columns_ = 0;
  int new_ = 0;
  int moved_ = 0;
  int gone_ = 0;
  bool same_names_ = true;
  bool exact_ = false;
};

/// Whether these weights, which came with a mesh, are those of the handles: as many, and of the
/// same names where the columns have names. Else a sentence that says what they are for.
bool weights_are_of(
  vtkDataArray* weights, const bindpose::Handles& handles, QString* why_not = nullptr);

#endif

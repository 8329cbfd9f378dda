#ifndef app_posing_handle_fields_h
#define app_posing_handle_fields_h

#include "poses/pose_blend.h"

#include <QWidget>

#include <array>
#include <optional>
#include <vector>

class QDoubleSpinBox;
class QLabel;

namespace app::posing
{

/// Number fields of the selected handle: translation, rotation and scale, and for a bone its
/// stretch and twist.
class HandleFields : public QWidget
{
  Q_OBJECT

public:
  explicit HandleFields(QWidget* parent = nullptr);

  /// Show values, without emitting values_chosen(). A field in which the user is typing is not
  /// changed.
  /// @param handle  null: no handle is selected
  /// @param free  true: the handle is in mode free, so the solver computes its position
  void show_values(const bindpose::Handle* handle, const bindpose::HandleValues& values, bool free);
  /// Show the layer of the selected handle. Where a planar shape overlaps itself, layers determine
  /// which part is in front. If the shape is not planar or no handle is selected, `layer` is empty.
  void show_layer(const std::optional<double>& layer);
  /// Show the number of selected handles, and the name of the handle whose values are displayed.
  /// This text is visible only if several handles are selected.
  void show_count(const QString& name, int count);
  bindpose::HandleValues values() const;
  /// Return a field by its index: 0 to 2 translation along x, y, z; 3 to 5 rotation about x, y, z;
  /// 6 scale; 7 stretch; 8 twist at the head; 9 twist at the tail.
  QDoubleSpinBox* field(int index) const { return this->fields_[static_cast<std::size_t>(index)]; }
  QDoubleSpinBox* layer() const { return this->layer_; }

Q_SIGNALS:
  /// Emitted when the value of a field has changed. The mouse wheel and the arrow keys cause one
  /// signal per increment.
  void values_chosen(int field);
  /// Emitted when an edit is complete: the field has lost the focus, or Enter was pressed.
  void edit_ended();
  void layer_chosen(double layer);

private:
  QLabel* count_;
  std::array<QDoubleSpinBox*, 10> fields_;
  QWidget* bone_rows_;
  QWidget* layer_row_;
  QDoubleSpinBox* layer_;
  QLabel* shear_note_;
  std::vector<QLabel*> names_; ///< labels of the fields that are always visible
};

} // namespace app::posing

#endif

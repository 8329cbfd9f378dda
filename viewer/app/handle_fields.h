#ifndef handle_fields_h
#define handle_fields_h

#include "posing/pose_blend.h"

#include <QWidget>

#include <array>
#include <optional>
#include <vector>

class QDoubleSpinBox;
class QLabel;

/// Number fields of the selected handle: translation, rotation and scale, and for a bone its
/// stretch and twist.
class HandleFields : public QWidget
{
  Q_OBJECT

public:
  explicit HandleFields(QWidget* parent = nullptr);

  /// Show values, without emitting values_chosen(). A field in which the user is typing is
  /// unchanged.
  /// @param handle  null: none is selected
  /// @param free  the solver computes the handle's position
  void show_values(const bindpose::Handle* handle, const bindpose::HandleValues& values, bool free);
  /// Show the layer of a handle in a planar shape. Empty: the shape is not planar, or no handle is
  /// selected.
  void show_layer(const std::optional<double>& layer);
  /// Show the handle to which the values belong, if several handles are selected.
  void show_count(const QString& name, int count);
  bindpose::HandleValues values() const;
  /// Return a field by its index: translate x y z, rotate x y z, scale, stretch, twist at head and
  /// tail.
  QDoubleSpinBox* field(int which) const { return this->fields_[static_cast<std::size_t>(which)]; }
  QDoubleSpinBox* layer() const { return this->layer_; }

Q_SIGNALS:
  /// The value of field(field) has changed. A wheel or an arrow key emits this once per step.
  void values_chosen(int field);
  /// An edit is complete: the field has lost the focus, or Enter was pressed.
  void edit_ended();
  void layer_chosen(double layer);

private:
  QLabel* count_;
  std::array<QDoubleSpinBox*, 10> fields_;
  QWidget* bone_rows_;
  QWidget* layer_row_;
  QDoubleSpinBox* layer_;
  QLabel* more_;
  std::vector<QLabel*> names_; ///< labels of the fields that are always visible
};

#endif

#ifndef handle_fields_h
#define handle_fields_h

#include "posing/pose_blend.h"

#include <QWidget>

#include <array>
#include <optional>
#include <vector>

class QDoubleSpinBox;
class QLabel;

/// Typed values of the selected handle: where it goes, how it turns, its size, and of a bone its
/// stretch and twist.
class HandleFields : public QWidget
{
  Q_OBJECT

public:
  explicit HandleFields(QWidget* parent = nullptr);

  /// Without values_chosen(). A field that is being typed in is left alone.
  /// @param handle  null: none is selected
  /// @param free  its place is for the solver to find
  void show_values(const bindpose::Handle* handle, const bindpose::HandleValues& values, bool free);
  /// Of a shape in a plane; nothing: it is in none, or no handle is selected.
  void show_layer(const std::optional<double>& layer);
  /// Whose values these are, where several handles are selected.
  void show_count(const QString& name, int count);
  bindpose::HandleValues values() const;
  /// translate x y z, rotate x y z, scale, stretch, twist at head and tail.
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
  std::vector<QLabel*> names_; ///< of fields that are always there
};

#endif

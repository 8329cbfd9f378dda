#ifndef app_parts_value_row_h
#define app_parts_value_row_h

#include <QWidget>

class QDoubleSpinBox;
class QSlider;

namespace app::parts
{

/// A row of a slider and a field that show and set a number in a range.
class ValueRow : public QWidget
{
  Q_OBJECT

public:
  explicit ValueRow(QWidget* parent = nullptr);

  void set_range(double lowest, double highest);
  /// Set the value without emitting value_chosen().
  void set_value(double value);
  double value() const;
  /// Let the argument of choose() be a fraction of the range, from 0 to 1, instead of a value.
  void set_option_is_fraction() { this->option_is_fraction_ = true; }
  /// Set the value and emit value_chosen(), as if a user had chosen the value. `option` is the
  /// value or, if set_option_is_fraction() was called, a fraction of the range.
  void choose(double option);
  QSlider* slider() const { return this->slider_; }
  QDoubleSpinBox* field() const { return this->field_; }

Q_SIGNALS:
  /// Emitted when the user has chosen a value.
  void value_chosen(double value);

private:
  QSlider* slider_;
  QDoubleSpinBox* field_;
  bool option_is_fraction_ = false;
};

} // namespace app::parts

#endif

#ifndef value_row_h
#define value_row_h

#include <QWidget>

class QDoubleSpinBox;
class QSlider;

/// A number in a range, shown by a slider and a field.
class ValueRow : public QWidget
{
  Q_OBJECT

public:
  explicit ValueRow(QWidget* parent = nullptr);

  void set_range(double lowest, double highest);
  /// Set the value without emitting value_chosen().
  void set_value(double value);
  double value() const;
  /// Let the row's option store the fraction of the range, from 0 to 1, instead of the number.
  void tell_shares() { this->tells_shares_ = true; }
  /// Choose the value of the option as a user does.
  void choose(double option);
  QSlider* slider() const { return this->slider_; }
  QDoubleSpinBox* field() const { return this->field_; }

Q_SIGNALS:
  /// The user has chosen a value.
  void value_chosen(double value);

private:
  QSlider* slider_;
  QDoubleSpinBox* field_;
  bool tells_shares_ = false;
};

#endif

#ifndef value_row_h
#define value_row_h

#include <QWidget>

class QDoubleSpinBox;
class QSlider;

/// A number in a range: a slider and a field, which show the same.
class ValueRow : public QWidget
{
  Q_OBJECT

public:
  explicit ValueRow(QWidget* parent = nullptr);

  void set_range(double lowest, double highest);
  /// Without value_chosen().
  void set_value(double value);
  double value() const;
  /// The option of its name is how far the number is through the range, from 0 to 1, and not the
  /// number itself.
  void tell_shares() { this->tells_shares_ = true; }
  /// As a person does who wants the option to be this.
  void choose(double option);
  QSlider* slider() const { return this->slider_; }
  QDoubleSpinBox* field() const { return this->field_; }

Q_SIGNALS:
  /// By the user.
  void value_chosen(double value);

private:
  QSlider* slider_;
  QDoubleSpinBox* field_;
  bool tells_shares_ = false;
};

#endif

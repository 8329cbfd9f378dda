#ifndef app_view_section_h
#define app_view_section_h

#include <QWidget>

class QPushButton;
class QVBoxLayout;

namespace app::view
{

/// A heading that users click to show or hide the widgets below it.
class Section : public QWidget
{
  Q_OBJECT

public:
  Section(const QString& title, const QString& tip, bool open, QWidget* parent = nullptr);

  /// Return the layout of the contents.
  QVBoxLayout* column() const { return this->column_; }
  QWidget* body() const { return this->body_; }
  void set_open(bool open);
  bool is_open() const;

private:
  QString title_;
  QPushButton* header_;
  QWidget* body_;
  QVBoxLayout* column_;
};

} // namespace app::view

#endif

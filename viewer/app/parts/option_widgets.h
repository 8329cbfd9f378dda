#ifndef app_parts_option_widgets_h
#define app_parts_option_widgets_h

#include <QStringList>

class QBoxLayout;
class QButtonGroup;
class QComboBox;
class QWidget;

namespace app::parts
{

class ValueRow;

// Functions that create the widget of an option of the document (document/options.h). Labels, range
// and initial value come from the table of options. The object name of the widget is the key of the
// option, so that OptionLinks finds it.

/// Return the labels of an option that has a fixed list of values.
QStringList option_labels(const char* key);
/// Return a combo box for an option that has a fixed list of values.
QComboBox* option_box(const char* key, QWidget* parent);
/// Add a row of buttons for an option that has a fixed list of values, one button per value.
/// Exactly one button is pressed. Ids count from 0.
QButtonGroup* option_segments(
  QBoxLayout* column, QWidget* parent, const char* key, const QStringList& tips);
/// Add a row of four buttons for the orientation of a plane. The ids of the buttons are
/// values of PlaneHandle::Orientation.
QButtonGroup* orientation_segments(QBoxLayout* column, QWidget* parent, const char* key);
/// Return a row of a slider and a field for a number.
ValueRow* option_row(const char* key, QWidget* parent);

} // namespace app::parts

#endif

#include "app/parts/option_widgets.h"

#include "app/parts/panel_parts.h"
#include "app/parts/value_row.h"
#include "document/options.h"

#include <QAbstractButton>
#include <QButtonGroup>
#include <QComboBox>
#include <QCoreApplication>

namespace app::parts
{

QStringList option_labels(const char* key)
{
  QStringList labels;
  for (const OptionChoice& choice : find_option(key)->choices)
  {
    labels << QCoreApplication::translate("Document", choice.label);
  }
  return labels;
}

QComboBox* option_box(const char* key, QWidget* parent)
{
  auto* box = new QComboBox(parent);
  box->setObjectName(key);
  box->addItems(option_labels(key));
  box->setCurrentIndex(find_option(key)->initial.toInt());
  return box;
}

QButtonGroup* option_segments(
  QBoxLayout* column, QWidget* parent, const char* key, const QStringList& tips)
{
  QButtonGroup* group = add_segments(column, parent, option_labels(key), tips);
  group->setObjectName(key);
  group->button(find_option(key)->initial.toInt())->setChecked(true);
  return group;
}

QButtonGroup* orientation_segments(QBoxLayout* column, QWidget* parent, const char* key)
{
  const auto translated = [](const char* text)
  { return QCoreApplication::translate("Panel", text); };
  QButtonGroup* group = option_segments(column, parent, key,
    { translated(QT_TRANSLATE_NOOP("Panel", "Perpendicular to the x axis")),
      translated(QT_TRANSLATE_NOOP("Panel", "Perpendicular to the y axis")),
      translated(QT_TRANSLATE_NOOP("Panel", "Perpendicular to the z axis")),
      translated(
        QT_TRANSLATE_NOOP("Panel", "Any orientation; drag the arrow of the plane to rotate it")) });
  // Draw one line between the second and the third of the four buttons: remove the right border of
  // the second button, because the third button has a left border.
  group->button(1)->setProperty("place", "second");
  return group;
}

ValueRow* option_row(const char* key, QWidget* parent)
{
  const OptionInfo& option = *find_option(key);
  auto* row = new ValueRow(parent);
  row->setObjectName(key);
  row->set_range(option.lowest, option.highest);
  row->set_value(option.initial.toDouble());
  return row;
}

} // namespace app::parts

#include "app/parts/panel_parts.h"

#include <QBoxLayout>
#include <QButtonGroup>
#include <QComboBox>
#include <QCoreApplication>
#include <QLabel>
#include <QPushButton>
#include <QStandardItemModel>
#include <QStringList>
#include <QVariant>

namespace app::parts
{

QLabel* heading(const QString& text, QWidget* parent)
{
  auto* label = new QLabel(text, parent);
  label->setObjectName("heading");
  return label;
}

QPushButton* button(const QString& text, QWidget* parent)
{
  auto* result = new QPushButton(text, parent);
  result->setFocusPolicy(Qt::TabFocus);
  return result;
}

QButtonGroup* add_segments(
  QBoxLayout* column, QWidget* parent, const QStringList& names, const QStringList& tips)
{
  auto* group = new QButtonGroup(parent);
  auto* row = new QHBoxLayout;
  row->setSpacing(0);
  for (int k = 0; k < names.size(); ++k)
  {
    QPushButton* segment = button(names[k], parent);
    segment->setObjectName("segment");
    segment->setProperty("place", k == 0 ? "first" : k + 1 == names.size() ? "last" : "middle");
    segment->setCheckable(true);
    segment->setToolTip(tips[k]);
    group->addButton(segment, k);
    row->addWidget(segment, 1);
  }
  group->button(0)->setChecked(true);
  column->addLayout(row);
  return group;
}

void enable_all_but(QComboBox* list, int item, const QString& reason)
{
  auto* items = qobject_cast<QStandardItemModel*>(list->model());
  for (int k = 0; k < list->count(); ++k)
  {
    items->item(k)->setEnabled(k != item);
    items->item(k)->setToolTip(k == item ? reason : QString());
  }
}

QString capitalized(const QString& text)
{
  return text.left(1).toUpper() + text.mid(1);
}

QString shortened(const QString& text, int maximum_length)
{
  return text.size() <= maximum_length
    ? text
    : text.left(maximum_length / 2) + QStringLiteral("…") + text.right(maximum_length / 2);
}

QString progress_note(double fraction, const QString& phase)
{
  return QCoreApplication::translate("Panel", "%1, %2 %")
    .arg(phase_description(phase))
    .arg(static_cast<int>(100.0 * fraction));
}

QString phase_description(const QString& phase)
{
  static const struct
  {
    const char* phases;
    const char* message;
  } table[] = {
    { "repair", QT_TRANSLATE_NOOP("Panel", "Checking the surface") },
    { "winding", QT_TRANSLATE_NOOP("Panel", "Finding the inside") },
    { "build evaluate", QT_TRANSLATE_NOOP("Panel", "Computing winding numbers") },
    { "tetrahedralize cdt refine tetgen label fill improve remesh distance wrap ftetwild "
      "lattice sample samples connect parts cut check",
      QT_TRANSLATE_NOOP("Panel", "Filling the inside with tets") },
    { "insert", QT_TRANSLATE_NOOP("Panel", "Placing the handles") },
    { "analyze guide weights", QT_TRANSLATE_NOOP("Panel", "Solving for the weights") },
    { "transfer", QT_TRANSLATE_NOOP("Panel", "Transferring the weights to the surface") },
  };
  for (const auto& row : table)
  {
    if (QString(row.phases).split(' ').contains(phase))
    {
      return QCoreApplication::translate("Panel", row.message);
    }
  }
  return phase;
}

} // namespace app::parts

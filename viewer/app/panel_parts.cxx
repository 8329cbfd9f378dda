#include "panel_parts.h"

#include <QBoxLayout>
#include <QButtonGroup>
#include <QCoreApplication>
#include <QLabel>
#include <QPushButton>
#include <QStringList>
#include <QVariant>

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

QButtonGroup* add_orientations(QBoxLayout* column, QWidget* parent)
{
  static const struct
  {
    const char* name;
    const char* tip;
    const char* place;
  } segments[] = {
    { QT_TRANSLATE_NOOP("Panel", "X"), QT_TRANSLATE_NOOP("Panel", "Perpendicular to the x axis"),
      "first" },
    { QT_TRANSLATE_NOOP("Panel", "Y"), QT_TRANSLATE_NOOP("Panel", "Perpendicular to the y axis"),
      "second" },
    { QT_TRANSLATE_NOOP("Panel", "Z"), QT_TRANSLATE_NOOP("Panel", "Perpendicular to the z axis"),
      "middle" },
    { QT_TRANSLATE_NOOP("Panel", "Free"), QT_TRANSLATE_NOOP("Panel", "Turned by its arrow"),
      "last" },
  };
  auto* group = new QButtonGroup(parent);
  auto* row = new QHBoxLayout;
  row->setSpacing(0);
  int id = 0;
  for (const auto& segment : segments)
  {
    QPushButton* its = button(QCoreApplication::translate("Panel", segment.name), parent);
    its->setObjectName("segment");
    its->setProperty("place", segment.place);
    its->setCheckable(true);
    its->setToolTip(QCoreApplication::translate("Panel", segment.tip));
    group->addButton(its, id++);
    row->addWidget(its, 1);
  }
  group->button(2)->setChecked(true);
  column->addLayout(row);
  return group;
}

QString sentence_of(const QString& phase)
{
  static const struct
  {
    const char* phases;
    const char* sentence;
  } table[] = {
    { "repair", QT_TRANSLATE_NOOP("Panel", "Looking at the surface") },
    { "winding", QT_TRANSLATE_NOOP("Panel", "Finding the inside") },
    { "tetrahedralize cdt refine tetgen label fill improve remesh distance wrap ftetwild "
      "lattice sample samples connect parts cut check",
      QT_TRANSLATE_NOOP("Panel", "Filling it with tets") },
    { "insert", QT_TRANSLATE_NOOP("Panel", "Placing the handles") },
    { "analyse guide weights", QT_TRANSLATE_NOOP("Panel", "Solving for the weights") },
    { "transfer", QT_TRANSLATE_NOOP("Panel", "Taking the weights to the surface") },
  };
  for (const auto& row : table)
  {
    if (QString(row.phases).split(' ').contains(phase))
    {
      return QCoreApplication::translate("Panel", row.sentence);
    }
  }
  return phase;
}

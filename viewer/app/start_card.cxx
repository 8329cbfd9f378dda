#include "start_card.h"

#include "panel_parts.h"

#include <QAction>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

StartCard::StartCard(QAction* auto_rig, QWidget* parent) : QFrame(parent)
{
  this->setObjectName("nothing");
  auto* column = new QVBoxLayout(this);
  column->setSpacing(8);
  QPushButton* rig = button(tr("Auto-rig"), this);
  rig->setObjectName("primary");
  rig->setToolTip(auto_rig->toolTip());
  rig->setEnabled(auto_rig->isEnabled());
  QObject::connect(rig, &QPushButton::clicked, auto_rig, &QAction::trigger);
  QObject::connect(
    auto_rig, &QAction::changed, rig, [auto_rig, rig] { rig->setEnabled(auto_rig->isEnabled()); });
  column->addWidget(rig, 0, Qt::AlignHCenter);
  auto* text = new QLabel(tr("makes bones along the shape and binds it, ready to drag.<br>"
                             "<b>By hand:</b> press A to add points, B bones, C a cage,<br>"
                             "P to paint regions, or open a file of handles. ? shows all keys."),
    this);
  text->setAlignment(Qt::AlignCenter);
  column->addWidget(text);
}

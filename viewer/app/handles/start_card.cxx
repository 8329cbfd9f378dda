#include "app/handles/start_card.h"

#include "app/parts/panel_parts.h"

#include <QAction>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

namespace app::handles
{

StartCard::StartCard(QAction* auto_rig, QWidget* parent) : QFrame(parent)
{
  this->setObjectName("nothing");
  auto* row = new QHBoxLayout(this); // a single row, so that the card covers little of the shape
  row->setSpacing(12);
  QPushButton* rig = parts::button(tr("Auto-rig"), this);
  rig->setObjectName("primary");
  rig->setToolTip(auto_rig->toolTip());
  rig->setEnabled(auto_rig->isEnabled());
  QObject::connect(rig, &QPushButton::clicked, auto_rig, &QAction::trigger);
  QObject::connect(
    auto_rig, &QAction::changed, rig, [auto_rig, rig] { rig->setEnabled(auto_rig->isEnabled()); });
  row->addWidget(rig);
  row->addWidget(new QLabel(tr("makes bones along the shape and binds it.<br>"
                               "<b>Or add:</b> points (A), bones (B), cage (C), regions (P)"),
    this));
}

} // namespace app::handles

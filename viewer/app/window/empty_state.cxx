#include "app/window/empty_state.h"

#include "app/parts/panel_parts.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace app::window
{

EmptyState::EmptyState(QWidget* parent) : QWidget(parent)
{
  this->setObjectName("empty");
  auto* column = new QVBoxLayout(this);
  column->addStretch(1);
  auto* title = new QLabel(tr("<p style='font-size:15pt'>Open a mesh, or drop one here</p>"), this);
  title->setAlignment(Qt::AlignCenter);
  column->addWidget(title);
  QPushButton* open = parts::button(tr("Open and auto-rig…"), this);
  open->setObjectName("primary");
  open->setToolTip(tr("Open a mesh, create bones along it and bind it"));
  QObject::connect(open, &QPushButton::clicked, this, &EmptyState::open_and_rig_requested);
  column->addWidget(open, 0, Qt::AlignHCenter);
  auto* text =
    new QLabel(tr("<p>Or add handles or open a handle file (.tgf or .vtp), then bind and drag.</p>"
                  "<p>A volume of winding numbers (.vti) is shown as a slice.</p>"),
      this);
  text->setAlignment(Qt::AlignCenter);
  text->setWordWrap(true);
  column->addWidget(text);
  column->addStretch(1);
}

} // namespace app::window

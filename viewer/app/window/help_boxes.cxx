#include "app/window/help_boxes.h"

#include <QMessageBox>

namespace app::window
{

void show_about(QWidget* window)
{
  QMessageBox::about(window, QObject::tr("About Bindpose"),
    QObject::tr(
      "<b>Bindpose %1</b><p>Bind any triangle mesh to handles and bend it in real time.</p>"
      "<p>The code of Bindpose is under the BSD 3-clause license.</p>")
      .arg(BINDPOSE_VERSION));
}

} // namespace app::window

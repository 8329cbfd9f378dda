#include "help_boxes.h"

#include <QMessageBox>

void show_about(QWidget* window)
{
  QMessageBox::about(window, QObject::tr("About Bindpose"),
    QObject::tr("<b>Bindpose %1</b>"
                "<p>Any triangle mesh to a shape that a person bends in real time.</p>"
                "<p>Own code under the BSD 3-clause license.</p>")
      .arg(BINDPOSE_VERSION));
}

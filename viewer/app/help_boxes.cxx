#include "help_boxes.h"

#include <QMessageBox>

void show_mouse_and_keys(QWidget* window)
{
  QMessageBox box(QMessageBox::NoIcon, QObject::tr("Mouse and keys"),
    QObject::tr(
      "<table cellspacing='6'>"
      "<tr><td><b>Drag a handle</b></td><td>moves it; a bone's tip turns the bone</td></tr>"
      "<tr><td><b>Esc</b> while dragging</td><td>takes the drag back</td></tr>"
      "<tr><td><b>Drag a slice or cut</b></td><td>moves it; its arrow, when free, turns "
      "it</td></tr>"
      "<tr><td><b>Drag elsewhere</b></td><td>turns the view</td></tr>"
      "<tr><td><b>Shift-drag, wheel</b></td><td>moves the view, zooms</td></tr>"
      "<tr><td><b>1 … 7</b></td><td>way to pose: linear, dual quaternions, reduced ARAP, "
      "stretchable&nbsp;bones, centers of rotation, full ARAP, smooth surface</td></tr>"
      "<tr><td><b>R</b></td><td>the shape at rest, and back to the pose</td></tr>"
      "<tr><td><b>K, space</b></td><td>sets a key frame, plays or pauses</td></tr>"
      "<tr><td><b>Ctrl+B</b></td><td>binds</td></tr>"
      "<tr><td><b>Ctrl+R</b></td><td>takes all handles back to rest</td></tr>"
      "<tr><td><b>Ctrl+Z, Ctrl+Y</b></td><td>undoes, redoes</td></tr>"
      "<tr><td><b>Home</b></td><td>shows the whole shape</td></tr></table>"),
    QMessageBox::Close, window);
  box.exec();
}

void show_about(QWidget* window)
{
  QMessageBox::about(window, QObject::tr("About Bindpose"),
    QObject::tr("<b>Bindpose %1</b>"
                "<p>Any triangle mesh to a shape that a person bends in real time.</p>"
                "<p>Own code under the BSD 3-clause licence.</p>")
      .arg(BINDPOSE_VERSION));
}

// Draws the icons of tools. Every icon consists of strokes in a square of 20 by 20 units.
#include "app/parts/tool_icons.h"

#include "app/parts/style.h"

#include <QPainter>
#include <QPainterPath>
#include <QPixmap>

#include <cmath>
#include <cstring>
#include <map>
#include <string>

namespace app::parts
{

namespace
{
constexpr double icon_units = 20.0;

/// Draw a line with an arrowhead at its end.
void arrow(QPainter& painter, const QPointF& from, const QPointF& to)
{
  painter.drawLine(from, to);
  const QPointF offset = to - from;
  const QPointF direction = offset / std::hypot(offset.x(), offset.y());
  const QPointF normal(-direction.y(), direction.x());
  painter.drawPolyline(
    QPolygonF({ to - 3.2 * direction + 2.6 * normal, to, to - 3.2 * direction - 2.6 * normal }));
}

void dot(QPainter& painter, const QPointF& center, double radius)
{
  painter.save();
  painter.setBrush(painter.pen().color());
  painter.setPen(Qt::NoPen);
  painter.drawEllipse(center, radius, radius);
  painter.restore();
}

void plus(QPainter& painter, const QPointF& center)
{
  painter.drawLine(center - QPointF(2.8, 0), center + QPointF(2.8, 0));
  painter.drawLine(center - QPointF(0, 2.8), center + QPointF(0, 2.8));
}

void ring(QPainter& painter, const QRectF& rectangle)
{
  painter.drawArc(rectangle, 60 * 16, 285 * 16);
  const QPointF end(rectangle.center().x() + 0.5 * rectangle.width() * std::cos(1.047),
    rectangle.center().y() - 0.5 * rectangle.height() * std::sin(1.047));
  painter.drawPolyline(QPolygonF({ end + QPointF(-0.2, -3.4), end, end + QPointF(-3.5, 0.6) }));
}

void box(QPainter& painter, const QPointF& center, double half)
{
  painter.drawRect(QRectF(center.x() - half, center.y() - half, 2.0 * half, 2.0 * half));
}

void draw_none(QPainter& painter)
{
  QPainterPath pointer(QPointF(5.5, 2.5));
  for (const QPointF& corner : { QPointF(5.5, 15.5), QPointF(8.8, 12.6), QPointF(11, 17.5),
         QPointF(13.2, 16.5), QPointF(11, 11.8), QPointF(15, 11.5) })
  {
    pointer.lineTo(corner);
  }
  pointer.closeSubpath();
  painter.drawPath(pointer);
}

void draw_move(QPainter& painter)
{
  for (const QPointF& end : { QPointF(10, 2), QPointF(10, 18), QPointF(2, 10), QPointF(18, 10) })
  {
    arrow(painter, { 10, 10 }, end);
  }
}

void draw_turn(QPainter& painter)
{
  ring(painter, { 3.5, 3.5, 13, 13 });
  dot(painter, { 10, 10 }, 1.5);
}

void draw_scale(QPainter& painter)
{
  box(painter, { 6, 14 }, 3);
  painter.drawLine(QPointF(9.5, 10.5), QPointF(15, 5));
  box(painter, { 15.5, 4.5 }, 1.6);
}

void draw_all(QPainter& painter)
{
  ring(painter, { 4.5, 4.5, 13, 13 });
  arrow(painter, { 3, 17 }, { 11, 9 });
  box(painter, { 3.4, 16.6 }, 1.2);
}

void draw_local(QPainter& painter)
{
  arrow(painter, { 6, 14.5 }, { 3.5, 4 });
  arrow(painter, { 6, 14.5 }, { 16.5, 12 });
  dot(painter, { 6, 14.5 }, 1.6);
}

void draw_rest(QPainter& painter)
{
  QPen dashed = painter.pen();
  dashed.setDashPattern({ 1.6, 1.6 });
  const QPen pen = painter.pen();
  painter.setPen(dashed);
  painter.drawEllipse(QPointF(5.5, 14.5), 3.2, 3.2);
  painter.setPen(pen);
  painter.drawLine(QPointF(8, 12), QPointF(11.5, 8.5));
  dot(painter, { 14, 6 }, 3.4);
}

void draw_points(QPainter& painter)
{
  dot(painter, { 7.5, 12 }, 4.2);
  plus(painter, { 15.2, 5.2 });
}

void draw_bones(QPainter& painter)
{
  painter.drawPolygon(QPolygonF({ { 3, 17 }, { 5, 11.5 }, { 13, 7 }, { 8.5, 15 } }));
  painter.drawLine(QPointF(5, 11.5), QPointF(8.5, 15));
  plus(painter, { 15.8, 4.8 });
}

void draw_cage(QPainter& painter)
{
  const QPolygonF corners({ { 4, 7 }, { 11, 4.5 }, { 16.5, 9.5 }, { 13, 16 }, { 5.5, 15 } });
  painter.drawPolygon(corners);
  for (const QPointF& corner : corners)
  {
    dot(painter, corner, 1.9);
  }
}

void draw_regions(QPainter& painter)
{
  painter.drawLine(QPointF(17, 3), QPointF(11, 9.6));
  QPainterPath brush(QPointF(11.8, 11));
  brush.cubicTo({ 11, 16 }, { 6.5, 17.5 }, { 2.8, 16.4 });
  brush.cubicTo({ 6, 15 }, { 5, 10 }, { 9.4, 8.6 });
  brush.closeSubpath();
  painter.setBrush(painter.pen().color());
  painter.drawPath(brush);
}

void draw_pose(QPainter& painter)
{
  dot(painter, { 10, 4.2 }, 2.2);
  painter.drawPolyline(QPolygonF({ { 3.5, 6 }, { 10, 9 }, { 16.5, 6.5 } }));
  painter.drawLine(QPointF(10, 8), QPointF(10, 12.5));
  painter.drawPolyline(QPolygonF({ { 5.5, 18 }, { 10, 12.5 }, { 15, 17.5 } }));
}

/// Draw a stick figure and, to its upper right, a spark (a plus sign).
void draw_auto_rig(QPainter& painter)
{
  dot(painter, { 8, 4.5 }, 1.9);
  painter.drawPolyline(QPolygonF({ { 2.5, 8.5 }, { 8, 8.5 }, { 13.5, 8.5 } }));
  painter.drawLine(QPointF(8, 6), QPointF(8, 12.5));
  painter.drawPolyline(QPolygonF({ { 4, 18 }, { 8, 12.5 }, { 12, 18 } }));
  painter.drawLine(QPointF(16, 1.5), QPointF(16, 6.5));
  painter.drawLine(QPointF(13.5, 4), QPointF(18.5, 4));
}

QPixmap render_icon(void (*draw)(QPainter&), const QColor& color, int scale)
{
  QPixmap pixmap(static_cast<int>(icon_units) * scale, static_cast<int>(icon_units) * scale);
  pixmap.setDevicePixelRatio(scale);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(color, 1.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  draw(painter);
  return pixmap;
}
} // namespace

QIcon tool_icon(const char* action)
{
  static const std::map<std::string, void (*)(QPainter&)> draw_functions = { { "gizmo.none",
                                                                               draw_none },
    { "gizmo.move", draw_move }, { "gizmo.turn", draw_turn }, { "gizmo.scale", draw_scale },
    { "gizmo.all", draw_all }, { "gizmo.local", draw_local }, { "mode.pose", draw_pose },
    { "mode.rest", draw_rest }, { "mode.points", draw_points }, { "mode.bones", draw_bones },
    { "mode.cage", draw_cage }, { "mode.regions", draw_regions }, { "auto_rig", draw_auto_rig } };
  QIcon icon;
  const auto drawing = draw_functions.find(action);
  for (int scale = 1; drawing != draw_functions.end() && scale <= 3; ++scale)
  {
    icon.addPixmap(
      render_icon(drawing->second, theme_color("ink"), scale), QIcon::Normal, QIcon::Off);
    icon.addPixmap(
      render_icon(drawing->second, theme_color("on_accent"), scale), QIcon::Normal, QIcon::On);
    icon.addPixmap(
      render_icon(drawing->second, theme_color("off"), scale), QIcon::Disabled, QIcon::Off);
    icon.addPixmap(render_icon(drawing->second, theme_color("accent_off_ink"), scale),
      QIcon::Disabled, QIcon::On);
  }
  return icon;
}

} // namespace app::parts

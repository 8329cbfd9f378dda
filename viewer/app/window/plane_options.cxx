#include "app/window/plane_options.h"

#include "app/view/plane_handle.h"
#include "app/window/option_links.h"
#include "document/document.h"

namespace app::window
{

using bindpose::Vec3;

void link_plane(
  OptionLinks* links, Document* document, const QString& name, view::PlaneHandle* plane)
{
  const QString position_key = name + ".place";
  const QString normal_key = name + ".normal";
  // During a drag, the getters return the values from before the drag, because a session that is
  // saved meanwhile must not contain intermediate values.
  links->link_option(
    position_key, [plane] { return plane->relative_position_before_drag(); },
    [plane](const QVariant& value) { plane->set_relative_position(value.toDouble()); });
  links->link_option(
    normal_key,
    [plane]
    {
      const Vec3 direction = plane->free_normal_before_drag();
      return QVariantList{ direction.x(), direction.y(), direction.z() };
    },
    [plane](const QVariant& value)
    {
      const QVariantList list = value.toList();
      plane->set_free_normal({ list[0].toDouble(), list[1].toDouble(), list[2].toDouble() });
    });
  // Undo these options together: choosing an axis changes the normal of the free plane, and
  // rotating the plane changes its relative position.
  links->group_options({ name + ".orientation", position_key, normal_key });
  QObject::connect(plane, &view::PlaneHandle::dragged, links,
    [links, document, position_key, normal_key](bool turned)
    {
      document->end_merge();
      links->chosen(turned ? normal_key : position_key);
      document->end_merge();
    });
  QObject::connect(document, &Document::about_to_change, plane, &view::PlaneHandle::cancel);
}

} // namespace app::window

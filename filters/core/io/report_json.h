#ifndef bindpose_io_report_json_h
#define bindpose_io_report_json_h

#include "base/status.h"

namespace bindpose
{

/// Return the report as a JSON object. "a.b" becomes {"a": {"b": …}}. The columns "h[].x", "h[].y"
/// become the list h of objects {"x": …, "y": …}. A bare "h[]" becomes the list of its values.
/// Numbers that are not finite are omitted, because JSON cannot represent them.
std::string to_json(const Report& report, int indent = 2);

} // namespace bindpose

#endif

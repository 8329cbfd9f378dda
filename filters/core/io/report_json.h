#ifndef bindpose_io_report_json_h
#define bindpose_io_report_json_h

#include "base/status.h"

namespace bindpose
{

/// Return the report as a JSON object. The key "a.b" becomes {"a": {"b": …}}. The keys "h[].x" and
/// "h[].y" become the list h of objects {"x": …, "y": …}. The key "h[]" becomes the list of its
/// values. JSON cannot represent numbers that are not finite: they are omitted, or null in a list
/// of values.
std::string to_json(const Report& report, int indent = 2);

} // namespace bindpose

#endif

#ifndef bindpose_io_report_json_h
#define bindpose_io_report_json_h

#include "base/status.h"

namespace bindpose
{

/// The report as a JSON object: "a.b" becomes {"a": {"b": …}}, the columns "h[].x", "h[].y" become
/// the list h of objects {"x": …, "y": …}, a bare "h[]" the list of its values. Numbers that are
/// not finite, which JSON cannot say, are left out.
std::string to_json(const Report& report, int indent = 2);

} // namespace bindpose

#endif

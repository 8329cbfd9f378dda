#ifndef tour_values_h
#define tour_values_h

#include <nlohmann/json.hpp>

class MainWindow;

namespace bindpose
{

/// What the window shows, in numbers and words by name: what a tour checks and writes beside its
/// pictures. Names and meanings are told in viewer/sessions_and_tours.md; what does not apply is
/// absent.
nlohmann::ordered_json tour_values(MainWindow* window);

/// The distance between two values: the largest of any component; of words 0 or infinite; infinite,
/// too, for values of different kinds.
double distance(const nlohmann::ordered_json& a, const nlohmann::ordered_json& b);

/// Seconds since this process was started; below 0 where that is not known.
double seconds_since_start();
/// Of all threads of this process, or of the one that calls.
double cpu_seconds();
double own_cpu_seconds();

} // namespace bindpose

#endif

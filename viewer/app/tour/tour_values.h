#ifndef app_tour_tour_values_h
#define app_tour_tour_values_h

#include <nlohmann/json.hpp>

namespace app::window
{
class MainWindow;
} // namespace app::window

namespace app::tour
{

/// Return the state that the window shows, as numbers and words with names. A tour compares these
/// values with expected values, and writes them together with its screenshots.
/// viewer/sessions_and_tours.md documents the names. Values that do not apply are absent.
nlohmann::ordered_json tour_values(window::MainWindow* window);

/// Return the distance between two values. For numbers it is the largest absolute difference of a
/// component. For strings it is 0 if they are equal, otherwise infinite. For values of different
/// types it is infinite.
double distance(const nlohmann::ordered_json& a, const nlohmann::ordered_json& b);

/// Return the seconds since this process was started; negative if unknown.
double seconds_since_start();
/// Return the CPU seconds of all threads of this process, or of the calling thread only.
double cpu_seconds();
double thread_cpu_seconds();

} // namespace app::tour

#endif

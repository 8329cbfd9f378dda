#ifndef bindpose_base_constants_h
#define bindpose_base_constants_h

#include <limits>

namespace bindpose
{

constexpr double pi = 3.14159265358979323846;
constexpr double two_pi = 2.0 * pi;
constexpr double four_pi = 4.0 * pi; ///< solid angle of the full sphere
constexpr double infinite = std::numeric_limits<double>::infinity();

} // namespace bindpose

#endif

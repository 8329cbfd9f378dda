#include "pose/pose.h"

namespace bindpose
{

const char* to_string(HandleMode mode)
{
  switch (mode)
  {
    case HandleMode::position:
      return "position";
    case HandleMode::free:
      return "free";
    case HandleMode::full:
      break;
  }
  return "full";
}

} // namespace bindpose

#include "check_tga.h"

#include "io/text_scanner.h"

#include <cstddef>

namespace bindpose
{

Status check_tga(const std::string& path)
{
  std::string bytes;
  const Status status = read_file(path, bytes);
  if (!status.ok())
  {
    return status;
  }
  constexpr std::size_t header_size = 18;
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(bytes[at]); };
  const auto word = [&](std::size_t at) { return byte(at) + 256U * byte(at + 1); };
  const Status truncated = Status::invalid_input("the file is truncated");
  if (bytes.size() < header_size)
  {
    return truncated;
  }
  const int type = byte(2);
  const std::size_t pixel_size = byte(16) / 8U;
  const bool has_runs = type == 10;
  if ((type != 2 && !has_runs) || byte(1) != 0 || (byte(16) != 24 && byte(16) != 32))
  {
    return Status::invalid_input("the TGA type is not supported; expected colors with 24 or 32 "
                                 "bits, uncompressed or run-length encoded");
  }
  constexpr unsigned int largest_side = 32767;
  if (word(12) < 1 || word(12) > largest_side || word(14) < 1 || word(14) > largest_side)
  {
    return Status::invalid_input("the picture has " + std::to_string(word(12)) + " x " +
      std::to_string(word(14)) + " pixels; expected 1 to 32767 in each direction");
  }
  std::size_t missing = std::size_t(word(12)) * word(14);
  std::size_t at = header_size + byte(0);
  if (!has_runs)
  {
    return at + missing * pixel_size <= bytes.size() ? Status() : truncated;
  }
  while (missing > 0)
  {
    if (at >= bytes.size())
    {
      return truncated;
    }
    const bool is_run = byte(at) >= 128; // one pixel that is repeated
    const std::size_t count = (byte(at) & 127U) + 1U;
    at += 1 + (is_run ? 1 : count) * pixel_size;
    if (at > bytes.size())
    {
      return truncated;
    }
    if (count > missing)
    {
      return Status::invalid_input("the file has more pixels than its header states");
    }
    missing -= count;
  }
  return {};
}

} // namespace bindpose

// The binary format of MesherData (see mesher_format.h): 8 bytes magic, five 64-bit array lengths,
// the arrays in the order of the struct and in the machine's byte order, and the magic again, so
// that a truncated file is detected.
#include "helper/mesher_format.h"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>

#include <unistd.h>

namespace bindpose
{

namespace
{
constexpr std::array<char, 8> magic{ 'B', 'P', 'M', 'E', 'S', 'H', '0', '3' };

bool write_all(int file, const void* data, std::size_t size)
{
  const char* next_byte = static_cast<const char*>(data);
  while (size > 0)
  {
    const ssize_t written = ::write(file, next_byte, size);
    if (written < 0 && errno == EINTR)
    {
      continue;
    }
    if (written <= 0)
    {
      return false;
    }
    next_byte += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

bool read_all(int file, std::vector<char>& bytes)
{
  constexpr std::size_t block = std::size_t(1) << 20;
  std::size_t size = 0;
  for (;;)
  {
    bytes.resize(size + block);
    const ssize_t byte_count = ::read(file, bytes.data() + size, block);
    if (byte_count < 0 && errno == EINTR)
    {
      continue;
    }
    if (byte_count < 0)
    {
      return false;
    }
    size += static_cast<std::size_t>(byte_count);
    if (byte_count == 0)
    {
      bytes.resize(size);
      return true;
    }
  }
}

bool ids_in_range(const Index* ids, Index count, Index vertices)
{
  for (Index k = 0; k < count; ++k)
  {
    if (ids[k] < 0 || ids[k] >= vertices)
    {
      return false;
    }
  }
  return true;
}
} // namespace

bool write_mesher_data(int file, const MesherData& data)
{
  const std::array<Index, 5> counts{ data.points.rows(), data.triangles.rows(), data.tets.rows(),
    static_cast<Index>(data.regions.size()), data.segments.rows() };
  return write_all(file, magic.data(), magic.size()) &&
    write_all(file, counts.data(), sizeof(counts)) &&
    write_all(file, data.points.data(), sizeof(double) * data.points.size()) &&
    write_all(file, data.triangles.data(), sizeof(Index) * data.triangles.size()) &&
    write_all(file, data.tets.data(), sizeof(Index) * data.tets.size()) &&
    write_all(file, data.regions.data(), sizeof(Index) * data.regions.size()) &&
    write_all(file, data.segments.data(), sizeof(Index) * data.segments.size()) &&
    write_all(file, magic.data(), magic.size());
}

bool read_mesher_data(int file, MesherData& data)
{
  data = MesherData();
  std::vector<char> bytes;
  std::array<Index, 5> counts{};
  if (!read_all(file, bytes) || bytes.size() < 2 * magic.size() + sizeof(counts) ||
    std::memcmp(bytes.data(), magic.data(), magic.size()) != 0)
  {
    return false;
  }
  std::memcpy(counts.data(), bytes.data() + magic.size(), sizeof(counts));
  constexpr std::array<std::size_t, 5> sizes{ 24, 24, 32, 8, 16 };
  std::size_t expected = 2 * magic.size() + sizeof(counts);
  for (std::size_t k = 0; k < counts.size(); ++k)
  {
    // Divide instead of multiplying, because the product could overflow.
    if (counts[k] < 0 || static_cast<std::size_t>(counts[k]) > bytes.size() / sizes[k])
    {
      return false;
    }
    expected += static_cast<std::size_t>(counts[k]) * sizes[k];
  }
  if (expected != bytes.size() ||
    std::memcmp(bytes.data() + bytes.size() - magic.size(), magic.data(), magic.size()) != 0)
  {
    return false;
  }
  const char* next_byte = bytes.data() + magic.size() + sizeof(counts);
  const auto read_array = [&](void* to, std::size_t size)
  {
    if (size > 0)
    {
      std::memcpy(to, next_byte, size);
    }
    next_byte += size;
  };
  data.points.resize(counts[0], 3);
  data.triangles.resize(counts[1], 3);
  data.tets.resize(counts[2], 4);
  data.regions.resize(static_cast<std::size_t>(counts[3]));
  data.segments.resize(counts[4], 2);
  read_array(data.points.data(), sizeof(double) * data.points.size());
  read_array(data.triangles.data(), sizeof(Index) * data.triangles.size());
  read_array(data.tets.data(), sizeof(Index) * data.tets.size());
  read_array(data.regions.data(), sizeof(Index) * data.regions.size());
  read_array(data.segments.data(), sizeof(Index) * data.segments.size());
  return data.points.allFinite() &&
    ids_in_range(data.triangles.data(), data.triangles.size(), counts[0]) &&
    ids_in_range(data.tets.data(), data.tets.size(), counts[0]) &&
    ids_in_range(data.segments.data(), data.segments.size(), counts[0]) &&
    (counts[3] == 0 || counts[3] == counts[2]);
}

} // namespace bindpose

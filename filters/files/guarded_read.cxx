// Files are read by the helper executable bindpose-reader. The headers of .vti and legacy .vtk
// files are parsed in this process.
#include "guarded_read.h"

#include "dataset_record.h"
#include "file_kind.h"
#include "helper/helper_file.h"
#include "helper/helper_process.h"

#include "vtkDataSet.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include <unistd.h>

namespace bindpose
{

namespace
{
constexpr Helper reader{ "bindpose-reader", "BINDPOSE_READER",
  "the helper executable bindpose-reader is missing; reinstall Bindpose or set the environment "
  "variable BINDPOSE_READER to its path" };

/// Return the first bytes of a file, which contain its header.
std::string beginning(const std::string& path)
{
  constexpr std::size_t header_size = 65536;
  std::ifstream file(path, std::ios::binary);
  std::string text(header_size, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

/// Return the memory limit of the helper in MiB, 0: no limit. The libraries take about 300 MiB of
/// address space. Reading text takes less than 20 bytes of memory per byte of the file.
/// Compressed files and pictures expand by a factor of at most 1,032 (zlib with constant data).
Index memory_limit(const std::string& path, const std::string& format, double size)
{
#if defined(__SANITIZE_ADDRESS__)
  return 0; // The address sanitizer reserves terabytes of address space.
#else
  const bool is_compressed = is_listed(format, "png jpg jpeg tif tiff bmp tga") ||
    beginning(path).find("compressor=") != std::string::npos;
  const double growth = is_compressed ? 1100.0 : 20.0;
  constexpr double mebibyte = 1048576.0;
  return 700 + static_cast<Index>(growth * size / mebibyte);
#endif
}

/// Return the value of an attribute of an XML element: the text between the quotes after NAME=.
std::string attribute(const std::string& element, const std::string& name)
{
  const std::size_t begin = element.find(" " + name + "=");
  const std::size_t quote = begin + name.size() + 2;
  if (begin == std::string::npos || quote >= element.size())
  {
    return {};
  }
  const std::size_t end = element.find(element[quote], quote + 1);
  return end == std::string::npos ? std::string() : element.substr(quote + 1, end - quote - 1);
}

template <typename Number, std::size_t size>
bool parse(const std::string& text, std::array<Number, size>& numbers)
{
  std::istringstream words(text);
  for (Number& number : numbers)
  {
    words >> number;
  }
  return !words.fail();
}
/// Read a file by the helper.
/// @param name what is read, for messages
/// @param path for the helper, whose working folder may be another one
/// @param input file descriptor of the standard input of the helper, -1: no input
/// @param size number of bytes of the file
Status read_by_helper(ExecutionContext& context, const std::string& name, const std::string& path,
  int input, const std::string& format, double size, vtkSmartPointer<vtkDataSet>& data)
{
  const FileDescriptor record(anonymous_file("bindpose-dataset"));
  if (record.get() < 0)
  {
    return Status::failure(StatusCode::internal_error,
      std::string("cannot create memory for a dataset: ") + std::strerror(errno));
  }
  HelperRequest request;
  request.name = reader.program;
  request.arguments = { path, format };
  request.input = input;
  request.memory_limit = memory_limit(path, format, size);
  constexpr double bytes_per_second = 1e6; // text is read at 10 to 50 MB per second
  request.time_limit = 10.0 + size / bytes_per_second;
  HelperRun run;
  Status status = run_helper(context, reader, request, record.get(), run);
  if (status.ok())
  {
    status = read_dataset_record(record.get(), data);
    if (!status.ok())
    {
      status.message = "bindpose-reader returned an invalid dataset: " + status.message;
    }
  }
  if (status.code == StatusCode::internal_error)
  {
    return Status::invalid_input(name + " cannot be read: " + status.message);
  }
  return status;
}
} // namespace

Status read_guarded(
  ExecutionContext& context, const std::string& path, vtkSmartPointer<vtkDataSet>& data)
{
  data = nullptr;
  std::string full;
  double size = 0.0;
  const Status found = find_for_helper(path, full, size);
  if (!found.ok())
  {
    return found;
  }
  return read_by_helper(context, path, full, -1, file_extension(path), size, data);
}

Status read_guarded(ExecutionContext& context, const std::string& name, const std::string& bytes,
  const std::string& format, vtkSmartPointer<vtkDataSet>& data)
{
  data = nullptr;
  const FileDescriptor file(anonymous_file("bindpose-picture"));
  std::size_t done = 0;
  while (file.get() >= 0 && done < bytes.size())
  {
    const ssize_t count = ::write(file.get(), bytes.data() + done, bytes.size() - done);
    if (count <= 0)
    {
      break;
    }
    done += static_cast<std::size_t>(count);
  }
  if (done < bytes.size())
  {
    return Status::failure(StatusCode::internal_error,
      std::string("cannot create memory for a picture: ") + std::strerror(errno));
  }
  return read_by_helper(
    context, name, "/dev/stdin", file.get(), format, static_cast<double>(bytes.size()), data);
}

bool read_image_header(const std::string& path, ImageHeader& header)
{
  const std::string text = beginning(path);
  const std::size_t begin = text.find("<ImageData");
  if (begin == std::string::npos)
  {
    return false;
  }
  std::string element = text.substr(begin, text.find('>', begin) - begin);
  std::replace_if(
    element.begin(), element.end(), [](unsigned char c) { return std::isspace(c) != 0; }, ' ');
  if (!parse(attribute(element, "WholeExtent"), header.extent))
  {
    return false;
  }
  ImageHeader defaults;
  if (!parse(attribute(element, "Origin"), header.origin))
  {
    header.origin = defaults.origin;
  }
  if (!parse(attribute(element, "Spacing"), header.spacing))
  {
    header.spacing = defaults.spacing;
  }
  return true;
}

std::string legacy_class(const std::string& path)
{
  std::istringstream lines(beginning(path));
  std::string line;
  // The first two lines are the version and a title, which may contain any words.
  std::getline(lines, line);
  std::getline(lines, line);
  while (std::getline(lines, line))
  {
    std::istringstream words(line);
    std::string keyword, type;
    words >> keyword >> type;
    const auto lower = [](std::string& word)
    {
      std::transform(word.begin(), word.end(), word.begin(),
        [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    };
    lower(keyword);
    lower(type);
    if (keyword == "dataset")
    {
      return type == "polydata"       ? "vtkPolyData"
        : type == "unstructured_grid" ? "vtkUnstructuredGrid"
        : type == "structured_points" ? "vtkImageData"
        : type == "rectilinear_grid"  ? "vtkRectilinearGrid"
        : type == "structured_grid"   ? "vtkStructuredGrid"
                                      : "";
    }
  }
  return {};
}

} // namespace bindpose

#include "pictures/sequence_file.h"

#include "file_kind.h"
#include "io/text_scanner.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"
#include "vtkXMLDataElement.h"
#include "vtkXMLUtilities.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace bindpose
{

namespace
{
std::string without_extension(const std::string& path)
{
  return path.substr(0, path.size() - file_extension(path).size() - 1);
}
} // namespace

std::string numbered_file(const std::string& path, int frame)
{
  char number[16];
  std::snprintf(number, sizeof(number), "_%04d.", frame);
  return without_extension(path) + number + file_extension(path);
}

std::string collection_file(const std::string& path)
{
  return without_extension(path) + ".pvd";
}

std::string format_collection(const std::vector<std::string>& files, double rate)
{
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
                     "  <Collection>\n";
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    const double time = static_cast<double>(i) / (rate > 0 ? rate : 1.0);
    char seconds[40];
    std::snprintf(seconds, sizeof(seconds), "%.9g", time);
    const std::string name = files[i].substr(files[i].find_last_of('/') + 1);
    text += std::string("    <DataSet timestep=\"") + seconds + "\" file=\"" + name + "\"/>\n";
  }
  return text + "  </Collection>\n</VTKFile>\n";
}

Status read_collection(const std::string& path, Sequence& sequence)
{
  sequence = Sequence();
  std::string text;
  const Status status = read_file(path, text);
  if (!status.ok())
  {
    return status;
  }
  const auto root = vtk::TakeSmartPointer(vtkXMLUtilities::ReadElementFromString(text.c_str()));
  vtkXMLDataElement* collection = root ? root->FindNestedElementWithName("Collection") : nullptr;
  if (!collection)
  {
    return Status::invalid_input(path + " is not a collection of files (.pvd)");
  }
  const std::size_t name = path.find_last_of('/') + 1; // npos + 1 is 0
  std::vector<std::pair<double, std::string>> frames;
  for (int k = 0; k < collection->GetNumberOfNestedElements(); ++k)
  {
    vtkXMLDataElement* entry = collection->GetNestedElement(k);
    const char* file = entry->GetAttribute("file");
    const char* time = entry->GetAttribute("timestep");
    double seconds = static_cast<double>(k);
    if (!file || !*file || (time && !(parse_number(time, seconds) && std::isfinite(seconds))))
    {
      return Status::invalid_input(
        path + ": entry " + std::to_string(k + 1) + " must have a file and a numeric time");
    }
    frames.emplace_back(seconds, file[0] == '/' ? file : path.substr(0, name) + file);
  }
  if (frames.empty())
  {
    return Status::invalid_input(path + " lists no files");
  }
  std::stable_sort(
    frames.begin(), frames.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [time, file] : frames)
  {
    sequence.times.push_back(time);
    sequence.files.push_back(file);
  }
  return {};
}

double frames_per_second(const Sequence& sequence)
{
  const double length = sequence.times.back() - sequence.times.front();
  const double rate = static_cast<double>(sequence.times.size() - 1) / length;
  return std::isfinite(rate) && rate > 0.0 ? rate : 24.0;
}

std::vector<std::size_t> evenly_spaced(std::size_t count, std::size_t maximum_count)
{
  std::vector<std::size_t> indices(std::min(count, maximum_count));
  for (std::size_t k = 0; k < indices.size(); ++k)
  {
    indices[k] =
      indices.size() < 2 ? 0 : (k * (count - 1) + (indices.size() - 1) / 2) / (indices.size() - 1);
  }
  return indices;
}

} // namespace bindpose

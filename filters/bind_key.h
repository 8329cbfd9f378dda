#ifndef bind_key_h
#define bind_key_h

#include "vtkObject.h"

#include <vector>

namespace bindpose
{

/// The inputs of a bind: objects and their modification times. The time of a dataset is not used,
/// because editing a transform raises the handle dataset's own time, and a filter that executes
/// again raises that of its output. If two keys are equal, the bind is still valid.
class BindKey
{
public:
  /// Add an array, points or cell array that the bind reads; null is allowed and part of the key.
  void add(vtkObject* object)
  {
    this->parts_.push_back(reinterpret_cast<vtkMTimeType>(object));
    this->parts_.push_back(object ? object->GetMTime() : 0);
  }
  /// Add the filter's own bind time (see BindModified).
  void add(vtkMTimeType time) { this->parts_.push_back(time); }

  bool operator==(const BindKey& other) const { return this->parts_ == other.parts_; }
  bool operator!=(const BindKey& other) const { return !(*this == other); }

private:
  std::vector<vtkMTimeType> parts_;
};

} // namespace bindpose

#endif

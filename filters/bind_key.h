#ifndef bind_key_h
#define bind_key_h

#include "vtkObject.h"

#include <vector>

namespace bindpose
{

/// What a bind was made from: the objects and their modification times, never those of a dataset
/// (editing a transform raises the handle dataset's own time; a re-executed filter raises its
/// output's). Equal keys: the bind still holds.
class BindKey
{
public:
  /// An array, points or cell array that the bind reads; null counts, too.
  void add(vtkObject* object)
  {
    this->parts_.push_back(reinterpret_cast<vtkMTimeType>(object));
    this->parts_.push_back(object ? object->GetMTime() : 0);
  }
  /// The filter's own bind time (see BindModified).
  void add(vtkMTimeType time) { this->parts_.push_back(time); }

  bool operator==(const BindKey& other) const { return this->parts_ == other.parts_; }
  bool operator!=(const BindKey& other) const { return !(*this == other); }

private:
  std::vector<vtkMTimeType> parts_;
};

} // namespace bindpose

#endif

#ifndef bind_key_h
#define bind_key_h

#include "vtkObject.h"

#include <vector>

namespace bindpose
{

/// Cache key of a bind, the computation that does not depend on the pose. The key contains the
/// addresses and modification times of all objects that the bind reads. If two keys are equal, the
/// bind is still valid. The key contains arrays instead of datasets, because the modification time
/// of a dataset also changes in cases in which the bind stays valid: a transform is edited, or an
/// upstream filter executes again.
class BindKey
{
public:
  /// Add an array, points or cell array that the bind reads; null is allowed and part of the key.
  void add(vtkObject* object)
  {
    this->parts_.push_back(reinterpret_cast<vtkMTimeType>(object));
    this->parts_.push_back(object ? object->GetMTime() : 0);
  }
  /// Add the time of the last change of a bind parameter of the filter (see BindModified).
  void add(vtkMTimeType time) { this->parts_.push_back(time); }

  bool operator==(const BindKey& other) const { return this->parts_ == other.parts_; }
  bool operator!=(const BindKey& other) const { return !(*this == other); }

private:
  std::vector<vtkMTimeType> parts_;
};

} // namespace bindpose

#endif

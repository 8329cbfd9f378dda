#ifndef bindpose_base_per_thread_h
#define bindpose_base_per_thread_h

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace bindpose
{

/// Working memory for parallel loop bodies. Each body that runs concurrently uses a separate
/// object, which is created when it is first needed and then reused.
template <typename T>
class PerThread
{
public:
  /// Call use(object) with an object that no other thread is using.
  /// @param make function () -> std::unique_ptr<T> that creates an object
  template <typename Make, typename Use>
  void use_object(const Make& make, const Use& use)
  {
    std::unique_ptr<T> object;
    {
      const std::lock_guard<std::mutex> lock(this->mutex_);
      if (!this->idle_.empty())
      {
        object = std::move(this->idle_.back());
        this->idle_.pop_back();
      }
    }
    if (!object)
    {
      object = make();
    }
    use(*object);
    const std::lock_guard<std::mutex> lock(this->mutex_);
    this->idle_.push_back(std::move(object));
  }

  /// Call visit(const T&) for each object. No loop body may run at the same time.
  template <typename Visit>
  void for_each(const Visit& visit) const
  {
    for (const auto& object : this->idle_)
    {
      visit(*object);
    }
  }

private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> idle_;
};

} // namespace bindpose

#endif

#ifndef bindpose_base_per_thread_h
#define bindpose_base_per_thread_h

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace bindpose
{

/// Lends working memory to parallel bodies. There are as many objects as bodies that run
/// concurrently; each one is created when it is first needed.
template <typename T>
class PerThread
{
public:
  /// @param make function () -> std::unique_ptr<T>
  template <typename Make, typename Use>
  void with(const Make& make, const Use& use)
  {
    std::unique_ptr<T> one;
    {
      const std::lock_guard<std::mutex> lock(this->mutex_);
      if (!this->idle_.empty())
      {
        one = std::move(this->idle_.back());
        this->idle_.pop_back();
      }
    }
    if (!one)
    {
      one = make();
    }
    use(*one);
    const std::lock_guard<std::mutex> lock(this->mutex_);
    this->idle_.push_back(std::move(one));
  }

  /// Call see(const T&) for each object. No body may run meanwhile.
  template <typename See>
  void for_each(const See& see) const
  {
    for (const auto& one : this->idle_)
    {
      see(*one);
    }
  }

private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> idle_;
};

} // namespace bindpose

#endif

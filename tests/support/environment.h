#ifndef bindpose_tests_support_environment_h
#define bindpose_tests_support_environment_h

#include <cstdlib>
#include <optional>
#include <string>

namespace bindpose::test
{

/// Sets or unsets an environment variable for the lifetime of the object.
class Environment
{
public:
  Environment(const char* name, const std::optional<std::string>& value) : name_(name)
  {
    const char* before = std::getenv(name);
    if (before)
    {
      this->before_ = before;
    }
    Environment::put(name, value);
  }
  ~Environment() { Environment::put(this->name_, this->before_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

private:
  static void put(const char* name, const std::optional<std::string>& value)
  {
    if (value)
    {
      ::setenv(name, value->c_str(), 1);
    }
    else
    {
      ::unsetenv(name);
    }
  }

  const char* name_;
  std::optional<std::string> before_;
};

} // namespace bindpose::test

#endif

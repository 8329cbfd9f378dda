#ifndef bindpose_poses_json_fields_h
#define bindpose_poses_json_fields_h

#include "base/status.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <iterator>
#include <string>

namespace bindpose
{

using Json = nlohmann::ordered_json;

/// Reads the fields of one JSON object of a session file. status() reports the first invalid field
/// in one sentence. A missing field leaves its variable unchanged.
class JsonFields
{
public:
  /// @param object_name  the object's name in messages, for example "the pose options"
  JsonFields(const Json& json, std::string object_name)
    : json_(json), object_name_(std::move(object_name))
  {
    if (!json.is_object())
    {
      this->status_ = Status::invalid_input(this->object_name_ + " must be an object");
    }
  }

  void read(const char* key, bool& value)
  {
    const Json* found = this->find(key);
    if (found && !found->is_boolean())
    {
      this->fail(key, "true or false");
      return;
    }
    value = found ? found->get<bool>() : value;
  }

  template <typename Number>
  void read(const char* key, Number& value, double lowest, double highest)
  {
    const Json* found = this->find(key);
    if (!found)
    {
      return;
    }
    const double number = found->is_number() ? found->get<double>() : std::nan("");
    if (!(number >= lowest && number <= highest))
    {
      this->fail(key, "a number from " + text(lowest) + " to " + text(highest));
      return;
    }
    value = static_cast<Number>(number);
  }

  void read(const char* key, std::string& value)
  {
    const Json* found = this->find(key);
    if (found && !found->is_string())
    {
      this->fail(key, "a string");
      return;
    }
    value = found ? found->get<std::string>() : value;
  }

  /// Read a word from a list of allowed words; the value is the word's index in the list.
  template <typename Choice, std::size_t Count>
  void read(const char* key, Choice& value, const char* const (&words)[Count])
  {
    const Json* found = this->find(key);
    if (!found)
    {
      return;
    }
    std::string all;
    for (std::size_t k = 0; k < Count; ++k)
    {
      if (found->is_string() && found->get<std::string>() == words[k])
      {
        value = static_cast<Choice>(k);
        return;
      }
      all += (k > 0 ? ", " : "") + std::string(words[k]);
    }
    this->fail(key, "one of " + all);
  }

  /// Read exactly `count` finite numbers.
  void read(const char* key, double* values, std::size_t count)
  {
    const Json* found = this->find(key);
    if (!found)
    {
      return;
    }
    bool good = found->is_array() && found->size() == count;
    for (std::size_t k = 0; good && k < count; ++k)
    {
      good = (*found)[k].is_number() && std::isfinite((*found)[k].get<double>());
    }
    if (!good)
    {
      this->fail(key, std::to_string(count) + " numbers");
      return;
    }
    for (std::size_t k = 0; k < count; ++k)
    {
      values[k] = (*found)[k].get<double>();
    }
  }

  /// Return a member that must be a list (`list` is true) or an object. Return null if it is
  /// missing or of another type.
  const Json* member(const char* key, bool list)
  {
    const Json* found = this->find(key);
    if (found && !(list ? found->is_array() : found->is_object()))
    {
      this->fail(key, list ? "a list" : "an object");
      return nullptr;
    }
    return found;
  }

  const Status& status() const { return this->status_; }

private:
  static std::string text(double number)
  {
    std::string digits = std::to_string(number); // always has six decimals
    digits.erase(digits.find_last_not_of('0') + 1);
    return digits.back() == '.' ? digits.substr(0, digits.size() - 1) : digits;
  }
  const Json* find(const char* key)
  {
    if (!this->status_.ok())
    {
      return nullptr;
    }
    const auto found = this->json_.find(key);
    return found == this->json_.end() ? nullptr : &*found;
  }
  void fail(const char* key, const std::string& expected)
  {
    this->status_ =
      Status::invalid_input(this->object_name_ + ": \"" + key + "\" must be " + expected);
  }

  const Json& json_;
  std::string object_name_;
  Status status_;
};

} // namespace bindpose

#endif

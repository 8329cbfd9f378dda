#include "gltf/gltf_integers.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <string>

namespace bindpose
{

namespace
{
using Json = nlohmann::json;

/// Receives the elements of a JSON text in their order, without a tree.
class IntegerCheck : public nlohmann::json_sax<Json>
{
public:
  const Status& status() const { return this->status_; }

  bool key(std::string& name) override
  {
    this->key_ = name;
    return true;
  }

  bool start_object(std::size_t) override { return this->enter(); }
  bool start_array(std::size_t) override { return this->enter(); }
  bool end_object() override { return this->leave(); }
  bool end_array() override { return this->leave(); }

  bool number_integer(std::int64_t value) override { return this->check(value >= 0, value); }
  bool number_unsigned(std::uint64_t value) override
  {
    return this->check(value <= 0xffffffffULL, value);
  }
  bool number_float(double value, const std::string&) override
  {
    return this->check(value >= 0.0 && value <= 4294967295.0 && value == std::floor(value), value);
  }

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool string(std::string&) override { return true; }
  bool binary(Json::binary_t&) override { return true; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override
  {
    return false;
  }

private:
  bool enter()
  {
    const bool is_unchecked = this->key_ == "extras" || this->key_ == "extensions";
    this->unchecked_depth_ += this->unchecked_depth_ > 0 || is_unchecked ? 1 : 0;
    this->key_.clear();
    return true;
  }

  bool leave()
  {
    this->unchecked_depth_ -= this->unchecked_depth_ > 0 ? 1 : 0;
    this->key_.clear();
    return true;
  }

  template <typename Value>
  bool check(bool valid, const Value& value)
  {
    const bool is_checked = this->unchecked_depth_ == 0 &&
      (this->key_ == "byteOffset" || this->key_ == "byteLength" || this->key_ == "byteStride" ||
        this->key_ == "count");
    if (is_checked && !valid)
    {
      this->status_ = Status::invalid_input("the property " + this->key_ + " is " +
        Json(value).dump().substr(0, 40) + "; expected an integer from 0 to 4294967295");
    }
    return this->status_.ok();
  }

  Status status_;
  std::string key_; ///< of the next value in an object
  int unchecked_depth_ = 0; ///< levels below the outermost extras or extensions, 0: outside
};
} // namespace

Status check_gltf_integers(std::string_view text)
{
  IntegerCheck check;
  Json::sax_parse(text.begin(), text.end(), &check);
  return check.status();
}

} // namespace bindpose

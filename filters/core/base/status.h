#ifndef bindpose_base_status_h
#define bindpose_base_status_h

// Status and report of a computation.

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace bindpose
{

/// Outcome of a computation. Filters return the integer values of these codes.
enum class StatusCode
{
  ok = 0,
  not_converged, ///< there is a result, but its residuals (see the report) exceed the tolerance
  invalid_input, ///< the caller's data cannot be used; the message contains the first violation
  canceled,
  /// A component is missing, or the method does not support the case; the message says what to do.
  unavailable,
  internal_error
};

/// Return "ok", "not_converged", …, as used in reports, files and Python.
const char* to_string(StatusCode code);

/// Measured values by key, in the order in which they were first set.
///
/// A key is one of the report's documented names. A dot separates the name of an object from the
/// name of its member ("seconds.factor"). "[]." separates the name of a list of objects from the
/// name of a member ("handles[].name"). The values of all keys with the same list name are vectors
/// of equal length, with one entry per object. A key that does not apply is absent. Field data,
/// JSON and Python use the same keys.
class Report
{
public:
  using Value = std::variant<std::int64_t, double, std::string, std::vector<std::int64_t>,
    std::vector<double>, std::vector<std::string>>;

  void set(const std::string& key, Value value);
  /// Store a number. Integers remain integers, other numbers become doubles.
  template <typename Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
  void set(const std::string& key, Number value)
  {
    using Stored = std::conditional_t<std::is_integral_v<Number>, std::int64_t, double>;
    this->set(key, Value(static_cast<Stored>(value)));
  }
  void set(const std::string& key, const char* value) { this->set(key, Value(std::string(value))); }
  /// Add the value to the number for the key. If the key is absent, set it to the value. Used for a
  /// phase that runs several times.
  void add(const std::string& key, double value);
  void erase(const std::string& key);
  /// Copy all entries of the other report. Existing entries with the same keys are replaced.
  void merge(const Report& other);

  const Value* find(const std::string& key) const;
  /// Return the number for the key, or `fallback` if it is absent or not a number.
  double number(const std::string& key, double fallback) const;
  std::string text(const std::string& key, const std::string& fallback = {}) const;

  const std::vector<std::pair<std::string, Value>>& entries() const { return this->entries_; }
  bool empty() const { return this->entries_.empty(); }

private:
  std::vector<std::pair<std::string, Value>> entries_;
};

/// Return the text with a '?' in place of every control character and every byte that is not UTF-8.
/// Therefore neither names nor text from files can break a line, a terminal or a Python string.
std::string sanitize_line(std::string text);

/// Outcome of a computation: a code, a message of one sentence, warnings (one sentence each) and a
/// report of measured values.
struct Status
{
  StatusCode code = StatusCode::ok;
  std::string message;
  std::vector<std::string> warnings;
  Report report;

  bool ok() const { return this->code == StatusCode::ok; }
  /// Report whether there is a result: the code is ok or not_converged.
  bool usable() const { return this->ok() || this->code == StatusCode::not_converged; }

  /// Return a failed status. The message is passed through sanitize_line().
  static Status failure(StatusCode code, std::string message);
  static Status invalid_input(std::string message);
  static Status canceled();
};

} // namespace bindpose

#endif

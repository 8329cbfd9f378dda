#ifndef bindpose_base_status_h
#define bindpose_base_status_h

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace bindpose
{

/// How a computation ended. The order is the one filters expose as an integer.
enum class StatusCode
{
  ok = 0,
  not_converged, ///< a result is there, its residuals are in the report and above the tolerance
  invalid_input, ///< the caller's data cannot be used; the message names the first offender
  cancelled,
  unavailable, ///< a part is missing, or the method cannot; the message names what to do
  internal_error
};

/// "ok", "not_converged", … : the words of reports, files and Python.
const char* to_string(StatusCode code);

/// What was measured, by key, in the order in which it was set.
///
/// A key is one of the report's documented names; a dot makes an object ("seconds.factor"), "[]."
/// makes a list of objects whose columns are vectors of equal length ("handles[].name"). A key
/// that does not apply is absent. The same keys are used in field data, JSON and Python.
class Report
{
public:
  using Value = std::variant<std::int64_t, double, std::string, std::vector<std::int64_t>,
    std::vector<double>, std::vector<std::string>>;

  void set(const std::string& key, Value value);
  /// Any number: whole ones stay whole, others are doubles.
  template <typename Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
  void set(const std::string& key, Number value)
  {
    using Stored = std::conditional_t<std::is_integral_v<Number>, std::int64_t, double>;
    this->set(key, Value(static_cast<Stored>(value)));
  }
  void set(const std::string& key, const char* value) { this->set(key, Value(std::string(value))); }
  /// Adds to a number that may not be there yet (seconds of a phase that runs several times).
  void add(const std::string& key, double value);
  void erase(const std::string& key);
  /// Takes over all of the other's entries, replacing those of the same key.
  void merge(const Report& other);

  const Value* find(const std::string& key) const;
  /// The number under the key, or the fallback when it is absent or not a number.
  double number(const std::string& key, double fallback) const;
  std::string text(const std::string& key, const std::string& fallback = {}) const;

  const std::vector<std::pair<std::string, Value>>& entries() const { return this->entries_; }
  bool empty() const { return this->entries_.empty(); }

private:
  std::vector<std::pair<std::string, Value>> entries_;
};

/// The text with a '?' for every control character and every byte that is no UTF-8: what a file or
/// a name holds must not break a line, a terminal or a Python string.
std::string one_line(std::string text);

/// Outcome of a computation: code, one sentence, warnings (one sentence each) and the numbers.
struct Status
{
  StatusCode code = StatusCode::ok;
  std::string message;
  std::vector<std::string> warnings;
  Report report;

  bool ok() const { return this->code == StatusCode::ok; }
  /// ok or not_converged: there is a result to hand on.
  bool usable() const { return this->ok() || this->code == StatusCode::not_converged; }

  /// The message is made one_line().
  static Status failure(StatusCode code, std::string message);
  static Status invalid_input(std::string message);
  static Status cancelled();
};

} // namespace bindpose

#endif

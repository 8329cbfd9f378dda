#ifndef bindpose_io_expression_h
#define bindpose_io_expression_h

#include "base/status.h"

#include <memory>
#include <string>

namespace bindpose
{

/// Evaluates arithmetic expressions in the variable t, such as those of pose files, with muParser.
///
/// An expression may contain numbers, t, the constant pi, the operators + - * / % ^ < > <= >= == !=
/// && || ! and ?:, and the functions abs, acos, acosh, asin, asinh, atan, atan2, atanh, ceil, clamp
/// (lower, value, upper), cos, cosh, exp, floor, hypot, if (condition, value, other value),
/// log (natural), log10, max, min, mod, pow, round, sign, sin, sinh, sqrt, tan, tanh and trunc. It
/// cannot contain assignments, loops or strings.
class ExpressionParser
{
public:
  ExpressionParser();
  ~ExpressionParser();
  ExpressionParser(const ExpressionParser&) = delete;
  ExpressionParser& operator=(const ExpressionParser&) = delete;

  /// Evaluate an expression at time t. The value is NaN if the result is not finite. If the text is
  /// not an expression with one number as its value, or is longer than 4,096 characters, return
  /// invalid_input with a message that names the error.
  Status evaluate(const std::string& text, double t, double& value);

private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace bindpose

#endif

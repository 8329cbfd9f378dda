#include "io/expression.h"

#include "base/text_check.h"

#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

namespace bindpose
{

namespace
{
constexpr std::size_t maximum_length = 4096;
constexpr double pi = 3.14159265358979323846;

/// muParser calls variadic functions with at least one argument.
double smallest(const double* values, int count)
{
  return *std::min_element(values, values + count);
}

double largest(const double* values, int count)
{
  return *std::max_element(values, values + count);
}

double sign(double x)
{
  return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : x);
}

double logical_not(double x)
{
  return x == 0.0 ? 1.0 : 0.0;
}

double choose(double condition, double value, double other)
{
  return condition != 0.0 ? value : other;
}

/// Unlike std::clamp, this is defined if the limits are in the wrong order.
double clamp(double lower, double value, double upper)
{
  return std::min(std::max(value, lower), upper);
}

std::string sentence_of(const mu::ParserError& error)
{
  std::string text = error.GetMsg();
  if (!text.empty() && text.back() == '.')
  {
    text.pop_back();
  }
  return text;
}
} // namespace

class ExpressionParser::Impl
{
public:
  Impl()
  {
    // Define only the documented functions, because the built-in functions of muParser depend on
    // the version of muParser.
    this->parser_.ClearFun();
    this->parser_.ClearConst();
    this->define("abs", std::fabs);
    this->define("acos", std::acos);
    this->define("acosh", std::acosh);
    this->define("asin", std::asin);
    this->define("asinh", std::asinh);
    this->define("atan", std::atan);
    this->define("atanh", std::atanh);
    this->define("ceil", std::ceil);
    this->define("cos", std::cos);
    this->define("cosh", std::cosh);
    this->define("exp", std::exp);
    this->define("floor", std::floor);
    this->define("log", std::log);
    this->define("log10", std::log10);
    this->define("round", std::round);
    this->define("sign", sign);
    this->define("sin", std::sin);
    this->define("sinh", std::sinh);
    this->define("sqrt", std::sqrt);
    this->define("tan", std::tan);
    this->define("tanh", std::tanh);
    this->define("trunc", std::trunc);
    this->define("atan2", std::atan2);
    this->define("hypot", std::hypot);
    this->define("mod", std::fmod);
    this->define("pow", std::pow);
    this->parser_.DefineFun("clamp", clamp);
    this->parser_.DefineFun("if", choose);
    this->parser_.DefineFun("max", largest);
    this->parser_.DefineFun("min", smallest);
    this->parser_.DefineOprt("%", std::fmod, mu::prMUL_DIV);
    this->parser_.DefineInfixOprt("!", logical_not);
    this->parser_.DefineConst("pi", pi);
  }

  /// @throw mu::ParserError
  double evaluate(const std::string& text, double t)
  {
    // Define t as a constant, so that an expression cannot assign to it.
    this->parser_.DefineConst("t", t);
    this->parser_.SetExpr(text);
    int count = 0;
    const double* values = this->parser_.Eval(count);
    if (count != 1)
    {
      throw mu::ParserError("The expression has " + std::to_string(count) + " values.");
    }
    return values[0];
  }

private:
  void define(const char* name, double (*function)(double))
  {
    this->parser_.DefineFun(name, function);
  }

  void define(const char* name, double (*function)(double, double))
  {
    this->parser_.DefineFun(name, function);
  }

  mu::Parser parser_;
};

ExpressionParser::ExpressionParser() : impl_(std::make_unique<Impl>()) {}

ExpressionParser::~ExpressionParser() = default;

Status ExpressionParser::evaluate(const std::string& text, double t, double& value)
{
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
  {
    return Status::invalid_input("the expression is empty");
  }
  if (text.size() > maximum_length)
  {
    return Status::invalid_input("the expression has " + std::to_string(text.size()) +
      " characters; expected at most " + std::to_string(maximum_length));
  }
  std::string line = text; // muParser accepts only spaces as white space
  std::replace_if(
    line.begin(), line.end(), [](unsigned char c) { return std::isspace(c) != 0; }, ' ');
  const std::string error = find_text_error(line);
  if (!error.empty())
  {
    return Status::invalid_input("the expression contains " + error);
  }
  try
  {
    const double result = this->impl_->evaluate(line, t);
    value = std::isfinite(result) ? result : std::numeric_limits<double>::quiet_NaN();
    return {};
  }
  catch (const mu::ParserError& parse_error)
  {
    return Status::invalid_input(
      "expected a scalar expression in t (" + sentence_of(parse_error) + ")");
  }
}

} // namespace bindpose

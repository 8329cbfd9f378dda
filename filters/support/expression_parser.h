#ifndef expression_parser_h
#define expression_parser_h

#include "base/status.h"

#include "vtkNew.h"

#include <string>

class vtkExprTkFunctionParser;

namespace bindpose
{

/// Evaluates expressions in the variable t with VTK's parser; suppresses its error events.
class ExpressionParser
{
public:
  ExpressionParser();
  ~ExpressionParser();

  /// Evaluate an expression at time t. The value is NaN if the result is not finite. If the text is
  /// not an expression with one number as its value, return invalid_input with a message that names
  /// the error.
  Status evaluate(const std::string& text, double t, double& value);

private:
  vtkNew<vtkExprTkFunctionParser> parser_;
  std::string error_; ///< message of the parser's last event
};

} // namespace bindpose

#endif

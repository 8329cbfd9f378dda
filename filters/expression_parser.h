#ifndef expression_parser_h
#define expression_parser_h

#include "base/status.h"

#include "vtkNew.h"

#include <string>

class vtkExprTkFunctionParser;

namespace bindpose
{

/// Values of expressions in the variable t, by VTK's parser, without its error events.
class ExpressionParser
{
public:
  ExpressionParser();
  ~ExpressionParser();

  /// invalid_input, with a clause that says what is wrong, for a text that is no expression of one
  /// number. A value that is not finite is a value.
  Status evaluate(const std::string& text, double t, double& value);

private:
  vtkNew<vtkExprTkFunctionParser> parser_;
  std::string error_; ///< of the parser's last event
};

} // namespace bindpose

#endif

// VTK's parser reports errors as events whose texts have several lines. The first line that names
// the error becomes the status message.
#include "expression_parser.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkExprTkFunctionParser.h"

#include <limits>

namespace bindpose
{

namespace
{
/// Return the message part of an event text "ERROR: In …\nvtkExprTkFunctionParser (0x…):
/// message\n\n" in one line.
std::string message_of(const std::string& event)
{
  const std::size_t begin = event.find("): ");
  std::string text = begin == std::string::npos ? event : event.substr(begin + 3);
  for (char& c : text)
  {
    c = c == '\n' ? ' ' : c;
  }
  while (!text.empty() && text.back() == ' ')
  {
    text.pop_back();
  }
  return text;
}
} // namespace

ExpressionParser::ExpressionParser()
{
  vtkNew<vtkCallbackCommand> callback;
  callback->SetClientData(&this->error_);
  callback->SetCallback(
    [](vtkObject*, unsigned long, void* client, void* data)
    {
      auto& error = *static_cast<std::string*>(client);
      if (error.empty() && data)
      {
        error = message_of(static_cast<const char*>(data));
      }
    });
  this->parser_->AddObserver(vtkCommand::ErrorEvent, callback);
  this->parser_->AddObserver(vtkCommand::WarningEvent, callback);
  // With the option ReplaceInvalidValues, the parser returns NaN for a value that is not finite.
  // Without the option, the parser would report an error, as for text that it cannot parse.
  this->parser_->ReplaceInvalidValuesOn();
  this->parser_->SetReplacementValue(std::numeric_limits<double>::quiet_NaN());
}

ExpressionParser::~ExpressionParser() = default;

Status ExpressionParser::evaluate(const std::string& text, double t, double& value)
{
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
  {
    return Status::invalid_input("the expression is empty");
  }
  this->error_.clear();
  this->parser_->SetScalarVariableValue("t", t);
  this->parser_->SetFunction(text.c_str());
  if (this->parser_->IsScalarResult() == 0)
  {
    return Status::invalid_input(this->error_.empty()
        ? "expected a scalar expression in t"
        : "expected a scalar expression in t (" + this->error_ + ")");
  }
  value = this->parser_->GetScalarResult();
  return {};
}

} // namespace bindpose

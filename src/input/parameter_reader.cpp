// Turns tokens into typed values and checks them against the declared type while their location in
// the text is known.
#include "input/parameter_reader.h"

#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "core/counted.h"
#include "input/number_text.h"
#include "input/parameter_types.h"

namespace nephroid {
namespace {

using Values = ParameterType::Values;

bool is_space(char c) {
  return c == ' ' || c == '\t';
}

/// Removes the next word from `text` and returns it; empty at the end.
std::string_view take_word(std::string_view& text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  size_t length = 0;
  while (length < text.size() && !is_space(text[length])) ++length;
  const std::string_view word = text.substr(0, length);
  text.remove_prefix(length);
  return word;
}

std::string title_with_type(const Parameter& parameter) {
  return "parameter \"" + parameter.name + "\" has type \"" + parameter.type + "\"";
}

[[noreturn]] void wrong_value(const Parameter& parameter, const Token& token,
                              const char* expected) {
  throw SceneError(token.where(), title_with_type(parameter) + ", expected " + expected +
                                      ", found " + describe(token));
}

const char* expected_values(Values values) {
  switch (values) {
    case Values::kIntegers:
      return "an integer";
    case Values::kStrings:
      return "a string in quotes";
    case Values::kBools:
      return "true or false";
    case Values::kSpectrum:
      return "numbers or the name of a spectrum";
    case Values::kNumbers:
      break;
  }
  return "a number";
}

/// Throws the reason why `token` is not a valid number for the parameter.
[[noreturn]] void wrong_number(const Parameter& parameter, const Token& token, bool integer) {
  const double value = number_from(
      token, (integer ? "an integer (" : "a number (") + title_with_type(parameter) + ")");
  const char* const reason = !integer                     ? " does not fit a 32-bit float"
                             : value != std::floor(value) ? " is not an integer"
                                                          : " does not fit a 32-bit integer";
  throw SceneError(token.where(), title_with_type(parameter) + ", but " + describe(token) + reason);
}

/// The number of a token, checked to fit a float or, for integers, a 32-bit int.
double checked_number(const Parameter& parameter, const Token& token, bool integer) {
  const std::optional<double> value = parse_number(token.text);
  bool good = value && std::abs(*value) <= std::numeric_limits<float>::max();
  if (good && integer) {
    good = *value == std::floor(*value) && *value >= std::numeric_limits<int>::min() &&
           *value <= std::numeric_limits<int>::max();
  }
  if (!good) wrong_number(parameter, token, integer);
  return *value;
}

void add_value(Parameter& parameter, Values values, const Token& token) {
  const bool quoted = token.kind == Token::Kind::kString;
  if (!quoted && token.kind != Token::Kind::kWord)
    wrong_value(parameter, token, expected_values(values));
  switch (values) {
    case Values::kStrings:
      if (!quoted) wrong_value(parameter, token, expected_values(values));
      parameter.strings.emplace_back(token.text);
      return;
    case Values::kBools:
      if (token.text != "true" && token.text != "false")
        wrong_value(parameter, token, expected_values(values));
      parameter.bools.push_back(token.text == "true");
      return;
    case Values::kSpectrum:
      if (quoted && parameter.numbers.empty() && parameter.strings.empty()) {
        parameter.strings.emplace_back(token.text);
        return;
      }
      if (quoted || !parameter.strings.empty())
        wrong_value(parameter, token, "either numbers or one name");
      break;
    case Values::kNumbers:
    case Values::kIntegers:
      if (quoted) wrong_value(parameter, token, expected_values(values));
      break;
  }
  parameter.numbers.push_back(checked_number(parameter, token, values == Values::kIntegers));
}

void check_count(const Parameter& parameter, const ParameterType& type) {
  const size_t numbers = parameter.numbers.size();
  if (numbers + parameter.strings.size() + parameter.bools.size() == 0)
    throw SceneError(parameter.where, title_with_type(parameter) + ", but no values");
  if (numbers % type.numbers_per_item != 0) {
    throw SceneError(parameter.where, title_with_type(parameter) + " and " +
                                          counted(numbers, "number") + ", expected a multiple of " +
                                          std::to_string(type.numbers_per_item));
  }
}

Parameter read_declaration(const Token& declaration) {
  Parameter parameter;
  parameter.where = declaration.where();
  std::string_view rest = declaration.text;
  const std::string_view type_word = take_word(rest);
  const std::string_view name = take_word(rest);
  if (name.empty() || !take_word(rest).empty())
    throw SceneError(parameter.where,
                     describe(declaration) + " declares no parameter, expected \"type name\"");
  const ParameterType* type = find_parameter_type(type_word);
  if (!type) {
    throw SceneError(parameter.where, "parameter \"" + std::string(name) +
                                          "\" has the unknown type \"" + std::string(type_word) +
                                          "\", expected one of: " + list_of_parameter_types());
  }
  parameter.type = type->name;
  parameter.name = name;
  return parameter;
}

}  // namespace

void read_parameter_values(TokenStream& tokens, Parameter& parameter) {
  const ParameterType& type = *find_parameter_type(parameter.type);
  const Token* token = &tokens.next();
  if (token->kind == Token::Kind::kEnd)
    throw SceneError(parameter.where, title_with_type(parameter) + ", but no values");
  if (token->kind != Token::Kind::kOpen) {
    add_value(parameter, type.values, *token);
  } else {
    const SourceLocation opened = token->where();
    for (token = &tokens.next(); token->kind != Token::Kind::kClose; token = &tokens.next()) {
      if (token->kind == Token::Kind::kEnd)
        throw SceneError(opened, "this '[' is not closed before the end of the file");
      if (token->kind == Token::Kind::kOpen)
        throw SceneError(token->where(), "'[' inside of '[ ]', expected a value or ']'");
      add_value(parameter, type.values, *token);
    }
  }
  check_count(parameter, type);
}

std::vector<Parameter> read_parameters(TokenStream& tokens, const std::string& color_space,
                                       Diagnostics& diagnostics) {
  std::vector<Parameter> parameters;
  while (tokens.peek().kind == Token::Kind::kString) {
    Parameter parameter = read_declaration(tokens.next());
    parameter.color_space = color_space;
    read_parameter_values(tokens, parameter);
    for (size_t i = 0; i < parameters.size(); ++i) {
      if (parameters[i].name != parameter.name) continue;
      diagnostics.warn(parameter.where,
                       "parameter \"" + parameter.name + "\" is given twice, the last one counts");
      parameters.erase(parameters.begin() + i);
      break;
    }
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

}  // namespace nephroid

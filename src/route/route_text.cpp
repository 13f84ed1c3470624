// Parses routes and AOVs: NAME=EXPRESSION:ESTIMATOR.
#include "route/route_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include "input/spelling.h"
#include "route/expression_error.h"
#include "route/nfa.h"

namespace nephroid {
namespace {

// Names of the picture's own layers and channels, present or reserved.
constexpr const char* kReservedNames[] = {
    "R",        "G",      "B",      "A",      "Z",       "N",        "P",
    "Ns",       "u",      "v",      "Y",      "RY",      "BY",       "dzdx",
    "dzdy",     "albedo", "Albedo", "stderr", "samples", "Variance", "RelativeVariance",
    "outliers", "bias",   "picture"};

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

// A half-open range of a text.
struct Range {
  size_t begin = 0, end = 0;
};
Range trimmed(const std::string& text, size_t begin, size_t end) {
  while (begin < end && is_space(text[begin])) ++begin;
  while (end > begin && is_space(text[end - 1])) --end;
  return {begin, end};
}

// Position of the first `c` from `begin` on that is not in a label, or npos. An apostrophe without
// a partner hides the rest of the text.
size_t find_outside_labels(const std::string& text, char c, size_t begin) {
  bool in_label = false;
  for (size_t i = begin; i < text.size(); ++i) {
    if (text[i] == '\'') in_label = !in_label;
    if (text[i] == c && !in_label) return i;
  }
  return std::string::npos;
}

// Reads "NAME=" and returns where the expression begins. `what` is "a route" or "an AOV".
size_t read_name(const std::string& text, const char* what, const char* form, std::string& name,
                 ExpressionSource& source) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw expression_error(source, text.size(),
                           std::string("expected ") + what + " as " + form + ", found no '='");
  const Range range = trimmed(text, 0, equals);
  name = text.substr(range.begin, range.end - range.begin);
  source.column = range.begin;
  check_layer_name(name, source);
  return equals + 1;
}

std::string read_expression(const std::string& text, size_t begin, size_t end,
                            ExpressionSource& source) {
  const Range range = trimmed(text, begin, end);
  source.column = range.begin;
  std::string expression = text.substr(range.begin, range.end - range.begin);
  parse_checked(expression, source);
  return expression;
}

const EstimatorTraits* read_estimator(const std::string& text, size_t colon, TraitsTable estimators,
                                      const ExpressionSource& source) {
  const Range range = trimmed(text, colon + 1, text.size());
  const std::string name = text.substr(range.begin, range.end - range.begin);
  std::vector<std::string> names;
  for (const EstimatorTraits* estimator : estimators) {
    if (name == estimator->name) return estimator;
    names.emplace_back(estimator->name);
  }
  const std::string known = fmt::format("{}", fmt::join(names, ", "));
  throw expression_error(source, range.begin,
                         name.empty() ? "expected an estimator behind ':', one of " + known
                                      : "unknown estimator '" + name + "', expected one of " +
                                            known + did_you_mean(name, names));
}

bool is_letter_of_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
}

bool is_reserved(const std::string& name) {
  return std::ranges::find(kReservedNames, name) != std::end(kReservedNames);
}

}  // namespace

bool is_layer_name(const std::string& name) {
  return !name.empty() && name.size() <= kMaxLayerName &&
         std::ranges::all_of(name, is_letter_of_name) && !is_reserved(name);
}

void check_layer_name(const std::string& name, const ExpressionSource& source) {
  if (name.empty())
    throw expression_error(source, source.column, "expected a name before '=', found none");
  for (size_t i = 0; i < name.size(); ++i)
    if (!is_letter_of_name(name[i]))
      throw expression_error(source, source.column + i,
                             "expected a name of letters, digits, '_' and '-', found " +
                                 found_text(name, i, "the end"));
  if (name.size() > kMaxLayerName)
    throw expression_error(
        source, source.column,
        "expected a name of at most " + std::to_string(kMaxLayerName) + " letters");
  if (is_reserved(name))
    throw expression_error(source, source.column,
                           "'" + name +
                               "' is the name of a layer or channel that "
                               "pictures have already, expected another");
}

ExpressionSource source_of(const ExpressionSource& source, const std::string& expression) {
  return source.text.empty() ? ExpressionSource{"route", expression, 0} : source;
}

Expression parse_checked(const std::string& expression, const ExpressionSource& source) {
  Expression e = parse_expression(expression, source);
  if (!matches_some_path(e, source))
    throw expression_error(source, source.column,
                           "this expression can match no path: a path begins with C, then come "
                           "events, and it ends with a light (L, O, B or M)");
  return e;
}

RouteDefinition parse_route(const std::string& text, TraitsTable estimators,
                            const std::string& where) {
  RouteDefinition route;
  route.source = {where, text, 0};
  const size_t begin =
      read_name(text, "a route", "NAME=EXPRESSION:ESTIMATOR", route.name, route.source);
  const size_t colon = find_outside_labels(text, ':', begin);
  route.expression = read_expression(text, begin, std::min(colon, text.size()), route.source);
  if (colon == std::string::npos)
    throw expression_error(route.source, text.size(),
                           "expected ':' and an estimator behind the expression, as in "
                           "NAME=EXPRESSION:path");
  route.estimator = read_estimator(text, colon, estimators, route.source);
  return route;
}

AovDefinition parse_aov(const std::string& text, const std::string& where) {
  AovDefinition aov;
  aov.source = {where, text, 0};
  const size_t begin = read_name(text, "an AOV", "NAME=EXPRESSION", aov.name, aov.source);
  const size_t colon = find_outside_labels(text, ':', begin);
  if (colon != std::string::npos)
    throw expression_error(
        aov.source, colon,
        "an AOV has no estimator: expected the end of the expression, found ':'");
  aov.expression = read_expression(text, begin, text.size(), aov.source);
  return aov;
}

std::vector<RouteDefinition> parse_route_file(const std::string& text, TraitsTable estimators,
                                              const std::string& file) {
  std::vector<RouteDefinition> routes;
  int number = 0;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::string whole = text.substr(begin, end - begin);
    begin = end + 1;
    ++number;
    const size_t comment = find_outside_labels(whole, '#', 0);
    const Range range = trimmed(whole, 0, std::min(comment, whole.size()));
    if (range.begin == range.end) continue;
    // The indentation is kept, so that columns are those of the file.
    routes.push_back(
        parse_route(whole.substr(0, range.end), estimators, file + ":" + std::to_string(number)));
  }
  if (routes.empty())
    throw UsageError(file + ": expected routes, NAME=EXPRESSION:ESTIMATOR, one a line; found none");
  return routes;
}

}  // namespace nephroid

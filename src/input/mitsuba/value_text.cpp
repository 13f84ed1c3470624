#include "input/mitsuba/value_text.h"

#include <cctype>
#include <cmath>
#include <optional>

#include "input/number_text.h"

namespace nephroid::mitsuba {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr std::string_view kSeparators = " \t\r\n,;";

bool is_upper(char c) {
  return std::isupper(static_cast<unsigned char>(c)) != 0;
}

/// The text for a message, cut if it is long.
std::string quoted(std::string_view text) {
  constexpr size_t kMaxShown = 40;
  return "\"" + std::string(text.substr(0, kMaxShown)) + (text.size() > kMaxShown ? "...\"" : "\"");
}

}  // namespace

std::string snake_case(std::string_view name) {
  std::string result;
  for (size_t i = 0; i < name.size(); ++i) {
    if (i > 0 && is_upper(name[i]) && !is_upper(name[i - 1]) && name[i - 1] != '_') result += '_';
    result += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
  }
  return result;
}

std::string_view trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (size_t at = text.find_first_not_of(kSeparators); at != std::string_view::npos;
       at = text.find_first_not_of(kSeparators, at)) {
    const size_t end = std::min(text.find_first_of(kSeparators, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

double finite_number(std::string_view text, const std::string& what, const SourceLocation& where) {
  const std::optional<double> value = parse_number(trimmed(text));
  if (!value || !std::isfinite(*value))
    throw SceneError(where, what + " is " + quoted(text) + ", expected a finite number");
  return *value;
}

std::vector<double> finite_numbers(std::string_view text, const std::string& what,
                                   const SourceLocation& where) {
  std::vector<double> numbers;
  for (const std::string_view word : words_of(text))
    numbers.push_back(finite_number(word, what, where));
  return numbers;
}

}  // namespace nephroid::mitsuba

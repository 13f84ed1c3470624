// Members of a JSON object by name and type: what is missing, unknown, of the wrong type or out of
// range gets a message with its place. Who calls it: suite.cpp. It must not know what suites are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/json_text.h"

namespace nephroid {

/// Throws UsageError unless the value is of a kind; `what` says what it is for.
void expect_kind(const JsonValue& value, JsonValue::Kind kind, const std::string& what);

/// One object whose members have names from a list.
class Fields {
 public:
  /// `what` is the object in messages ("a scene"). Throws UsageError if the value is no object or
  /// has a member with another name.
  Fields(const JsonValue& value, std::string what, std::vector<std::string> names);

  const SourceLocation& where() const { return value_.where; }
  bool has(const std::string& name) const { return value_.find(name) != nullptr; }
  /// The member; throws UsageError if it is not there.
  const JsonValue& required(const std::string& name) const;
  const JsonValue* find(const std::string& name) const { return value_.find(name); }

  // Values of members, or what to take if they are not there. All throw UsageError for another
  // type, and numbers out of their range.
  std::string text(const std::string& name) const;
  std::string text_or(const std::string& name, const std::string& otherwise) const;
  double number_or(const std::string& name, double otherwise, double low, double high) const;
  uint64_t integer_or(const std::string& name, uint64_t otherwise, uint64_t low,
                      uint64_t high) const;
  /// The items of a list; none if it is not there.
  const std::vector<JsonValue>& list(const std::string& name) const;
  /// A list of strings, or one string in place of a list of one.
  std::vector<std::string> texts(const std::string& name) const;

 private:
  const JsonValue& value_;
  std::string what_;
};

/// The text of a string.
const std::string& text_of(const JsonValue& value, const std::string& what);
/// The number of a value in [low, high].
double number_of(const JsonValue& value, const std::string& what, double low, double high);

/// Runs `read`, which throws UsageErrors without a place, and puts the place of `value` in front.
template <class Read>
auto read_at(const JsonValue& value, const Read& read) {
  try {
    return read();
  } catch (const UsageError& error) {
    fail_at(value.where, error.what());
  }
}

}  // namespace nephroid

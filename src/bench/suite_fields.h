// Values of a JSON file with their locations, and members of objects by name and type. Errors in
// them have a JSON pointer (RFC 6901). It must not know what suites are.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"

namespace nephroid {

using Json = nlohmann::ordered_json;

struct JsonMember;

/// A value and its location. The document must outlive it.
class JsonValue {
 public:
  JsonValue(const Json& json, std::string file, Json::json_pointer where = Json::json_pointer())
      : json_(&json), file_(std::move(file)), where_(std::move(where)) {}

  const Json& json() const { return *json_; }
  /// The items of an array; none for any other value.
  std::vector<JsonValue> items() const;
  /// The members of an object, in the order of the file; none for any other value.
  std::vector<JsonMember> members() const;
  std::optional<JsonValue> find(const std::string& key) const;

  /// Throws UsageError "FILE: /scenes/2/resolution: MESSAGE".
  [[noreturn]] void fail(const std::string& message) const;

 private:
  const Json* json_;
  std::string file_;
  Json::json_pointer where_;
};

struct JsonMember {
  std::string key;
  JsonValue value;
};

/// Parses a text as a document; `file` is its name in messages. Throws UsageError
/// "FILE:LINE:COLUMN: what is wrong, what was expected", also for a key that an object has twice.
Json parse_json(const std::string& text, const std::string& file);

/// Throws UsageError unless the value has the type; `what` is its name in messages.
void expect_type(const JsonValue& value, Json::value_t type, const std::string& what);
/// The text of a string.
const std::string& text_of(const JsonValue& value, const std::string& what);
/// The number of a value in [low, high].
double number_of(const JsonValue& value, const std::string& what, double low, double high);

/// An object whose members have names from a list.
class Fields {
 public:
  /// `what` is the object's name in messages ("a scene"). Throws UsageError if the value is not an
  /// object or has a member with another name.
  Fields(JsonValue value, std::string what, const std::vector<std::string>& names);

  const JsonValue& value() const { return value_; }
  bool has(const std::string& name) const { return value_.json().contains(name); }
  /// The member; throws UsageError if it is missing.
  JsonValue required(const std::string& name) const;
  std::optional<JsonValue> find(const std::string& name) const { return value_.find(name); }

  // Values of members, or defaults for missing ones. All throw UsageError for a wrong type, and for
  // numbers out of range.
  std::string text(const std::string& name) const;
  std::string text_or(const std::string& name, const std::string& otherwise) const;
  double number_or(const std::string& name, double otherwise, double low, double high) const;
  uint64_t integer_or(const std::string& name, uint64_t otherwise, uint64_t low,
                      uint64_t high) const;
  /// The items of a list; empty if it is missing.
  std::vector<JsonValue> list(const std::string& name) const;
  /// The strings of a list, or a single string as a list of one.
  std::vector<std::string> texts(const std::string& name) const;

 private:
  JsonValue value_;
  std::string what_;
};

/// Runs `read`, which throws UsageErrors without a location, and prefixes them with that of
/// `value`.
template <class Read>
auto read_at(const JsonValue& value, const Read& read) {
  try {
    return read();
  } catch (const UsageError& error) {
    value.fail(error.what());
  }
}

}  // namespace nephroid

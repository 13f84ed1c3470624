// JSON whose values know where they stand in the file, so that a message can point at them. The
// grammar is the library's; this adds places, refuses a key that comes twice and limits the depth.
// Who calls it: suite.cpp. It must not know what the values mean.
#pragma once

#include <string>
#include <vector>

#include "core/errors.h"

namespace nephroid {

struct JsonMember;

struct JsonValue {
  enum class Kind { kNull, kBoolean, kNumber, kString, kArray, kObject };
  Kind kind = Kind::kNull;
  SourceLocation where;
  bool boolean = false;
  double number = 0;
  std::string text;                 ///< of a string; of a number as it was written
  std::vector<JsonValue> items;     ///< of an array
  std::vector<JsonMember> members;  ///< of an object, in the order of the file

  /// The value of a member, null if there is none of that name.
  const JsonValue* find(const std::string& key) const;
};

struct JsonMember {
  std::string key;
  SourceLocation where;  ///< of the key
  JsonValue value;
};

/// "a number", "an object" ... for messages.
std::string json_kind_name(JsonValue::Kind kind);

/// The value that a whole text stands for; `file` is its name in messages. Throws UsageError
/// "file:line:column: what is wrong, what was expected".
JsonValue parse_json(const std::string& text, const std::string& file);

/// Throws UsageError with the place in front.
[[noreturn]] void fail_at(const SourceLocation& where, const std::string& message);

}  // namespace nephroid

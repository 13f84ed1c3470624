#include "bench/suite_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace nephroid {

void expect_kind(const JsonValue& value, JsonValue::Kind kind, const std::string& what) {
  if (value.kind == kind) return;
  fail_at(value.where, fmt::format("{} is {}, expected {}", what, json_kind_name(value.kind),
                                   json_kind_name(kind)));
}

const std::string& text_of(const JsonValue& value, const std::string& what) {
  expect_kind(value, JsonValue::Kind::kString, what);
  return value.text;
}

double number_of(const JsonValue& value, const std::string& what, double low, double high) {
  expect_kind(value, JsonValue::Kind::kNumber, what);
  if (std::isfinite(value.number) && value.number >= low && value.number <= high)
    return value.number;
  const std::string expected = std::isfinite(high)
                                   ? fmt::format("a number from {:g} to {:g}", low, high)
                                   : fmt::format("a number from {:g}", low);
  fail_at(value.where, fmt::format("{} is {}, expected {}", what, value.text, expected));
}

Fields::Fields(const JsonValue& value, std::string what, std::vector<std::string> names)
    : value_(value), what_(std::move(what)) {
  expect_kind(value, JsonValue::Kind::kObject, what_);
  for (const JsonMember& member : value.members) {
    if (std::find(names.begin(), names.end(), member.key) != names.end()) continue;
    std::string known;
    for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
    fail_at(member.where,
            fmt::format("unknown key \"{}\" in {}, expected one of: {}", member.key, what_, known));
  }
}

const JsonValue& Fields::required(const std::string& name) const {
  if (const JsonValue* value = value_.find(name)) return *value;
  fail_at(value_.where, fmt::format("{} has no \"{}\", expected one", what_, name));
}

std::string Fields::text(const std::string& name) const {
  return text_of(required(name), fmt::format("\"{}\"", name));
}

std::string Fields::text_or(const std::string& name, const std::string& otherwise) const {
  return has(name) ? text(name) : otherwise;
}

double Fields::number_or(const std::string& name, double otherwise, double low, double high) const {
  const JsonValue* value = value_.find(name);
  return value == nullptr ? otherwise : number_of(*value, fmt::format("\"{}\"", name), low, high);
}

uint64_t Fields::integer_or(const std::string& name, uint64_t otherwise, uint64_t low,
                            uint64_t high) const {
  const JsonValue* value = value_.find(name);
  if (value == nullptr) return otherwise;
  expect_kind(*value, JsonValue::Kind::kNumber, fmt::format("\"{}\"", name));
  uint64_t result = 0;
  const char* end = value->text.data() + value->text.size();
  const auto [stop, error] = std::from_chars(value->text.data(), end, result);
  if (error == std::errc() && stop == end && result >= low && result <= high) return result;
  fail_at(value->where, fmt::format("\"{}\" is {}, expected a whole number from {} to {}", name,
                                    value->text, low, high));
}

const std::vector<JsonValue>& Fields::list(const std::string& name) const {
  static const std::vector<JsonValue> none;
  const JsonValue* value = value_.find(name);
  if (value == nullptr) return none;
  expect_kind(*value, JsonValue::Kind::kArray, fmt::format("\"{}\"", name));
  return value->items;
}

std::vector<std::string> Fields::texts(const std::string& name) const {
  const JsonValue* value = value_.find(name);
  if (value != nullptr && value->kind == JsonValue::Kind::kString) return {value->text};
  std::vector<std::string> result;
  for (const JsonValue& item : list(name))
    result.push_back(text_of(item, fmt::format("an item of \"{}\"", name)));
  return result;
}

}  // namespace nephroid

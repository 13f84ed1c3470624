#include "bench/suite_fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

namespace nephroid {
namespace {

const char* type_name(Json::value_t type) {
  switch (type) {
    case Json::value_t::null:
      return "null";
    case Json::value_t::boolean:
      return "true or false";
    case Json::value_t::string:
      return "a string";
    case Json::value_t::array:
      return "a list";
    case Json::value_t::object:
      return "an object";
    default:
      return "a number";
  }
}

/// The location of a byte of a text.
SourceLocation place_of(const std::string& text, size_t byte, const std::string& file) {
  const auto end = text.begin() + std::min(byte, text.size());
  const auto line_begin = std::find(std::make_reverse_iterator(end), text.rend(), '\n').base();
  return {std::make_shared<const std::string>(file),
          static_cast<int>(std::count(text.begin(), end, '\n')) + 1,
          static_cast<int>(end - line_begin) + 1};
}

}  // namespace

std::vector<JsonValue> JsonValue::items() const {
  std::vector<JsonValue> result;
  if (!json_->is_array()) return result;
  for (size_t i = 0; i < json_->size(); ++i) result.emplace_back((*json_)[i], file_, where_ / i);
  return result;
}

std::vector<JsonMember> JsonValue::members() const {
  std::vector<JsonMember> result;
  if (!json_->is_object()) return result;
  for (const auto& [key, value] : json_->items())
    result.push_back({key, {value, file_, where_ / key}});
  return result;
}

std::optional<JsonValue> JsonValue::find(const std::string& key) const {
  const auto found = json_->find(key);
  if (found == json_->end()) return std::nullopt;
  return JsonValue(*found, file_, where_ / key);
}

void JsonValue::fail(const std::string& message) const {
  const std::string where = where_.to_string();
  throw UsageError(fmt::format("{}: {}{}{}", file_, where, where.empty() ? "" : ": ", message));
}

Json parse_json(const std::string& text, const std::string& file) {
  // The keys of each open object, for finding equal ones: the library would keep the last.
  std::vector<std::set<std::string>> keys;
  const auto check = [&](int, Json::parse_event_t event, const Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(parsed.get<std::string>()).second)
      throw UsageError(fmt::format("{}: {} is twice in an object, expected once", file,
                                   parsed.dump(-1, ' ', false, Json::error_handler_t::replace)));
    return true;
  };
  try {
    return Json::parse(text, check);
  } catch (const Json::parse_error& error) {
    const size_t last = std::max<size_t>(error.byte, 1) - 1;
    throw UsageError(located(place_of(text, last, file),
                             last >= text.size()
                                 ? "the file ends before the JSON is complete"
                                 : fmt::format("found '{}', expected JSON", text[last])));
  } catch (const Json::exception& error) {
    throw UsageError(
        fmt::format("{}: {}, expected numbers that a double can hold", file, error.what()));
  }
}

void expect_type(const JsonValue& value, Json::value_t type, const std::string& what) {
  if (value.json().type() == type) return;
  value.fail(
      fmt::format("{} is {}, expected {}", what, type_name(value.json().type()), type_name(type)));
}

const std::string& text_of(const JsonValue& value, const std::string& what) {
  expect_type(value, Json::value_t::string, what);
  return value.json().get_ref<const std::string&>();
}

double number_of(const JsonValue& value, const std::string& what, double low, double high) {
  if (!value.json().is_number()) expect_type(value, Json::value_t::number_float, what);
  const double number = value.json().get<double>();
  if (number >= low && number <= high) return number;
  value.fail(fmt::format("{} is {}, expected a number {}", what, value.json().dump(),
                         std::isfinite(high) ? fmt::format("from {:g} to {:g}", low, high)
                                             : fmt::format("from {:g}", low)));
}

Fields::Fields(JsonValue value, std::string what, const std::vector<std::string>& names)
    : value_(std::move(value)), what_(std::move(what)) {
  expect_type(value_, Json::value_t::object, what_);
  for (const JsonMember& member : value_.members())
    if (std::find(names.begin(), names.end(), member.key) == names.end())
      member.value.fail(fmt::format("unknown key \"{}\" in {}, expected one of: {}", member.key,
                                    what_, fmt::join(names, ", ")));
}

JsonValue Fields::required(const std::string& name) const {
  if (std::optional<JsonValue> value = find(name)) return *std::move(value);
  value_.fail(fmt::format("{} has no \"{}\", expected one", what_, name));
}

std::string Fields::text(const std::string& name) const {
  return text_of(required(name), fmt::format("\"{}\"", name));
}

std::string Fields::text_or(const std::string& name, const std::string& otherwise) const {
  return has(name) ? text(name) : otherwise;
}

double Fields::number_or(const std::string& name, double otherwise, double low, double high) const {
  const std::optional<JsonValue> value = find(name);
  return value ? number_of(*value, fmt::format("\"{}\"", name), low, high) : otherwise;
}

uint64_t Fields::integer_or(const std::string& name, uint64_t otherwise, uint64_t low,
                            uint64_t high) const {
  const std::optional<JsonValue> value = find(name);
  if (!value) return otherwise;
  const Json& json = value->json();
  if (!json.is_number())
    expect_type(*value, Json::value_t::number_unsigned, fmt::format("\"{}\"", name));
  if (json.is_number_unsigned() && json.get<uint64_t>() >= low && json.get<uint64_t>() <= high)
    return json.get<uint64_t>();
  value->fail(fmt::format("\"{}\" is {}, expected a whole number from {} to {}", name, json.dump(),
                          low, high));
}

std::vector<JsonValue> Fields::list(const std::string& name) const {
  const std::optional<JsonValue> value = find(name);
  if (!value) return {};
  expect_type(*value, Json::value_t::array, fmt::format("\"{}\"", name));
  return value->items();
}

std::vector<std::string> Fields::texts(const std::string& name) const {
  const std::optional<JsonValue> value = find(name);
  if (value && value->json().is_string()) return {value->json().get<std::string>()};
  std::vector<std::string> result;
  for (const JsonValue& item : list(name))
    result.push_back(text_of(item, fmt::format("an item of \"{}\"", name)));
  return result;
}

}  // namespace nephroid

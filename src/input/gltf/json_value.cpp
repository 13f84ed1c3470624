// The only file with the JSON library; see json_value.h.
#include "input/gltf/json_value.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/counted.h"

namespace nephroid::gltf {

using nlohmann::json;

namespace {

/// A step of a JSON pointer (RFC 6901).
std::string escaped(const std::string& name) {
  std::string step;
  for (const char c : name) {
    if (c == '~')
      step += "~0";
    else if (c == '/')
      step += "~1";
    else
      step += c;
  }
  return step;
}

/// A nesting that no real file has. The parser does not recurse, but a deep file is an attack.
constexpr int kMaxJsonDepth = 200;

}  // namespace

SourceLocation JsonValue::where() const {
  return {std::make_shared<const std::string>(pointer_.empty() ? *file_ : *file_ + "#" + pointer_),
          0, 0};
}

void JsonValue::fail(const std::string& message) const {
  throw SceneError(where(), message);
}

std::optional<JsonValue> JsonValue::find(const std::string& name) const {
  if (!json_->is_object())
    fail(std::string("this is of type ") + json_->type_name() + ", expected an object");
  const auto found = json_->find(name);
  if (found == json_->end()) return std::nullopt;
  return below(*found, escaped(name));
}

JsonValue JsonValue::get(const std::string& name) const {
  const std::optional<JsonValue> member = find(name);
  if (!member) fail("\"" + name + "\" is missing");
  return *member;
}

std::optional<JsonValue> JsonValue::find_object(const std::string& name) const {
  std::optional<JsonValue> member = find(name);
  if (member && !member->json_->is_object())
    member->fail(std::string("this is of type ") + member->json_->type_name() +
                 ", expected an object");
  return member;
}

std::optional<JsonValue> JsonValue::find_array(const std::string& name) const {
  std::optional<JsonValue> member = find(name);
  if (member && !member->json_->is_array())
    member->fail(std::string("this is of type ") + member->json_->type_name() +
                 ", expected an array");
  return member;
}

bool JsonValue::is_equal(const JsonValue& other) const {
  return *json_ == *other.json_;
}

std::optional<JsonValue> JsonValue::extension(const std::string& name) const {
  const std::optional<JsonValue> extensions = find_object("extensions");
  return extensions ? extensions->find_object(name) : std::nullopt;
}

std::vector<JsonValue> JsonValue::elements() const {
  std::vector<JsonValue> list;
  if (!json_->is_array())
    fail(std::string("this is of type ") + json_->type_name() + ", expected an array");
  list.reserve(json_->size());
  for (size_t i = 0; i < json_->size(); ++i) list.push_back(below((*json_)[i], std::to_string(i)));
  return list;
}

std::vector<std::string> JsonValue::member_names() const {
  if (!json_->is_object())
    fail(std::string("this is of type ") + json_->type_name() + ", expected an object");
  std::vector<std::string> names;
  for (const auto& member : json_->items()) names.push_back(member.key());
  return names;
}

double JsonValue::number() const {
  if (!json_->is_number())
    fail(std::string("this is of type ") + json_->type_name() + ", expected a number");
  const auto value = json_->get<double>();
  if (!std::isfinite(value)) fail("this number is not finite, expected a finite one");
  return value;
}

std::string JsonValue::text() const {
  if (!json_->is_string())
    fail(std::string("this is of type ") + json_->type_name() + ", expected a string");
  return json_->get<std::string>();
}

size_t JsonValue::index() const {
  const double value = number();
  // Exact in double, and small enough to multiply by the size of an element.
  constexpr double kMaxIndex = 9e15;
  if (!(value >= 0.0 && value <= kMaxIndex && value == std::floor(value)))
    fail("this is " + json_->dump() + ", expected an integer of at least 0");
  return static_cast<size_t>(value);
}

double JsonValue::get_number(const std::string& name, double fallback) const {
  const std::optional<JsonValue> member = find(name);
  return member ? member->number() : fallback;
}

std::string JsonValue::get_text(const std::string& name, const std::string& fallback) const {
  const std::optional<JsonValue> member = find(name);
  return member ? member->text() : fallback;
}

bool JsonValue::get_flag(const std::string& name, bool fallback) const {
  const std::optional<JsonValue> member = find(name);
  if (!member) return fallback;
  if (!member->json_->is_boolean())
    member->fail(std::string("this is of type ") + member->json_->type_name() +
                 ", expected true or false");
  return member->json_->get<bool>();
}

std::optional<size_t> JsonValue::find_index(const std::string& name) const {
  const std::optional<JsonValue> member = find(name);
  if (!member) return std::nullopt;
  return member->index();
}

size_t JsonValue::get_index(const std::string& name) const {
  return get(name).index();
}

size_t JsonValue::get_index(const std::string& name, size_t fallback) const {
  return find_index(name).value_or(fallback);
}

std::vector<double> JsonValue::find_numbers(const std::string& name) const {
  const std::optional<JsonValue> member = find_array(name);
  std::vector<double> numbers;
  if (!member) return numbers;
  for (const JsonValue& element : member->elements()) numbers.push_back(element.number());
  return numbers;
}

std::vector<double> JsonValue::find_numbers(const std::string& name, size_t count) const {
  std::vector<double> numbers = find_numbers(name);
  if (find(name) && numbers.size() != count)
    get(name).fail("this array has " + counted(numbers.size(), "number") + ", expected " +
                   std::to_string(count));
  return numbers;
}

namespace {

/// Whether more than `limit` arrays and objects are open at some place of the text. A callback
/// of the parser would tell the depth, too, but with a callback the parser searches the whole array
/// after each object in it: quadratic time.
bool is_nested_deeper(std::string_view text, int limit) {
  int depth = 0;
  bool in_string = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string && c == '\\')
      ++i;
    else if (c == '"')
      in_string = !in_string;
    else if (!in_string && (c == '[' || c == '{'))
      ++depth;
    else if (!in_string && (c == ']' || c == '}'))
      --depth;
    if (depth > limit) return true;
  }
  return false;
}

json parse(std::string_view text, const std::string& file) {
  if (is_nested_deeper(text, kMaxJsonDepth))
    throw SceneError({std::make_shared<const std::string>(file), 0, 0},
                     "the JSON text is nested more than " + std::to_string(kMaxJsonDepth) +
                         " levels deep, expected fewer");
  try {
    return json::parse(text.begin(), text.end());
  } catch (const json::parse_error& error) {
    const size_t at = std::min(error.byte, text.size());
    const std::string_view before = text.substr(0, at);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const size_t start = before.rfind('\n') + 1;  // 0 if there is none
    throw SceneError({std::make_shared<const std::string>(file), static_cast<int>(line),
                      static_cast<int>(std::max<size_t>(1, at - start))},
                     "the text is not JSON from here on, expected the JSON text of a glTF file");
  } catch (const json::exception&) {
    throw SceneError(
        {std::make_shared<const std::string>(file), 0, 0},
        "a number of the JSON text is out of range, expected numbers that a double can hold");
  }
}

}  // namespace

JsonFile::JsonFile(std::string_view text, std::string file)
    : file_(std::move(file)), json_(std::make_unique<json>(parse(text, file_))) {
  if (!json_->is_object())
    throw SceneError({std::make_shared<const std::string>(file_), 1, 1},
                     "the JSON text is not an object, expected a glTF file");
}

JsonFile::~JsonFile() = default;

}  // namespace nephroid::gltf

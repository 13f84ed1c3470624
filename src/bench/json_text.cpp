// The library reads through an iterator that tells how far it came; a token ends there, and where
// it began follows from its text.
#include "bench/json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

namespace nephroid {
namespace {

constexpr size_t kDeepest = 64;

/// Walks over the text and leaves behind how far it came.
struct WatchedIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  const char* at = nullptr;
  const char** reached = nullptr;

  reference operator*() const { return *at; }
  WatchedIterator& operator++() {
    *reached = ++at;
    return *this;
  }
  WatchedIterator operator++(int) {
    const WatchedIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const WatchedIterator& other) const { return at == other.at; }
};

/// Line and column of offsets that only grow.
class Places {
 public:
  Places(const std::string& text, const std::string& file)
      : text_(text), file_(std::make_shared<const std::string>(file)) {}
  SourceLocation at(size_t offset) {
    if (offset < offset_) offset_ = line_start_ = 0, line_ = 1;
    for (; offset_ < std::min(offset, text_.size()); ++offset_)
      if (text_[offset_] == '\n') {
        ++line_;
        line_start_ = offset_ + 1;
      }
    return {file_, line_, static_cast<int>(offset - line_start_) + 1};
  }

 private:
  const std::string& text_;
  std::shared_ptr<const std::string> file_;
  size_t offset_ = 0, line_start_ = 0;
  int line_ = 1;
};

class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  TreeBuilder(const std::string& text, const std::string& file)
      : reached(text.data()), text_(text), places_(text, file) {}

  const char* reached;
  JsonValue root;

  bool null() override { return leaf(JsonValue::Kind::kNull, before(4)); }
  bool boolean(bool value) override {
    return leaf(JsonValue::Kind::kBoolean, before(value ? 4 : 5),
                [&](JsonValue& v) { v.boolean = value; });
  }
  bool number_integer(number_integer_t value) override { return number(double(value)); }
  bool number_unsigned(number_unsigned_t value) override { return number(double(value)); }
  bool number_float(number_float_t value, const string_t&) override { return number(value); }
  bool string(string_t& value) override {
    return leaf(JsonValue::Kind::kString, string_begin(),
                [&](JsonValue& v) { v.text = std::move(value); });
  }
  bool binary(binary_t&) override { return false; }
  bool start_object(size_t) override { return open(JsonValue::Kind::kObject); }
  bool start_array(size_t) override { return open(JsonValue::Kind::kArray); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    const SourceLocation where = places_.at(string_begin());
    JsonValue& object = *open_.back();
    if (object.find(name) != nullptr)
      fail_at(where, fmt::format("\"{}\" is given twice, expected it once", name));
    object.members.push_back({name, where, {}});
    return true;
  }
  bool parse_error(size_t position, const std::string&, const nlohmann::json::exception&) override {
    const size_t last = position > 0 ? position - 1 : 0;
    if (last >= text_.size())
      fail_at(places_.at(last), "the file ends in the middle of JSON, expected the rest of it");
    fail_at(places_.at(last), fmt::format("'{}' does not belong here, expected JSON", text_[last]));
  }

 private:
  size_t offset() const { return static_cast<size_t>(reached - text_.data()); }
  size_t before(size_t length) const { return offset() - length; }

  /// The opening quote of the string that ends here.
  size_t string_begin() const {
    size_t i = offset() - 2;
    for (;; --i) {
      if (text_[i] != '"') continue;
      size_t slashes = 0;
      while (slashes < i && text_[i - 1 - slashes] == '\\') ++slashes;
      if (slashes % 2 == 0) return i;
    }
  }

  bool number(double value) {
    const auto is_part = [&](size_t i) {
      const auto c = static_cast<unsigned char>(text_[i]);
      return std::isalnum(c) != 0 || c == '+' || c == '-' || c == '.';
    };
    // The reader of numbers has looked one character further, unless the text ended.
    size_t end = offset();
    if (!is_part(end - 1)) --end;
    size_t begin = end;
    while (begin > 0 && is_part(begin - 1)) --begin;
    return leaf(JsonValue::Kind::kNumber, begin, [&](JsonValue& v) {
      v.number = value;
      v.text = text_.substr(begin, end - begin);
    });
  }

  JsonValue& place() {
    if (open_.empty()) return root;
    JsonValue& parent = *open_.back();
    if (parent.kind == JsonValue::Kind::kObject) return parent.members.back().value;
    return parent.items.emplace_back();
  }
  JsonValue& put(JsonValue::Kind kind, size_t begin) {
    JsonValue& value = place();
    value.kind = kind;
    value.where = places_.at(begin);
    return value;
  }
  bool leaf(JsonValue::Kind kind, size_t begin) {
    put(kind, begin);
    return true;
  }
  template <class Fill>
  bool leaf(JsonValue::Kind kind, size_t begin, const Fill& fill) {
    fill(put(kind, begin));
    return true;
  }
  /// A parent has no new child while one of its children is open, so pointers stay good.
  bool open(JsonValue::Kind kind) {
    JsonValue& value = put(kind, before(1));
    if (open_.size() == kDeepest)
      fail_at(value.where, fmt::format("nested too deeply, expected at most {} levels", kDeepest));
    open_.push_back(&value);
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  const std::string& text_;
  Places places_;
  std::vector<JsonValue*> open_;
};

}  // namespace

const JsonValue* JsonValue::find(const std::string& key) const {
  for (const JsonMember& member : members)
    if (member.key == key) return &member.value;
  return nullptr;
}

std::string json_kind_name(JsonValue::Kind kind) {
  switch (kind) {
    case JsonValue::Kind::kNull:
      return "null";
    case JsonValue::Kind::kBoolean:
      return "true or false";
    case JsonValue::Kind::kNumber:
      return "a number";
    case JsonValue::Kind::kString:
      return "a string";
    case JsonValue::Kind::kArray:
      return "a list";
    case JsonValue::Kind::kObject:
      break;
  }
  return "an object";
}

JsonValue parse_json(const std::string& text, const std::string& file) {
  TreeBuilder builder(text, file);
  const WatchedIterator begin{text.data(), &builder.reached};
  const WatchedIterator end{text.data() + text.size(), &builder.reached};
  nlohmann::json::sax_parse(begin, end, &builder);
  return std::move(builder.root);
}

void fail_at(const SourceLocation& where, const std::string& message) {
  throw UsageError(located(where, message));
}

}  // namespace nephroid

// A value of a JSON file that knows its place. Its typed getters throw SceneError at the value's
// file and JSON pointer. It must not know what the members mean.
#pragma once

#include <array>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/errors.h"

namespace nephroid::gltf {

/// The text of a JSON file, parsed. Values refer to it and must not outlive it.
class JsonFile;

class JsonValue {
 public:
  JsonValue(const nlohmann::json& json, const std::string& file, std::string pointer)
      : json_(&json), file_(&file), pointer_(std::move(pointer)) {}

  /// The file and the JSON pointer, as in "model.gltf#/meshes/0".
  SourceLocation where() const;
  /// Throws SceneError here.
  [[noreturn]] void fail(const std::string& message) const;

  /// The member of any type; empty if absent. Throws if this is no object.
  std::optional<JsonValue> find(const std::string& name) const;
  /// The same for a member that must be there.
  JsonValue get(const std::string& name) const;
  /// The member, an object or an array; empty if absent.
  std::optional<JsonValue> find_object(const std::string& name) const;
  std::optional<JsonValue> find_array(const std::string& name) const;
  /// True if the other value has the same contents.
  bool is_equal(const JsonValue& other) const;
  /// The extension of this object; empty if absent.
  std::optional<JsonValue> extension(const std::string& name) const;

  /// The elements of an array.
  std::vector<JsonValue> elements() const;
  std::vector<std::string> member_names() const;

  double get_number(const std::string& name, double fallback) const;
  std::string get_text(const std::string& name, const std::string& fallback) const;
  bool get_flag(const std::string& name, bool fallback) const;
  /// An integer of at least 0; empty if absent.
  std::optional<size_t> find_index(const std::string& name) const;
  /// The same for a member that must be there.
  size_t get_index(const std::string& name) const;
  size_t get_index(const std::string& name, size_t fallback) const;
  /// The numbers of an array; empty if absent. Throws if there are not `count` of them.
  std::vector<double> find_numbers(const std::string& name, size_t count) const;
  /// The numbers of an array of any length; empty if absent.
  std::vector<double> find_numbers(const std::string& name) const;
  template <size_t N>
  std::array<double, N> get_numbers(const std::string& name,
                                    const std::array<double, N>& fallback) const {
    const std::vector<double> numbers = find_numbers(name, N);
    if (numbers.empty()) return fallback;
    std::array<double, N> result;
    std::copy(numbers.begin(), numbers.end(), result.begin());
    return result;
  }

  /// This value as a finite number, a text, or an integer of at least 0.
  double number() const;
  std::string text() const;
  size_t index() const;

 private:
  JsonValue below(const nlohmann::json& json, const std::string& step) const {
    return {json, *file_, pointer_ + "/" + step};
  }

  const nlohmann::json* json_;
  const std::string* file_;
  std::string pointer_;
};

class JsonFile {
 public:
  /// Parses `text`. Throws SceneError with the line of a syntax error, and if the text is no
  /// object.
  JsonFile(std::string_view text, std::string file);
  ~JsonFile();
  JsonFile(const JsonFile&) = delete;
  JsonFile& operator=(const JsonFile&) = delete;

  JsonValue root() const { return {*json_, file_, ""}; }
  const std::string& file() const { return file_; }

 private:
  std::string file_;
  std::unique_ptr<nlohmann::json> json_;
};

}  // namespace nephroid::gltf

// Small glTF files for tests: numbers become accessors in a data URI, the rest is JSON text.
#pragma once

#include <fmt/format.h>

#include <cstring>
#include <string>
#include <vector>

#include "input/gltf/gltf_reader.h"
#include "unit/input/temporary_directory.h"

namespace nephroid::testing {

inline std::string base64(const std::string& bytes) {
  constexpr const char* kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0u);
    for (size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : kLetters[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

template <class T>
std::string bytes_of_values(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

/// A glTF file under construction.
class GltfText {
 public:
  /// Adds bytes as a buffer view; returns its index.
  size_t add_view(const std::string& bytes, const std::string& members = "") {
    buffer_.resize((buffer_.size() + 3) / 4 * 4);
    add(views_, fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{}{}}})", buffer_.size(),
                            bytes.size(), members));
    buffer_ += bytes;
    return view_count_++;
  }
  /// Adds values as an accessor; `type` and `component` are glTF's. Returns its index.
  template <class T>
  size_t add_accessor(const std::vector<T>& values, const std::string& type, int component,
                      size_t width, const std::string& members = "") {
    const size_t view = add_view(bytes_of_values(values));
    return add_raw_accessor(
        fmt::format(R"("bufferView":{},"componentType":{},"count":{},"type":"{}"{})", view,
                    component, values.size() / width, type, members));
  }
  size_t add_raw_accessor(const std::string& members) {
    add(accessors_, "{" + members + "}");
    return accessor_count_++;
  }
  size_t floats(const std::vector<float>& v, const std::string& type, size_t width) {
    return add_accessor(v, type, 5126, width);
  }
  size_t vec3(const std::vector<float>& v) { return floats(v, "VEC3", 3); }
  size_t vec2(const std::vector<float>& v) { return floats(v, "VEC2", 2); }

  const std::string& buffer() const { return buffer_; }
  /// The JSON text with the other members of the root.
  std::string text(const std::string& members) const {
    return with_buffer(members, fmt::format(R"("uri":"data:application/octet-stream;base64,{}",)",
                                            base64(buffer_)));
  }
  /// The same as a GLB file.
  std::string glb(const std::string& members) const {
    std::string json = with_buffer(members, "");
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string binary = buffer_;
    binary.resize((binary.size() + 3) / 4 * 4);
    const auto word = [](size_t value) {
      return bytes_of_values(std::vector<uint32_t>{static_cast<uint32_t>(value)});
    };
    return "glTF" + word(2) + word(12 + 8 + json.size() + 8 + binary.size()) + word(json.size()) +
           "JSON" + json + word(binary.size()) + std::string("BIN\0", 4) + binary;
  }

 private:
  static void add(std::string& list, const std::string& item) {
    list += (list.empty() ? "" : ",") + item;
  }
  std::string with_buffer(const std::string& members, const std::string& uri) const {
    std::string all = R"({"asset":{"version":"2.0"})";
    if (!buffer_.empty())
      all += fmt::format(R"(,"buffers":[{{{}"byteLength":{}}}],"bufferViews":[{}])", uri,
                         buffer_.size(), views_);
    if (!accessors_.empty()) all += R"(,"accessors":[)" + accessors_ + "]";
    return all + (members.empty() ? "" : "," + members) + "}";
  }

  std::string buffer_, views_, accessors_;
  size_t view_count_ = 0, accessor_count_ = 0;
};

/// A triangle at (0,0,0), (1,0,0), (0,1,0) and what is around it.
struct TriangleScene {
  GltfText file;
  std::string attributes;         ///< further ones: ,"NAME":accessor
  std::string primitive_members;  ///< further ones of the primitive: ,"material":0 ...
  std::string node_members;       ///< further ones of the node with the mesh

  TriangleScene() { positions_ = file.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0}); }
  std::string members(const std::string& more = "") const {
    return fmt::format(
        R"("nodes":[{{"mesh":0{}}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":{}{}}}{}}}]}}]{})",
        node_members, positions_, attributes, primitive_members, more);
  }

 private:
  size_t positions_;
};

struct ReadScene {
  SceneDescription scene;
  std::vector<Warning> warnings;
};

/// Reads a file of these contents.
inline ReadScene read_gltf_text(const std::string& contents, const ImportOptions& options = {},
                                const std::string& name = "scene.gltf") {
  const TemporaryDirectory folder;
  Diagnostics diagnostics;
  ReadScene result{read_gltf(folder.write(name, contents), options, diagnostics), {}};
  result.warnings = diagnostics.warnings();
  return result;
}

/// The message of the error that reading gives, without the folder; empty if there is none.
inline std::string gltf_error(const std::string& contents, const ImportOptions& options = {},
                              const std::string& name = "scene.gltf") {
  const TemporaryDirectory folder;
  Diagnostics diagnostics;
  try {
    read_gltf(folder.write(name, contents), options, diagnostics);
  } catch (const Error& error) {
    std::string message = error.what();
    for (size_t at; (at = message.find(folder.path() + "/")) != std::string::npos;)
      message.erase(at, folder.path().size() + 1);
    return message;
  }
  return "";
}

/// The numbers, or the string, of a parameter; empty if it is absent.
inline std::vector<double> numbers_of(const ParameterSet& set, const std::string& name) {
  const Parameter* p = set.find(name);
  return p ? p->numbers : std::vector<double>();
}
inline std::string string_of(const ParameterSet& set, const std::string& name) {
  const Parameter* p = set.find(name);
  return p && !p->strings.empty() ? p->strings[0] : "";
}
inline double number_of(const ParameterSet& set, const std::string& name) {
  const std::vector<double> numbers = numbers_of(set, name);
  return numbers.size() == 1 ? numbers[0] : std::nan("");
}
inline bool flag_of(const ParameterSet& set, const std::string& name) {
  const Parameter* p = set.find(name);
  return p && !p->bools.empty() && p->bools[0];
}

}  // namespace nephroid::testing

// An opened glTF file: its JSON lists, and the bytes of its buffers and buffer views, each checked
// against what is really there. It must not know what bytes mean.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "input/gltf/json_value.h"
#include "input/import_options.h"
#include "input/scene_files.h"

namespace nephroid::gltf {

using Bytes = std::span<const std::byte>;

class Document {
 public:
  /// Reads the file and parses its JSON. Buffers are read when they are first used.
  Document(const std::string& path, SceneFiles& files, const ImportOptions& options,
           Diagnostics& diagnostics);

  JsonValue root() const { return json_->root(); }
  const std::string& path() const { return path_; }
  SceneFiles& files() const { return files_; }
  const ImportOptions& options() const { return options_; }
  Diagnostics& diagnostics() const { return diagnostics_; }

  /// The elements of a list at the root, such as "meshes"; none if it is absent.
  const std::vector<JsonValue>& list(const std::string& name);
  /// The element of a list. Throws SceneError at `wanted_by` if the index is out of range.
  const JsonValue& item(const std::string& name, size_t index, const JsonValue& wanted_by);
  /// The element that the member `member` of `wanted_by` names by its index.
  const JsonValue& item_of(const std::string& name, const JsonValue& wanted_by,
                           const std::string& member);

  /// The bytes of a buffer view, decompressed if need be. They live as long as the document.
  Bytes buffer_view(size_t index, const JsonValue& wanted_by);
  /// The stride of the elements in a buffer view, in bytes; 0 if they are tightly packed.
  size_t buffer_view_stride(size_t index, const JsonValue& wanted_by);

  /// A part of a buffer. Throws SceneError at `wanted_by` if it reaches beyond the end.
  Bytes buffer_part(size_t buffer, size_t offset, size_t length, const JsonValue& wanted_by);

  /// The bytes of a "uri" member, a data URI or a file. The file is part of the scene's hash.
  std::string bytes_of_uri(const JsonValue& uri);

  /// Counts memory of the scene that no bytes of the file stand for. Throws SceneError at
  /// `wanted_by` once the whole file claims too much.
  void claim_memory(size_t bytes, const JsonValue& wanted_by);

 private:
  Bytes buffer(size_t index, const JsonValue& wanted_by);
  std::string load_buffer(size_t index, const JsonValue& description);

  std::string path_;
  SceneFiles& files_;
  const ImportOptions& options_;
  Diagnostics& diagnostics_;
  std::string file_bytes_;
  std::string_view binary_chunk_;
  std::unique_ptr<JsonFile> json_;
  std::map<std::string, std::vector<JsonValue>> lists_;
  std::map<size_t, std::string> buffers_;                  ///< loaded buffers by index
  std::map<size_t, std::vector<std::byte>> decompressed_;  ///< decompressed views by index
  size_t claimed_ = 0;                                     ///< bytes of claim_memory
};

}  // namespace nephroid::gltf

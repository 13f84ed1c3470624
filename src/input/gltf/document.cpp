#include "input/gltf/document.h"

#include "core/counted.h"
#include "input/contained_file.h"
#include "input/gltf/container.h"
#include "input/gltf/meshopt.h"
#include "input/gltf/uri.h"

namespace nephroid::gltf {

Document::Document(const std::string& path, SceneFiles& files, const ImportOptions& options,
                   Diagnostics& diagnostics)
    : path_(path),
      files_(files),
      options_(options),
      diagnostics_(diagnostics),
      file_bytes_(files.read(path)) {
  const SourceLocation where{std::make_shared<const std::string>(path), 0, 0};
  const Container container = read_container(file_bytes_, where);
  binary_chunk_ = container.binary;
  json_ = std::make_unique<JsonFile>(container.json, path);
}

const std::vector<JsonValue>& Document::list(const std::string& name) {
  const auto known = lists_.find(name);
  if (known != lists_.end()) return known->second;
  const std::optional<JsonValue> array = root().find_array(name);
  return lists_.emplace(name, array ? array->elements() : std::vector<JsonValue>()).first->second;
}

const JsonValue& Document::item(const std::string& name, size_t index, const JsonValue& wanted_by) {
  const std::vector<JsonValue>& all = list(name);
  if (index >= all.size())
    wanted_by.fail("index " + std::to_string(index) + " into \"" + name +
                   "\" is out of range, expected an index below " + std::to_string(all.size()));
  return all[index];
}

const JsonValue& Document::item_of(const std::string& name, const JsonValue& wanted_by,
                                   const std::string& member) {
  const JsonValue reference = wanted_by.get(member);
  return item(name, reference.index(), reference);
}

std::string Document::bytes_of_uri(const JsonValue& uri) {
  const std::string text = uri.text();
  if (is_data_uri(text)) return data_of_uri(text, uri);
  const std::string name =
      contained_file(files_, file_of_uri(text, uri), options_.allow_outside, uri.where());
  try {
    return files_.read(files_.path_of(name));
  } catch (const IoError& error) {
    uri.fail(error.what());
  }
}

std::string Document::load_buffer(size_t index, const JsonValue& description) {
  if (const std::optional<JsonValue> uri = description.find("uri")) return bytes_of_uri(*uri);
  if (index == 0 && !binary_chunk_.empty()) return std::string();  // see buffer()
  description.fail("this buffer has no \"uri\" and the file has no binary chunk for it");
}

Bytes Document::buffer(size_t index, const JsonValue& wanted_by) {
  const JsonValue& description = item("buffers", index, wanted_by);
  if (!buffers_.contains(index)) buffers_[index] = load_buffer(index, description);
  const bool is_chunk = index == 0 && !binary_chunk_.empty() && !description.find("uri");
  const std::string_view bytes = is_chunk ? binary_chunk_ : std::string_view(buffers_[index]);
  const size_t claimed = description.get_index("byteLength");
  if (claimed > bytes.size())
    description.fail("this buffer claims " + counted(claimed, "byte") + ", more than the " +
                     std::to_string(bytes.size()) + " there are");
  return std::as_bytes(std::span(bytes.data(), claimed));
}

Bytes Document::buffer_part(size_t index, size_t offset, size_t length,
                            const JsonValue& wanted_by) {
  const Bytes all = buffer(index, wanted_by);
  if (offset > all.size() || length > all.size() - offset)
    wanted_by.fail("bytes " + std::to_string(offset) + " to " + std::to_string(offset + length) +
                   " reach beyond the buffer, which has " + counted(all.size(), "byte"));
  return all.subspan(offset, length);
}

void Document::claim_memory(size_t bytes, const JsonValue& wanted_by) {
  constexpr size_t kMaxClaim = size_t{1} << 29;
  if (bytes > kMaxClaim - claimed_)
    wanted_by.fail("the file claims more than " + std::to_string(kMaxClaim >> 20) +
                   " MB by elements without data, expected data for so many");
  claimed_ += bytes;
}

Bytes Document::buffer_view(size_t index, const JsonValue& wanted_by) {
  const JsonValue& view = item("bufferViews", index, wanted_by);
  if (const std::optional<JsonValue> packed = view.extension("EXT_meshopt_compression")) {
    const auto known = decompressed_.find(index);
    if (known != decompressed_.end()) return known->second;
    return decompressed_[index] = decompress_meshopt(*this, *packed);
  }
  return buffer_part(view.get_index("buffer"), view.get_index("byteOffset", 0),
                     view.get_index("byteLength"), view);
}

size_t Document::buffer_view_stride(size_t index, const JsonValue& wanted_by) {
  const JsonValue& view = item("bufferViews", index, wanted_by);
  const std::optional<JsonValue> packed = view.extension("EXT_meshopt_compression");
  return packed ? packed->get_index("byteStride") : view.get_index("byteStride", 0);
}

}  // namespace nephroid::gltf

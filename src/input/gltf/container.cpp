#include "input/gltf/container.h"

#include <cstdint>
#include <cstring>

namespace nephroid::gltf {
namespace {

constexpr size_t kGlbHeader = 12, kChunkHeader = 8;
constexpr uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;

/// A little-endian word, as all that glTF stores.
uint32_t word_at(std::string_view bytes, size_t at) {
  uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

}  // namespace

Container read_container(std::string_view bytes, const SourceLocation& file) {
  if (bytes.empty()) throw SceneError(file, "the file is empty, expected a glTF scene");
  if (!bytes.starts_with("glTF")) return {bytes, {}};
  if (bytes.size() < kGlbHeader)
    throw SceneError(file, "the GLB header is cut off, expected 12 bytes");
  if (word_at(bytes, 4) != 2)
    throw SceneError(file, "this GLB file has version " + std::to_string(word_at(bytes, 4)) +
                               ", expected version 2");
  const uint32_t length = word_at(bytes, 8);
  if (length > bytes.size())
    throw SceneError(file, "the GLB file is cut off: its header claims " + std::to_string(length) +
                               " bytes, there are " + std::to_string(bytes.size()));
  Container container;
  for (size_t at = kGlbHeader; at + kChunkHeader <= length;) {
    const size_t size = word_at(bytes, at), start = at + kChunkHeader;
    const uint32_t type = word_at(bytes, at + 4);
    if (size > length - start)
      throw SceneError(file, "a chunk of the GLB file claims " + std::to_string(size) +
                                 " bytes, there are " + std::to_string(length - start) + " left");
    const std::string_view chunk = bytes.substr(start, size);
    if (type == kJsonChunk && at == kGlbHeader) container.json = chunk;
    if (type == kBinaryChunk && container.binary.empty()) container.binary = chunk;
    at = start + size;
  }
  if (container.json.empty())
    throw SceneError(file,
                     "the first chunk of the GLB file is not JSON, expected the scene's JSON");
  return container;
}

}  // namespace nephroid::gltf

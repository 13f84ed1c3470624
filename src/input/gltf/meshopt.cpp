// The only file with meshoptimizer; see meshopt.h.
#include "input/gltf/meshopt.h"

#include <meshoptimizer.h>

#include "input/gltf/document.h"

namespace nephroid::gltf {
namespace {

struct PackedView {
  Bytes bytes;
  size_t count, stride;
  std::string mode, filter;
};

/// The most elements that the packed bytes can hold: the codecs spend at least two bits on 16 bytes
/// of vertices, and a byte on a triangle or an index. A larger claim is found before memory is
/// allocated.
size_t max_count(const PackedView& view) {
  if (view.mode == "TRIANGLES") return 3 * view.bytes.size();
  if (view.mode == "INDICES") return view.bytes.size();
  return 64 * view.bytes.size() / view.stride;
}

PackedView read_description(Document& document, const JsonValue& extension) {
  PackedView view{
      document.buffer_part(extension.get_index("buffer"), extension.get_index("byteOffset", 0),
                           extension.get_index("byteLength"), extension),
      extension.get_index("count"), extension.get_index("byteStride"), extension.get("mode").text(),
      extension.get_text("filter", "NONE")};
  if (view.stride == 0 || view.stride > 256)
    extension.get("byteStride")
        .fail("this is " + std::to_string(view.stride) + ", expected a stride from 1 to 256 bytes");
  if (view.count > max_count(view))
    extension.get("count").fail("this claims more elements than the packed bytes can hold");
  return view;
}

/// Decodes the elements. Returns false if the bytes are damaged.
bool decode(const PackedView& view, const JsonValue& extension, std::byte* target) {
  const auto* source = reinterpret_cast<const unsigned char*>(view.bytes.data());
  const size_t size = view.bytes.size();
  if (view.mode == "ATTRIBUTES") {
    if (view.stride % 4 != 0)
      extension.get("byteStride")
          .fail("this is " + std::to_string(view.stride) + ", expected a multiple of 4");
    return meshopt_decodeVertexBuffer(target, view.count, view.stride, source, size) == 0;
  }
  if (view.stride != 2 && view.stride != 4)
    extension.get("byteStride")
        .fail("this is " + std::to_string(view.stride) + ", expected 2 or 4 bytes for an index");
  if (view.mode == "TRIANGLES") {
    if (view.count % 3 != 0)
      extension.get("count").fail("this is " + std::to_string(view.count) +
                                  ", expected a multiple of 3");
    return meshopt_decodeIndexBuffer(target, view.count, view.stride, source, size) == 0;
  }
  if (view.mode == "INDICES")
    return meshopt_decodeIndexSequence(target, view.count, view.stride, source, size) == 0;
  extension.get("mode").fail("unknown mode \"" + view.mode +
                             "\", expected ATTRIBUTES, TRIANGLES or INDICES");
}

void apply_filter(const PackedView& view, const JsonValue& extension, std::byte* target) {
  if (view.filter == "NONE") return;
  const JsonValue stride = extension.get("byteStride");
  if (view.filter == "OCTAHEDRAL") {
    if (view.stride != 4 && view.stride != 8)
      stride.fail("this is " + std::to_string(view.stride) +
                  ", expected 4 or 8 for the filter OCTAHEDRAL");
    meshopt_decodeFilterOct(target, view.count, view.stride);
  } else if (view.filter == "QUATERNION") {
    if (view.stride != 8)
      stride.fail("this is " + std::to_string(view.stride) +
                  ", expected 8 for the filter QUATERNION");
    meshopt_decodeFilterQuat(target, view.count, view.stride);
  } else if (view.filter == "EXPONENTIAL") {
    if (view.stride % 4 != 0)
      stride.fail("this is " + std::to_string(view.stride) +
                  ", expected a multiple of 4 for the filter EXPONENTIAL");
    meshopt_decodeFilterExp(target, view.count, view.stride);
  } else {
    extension.get("filter").fail("unknown filter \"" + view.filter +
                                 "\", expected NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL");
  }
}

}  // namespace

std::vector<std::byte> decompress_meshopt(Document& document, const JsonValue& extension) {
  const PackedView view = read_description(document, extension);
  std::vector<std::byte> bytes(view.count * view.stride);
  if (!decode(view, extension, bytes.data()))
    extension.fail("the packed bytes are damaged, expected data of meshoptimizer");
  apply_filter(view, extension, bytes.data());
  return bytes;
}

}  // namespace nephroid::gltf

#include "input/gltf/vertices.h"

#include <cmath>

#include "core/counted.h"
#include "input/gltf/draco.h"

namespace nephroid::gltf {
namespace {

enum Mode : size_t { kTriangles = 4, kStrip = 5, kFan = 6 };

/// Attributes in accessors.
class AccessorSource final : public AttributeSource {
 public:
  AccessorSource(Document& document, JsonValue primitive)
      : document_(document),
        primitive_(std::move(primitive)),
        attributes_(primitive_.get("attributes")) {}

  std::optional<NumberArray> find(const std::string& name) override {
    const std::optional<JsonValue> reference = attributes_.find(name);
    if (!reference) return std::nullopt;
    return read_accessor(document_, reference->index(), *reference);
  }
  std::optional<std::vector<uint32_t>> indices() override {
    const std::optional<JsonValue> reference = primitive_.find("indices");
    if (!reference) return std::nullopt;
    return read_integers(document_, reference->index(), *reference);
  }

 private:
  Document& document_;
  JsonValue primitive_, attributes_;
};

std::vector<Vec3f> to_vectors(const NumberArray& array) {
  std::vector<Vec3f> vectors(array.count);
  for (size_t i = 0; i < array.count; ++i)
    vectors[i] = Vec3f(array[i][0], array[i][1], array[i][2]);
  return vectors;
}

/// glTF's v runs downwards from the top of the image.
std::vector<Vec2f> to_uvs(const NumberArray& array) {
  std::vector<Vec2f> uvs(array.count);
  for (size_t i = 0; i < array.count; ++i) uvs[i] = Vec2f(array[i][0], 1.0f - array[i][1]);
  return uvs;
}

/// The corners of the triangles of a list, a strip or a fan of `count` vertices.
std::vector<uint32_t> corners(size_t mode, size_t count) {
  std::vector<uint32_t> list;
  const auto n = static_cast<uint32_t>(count);
  if (mode == kTriangles) {
    list.resize(n / 3 * 3);
    for (uint32_t i = 0; i < list.size(); ++i) list[i] = i;
  }
  for (uint32_t i = 0; mode == kStrip && i + 2 < n; ++i)
    list.insert(list.end(), {i, i + 1 + i % 2, i + 2 - i % 2});
  for (uint32_t i = 0; mode == kFan && i + 2 < n; ++i) list.insert(list.end(), {i + 1, i + 2, 0});
  return list;
}

std::vector<uint32_t> read_triangles(AttributeSource& source, const JsonValue& primitive,
                                     size_t vertices) {
  // Draco stores triangles, whatever the mode was.
  const bool is_draco = primitive.extension("KHR_draco_mesh_compression").has_value();
  const size_t mode = is_draco ? kTriangles : primitive.get_index("mode", kTriangles);
  const std::optional<std::vector<uint32_t>> indices = source.indices();
  std::vector<uint32_t> triangles = corners(mode, indices ? indices->size() : vertices);
  if (!indices) return triangles;
  for (uint32_t& corner : triangles) {
    corner = (*indices)[corner];
    if (corner >= vertices)
      primitive.fail("vertex index " + std::to_string(corner) + " is out of range, there are " +
                     counted(vertices, "vertex", "vertices"));
  }
  return triangles;
}

/// Reads the named attributes of a primitive, checked to have one element per vertex.
class VertexReader {
 public:
  VertexReader(AttributeSource& source, const JsonValue& primitive, size_t count)
      : source_(source), primitive_(primitive), count_(count) {}

  std::optional<NumberArray> find(const std::string& name, size_t min_width, size_t max_width) {
    std::optional<NumberArray> array = source_.find(name);
    if (!array) return std::nullopt;
    if (array->count != count_)
      primitive_.fail(name + " has " + counted(array->count, "element") + ", expected " +
                      std::to_string(count_) + ", one per vertex");
    if (array->width < min_width || array->width > max_width)
      primitive_.fail(name + " has " + counted(array->width, "number") + " per element, expected " +
                      (min_width < max_width ? std::to_string(min_width) + " to " : "") +
                      std::to_string(max_width));
    return array;
  }

 private:
  AttributeSource& source_;
  const JsonValue& primitive_;
  size_t count_;
};

void read_uvs(VertexReader& reader, const JsonValue& primitive, const WantedAttributes& wanted,
              Vertices& vertices, Diagnostics& diagnostics) {
  for (size_t i = 0; i < wanted.uv_sets.size(); ++i) {
    const std::string name = "TEXCOORD_" + std::to_string(wanted.uv_sets[i]);
    if (const auto array = reader.find(name, 2, 2)) {
      vertices.uvs[i] = to_uvs(*array);
      continue;
    }
    diagnostics.warn(primitive.where(), "the material's textures need " + name +
                                            ", which the mesh does not have: 0 is used");
    vertices.uvs[i].assign(vertices.positions.size(), Vec2f(0, 1));
  }
}

void read_tangents(VertexReader& reader, Vertices& vertices) {
  const std::optional<NumberArray> array = reader.find("TANGENT", 4, 4);
  if (!array) return;
  vertices.tangents = to_vectors(*array);
  for (size_t i = 0; i < array->count; ++i) vertices.tangent_signs.push_back((*array)[i][3]);
}

void read_colors(VertexReader& reader, Vertices& vertices) {
  const std::optional<NumberArray> array = reader.find("COLOR_0", 3, 4);
  if (!array) return;
  for (size_t i = 0; i < array->count; ++i) {
    const float* c = (*array)[i];
    vertices.colors.push_back({c[0], c[1], c[2], array->width == 4 ? c[3] : 1.0f});
  }
}

}  // namespace

std::unique_ptr<AttributeSource> open_attributes(Document& document, const JsonValue& primitive) {
  if (const auto packed = primitive.extension("KHR_draco_mesh_compression"))
    return open_draco(document, primitive, *packed);
  return std::make_unique<AccessorSource>(document, primitive);
}

bool has_area(const JsonValue& primitive) {
  const size_t mode = primitive.get_index("mode", kTriangles);
  if (mode > kFan)
    primitive.get("mode").fail("unknown mode " + std::to_string(mode) + ", expected 0 to 6");
  return mode >= kTriangles;
}

Vertices read_vertices(AttributeSource& source, const JsonValue& primitive,
                       const WantedAttributes& wanted, Diagnostics& diagnostics) {
  const std::optional<NumberArray> positions = source.find("POSITION");
  Vertices vertices;
  if (!positions) {
    diagnostics.warn(primitive.where(), "this primitive has no POSITION, it is left out");
    return vertices;
  }
  if (positions->width != 3)
    primitive.fail("POSITION has " + counted(positions->width, "number") +
                   " per element, expected 3");
  vertices.positions = to_vectors(*positions);
  vertices.triangles = read_triangles(source, primitive, positions->count);
  VertexReader reader(source, primitive, positions->count);
  if (const auto normals = reader.find("NORMAL", 3, 3)) vertices.normals = to_vectors(*normals);
  read_uvs(reader, primitive, wanted, vertices, diagnostics);
  if (wanted.tangents) read_tangents(reader, vertices);
  if (wanted.colors) read_colors(reader, vertices);
  return vertices;
}

}  // namespace nephroid::gltf

#include "input/mitsuba/serialized_mesh.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>

#include "input/mitsuba/zlib_stream.h"

namespace nephroid::mitsuba {
namespace {

constexpr uint16_t kSerializedMagic = 0x041c;
enum Flags : uint32_t {
  kNormals = 0x0001,
  kUvs = 0x0002,
  kColors = 0x0008,
  kFaceNormals = 0x0010,
  kSinglePrecision = 0x1000,
  kDoublePrecision = 0x2000,
};

/// A fault of the file, without its name.
struct BadFile : std::runtime_error {
  using std::runtime_error::runtime_error;
};

template <class Value>
Value value_at(std::string_view bytes, size_t offset) {
  if (offset > bytes.size() || bytes.size() - offset < sizeof(Value))
    throw BadFile("the file ends too early");
  Value value;
  std::memcpy(&value, bytes.data() + offset, sizeof(Value));
  return value;
}

int version_at(std::string_view bytes, size_t offset) {
  if (value_at<uint16_t>(bytes, offset) != kSerializedMagic)
    throw BadFile("the bytes at a mesh are not 1c 04, expected a .serialized file");
  const int version = value_at<uint16_t>(bytes, offset + 2);
  if (version != 3 && version != 4)
    throw BadFile("the file has version " + std::to_string(version) + ", expected 3 or 4");
  return version;
}

/// The packed data of a mesh, behind its four bytes of header. The table at the end of the file has
/// offsets of 4 bytes in version 3 and of 8 bytes in version 4.
std::string_view packed_mesh(std::string_view bytes, int version, int index) {
  const size_t entry = version == 3 ? 4 : 8;
  const uint32_t count =
      value_at<uint32_t>(bytes, bytes.size() - std::min<size_t>(bytes.size(), 4));
  if (bytes.size() < 8 || count > (bytes.size() - 4) / entry)
    throw BadFile("the file claims to hold " + std::to_string(count) +
                  " meshes, expected fewer for its size");
  if (index < 0 || static_cast<uint32_t>(index) >= count)
    throw BadFile("there is no mesh " + std::to_string(index) + ", expected 0 to " +
                  std::to_string(static_cast<int64_t>(count) - 1));
  const size_t table = bytes.size() - 4 - count * entry;
  const auto offset_of = [&](size_t i) -> uint64_t {
    return entry == 4 ? value_at<uint32_t>(bytes, table + i * entry)
                      : value_at<uint64_t>(bytes, table + i * entry);
  };
  const uint64_t begin = offset_of(static_cast<size_t>(index));
  const uint64_t end =
      static_cast<uint32_t>(index) + 1 < count ? offset_of(static_cast<size_t>(index) + 1) : table;
  if (begin >= table || end > table || end < begin || end - begin < 4)
    throw BadFile("the offset of mesh " + std::to_string(index) + " is out of range");
  version_at(bytes, begin);
  return bytes.substr(begin + 4, end - begin - 4);
}

/// `per_vertex` numbers for each vertex, in the precision of the file.
std::vector<float> read_numbers(ZlibStream& stream, uint32_t flags, uint64_t vertices,
                                uint64_t per_vertex) {
  if (!(flags & kDoublePrecision)) return stream.read_values<float>(vertices * per_vertex);
  const std::vector<double> numbers = stream.read_values<double>(vertices * per_vertex);
  std::vector<float> result(numbers.size());
  std::transform(numbers.begin(), numbers.end(), result.begin(),
                 [](double v) { return static_cast<float>(v); });
  return result;
}

std::vector<Vec3f> vectors(const std::vector<float>& numbers) {
  std::vector<Vec3f> result(numbers.size() / 3);
  for (size_t i = 0; i < result.size(); ++i)
    result[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
  return result;
}

std::vector<Vec2f> pairs(const std::vector<float>& numbers) {
  std::vector<Vec2f> result(numbers.size() / 2);
  for (size_t i = 0; i < result.size(); ++i) result[i] = {numbers[2 * i], numbers[2 * i + 1]};
  return result;
}

void skip_name(ZlibStream& stream) {
  constexpr int kMaxName = 1 << 16;
  for (int i = 0; i < kMaxName; ++i)
    if (stream.read_value<char>() == '\0') return;
  throw BadFile("the name of a mesh has no end");
}

SerializedMesh read_mesh(std::string_view packed, int version) {
  ZlibStream stream(packed);
  const auto flags = stream.read_value<uint32_t>();
  // Old files have neither flag and are in single precision.
  if ((flags & kSinglePrecision) && (flags & kDoublePrecision))
    throw BadFile("a mesh has flags " + std::to_string(flags) +
                  ", expected those of single or of double precision");
  if (version == 4) skip_name(stream);
  const auto vertices = stream.read_value<uint64_t>(), triangles = stream.read_value<uint64_t>();
  constexpr uint64_t kMaxVertices = 0xffffffff, kMaxTriangles = uint64_t{1} << 34;
  if (vertices > kMaxVertices || triangles > kMaxTriangles)
    throw BadFile("a mesh claims " + std::to_string(vertices) + " vertices and " +
                  std::to_string(triangles) +
                  " triangles, expected fewer than 2^32 and at most 2^34");
  SerializedMesh result;
  result.has_face_normals = (flags & kFaceNormals) != 0;
  MeshData& mesh = result.mesh;
  mesh.positions = vectors(read_numbers(stream, flags, vertices, 3));
  if (flags & kNormals) mesh.normals = vectors(read_numbers(stream, flags, vertices, 3));
  if (flags & kUvs) mesh.uvs = pairs(read_numbers(stream, flags, vertices, 2));
  if (flags & kColors)
    for (const Vec3f& color : vectors(read_numbers(stream, flags, vertices, 3)))
      mesh.colors.push_back({color.x, color.y, color.z, 1});
  mesh.triangles = stream.read_values<uint32_t>(3 * triangles);
  return result;
}

void check(const MeshData& mesh) {
  for (const uint32_t i : mesh.triangles)
    if (i >= mesh.positions.size())
      throw BadFile("a triangle has vertex " + std::to_string(i) + ", expected one of " +
                    std::to_string(mesh.positions.size()));
  for (const Vec3f& p : mesh.positions)
    if (!is_finite(p)) throw BadFile("a position is not finite, expected finite numbers");
  for (const auto& color : mesh.colors)
    for (const float c : color)
      if (!(c >= 0) || !std::isfinite(c))
        throw BadFile("a colour is negative or not finite, expected finite numbers from 0");
}

}  // namespace

SerializedMesh read_serialized(std::string_view bytes, int index, const SourceLocation& where) {
  try {
    const int version = version_at(bytes, 0);
    SerializedMesh result = read_mesh(packed_mesh(bytes, version, index), version);
    check(result.mesh);
    for (Vec2f& uv : result.mesh.uvs)
      if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) uv = {0, 0};
    return result;
  } catch (const BadFile& fault) {
    throw SceneError(where, std::string("the file cannot be used: ") + fault.what());
  } catch (const ZlibError& fault) {
    throw SceneError(where, "mesh " + std::to_string(index) + " of the file: " + fault.what());
  }
}

}  // namespace nephroid::mitsuba

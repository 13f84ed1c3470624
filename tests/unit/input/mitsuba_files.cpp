#include "unit/input/mitsuba_files.h"

#include <zlib.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

namespace nephroid::testing {
namespace {

template <class Value>
void append(std::string& bytes, const Value& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(Value));
}

template <class Vec>
void append_numbers(std::string& bytes, const std::vector<Vec>& vectors, bool is_double) {
  for (const Vec& v : vectors)
    for (unsigned int i = 0; i < Vec::dimensions(); ++i) {
      const float x = v[static_cast<int>(i)];
      if (is_double)
        append(bytes, static_cast<double>(x));
      else
        append(bytes, x);
    }
}

std::string packed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string result(size, '\0');
  if (compress(reinterpret_cast<Bytef*>(result.data()), &size,
               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()) != Z_OK)
    throw std::runtime_error("zlib does not compress");
  result.resize(size);
  return result;
}

std::string mesh_bytes(const SerializedSample& m) {
  std::string body;
  append(body, static_cast<uint32_t>((m.normals.empty() ? 0 : 1) | (m.uvs.empty() ? 0 : 2) |
                                     (m.colors.empty() ? 0 : 8) | (m.has_face_normals ? 16 : 0) |
                                     (m.is_double ? 0x2000 : 0x1000)));
  if (m.version == 4) body += std::string("name") + '\0';
  append(body, static_cast<uint64_t>(m.positions.size()));
  append(body, m.claimed_triangles > 0 ? m.claimed_triangles
                                       : static_cast<uint64_t>(m.triangles.size() / 3));
  append_numbers(body, m.positions, m.is_double);
  append_numbers(body, m.normals, m.is_double);
  append_numbers(body, m.uvs, m.is_double);
  append_numbers(body, m.colors, m.is_double);
  for (const uint32_t index : m.triangles) append(body, index);
  std::string bytes;
  append(bytes, uint16_t{0x041c});
  append(bytes, static_cast<uint16_t>(m.version));
  return bytes + packed(body);
}

}  // namespace

SerializedSample::SerializedSample()
    : positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, triangles{0, 1, 2} {}

VolumeSample::VolumeSample() : values(8) {
  std::iota(values.begin(), values.end(), 0.0f);
}

std::string serialized_file(const std::vector<SerializedSample>& meshes) {
  std::string bytes;
  std::vector<uint64_t> offsets;
  for (const SerializedSample& mesh : meshes) {
    offsets.push_back(bytes.size());
    bytes += mesh_bytes(mesh);
  }
  for (const uint64_t offset : offsets) {
    if (meshes[0].version == 3)
      append(bytes, static_cast<uint32_t>(offset));
    else
      append(bytes, offset);
  }
  append(bytes, static_cast<uint32_t>(meshes.size()));
  return bytes;
}

std::string volume_file(const VolumeSample& v) {
  std::string bytes = "VOL\x03";
  append(bytes, static_cast<int32_t>(v.encoding));
  for (const int n : v.resolution) append(bytes, static_cast<int32_t>(n));
  append(bytes, static_cast<int32_t>(v.channels));
  for (const Vec3f& corner : {v.min, v.max})
    for (int i = 0; i < 3; ++i) append(bytes, corner[i]);
  for (const float value : v.values) {
    if (v.encoding == 3)
      append(bytes, static_cast<unsigned char>(std::lround(value * 255)));
    else
      append(bytes, value);
  }
  return bytes;
}

}  // namespace nephroid::testing

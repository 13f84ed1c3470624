#include "input/mitsuba/volume_grid.h"

#include <cmath>
#include <cstring>
#include <string>

#include "core/counted.h"

namespace nephroid::mitsuba {
namespace {

constexpr size_t kGridHeader = 48;
enum Encoding : int32_t { kFloat32 = 1, kFloat16 = 2, kUint8 = 3, kDirections = 4 };

template <class Value>
Value grid_value(std::string_view bytes, size_t offset) {
  Value value;
  std::memcpy(&value, bytes.data() + offset, sizeof(value));
  return value;
}

[[noreturn]] void refuse(const SourceLocation& where, const std::string& message) {
  throw SceneError(where, "the volume cannot be used: " + message);
}

void check_header(std::string_view bytes, const SourceLocation& where) {
  if (!bytes.starts_with("VOL")) refuse(where, "it does not start with VOL, expected a .vol file");
  if (bytes.size() < kGridHeader)
    refuse(where, "it ends within its header, expected " + std::to_string(kGridHeader) + " bytes");
  if (bytes[3] != 3) refuse(where, "it has version " + std::to_string(bytes[3]) + ", expected 3");
}

size_t bytes_per_value(int32_t encoding, const SourceLocation& where) {
  if (encoding == kFloat32) return sizeof(float);
  if (encoding == kUint8) return 1;
  refuse(where, "its values are of type " + std::to_string(encoding) +
                    ", expected 1 (32-bit floats) or 3 (8 bits)");
}

void read_box(std::string_view bytes, VolumeGrid& grid, const SourceLocation& where) {
  for (int i = 0; i < 3; ++i) {
    grid.min[i] = grid_value<float>(bytes, 24 + 4 * static_cast<size_t>(i));
    grid.max[i] = grid_value<float>(bytes, 36 + 4 * static_cast<size_t>(i));
    if (!std::isfinite(grid.min[i]) || !std::isfinite(grid.max[i]))
      refuse(where, "its box is not finite, expected finite numbers");
  }
}

}  // namespace

VolumeGrid read_volume_grid(std::string_view bytes, const SourceLocation& where) {
  check_header(bytes, where);
  const auto encoding = grid_value<int32_t>(bytes, 4);
  const size_t size = bytes_per_value(encoding, where);
  VolumeGrid grid;
  uint64_t count = 1;
  constexpr int kMaxResolution = 1 << 20;
  for (int i = 0; i < 3; ++i) {
    grid.resolution[i] = grid_value<int32_t>(bytes, 8 + 4 * static_cast<size_t>(i));
    if (grid.resolution[i] < 1 || grid.resolution[i] > kMaxResolution)
      refuse(where,
             "a resolution is " + std::to_string(grid.resolution[i]) + ", expected 1 to 1048576");
    count *= static_cast<uint64_t>(grid.resolution[i]);
  }
  grid.channels = grid_value<int32_t>(bytes, 20);
  if (grid.channels != 1 && grid.channels != 3)
    refuse(where, "it has " + std::to_string(grid.channels) + " channels, expected 1 or 3");
  count *= static_cast<uint64_t>(grid.channels);
  if (count > (bytes.size() - kGridHeader) / size)
    refuse(where, "it claims " + counted(count, "value") + ", more than the file holds");
  read_box(bytes, grid, where);
  grid.values.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    const float v =
        encoding == kFloat32
            ? grid_value<float>(bytes, kGridHeader + i * size)
            : static_cast<float>(static_cast<unsigned char>(bytes[kGridHeader + i])) / 255.f;
    if (!(v >= 0) || !std::isfinite(v))
      refuse(where, "a value is negative or not finite, expected finite numbers from 0");
    grid.values.push_back(v);
  }
  return grid;
}

}  // namespace nephroid::mitsuba

// Corners of OBJ faces, and the table that gives equal corners one vertex. It must not know files.
#pragma once

#include <cstdint>
#include <limits>
#include <unordered_map>
#include <utility>

namespace nephroid {

/// Indices of one corner, counted from 0.
struct Corner {
  static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
  uint32_t position = 0, uv = kNone, normal = kNone;
  bool operator==(const Corner&) const = default;
};

struct CornerHash {
  size_t operator()(const Corner& c) const {
    uint64_t h = (uint64_t{c.position} << 32 | c.uv) * 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 29) ^ c.normal) * 0xbf58476d1ce4e5b9u;
    return static_cast<size_t>(h ^ (h >> 32));
  }
};

/// Numbers the distinct corners of a mesh. Indices that its vertices do not use are ignored.
class CornerIndex {
 public:
  CornerIndex(bool has_uvs, bool has_normals) : has_uvs_(has_uvs), has_normals_(has_normals) {}
  bool has_uvs() const { return has_uvs_; }
  bool has_normals() const { return has_normals_; }

  /// The vertex of a corner, and whether it is new.
  std::pair<uint32_t, bool> find_or_add(Corner corner) {
    if (!has_uvs_) corner.uv = Corner::kNone;
    if (!has_normals_) corner.normal = Corner::kNone;
    const auto [entry, is_new] =
        vertex_of_.try_emplace(corner, static_cast<uint32_t>(vertex_of_.size()));
    return {entry->second, is_new};
  }

 private:
  bool has_uvs_, has_normals_;
  std::unordered_map<Corner, uint32_t, CornerHash> vertex_of_;
};

}  // namespace nephroid

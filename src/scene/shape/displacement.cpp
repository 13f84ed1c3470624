// Longest-edge bisection with shared midpoints, then heights and normals; see displacement.h.
#include "scene/shape/displacement.h"

#include <array>
#include <unordered_map>

#include "core/parallel.h"
#include "scene/shape/mesh_preparation.h"

namespace nephroid {
namespace {

/// Unit normals of vertices: the sum of the unit normals of their faces. Zero where there are none.
std::vector<Vec3f> vertex_normals(const MeshData& mesh) {
  std::vector<Vec3f> normals(mesh.positions.size(), Vec3f(0, 0, 0));
  for (size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const uint32_t* v = &mesh.triangles[i];
    const Vec3f& p1 = mesh.positions[v[1]];
    const Vec3f n = cross(p1 - mesh.positions[v[0]], mesh.positions[v[2]] - p1);
    if (!(max_component(abs(n)) > 0.0f)) continue;
    const Vec3f unit = normalize(n);
    for (int k = 0; k < 3; ++k) normals[v[k]] += unit;
  }
  for (Vec3f& n : normals)
    if (max_component(abs(n)) > 0.0f) n = normalize(n);
  return normals;
}

class Refinement {
 public:
  Refinement(MeshData& mesh, const Displacement& displacement, size_t most_triangles)
      : mesh_(mesh),
        to_world_(displacement.object_to_world),
        longest_(displacement.edge_length),
        most_(most_triangles) {}

  /// Replaces all triangles. False if there would be too many.
  bool run() {
    const std::vector<uint32_t> coarse = std::move(mesh_.triangles);
    const std::vector<int> coarse_tags = std::move(mesh_.face_indices);
    mesh_.triangles.clear();
    mesh_.face_indices.clear();
    for (size_t i = 0; i < coarse.size(); i += 3) {
      const size_t before = mesh_.triangles.size();
      if (!refine({coarse[i], coarse[i + 1], coarse[i + 2]})) return false;
      if (!coarse_tags.empty())
        mesh_.face_indices.insert(mesh_.face_indices.end(), (mesh_.triangles.size() - before) / 3,
                                  coarse_tags[i / 3]);
    }
    return true;
  }

 private:
  using Corners = std::array<uint32_t, 3>;

  float length_in_world(uint32_t a, uint32_t b) const {
    return length(to_world_.point(mesh_.positions[a]) - to_world_.point(mesh_.positions[b]));
  }

  bool refine(const Corners& triangle) {
    waiting_.assign(1, triangle);
    while (!waiting_.empty()) {
      const Corners v = waiting_.back();
      waiting_.pop_back();
      const float d01 = length_in_world(v[0], v[1]), d12 = length_in_world(v[1], v[2]),
                  d20 = length_in_world(v[2], v[0]);
      if (!(d01 + d12 + d20 < kInfinity)) return false;
      if (d01 < longest_ && d12 < longest_ && d20 < longest_) {
        mesh_.triangles.insert(mesh_.triangles.end(), v.begin(), v.end());
        continue;
      }
      // Rotates the longest edge to the front; the later one of equal edges.
      Corners w = {v[2], v[0], v[1]};
      if (d01 > d12 && d01 > d20) w = v;
      if (d12 >= d01 && d12 > d20) w = {v[1], v[2], v[0]};
      const uint32_t middle = midpoint(w[0], w[1]);
      waiting_.push_back({middle, w[1], w[2]});
      waiting_.push_back({w[0], middle, w[2]});
      if (mesh_.triangles.size() / 3 + waiting_.size() > most_ || mesh_.positions.size() > most_)
        return false;
    }
    return true;
  }

  /// The vertex in the middle of an edge, shared by the triangles on both sides.
  uint32_t midpoint(uint32_t a, uint32_t b) {
    const uint64_t edge = (uint64_t{std::min(a, b)} << 32) | std::max(a, b);
    const auto [found, is_new] =
        midpoints_.try_emplace(edge, static_cast<uint32_t>(mesh_.positions.size()));
    if (is_new) {
      mesh_.positions.push_back((mesh_.positions[a] + mesh_.positions[b]) * 0.5f);
      mesh_.normals.push_back(normalize(mesh_.normals[a] + mesh_.normals[b]));
      mesh_.uvs.push_back((mesh_.uvs[a] + mesh_.uvs[b]) * 0.5f);
    }
    return found->second;
  }

  MeshData& mesh_;
  const Transform& to_world_;
  float longest_;
  size_t most_;
  std::vector<Corners> waiting_;
  std::unordered_map<uint64_t, uint32_t> midpoints_;
};

}  // namespace

std::optional<MeshData> displace_mesh(MeshData mesh, const Displacement& displacement,
                                      size_t most_triangles) {
  mesh = split_quads(std::move(mesh));
  mesh.tangents.clear();
  if (mesh.normals.empty()) mesh.normals = vertex_normals(mesh);
  if (!Refinement(mesh, displacement, most_triangles).run()) return std::nullopt;
  constexpr int64_t kChunk = 4096;
  parallel_chunks(mesh.positions.size(), kChunk, [&](int64_t, int64_t begin, int64_t end) {
    for (int64_t i = begin; i < end; ++i) {
      Vec3f& p = mesh.positions[i];
      p += mesh.normals[i] * displacement.height(p, mesh.uvs[i]);
    }
  });
  mesh.normals = vertex_normals(mesh);
  return mesh;
}

}  // namespace nephroid

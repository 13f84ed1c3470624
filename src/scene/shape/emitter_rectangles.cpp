#include "scene/shape/emitter_rectangles.h"

namespace nephroid {

namespace {

// Relative to the size of the rectangle: allows for rounding in files with six digits.
constexpr float kTolerance = 2e-5f;

bool is_rectangle(const MeshData& mesh, const uint32_t v[4]) {
  const auto& p = mesh.positions;
  const Vec3f a = p[v[1]] - p[v[0]], b = p[v[3]] - p[v[0]];
  const float la = length(a), lb = length(b);
  if (!(la > 0 && lb > 0)) return false;
  const Vec3f closing = p[v[0]] - p[v[1]] + p[v[2]] - p[v[3]];
  if (length(closing) > kTolerance * (la + lb)) return false;
  if (std::abs(dot(a, b)) > 10 * kTolerance * la * lb) return false;
  const auto& t = mesh.uvs;
  const Vec2f bend = t[v[0]] - t[v[1]] + t[v[2]] - t[v[3]];
  if (std::abs(bend.x) + std::abs(bend.y) > kTolerance) return false;
  // A patch takes its edges for the directions of u and v.
  const Vec2f along_a = t[v[1]] - t[v[0]], along_b = t[v[3]] - t[v[0]];
  const auto slant = [](const Vec2f& d) { return std::min(std::abs(d.x), std::abs(d.y)); };
  if (slant(along_a) + slant(along_b) > kTolerance) return false;
  if (!mesh.normals.empty())
    for (int i = 1; i < 4; ++i)
      if (length(mesh.normals[v[i]] - mesh.normals[v[0]]) > 1e-4f) return false;
  return true;
}

}  // namespace

MeshData join_rectangles(MeshData mesh) {
  if (mesh.uvs.empty() || !mesh.face_indices.empty() || !mesh.tangents.empty()) return mesh;
  std::vector<uint32_t> rest;
  const auto& t = mesh.triangles;
  for (size_t i = 0; i < t.size(); i += 3) {
    if (i + 5 < t.size() && t[i] == t[i + 3] && t[i + 2] == t[i + 4]) {
      const uint32_t quad[4] = {t[i], t[i + 1], t[i + 2], t[i + 5]};
      if (is_rectangle(mesh, quad)) {
        mesh.quads.insert(mesh.quads.end(), quad, quad + 4);
        i += 3;
        continue;
      }
    }
    rest.insert(rest.end(), t.begin() + i, t.begin() + i + 3);
  }
  mesh.triangles = std::move(rest);
  return mesh;
}

}  // namespace nephroid

// Tangents of vertices along u; see vertices.h.
#include <cmath>

#include "input/gltf/vertices.h"

namespace nephroid::gltf {
namespace {

Vec3f without_part_along(const Vec3f& v, const Vec3f& n) {
  return v - n * dot(v, n);
}

/// The derivative of the position by u over a triangle; its sign of v is in `sign`.
struct UvFrame {
  Vec3f along_u;
  float sign;
};

std::optional<UvFrame> uv_frame(const Vertices& vertices, const uint32_t* corner) {
  const auto& uv = vertices.uvs[0];
  const Vec3f edge1 = vertices.positions[corner[1]] - vertices.positions[corner[0]];
  const Vec3f edge2 = vertices.positions[corner[2]] - vertices.positions[corner[0]];
  const Vec2f d1 = uv[corner[1]] - uv[corner[0]], d2 = uv[corner[2]] - uv[corner[0]];
  const float determinant = d1.x * d2.y - d1.y * d2.x;
  if (determinant == 0.0f) return std::nullopt;
  const float sign = determinant < 0.0f ? -1.0f : 1.0f;
  return UvFrame{normalize((edge1 * d2.y - edge2 * d1.y) * sign), sign};
}

/// The angle of a triangle at a corner, seen along the normal.
float angle_at(const Vertices& vertices, const uint32_t* corner, int k, const Vec3f& n) {
  const Vec3f p = vertices.positions[corner[k]];
  const Vec3f a = normalize(without_part_along(vertices.positions[corner[(k + 1) % 3]] - p, n));
  const Vec3f b = normalize(without_part_along(vertices.positions[corner[(k + 2) % 3]] - p, n));
  return std::acos(std::clamp(dot(a, b), -1.0f, 1.0f));
}

}  // namespace

void add_tangents(Vertices& vertices) {
  if (vertices.uvs[0].empty() || vertices.normals.empty()) return;
  const size_t count = vertices.positions.size();
  std::vector<Vec3f> sums(count, Vec3f(0, 0, 0));
  std::vector<float> signs(count, 0.0f);
  for (size_t t = 0; t + 2 < vertices.triangles.size(); t += 3) {
    const uint32_t* corner = &vertices.triangles[t];
    const std::optional<UvFrame> frame = uv_frame(vertices, corner);
    if (!frame) continue;
    for (int k = 0; k < 3; ++k) {
      const Vec3f n = normalize(vertices.normals[corner[k]]);
      const float angle = angle_at(vertices, corner, k, n);
      sums[corner[k]] += normalize(without_part_along(frame->along_u, n)) * angle;
      signs[corner[k]] += frame->sign * angle;
    }
  }
  vertices.tangents.resize(count);
  vertices.tangent_signs.resize(count);
  for (size_t i = 0; i < count; ++i) {
    vertices.tangents[i] = normalize(sums[i]);
    vertices.tangent_signs[i] = signs[i] < 0.0f ? -1.0f : 1.0f;
  }
}

void make_faceted(Vertices& vertices) {
  const auto unshare = [&](auto& values) {
    if (values.empty()) return;
    std::decay_t<decltype(values)> own;
    own.reserve(vertices.triangles.size());
    for (const uint32_t corner : vertices.triangles) own.push_back(values[corner]);
    values = std::move(own);
  };
  unshare(vertices.positions);
  unshare(vertices.uvs[0]);
  unshare(vertices.uvs[1]);
  unshare(vertices.colors);
  for (uint32_t i = 0; i < vertices.triangles.size(); ++i) vertices.triangles[i] = i;
  vertices.normals.clear();
  for (size_t i = 0; i < vertices.positions.size(); i += 3) {
    const Vec3f* p = &vertices.positions[i];
    const Vec3f n = cross(p[1] - p[0], p[2] - p[0]);
    vertices.normals.insert(vertices.normals.end(), 3,
                            length(n) > 0 ? normalize(n) : Vec3f(0, 0, 1));
  }
  add_tangents(vertices);
}

void rotate_tangents(Vertices& vertices, double angle) {
  if (vertices.normals.empty() || vertices.tangents.empty()) return;
  const auto cosine = static_cast<float>(std::cos(angle));
  const auto sine = static_cast<float>(std::sin(angle));
  for (size_t i = 0; i < vertices.tangents.size(); ++i) {
    const Vec3f t = vertices.tangents[i];
    const Vec3f b = cross(normalize(vertices.normals[i]), t) * vertices.tangent_signs[i];
    vertices.tangents[i] = t * cosine + b * sine;
  }
}

}  // namespace nephroid::gltf

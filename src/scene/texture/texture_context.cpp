// Attributes of vertices at the point of a lookup; see texture.h.
#include "scene/texture/texture.h"

namespace nephroid {

Vec2f TextureContext::second_uv() const {
  if (!mesh || mesh->second_uvs.empty()) return uv;
  const uint32_t* v = &mesh->triangles[3 * size_t{primitive}];
  const auto& uvs = mesh->second_uvs;
  return uvs[v[0]] * (1.0f - barycentric.x - barycentric.y) + uvs[v[1]] * barycentric.x +
         uvs[v[2]] * barycentric.y;
}

float TextureContext::vertex_channel(int channel) const {
  if (!mesh || mesh->colors.empty()) return 1.0f;
  const uint32_t* v = &mesh->triangles[3 * size_t{primitive}];
  const auto at = [&](int corner) { return mesh->colors[v[corner]][static_cast<size_t>(channel)]; };
  return at(0) * (1.0f - barycentric.x - barycentric.y) + at(1) * barycentric.x +
         at(2) * barycentric.y;
}

}  // namespace nephroid

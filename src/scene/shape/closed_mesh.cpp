#include "scene/shape/closed_mesh.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace nephroid {
namespace {

using Edge = std::pair<uint32_t, uint32_t>;

/// Six times the volume, positive if the outside points away from it.
double signed_volume(const std::vector<Vec3f>& positions, size_t faces,
                     const std::function<OutsideRing(size_t)>& ring_of) {
  // Relative to a vertex, so that meshes far from the origin keep precision.
  const Vec3d origin = to_double(positions.front());
  double volume = 0;
  for (size_t f = 0; f < faces; ++f) {
    const OutsideRing ring = ring_of(f);
    Vec3d p[4];
    for (int i = 0; i < 4; ++i) p[i] = to_double(positions[ring.corners[i]]) - origin;
    volume += p[0].dot(p[1].cross(p[2])) + p[0].dot(p[2].cross(p[3]));
  }
  return volume;
}

/// For each vertex the first vertex at the same position.
std::vector<uint32_t> welded(const std::vector<Vec3f>& positions) {
  std::vector<uint32_t> order(positions.size()), first(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto before = [&](uint32_t a, uint32_t b) {
    const Vec3f &p = positions[a], &q = positions[b];
    return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
  };
  std::stable_sort(order.begin(), order.end(), before);
  for (size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && !before(order[i - 1], order[i]) ? first[order[i - 1]] : order[i];
  return first;
}

bool is_closed(const std::vector<Vec3f>& positions, size_t faces,
               const std::function<OutsideRing(size_t)>& ring_of) {
  const std::vector<uint32_t> vertex = welded(positions);
  std::vector<Edge> edges;
  for (size_t f = 0; f < faces; ++f) {
    const OutsideRing ring = ring_of(f);
    for (int i = 0; i < 4; ++i) {
      const uint32_t a = vertex[ring.corners[i]], b = vertex[ring.corners[(i + 1) % 4]];
      if (a != b) edges.emplace_back(a, b);
    }
  }
  std::vector<Edge> back;
  for (const Edge& edge : edges) back.emplace_back(edge.second, edge.first);
  std::sort(edges.begin(), edges.end());
  std::sort(back.begin(), back.end());
  return edges == back && std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

}  // namespace

bool is_closed_inside_out(const std::vector<Vec3f>& positions, size_t faces,
                          const std::function<OutsideRing(size_t)>& ring_of) {
  // The cheap test first, since most meshes have the correct orientation.
  return faces > 0 && signed_volume(positions, faces, ring_of) < 0 &&
         is_closed(positions, faces, ring_of);
}

}  // namespace nephroid

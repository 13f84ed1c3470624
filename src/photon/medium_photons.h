// Finds the photons of media along a ray: each is a disc that faces the ray, as wide as its own
// merge radius (the beam radiance estimate of Jarosz, Zwicker & Jensen 2008). A bounding hierarchy
// over photons in Morton order. It must not know media, phase functions or films.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "photon/photon.h"

namespace nephroid {

class MediumPhotons {
 public:
  MediumPhotons() = default;
  /// Takes photons and sorts them. `radius_at(p)` is the merge radius at a place, in world units.
  /// `order` as in PhotonGrid.
  MediumPhotons(std::vector<Photon> photons, const std::function<float(const Vec3f&)>& radius_at,
                std::vector<uint32_t>* order = nullptr);

  const std::vector<Photon>& photons() const { return photons_; }
  /// Peak memory of the photons and the hierarchy, construction included.
  size_t bytes() const { return bytes_; }

  /// Calls found(photon, t, distance_squared, radius) for every photon whose disc the ray crosses
  /// at 0 < t < t_max, in an order that depends on the photons and the ray alone. The ray has unit
  /// direction.
  template <class F>
  void query(const Ray& ray, float t_max, F&& found) const;

 private:
  static constexpr uint32_t kLeafSize = 4;
  /// With 63 bits in a code, and halves of at most 2^32 photons with the same code.
  static constexpr int kMaxDepth = 63 + 32;
  struct Node {
    Vec3f min, max;      ///< bounds of the spheres around the photons
    uint32_t first = 0;  ///< a leaf's first photon; else the second child, the first one is next
    uint32_t count = 0;  ///< number of photons of a leaf; 0: no leaf
  };
  void build(uint32_t begin, uint32_t end, const std::vector<uint64_t>& codes);

  std::vector<Photon> photons_;
  std::vector<float> radii_;
  std::vector<Node> nodes_;
  size_t bytes_ = 0;
};

template <class F>
void MediumPhotons::query(const Ray& ray, float t_max, F&& found) const {
  if (nodes_.empty()) return;
  Vec3f inverse;
  for (int i = 0; i < 3; ++i) {
    constexpr float kLeast = 1e-18f;
    inverse[i] = 1.0f / (std::abs(ray.d[i]) < kLeast ? std::copysign(kLeast, ray.d[i]) : ray.d[i]);
  }
  uint32_t open[kMaxDepth + 1];
  int count = 0;
  open[count++] = 0;
  while (count > 0) {
    const uint32_t index = open[--count];
    const Node& node = nodes_[index];
    float begin = 0, end = t_max;
    for (int i = 0; i < 3; ++i) {
      const float a = (node.min[i] - ray.o[i]) * inverse[i];
      const float b = (node.max[i] - ray.o[i]) * inverse[i];
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    // Rounding must not lose a photon at the face of its box.
    if (begin > end * (1 + 8 * kMachineEpsilon)) continue;
    if (node.count == 0) {
      open[count++] = node.first;
      open[count++] = index + 1;
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Vec3f way = photons_[i].p - ray.o;
      const float t = dot(way, ray.d);
      if (!(t > 0.0f && t < t_max)) continue;
      const float d2 = length_squared(way - ray.d * t);
      if (d2 < sqr(radii_[i])) found(photons_[i], t, d2, radii_[i]);
    }
  }
}

}  // namespace nephroid

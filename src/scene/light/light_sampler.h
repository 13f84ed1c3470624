// Chooses a light: for a receiving point by a light tree with a share for infinite lights, and by
// what was learned of their visibility; or for emitting a photon by power.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "scene/light/equiangular.h"
#include "scene/light/light.h"
#include "scene/light/light_visibility.h"

namespace nephroid {

struct LightChoice {
  int light = -1;
  float pdf_p = 0;
};

/// A bounded light chosen for a ray, and the distances along the ray that see it well.
struct LightAlong {
  int light = -1;  ///< -1: the choice led to no light
  float pdf_p = 0;
  Equiangular distances;
  /// Density of the light and a distance, 1/length.
  float pdf(float t) const { return pdf_p * distances.pdf(t); }
};

class LightSampler {
 public:
  explicit LightSampler(const std::vector<LightPtr>& lights);
  ~LightSampler();
  LightSampler(LightSampler&&) noexcept;

  /// Samples a light for point `p` with unit normal `n` (null: no normal). Empty if no light can
  /// contribute.
  std::optional<LightChoice> sample(const Vec3f& p, const Vec3f& n, float u) const;
  /// Probability that sample() returns `light` at this point.
  float pmf(const Vec3f& p, const Vec3f& n, int light) const;
  /// The same if nothing had been learned: it has no jumps between cells.
  float plain_pmf(const Vec3f& p, const Vec3f& n, int light) const;

  /// Number of lights and groups of lights whose visibility can be learned; 0 if there is no
  /// choice.
  size_t slot_count() const;
  /// Samples a light by `u` in [0,1) for a point to learn from, and adds what is found to
  /// `samples`: nothing if no light can contribute. `arrives` is called with the light, at most
  /// once; it returns the light that arrives at the point over the density of its sample, of which
  /// only ratios count.
  void survey(const Vec3f& p, const Vec3f& n, float u, const std::function<float(int)>& arrives,
              std::vector<SlotSample>& samples) const;
  /// From now on sample() and pmf() follow what was learned by survey(), at points with a normal.
  /// Not while a thread samples.
  void learn(LightVisibility visibility);

  /// Samples a bounded light for a ray of unit direction, by what it can send to all of its points
  /// up to `t_max`. Empty for all `u` or for none; with many lights the choice may lead to none.
  std::optional<LightAlong> sample_along(const Ray& ray, float t_max, float u) const;
  /// The result of sample_along() for a given light; empty if it never chooses that light.
  std::optional<LightAlong> find_along(const Ray& ray, float t_max, int light) const;

  /// Samples a light in proportion to its power. Empty if all are black. `u` is rescaled to [0,1)
  /// for reuse.
  std::optional<LightChoice> sample_by_power(float& u) const;
  float pmf_by_power(int light) const;

  /// Indices of the infinite lights.
  const std::vector<int>& infinite_lights() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nephroid

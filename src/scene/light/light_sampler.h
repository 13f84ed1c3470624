// Chooses a light: for a receiving point by a light tree with a share for infinite lights, or for
// emitting a photon by power.
#pragma once

#include <optional>
#include <vector>

#include "scene/light/light.h"

namespace nephroid {

struct LightChoice {
  int light = -1;
  float pdf_p = 0;
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

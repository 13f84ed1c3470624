// Fuzz on a surface: a lobe of fibres that stand up, brightest at grazing angles, with a table of
// its directional albedo. Class D. It must not know what lies below. Paper: Estevez & Kulla,
// Production Friendly Microfacet Sheen BRDF, 2017 (distribution); Neubelt & Pettineo 2013
// (visibility).
#pragma once

#include <array>

#include "core/math.h"

namespace nephroid {

class FuzzTable {
 public:
  FuzzTable();

  /// f of white fuzz for two directions above the surface, scaled down where the model would
  /// reflect more light than it gets. `roughness` in [0,1].
  float f(const Vec3f& wo, const Vec3f& wi, float roughness) const;
  /// Share of flux from cosine `c` that white fuzz reflects.
  float albedo(float c, float roughness) const;

 private:
  static constexpr int kRoughnesses = 24, kCosines = 32;
  static float unscaled(const Vec3f& wo, const Vec3f& wi, float roughness);
  /// 1 over the largest albedo of the unscaled model, if that is above 1.
  float scale(float roughness) const;

  std::array<std::array<float, kCosines>, kRoughnesses> albedo_{};  ///< of the unscaled model
  std::array<float, kRoughnesses> most_{};
};

}  // namespace nephroid

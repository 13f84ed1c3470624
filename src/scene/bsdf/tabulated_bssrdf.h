// The separable profile around one point, read from a table at each wavelength's extinction and
// albedo, and the probes that find where light leaves. It must not know shapes. Papers: Habel et
// al. 2013 (profile); King et al., BSSRDF Importance Sampling, SIGGRAPH Talks 2013 (probes along
// three axes).
#pragma once

#include "scene/bsdf/bssrdf.h"
#include "scene/bsdf/bssrdf_table.h"

namespace nephroid {

class TabulatedBssrdf final : public Bssrdf {
 public:
  /// Profile around `p` with unit shading normal `ns`, world space. `sigma_a` and `sigma_s` are per
  /// length in the scene's units, not negative. `table` outlives the object. Only wavelength number
  /// `left` of a path counts, or all do (kAllWavelengths).
  TabulatedBssrdf(const Vec3f& p, const Vec3f& ns, const SampledSpectrum& sigma_a,
                  const SampledSpectrum& sigma_s, const BssrdfTable* table, int left);

  std::optional<BssrdfProbe> sample_probe(float u_axis, const Vec2f& u) const override;
  SampledSpectrum sp(const Vec3f& p) const override;
  float pdf_a(const Vec3f& p, const Vec3f& ng) const override;
  const Bsdf* exit_bsdf(BsdfArena& arena) const override;

  /// Sp at distance r at wavelength i, per area.
  float profile(int i, float r) const;
  /// Density of the probe radii of wavelength i, per area of the plane perpendicular to the probe.
  float pdf_r(int i, float r) const;
  /// Largest probe radius of wavelength i: all but about 1/1000 of the profile lies within. 0 if no
  /// light leaves.
  float reach(int i) const { return reach_[i]; }

 private:
  Vec3f p_;
  Frame frame_;
  const BssrdfTable* table_;
  int first_, wavelengths_;  ///< first index and number of the path's wavelengths in use
  SampledSpectrum sigma_t_, effective_albedo_, reach_;
  std::array<SplineWeights, kSpectrumSamples> albedo_;
};

}  // namespace nephroid

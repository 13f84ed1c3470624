// The random walk between a dielectric coat and an opaque base, with or without a scattering medium
// in the gap: an unbiased estimate of their joint value for two given directions. It must not know
// classes, materials or textures. Papers: Guo, Hasan & Zhao 2018; pbrt-v4 section 14.3
// (position-free form; gap, largest depth and medium mean the same).
#pragma once

#include "core/sampler.h"
#include "core/warps.h"
#include "scene/bsdf/dielectric.h"

namespace nephroid {

/// A dielectric layer above a base.
struct Coat {
  DielectricInterface boundary;
  float thickness = 0.01f;  ///< thickness of the gap, in mean free paths
  SampledSpectrum albedo;   ///< albedo of the medium in the gap; black: it only absorbs
  float g = 0;              ///< Henyey-Greenstein asymmetry of the medium
  int max_depth = 10;       ///< maximum number of steps of the walk
  int walks = 1;            ///< walks per evaluation
  bool scatters = false;    ///< whether albedo is not black
  uint64_t seed = 0;        ///< seed of the random walks, different for each point and path

  /// Transmittance over a depth difference `dz` along w.
  static float transmittance(float dz, const Vec3f& w) {
    return std::abs(dz) > 0.0f ? std::exp(-std::abs(dz / w.z)) : 1.0f;
  }
};

/// Random numbers of one walk, a function of the coat's seed and the directions. The same
/// evaluation gives the same answer; other points and paths get other numbers.
class WalkRandom {
 public:
  WalkRandom(uint64_t seed, const Vec3f& a, const Vec3f& b)
      : state_(hash_combine(seed, bits(a.x, a.y), bits(a.z, b.z), bits(b.x, b.y))) {}
  explicit WalkRandom(uint64_t seed) : state_(mix_bits(seed)) {}
  float next() {
    state_ += 0x9e3779b97f4a7c15ull;
    return bits_to_unit_float(static_cast<uint32_t>(mix_bits(state_) >> 32));
  }
  Vec2f next2() {
    const float x = next();
    return {x, next()};
  }

 private:
  static uint64_t bits(float a, float b) {
    return static_cast<uint64_t>(std::bit_cast<uint32_t>(a)) << 32 | std::bit_cast<uint32_t>(b);
  }
  uint64_t state_;
};

/// Density of scattering (pdf_w and phase function in one); `c` is the cosine between the two
/// directions of travel.
inline float henyey_greenstein(float c, float g) {
  const float denominator = 1.0f + g * g - 2.0f * g * c;
  return kInv4Pi * (1.0f - g * g) / std::max(denominator * safe_sqrt(denominator), 1e-12f);
}

/// A new direction of travel with density henyey_greenstein(dot(w, result), g).
inline Vec3f sample_henyey_greenstein(const Vec3f& w, float g, const Vec2f& u) {
  float c = 1.0f - 2.0f * u.x;
  if (std::abs(g) > 1e-3f) {
    const float q = (1.0f - g * g) / (1.0f + g - 2.0f * g * u.x);
    c = std::clamp((1.0f + g * g - q * q) / (2.0f * g), -1.0f, 1.0f);
  }
  const float r = safe_sqrt(1.0f - c * c), phi = 2.0f * kPi * u.y;
  return normalize(Frame::from_z(w).to_world(Vec3f(r * std::cos(phi), r * std::sin(phi), c)));
}

/// One walk. The base is at z = 0, the coat at z = thickness. Directions are directions of travel,
/// starting from wo.
template <class Base>
class LayeredWalk {
 public:
  LayeredWalk(const Coat& coat, const Base& base, const Vec3f& wi, TransportMode mode)
      : coat_(coat),
        base_(base),
        wi_(wi),
        mode_(mode),
        adjoint_(mode == TransportMode::kRadiance ? TransportMode::kImportance
                                                  : TransportMode::kRadiance) {}

  /// Estimate of f(wo, wi) for all light that entered the coat; wo and wi above.
  SampledSpectrum run(const Vec3f& wo, WalkRandom& random) {
    sum_ = SampledSpectrum();
    const auto entry = at_coat(wo, mode_, BoundaryPart::kTransmission, random);
    // The last crossing is sampled backwards, from wi, in the adjoint mode.
    exit_ = at_coat(wi_, adjoint_, BoundaryPart::kTransmission, random);
    if (!entry || !exit_) return sum_;
    exit_weight_ = exit_->weight / std::abs(exit_->wi.z);
    beta_ = SampledSpectrum(entry->weight);
    w_ = entry->wi;
    z_ = coat_.thickness;
    for (int depth = 0; depth < coat_.max_depth; ++depth) {
      if (depth > 3 && !survives(random)) break;
      if (coat_.scatters) {
        const float dz = -std::log(1.0f - random.next()) * std::abs(w_.z);
        const float z = w_.z > 0.0f ? z_ + dz : z_ - dz;
        if (z == z_) continue;
        if (z > 0.0f && z < coat_.thickness) {
          scatter_in_medium(z, random);
          if (w_.z == 0.0f) break;
          continue;
        }
        z_ = z > 0.0f ? coat_.thickness : 0.0f;
      } else {
        z_ = w_.z > 0.0f ? coat_.thickness : 0.0f;
        beta_ *= Coat::transmittance(coat_.thickness, w_);
      }
      if (!(z_ > 0.0f ? reflect_at_coat(random) : scatter_at_base(random))) break;
    }
    return sum_;
  }

 private:
  bool survives(WalkRandom& random) {
    const float b = beta_.max_component();
    if (b >= 0.25f) return true;
    if (!(random.next() < b)) return false;
    beta_ /= b;
    return true;
  }

  std::optional<DielectricInterface::Sample> at_coat(const Vec3f& w, TransportMode mode,
                                                     BoundaryPart part, WalkRandom& random) const {
    const float uc = random.next();
    return coat_.boundary.sample(w, uc, random.next2(), mode, part);
  }

  /// f of the crossing from w_ to wi, and the density of the presampled crossing. The density is
  /// that of the backward direction, in which the crossing is sampled. (pbrt-v4 uses the forward
  /// density, which makes its rough coats a few per cent too bright.)
  DielectricInterface::Value leave_along_w() const {
    return coat_.boundary.evaluate(wi_, -w_, adjoint_, BoundaryPart::kTransmission);
  }

  bool reflect_at_coat(WalkRandom& random) {
    const auto s = at_coat(-w_, mode_, BoundaryPart::kReflection, random);
    if (!s) return false;
    beta_ *= s->weight;
    w_ = s->wi;
    return !beta_.is_black();
  }

  /// Connects to wi by the presampled crossing and by a sampled direction, combined by MIS. A
  /// smooth boundary cannot be hit by chance, so the other technique then gets all the weight.
  bool scatter_at_base(WalkRandom& random) {
    const Vec3f back = -w_;
    if (!base_.smooth()) {
      const Vec3f out = -exit_->wi;
      const auto v = base_.evaluate(back, out);
      const float weight = coat_.boundary.smooth() ? 1.0f : power_heuristic(exit_->pdf_w, v.pdf_w);
      sum_ +=
          beta_ * v.f * (out.z * weight * Coat::transmittance(coat_.thickness, out) * exit_weight_);
    }
    const auto s = base_.sample(back, random.next2());
    if (!s) return false;
    beta_ *= s->weight;
    w_ = s->wi;
    if (!coat_.boundary.smooth()) {
      const auto v = leave_along_w();
      const float weight = base_.smooth() ? 1.0f : power_heuristic(s->pdf_w, v.pdf_w);
      sum_ += beta_ * (Coat::transmittance(coat_.thickness, w_) * v.f * weight);
    }
    return !beta_.is_black();
  }

  void scatter_in_medium(float z, WalkRandom& random) {
    beta_ *= coat_.albedo;
    const Vec3f out = -exit_->wi;
    const float phase = henyey_greenstein(dot(w_, out), coat_.g);
    const float weight = coat_.boundary.smooth() ? 1.0f : power_heuristic(exit_->pdf_w, phase);
    sum_ += beta_ * (phase * weight * exit_weight_ * Coat::transmittance(coat_.thickness - z, out));
    if (coat_.boundary.smooth() && base_.smooth()) connect_by_mirrors(z, out);
    const Vec3f before = w_;
    w_ = sample_henyey_greenstein(before, coat_.g, random.next2());
    z_ = z;
    if (w_.z > 0.0f && !coat_.boundary.smooth()) {
      const auto v = leave_along_w();
      const float w = power_heuristic(henyey_greenstein(dot(before, w_), coat_.g), v.pdf_w);
      sum_ += beta_ * (Coat::transmittance(coat_.thickness - z, w_) * v.f * w);
    }
  }

  /// With two mirrors no later vertex can see the exit. Adds the light that goes from the medium
  /// down to the base, or up to the coat and back, any number of times, and then out.
  void connect_by_mirrors(float z, const Vec3f& out) {
    const Vec3f down(out.x, out.y, -out.z);
    const auto base = base_.sample(out, Vec2f(0.5f, 0.5f));
    if (!base) return;
    const float inner = coat_.boundary.fresnel(down);
    const float across = Coat::transmittance(coat_.thickness, out);
    const float by_base =
        henyey_greenstein(dot(w_, down), coat_.g) * Coat::transmittance(z, out) * across;
    const float by_coat = henyey_greenstein(dot(w_, out), coat_.g) *
                          Coat::transmittance(coat_.thickness - z, out) * inner * sqr(across);
    const SampledSpectrum round = base->weight * (inner * sqr(across));
    sum_ += beta_ * base->weight * ((by_base + by_coat) * exit_weight_) /
            (SampledSpectrum(1.0f) - clamp(round, 0.0f, 0.9999f));
  }

  const Coat& coat_;
  const Base& base_;
  Vec3f wi_;
  TransportMode mode_, adjoint_;
  SampledSpectrum sum_, beta_;
  std::optional<DielectricInterface::Sample> exit_;
  float exit_weight_ = 0;  ///< f / pdf of the last crossing
  Vec3f w_;
  float z_ = 0;
};

/// f(wo, wi) of everything but the coat's own reflection; both directions above. Random numbers
/// derive from the directions.
template <class Base>
SampledSpectrum layered_base_value(const Coat& coat, const Base& base, const Vec3f& wo,
                                   const Vec3f& wi, TransportMode mode) {
  WalkRandom random(coat.seed, wo, wi);
  LayeredWalk<Base> walk(coat, base, wi, mode);
  SampledSpectrum sum;
  for (int i = 0; i < coat.walks; ++i) sum += walk.run(wo, random);
  return sum / static_cast<float>(coat.walks);
}

}  // namespace nephroid

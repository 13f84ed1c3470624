// See forced_diffuse.h. A hash instead of a generator keeps the BSDF a function of its arguments.
#include "scene/material/forced_diffuse.h"

#include <bit>
#include <utility>

#include "core/sampler.h"
#include "scene/bsdf/diffuse.h"

namespace nephroid {
namespace {

constexpr int kSamples = 16;

class ForcedDiffuse final : public Material {
 public:
  explicit ForcedDiffuse(MaterialPtr material) : material_(std::move(material)) {}

  const Bsdf* make_bsdf(const SurfaceInteraction& point, SampledWavelengths& lambda,
                        float specular_alpha, BsdfArena& arena) const override {
    BsdfArena own;
    const Bsdf* bsdf = material_->make_bsdf(point, lambda, specular_alpha, own);
    if (!bsdf) return nullptr;
    uint64_t hash = std::bit_cast<uint32_t>(lambda.lambda(0));
    for (int i = 0; i < 3; ++i)
      hash = hash_combine(hash, std::bit_cast<uint32_t>(point.p[i]),
                          std::bit_cast<uint32_t>(point.wo[i]));
    const Vec3f wo = point.shading.to_local(point.wo);
    SampledSpectrum sum;
    for (int i = 0; i < kSamples; ++i) {
      const auto number = [&](uint64_t dimension) {
        return bits_to_unit_float(
            static_cast<uint32_t>(hash_combine(hash, static_cast<uint64_t>(i), dimension) >> 32));
      };
      const float choice = (static_cast<float>(i) + number(0)) / kSamples;
      const std::optional<BsdfSample> s =
          bsdf->sample(wo, std::min(choice, kOneMinusEpsilon), {number(1), number(2)},
                       TransportMode::kRadiance, ClassMask::kAll);
      if (s && s->pdf_w > 0) sum += s->f * (abs_cos_theta(s->wi) / s->pdf_w);
    }
    return arena.make<DiffuseBsdf>(sum / static_cast<float>(kSamples));
  }
  void bump(SurfaceInteraction& point) const override { material_->bump(point); }
  bool has_bump() const override { return material_->has_bump(); }
  ClassMask possible_classes() const override { return ClassMask::kDiffuse; }

 private:
  MaterialPtr material_;
};

}  // namespace

std::shared_ptr<Material> force_diffuse(MaterialPtr material) {
  return std::make_shared<ForcedDiffuse>(std::move(material));
}

}  // namespace nephroid

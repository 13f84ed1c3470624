// The material "principled", in the terms of OpenPBR 1.1, to which the importers of other formats
// map their materials. It must not know how the layers share light.
#include "scene/bsdf/principled.h"
#include "scene/bsdf/principled_subsurface.h"
#include "scene/material/principled_inputs.h"
#include "scene/material/surface_material.h"

namespace nephroid {
namespace {

/// Classes of a lobe with these facets; both if they vary.
ClassMask classes_of(const std::optional<TrowbridgeReitz>& facets, const SpecularBand& band) {
  if (!facets) return ClassMask::kGlossy | ClassMask::kSpecular;
  return mask_of(facets->event_class(band.low)) | mask_of(facets->event_class(band.high));
}

class PrincipledMaterial final : public SurfaceMaterial {
 public:
  PrincipledMaterial(const MaterialDescription& d, const MaterialContext& c)
      : SurfaceMaterial(d, c),
        inputs_(d, c),
        band_(c.settings.specular_band),
        tables_(c.principled_tables->get()) {
    // The layers decide how much light enters and leaves, and the profile only its shape. So the
    // index may be clamped to the range of glasses.
    constexpr float kMinEta = 1.0f, kMaxEta = 2.0f;
    if (inputs_.may_scatter_below())
      profiles_ = c.bssrdf_tables->find_or_make(
          inputs_.scatter_anisotropy(), std::clamp(inputs_.index_at_550_nm(), kMinEta, kMaxEta));
  }

  const Bsdf* make_bsdf(const SurfaceInteraction& point, SampledWavelengths& lambda,
                        float specular_alpha, BsdfArena& arena) const override {
    return arena.make<PrincipledBsdf>(layers(inputs_.at(point, lambda), arena), specular_alpha);
  }
  const Bssrdf* make_bssrdf(const SurfaceInteraction& point, const SampledWavelengths& lambda,
                            BsdfArena& arena) const override {
    if (!profiles_) return nullptr;
    SampledWavelengths same = lambda;
    const PrincipledSurface surface = inputs_.at(point, same);
    const SampledSpectrum path = inputs_.free_path(point, lambda);
    SampledSpectrum sigma_a, sigma_s;
    for (int i = 0; i < kSpectrumSamples; ++i) {
      const float sigma_t = path[i] > 0.0f ? 1.0f / path[i] : 0.0f;
      const float albedo = profiles_->invert_effective_albedo(surface.subsurface_color[i]);
      sigma_s.set(i, albedo * sigma_t);
      sigma_a.set(i, (1.0f - albedo) * sigma_t);
    }
    const TabulatedBssrdf profile(point.p, point.shading.z, sigma_a, sigma_s, profiles_.get(),
                                  lambda.left());
    return arena.make<PrincipledBssrdf>(profile, layers(surface, arena));
  }
  bool has_bssrdf() const override { return profiles_ != nullptr; }

  std::optional<float> refractive_index() const override {
    const float index = inputs_.index_at_550_nm();
    if (!inputs_.may_transmit() || inputs_.thin_walled() || index == 1.0f) return std::nullopt;
    return index;
  }
  bool transmits_straight() const override { return inputs_.may_go_straight(); }
  SampledSpectrum straight_transmittance(const SurfaceInteraction& point,
                                         const SampledWavelengths& lambda) const override {
    if (!transmits_straight()) return {};
    SurfaceInteraction bumped = point;
    bump(bumped);
    SampledWavelengths same = lambda;
    BsdfArena arena;
    const PrincipledBsdf bsdf(layers(inputs_.at(bumped, same), arena), 0.0f);
    return bsdf.straight_transmittance(bumped.shading.to_local(bumped.wo));
  }
  ClassMask possible_classes() const override {
    ClassMask m = ClassMask::kNone;
    if (inputs_.may_have_fuzz() || inputs_.may_be_opaque_dielectric()) m = ClassMask::kDiffuse;
    if (inputs_.may_have_coat()) m = m | classes_of(inputs_.constant_coat_facets(), band_);
    if (inputs_.may_have_facets()) m = m | classes_of(inputs_.constant_facets(), band_);
    return m;
  }
  std::optional<float> facet_alpha() const override {
    const bool has_coat = inputs_.may_have_coat(), has_facets = inputs_.may_have_facets();
    const auto coat = inputs_.constant_coat_facets(), base = inputs_.constant_facets();
    if ((has_coat && !coat) || (has_facets && !base)) return std::nullopt;
    if (has_coat && has_facets) return std::min(coat->max_alpha(), base->max_alpha());
    if (has_coat) return coat->max_alpha();
    return has_facets ? std::optional(base->max_alpha()) : std::nullopt;
  }

 private:
  const PrincipledLayers* layers(const PrincipledSurface& surface, BsdfArena& arena) const {
    const bool film = surface.film_weight > 0.0f && surface.opaque() > 0.0f;
    return arena.make<PrincipledLayers>(tables_.get(), surface,
                                        film ? arena.make<PrincipledLayers::FilmNodes>() : nullptr);
  }

  PrincipledInputs inputs_;
  SpecularBand band_;
  std::shared_ptr<const PrincipledTables> tables_;
  std::shared_ptr<const BssrdfTable> profiles_;  ///< null: no light scatters below the surface
};

}  // namespace

std::shared_ptr<const PrincipledTables> PrincipledTableCache::get() {
  if (!tables_) tables_ = std::make_shared<PrincipledTables>();
  return tables_;
}

NewMaterial make_principled(const MaterialDescription& d, const MaterialContext& c) {
  return std::make_shared<PrincipledMaterial>(d, c);
}

}  // namespace nephroid

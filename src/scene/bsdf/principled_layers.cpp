// Shares of light between the layers of a principled surface; see principled_layers.h.
#include "scene/bsdf/principled_layers.h"

#include "scene/bsdf/fresnel.h"
#include "scene/bsdf/oren_nayar.h"

namespace nephroid {

PrincipledLayers::PrincipledLayers(const PrincipledTables* tables, const PrincipledSurface& surface,
                                   FilmNodes* film)
    : tables_(tables), surface_(surface), fresnel_(surface) {
  if (surface_.coat_weight > 0.0f) prepare_coat();
  if (surface_.metalness > 0.0f) prepare_metal();
  if (surface_.opaque() > 0.0f) prepare_boundary(film);
}

void PrincipledLayers::prepare_coat() {
  coat_nodes_ = FacetAlbedoTable::nodes_of(
      [this](float c) { return fresnel_dielectric(c, surface_.coat_ior); });
  const float entering = 1.0f - tables_->facets.diffuse_mean(coat_nodes_);
  coat_diffuse_return_ = std::clamp(1.0f - entering / sqr(surface_.coat_ior), 0.0f, 1.0f);
  coat_tints_ = !(surface_.coat_color == SampledSpectrum(1.0f));
  log_coat_color_ = surface_.coat_color.map([](float x) { return std::log(std::max(x, 1e-6f)); });
}

void PrincipledLayers::prepare_metal() {
  const bool rough = !surface_.facets.smooth();
  if (!rough && surface_.coat_weight == 0.0f) return;
  const auto nodes = FacetAlbedoTable::nodes_of([this](float c) { return fresnel_.metal(c); });
  const SampledSpectrum mean = tables_->facets.diffuse_mean(nodes);
  const float alpha = FacetAlbedoTable::mean_alpha(surface_.facets);
  if (surface_.coat_weight > 0.0f) {
    // A mirror returns light to the coat in one direction, rough metal in all directions.
    const float inner = lerp(std::sqrt(alpha), coat_nodes_.back(), coat_diffuse_return_);
    metal_darkening_ = darkening(mean, inner);
  }
  if (!rough) return;
  const float white = tables_->facets.white_mean(alpha), lost = std::max(1.0f - white, 1e-6f);
  multiple_ = safe_div(mean * mean * white, SampledSpectrum(1.0f) - mean * lost) * (kInvPi / lost);
}

void PrincipledLayers::prepare_boundary(FilmNodes* film) {
  const bool bare = fresnel_.no_dielectric();
  if (!bare && !surface_.facets.smooth()) {
    if (surface_.film_weight > 0.0f && film) {
      *film = FacetAlbedoTable::nodes_of([this](float c) { return fresnel_.dielectric(c); });
      film_nodes_ = film;
    } else {
      boundary_nodes_ =
          FacetAlbedoTable::nodes_of([this](float c) { return fresnel_.dielectric(c)[0]; });
    }
  }
  if (bare && surface_.coat_weight == 0.0f && surface_.fuzz_weight == 0.0f) return;
  // Gauss-Legendre in the root of the cosine, of which these shares are smooth functions.
  static constexpr float kX[] = {0.0337652429f, 0.1693953068f, 0.3806904070f,
                                 0.6193095930f, 0.8306046932f, 0.9662347571f};
  static constexpr float kW[] = {0.0856622462f, 0.1803807865f, 0.2339569673f,
                                 0.2339569673f, 0.1803807865f, 0.0856622462f};
  const float alpha = FacetAlbedoTable::mean_alpha(surface_.facets);
  const float coat_alpha = FacetAlbedoTable::mean_alpha(surface_.coat_facets);
  const OrenNayar white(SampledSpectrum(1.0f), surface_.diffuse_roughness);
  SampledSpectrum lambert, along_normal;
  for (int i = 0; i < 6; ++i) {
    const float c = sqr(kX[i]);
    float fuzz;
    const SampledSpectrum passed = (SampledSpectrum(1.0f) - boundary_albedo(c, alpha)) *
                                   (passed_above(c, coat_alpha, &fuzz) * 4.0f * kX[i] * c * kW[i]);
    lambert += passed;
    along_normal += passed * white.pi_f(Vec3f(0, 0, 1), Vec3f(safe_sqrt(1 - c * c), 0, c));
  }
  // A rough base sends more light along the normal, where more of it leaves.
  for (int i = 0; i < kSpectrumSamples; ++i) mean_.set(i, std::max(lambert[i], along_normal[i]));
}

SampledSpectrum PrincipledLayers::boundary_albedo(float c, float alpha) const {
  if (fresnel_.no_dielectric()) return {};
  if (surface_.facets.smooth()) return fresnel_.dielectric(c);
  if (film_nodes_) return tables_->facets.albedo(c, alpha, *film_nodes_);
  return SampledSpectrum(tables_->facets.albedo(c, alpha, boundary_nodes_));
}

float PrincipledLayers::fuzz_albedo(float c) const {
  return surface_.fuzz_weight == 0.0f
             ? 0.0f
             : surface_.fuzz_weight * tables_->fuzz.albedo(c, surface_.fuzz_roughness);
}

float PrincipledLayers::coat_fresnel(float c) const {
  return surface_.coat_weight * fresnel_dielectric(std::abs(c), surface_.coat_ior);
}

float PrincipledLayers::coat_albedo(float c, float alpha) const {
  if (surface_.coat_weight == 0.0f) return 0.0f;
  if (surface_.coat_facets.smooth()) return coat_fresnel(c);
  return surface_.coat_weight * tables_->facets.albedo(c, alpha, coat_nodes_);
}

float PrincipledLayers::coat_albedo(const Vec3f& w) const {
  return coat_albedo(std::abs(w.z), alpha_towards(surface_.coat_facets, w));
}

float PrincipledLayers::passed_above(float c, float coat_alpha, float* fuzz) const {
  *fuzz = 1.0f - fuzz_albedo(c);
  return *fuzz * (1.0f - coat_albedo(c, coat_alpha));
}

SampledSpectrum PrincipledLayers::coat_color(float c) const {
  // The colour is that of light which passes the coat twice along the normal.
  const float inside = safe_sqrt(1.0f - (1.0f - c * c) / sqr(surface_.coat_ior));
  const float way = 0.5f / std::max(inside, 1e-3f);
  return lerp(surface_.coat_weight, SampledSpectrum(1.0f), exp(log_coat_color_ * way));
}

PrincipledLayers::Passed PrincipledLayers::passed(const Vec3f& w) const {
  Passed p;
  if (surface_.coat_weight == 0.0f && surface_.fuzz_weight == 0.0f) return p;
  const float c = std::abs(w.z);
  p.above = passed_above(c, alpha_towards(surface_.coat_facets, w), &p.fuzz);
  if (coat_tints_) p.color = coat_color(c);
  return p;
}

SampledSpectrum PrincipledLayers::reaches_base(const Vec3f& w, const Passed& passed) const {
  const SampledSpectrum boundary =
      boundary_albedo(std::abs(w.z), alpha_towards(surface_.facets, w));
  return (SampledSpectrum(1.0f) - boundary) * passed.color * passed.above;
}

float PrincipledLayers::lost(const Vec3f& w) const {
  const float alpha = alpha_towards(surface_.facets, w);
  return std::max(0.0f, 1.0f - tables_->facets.white_albedo(std::abs(w.z), alpha));
}

SampledSpectrum PrincipledLayers::darkening(const SampledSpectrum& albedo, float inner) const {
  const float amount = surface_.coat_weight * surface_.coat_darkening;
  if (amount == 0.0f) return SampledSpectrum(1.0f);
  const SampledSpectrum kept = SampledSpectrum(1.0f) - albedo * inner;
  return lerp(amount, SampledSpectrum(1.0f), safe_div(SampledSpectrum(1.0f - inner), kept));
}

}  // namespace nephroid

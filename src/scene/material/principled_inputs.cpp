// Reading and evaluation of the principled material's parameters; see principled_inputs.h.
#include "scene/material/principled_inputs.h"

#include <fmt/format.h>

namespace nephroid {
namespace {

constexpr float kMinIor = 0.1f, kMaxIor = 10.0f;
/// Lines of the Abbe number, in nm: d of helium, F and C of hydrogen.
constexpr float kLineD = 587.56f, kLineF = 486.13f, kLineC = 656.27f;

SpectrumInput read_color(const MaterialDescription& d, const MaterialContext& c, const char* name,
                         float fallback) {
  return read_spectrum(c.textures, d.parameters, name, SpectrumKind::kAlbedo, fallback);
}

SpectrumInput read_radius_scale(const MaterialDescription& d, const MaterialContext& c) {
  SpectrumTexturePtr texture = c.textures.spectrum_texture(d.parameters, "subsurface_radius_scale",
                                                           SpectrumKind::kUnbounded);
  if (!texture)
    texture = constant_spectrum_texture(
        rgb_unbounded_spectrum(RgbColorSpace::srgb(), Rgb{1.0f, 0.5f, 0.25f}));
  return SpectrumInput(std::move(texture));
}

/// Facets seen through a rough coat of index `ior` that covers the share `weight`: the variances of
/// slopes add up (OpenPBR 1.1).
TrowbridgeReitz roughened(const TrowbridgeReitz& base, const TrowbridgeReitz& coat, float weight,
                          float ior) {
  if (weight == 0.0f || coat.smooth()) return base;
  const float turn = 1.0f - std::min(ior, 1.0f / ior);
  const float added = 2.0f * weight * turn * coat.alpha_x() * coat.alpha_y();
  return {std::min(std::sqrt(sqr(base.alpha_x()) + added), 1.0f),
          std::min(std::sqrt(sqr(base.alpha_y()) + added), 1.0f)};
}

/// Adds subsurface light to the diffuse lobes: these shares of it go to the two sides.
void scatter_at_surface(PrincipledSurface& s, float reflected, float transmitted) {
  const float rest = 1.0f - s.subsurface;
  const float diffuse = rest * (1.0f - s.diffuse_transmission), through = rest - diffuse;
  const auto blend = [&s](const SampledSpectrum& color, float share, float added) {
    return (color * share + s.subsurface_color * added) / (share + added);
  };
  reflected *= s.subsurface;
  transmitted *= s.subsurface;
  if (diffuse + reflected > 0.0f) s.diffuse_color = blend(s.diffuse_color, diffuse, reflected);
  if (through + transmitted > 0.0f)
    s.diffuse_transmission_color = blend(s.diffuse_transmission_color, through, transmitted);
  s.diffuse_transmission = through + transmitted;
  s.subsurface = 0.0f;
}

/// A number that must be the same everywhere, by default 0.
float constant_of(const MaterialDescription& d, const MaterialContext& c, const char* name,
                  float low, float high) {
  const BoundedInput input(d, c, name, 0.0f, low, high);
  if (!input.constant())
    c.diagnostics.warn(
        d.parameters.find(name)->where,
        fmt::format("\"{}\" varies over the surface, expected a number; 0 is used", name));
  return input.constant().value_or(0.0f);
}

}  // namespace

BoundedInput::BoundedInput(const MaterialDescription& d, const MaterialContext& c, const char* name,
                           float fallback, float low, float high)
    : input_(c.textures.float_texture(d.parameters, name, fallback)), low_(low), high_(high) {
  const std::optional<float> given = input_.constant();
  if (!given) return;
  constant_ = clamped(*given);
  if (*constant_ == *given) return;
  const SourceLocation& where = d.parameters.find(name)->where;
  if (high < kInfinity)
    c.diagnostics.warn(
        where, fmt::format("\"{}\" is {}, expected a number from {} to {}; {} is used", name,
                           *given, low, high, *constant_));
  else
    c.diagnostics.warn(where, fmt::format("\"{}\" is {}, expected a number of at least {}; {} is "
                                          "used",
                                          name, *given, low, *constant_));
}

PrincipledInputs::PrincipledInputs(const MaterialDescription& d, const MaterialContext& c)
    : base_color_(read_color(d, c, "base_color", 0.8f)),
      base_weight_(d, c, "base_weight", 1.0f),
      metalness_(d, c, "base_metalness", 0.0f),
      diffuse_roughness_(d, c, "base_diffuse_roughness", 0.0f),
      specular_weight_(d, c, "specular_weight", 1.0f, 0.0f, kInfinity),
      roughness_(d, c, "specular_roughness", 0.3f),
      anisotropy_(d, c, "specular_roughness_anisotropy", 0.0f),
      ior_(d, c, "specular_ior", 1.5f, kMinIor, kMaxIor),
      specular_color_(read_color(d, c, "specular_color", 1.0f)),
      transmission_(d, c, "transmission_weight", 0.0f),
      transmission_color_(read_color(d, c, "transmission_color", 1.0f)),
      diffuse_transmission_(d, c, "diffuse_transmission_weight", 0.0f),
      diffuse_transmission_color_(read_color(d, c, "diffuse_transmission_color", 1.0f)),
      subsurface_(d, c, "subsurface_weight", 0.0f),
      subsurface_color_(read_color(d, c, "subsurface_color", 0.8f)),
      radius_(d, c, "subsurface_radius", 1.0f, 0.0f, kInfinity),
      radius_scale_(read_radius_scale(d, c)),
      fuzz_weight_(d, c, "fuzz_weight", 0.0f),
      fuzz_roughness_(d, c, "fuzz_roughness", 0.5f),
      fuzz_color_(read_color(d, c, "fuzz_color", 1.0f)),
      coat_weight_(d, c, "coat_weight", 0.0f),
      coat_roughness_(d, c, "coat_roughness", 0.0f),
      coat_anisotropy_(d, c, "coat_roughness_anisotropy", 0.0f),
      coat_ior_(d, c, "coat_ior", 1.6f, 1.0f, kMaxIor),
      coat_darkening_(d, c, "coat_darkening", 1.0f),
      coat_color_(read_color(d, c, "coat_color", 1.0f)),
      coat_affects_specular_(d.parameters.get_bool("coat_affects_specular", true)),
      film_weight_(d, c, "thin_film_weight", 0.0f),
      film_thickness_(d, c, "thin_film_thickness", 0.5f, 0.0f, kInfinity),
      film_ior_(d, c, "thin_film_ior", 1.4f, kMinIor, kMaxIor),
      thin_walled_(d.parameters.get_bool("geometry_thin_walled", false)),
      remap_roughness_(d.parameters.get_bool("remaproughness", true)) {
  // Profiles of subsurface light are tables for one mean cosine.
  g_ = constant_of(d, c, "subsurface_scatter_anisotropy", -0.95f, 0.95f);
  abbe_ = constant_of(d, c, "transmission_dispersion_abbe_number", 0.0f, kInfinity);
}

// The mean square of both alphas is that of isotropic facets.
TrowbridgeReitz PrincipledInputs::facets_of(float roughness, float anisotropy) const {
  const float alpha = remap_roughness_ ? sqr(roughness) : roughness;
  const float across = 1.0f - anisotropy;
  const float x = alpha * std::sqrt(2.0f / (1.0f + sqr(across)));
  return {std::min(x, 1.0f), std::min(across * x, 1.0f)};
}

float PrincipledInputs::dispersed(float ior, float lambda) const {
  if (!(abbe_ > 0.0f)) return ior;
  // Cauchy's formula A + B / lambda^2 through the index and the Abbe number.
  const float b = (ior - 1.0f) / (abbe_ * (1.0f / sqr(kLineF) - 1.0f / sqr(kLineC)));
  return std::max(ior + b * (1.0f / sqr(lambda) - 1.0f / sqr(kLineD)), kMinIor);
}

PrincipledSurface PrincipledInputs::at(const SurfaceInteraction& point,
                                       SampledWavelengths& lambda) const {
  PrincipledSurface s;
  s.thin_walled = thin_walled_;
  set_layers(point, lambda, s);
  set_base(point, lambda, s);
  s.lambdas = lambda.lambdas();
  if (s.subsurface == 0.0f) return s;
  // A thin wall has no inside: light scattered in it leaves on both sides.
  if (thin_walled_)
    scatter_at_surface(s, 0.5f * (1.0f - g_), 0.5f * (1.0f + g_));
  else if (free_path(point, lambda).is_black())
    scatter_at_surface(s, 1.0f, 0.0f);
  return s;
}

void PrincipledInputs::set_layers(const SurfaceInteraction& point, const SampledWavelengths& lambda,
                                  PrincipledSurface& s) const {
  s.fuzz_weight = fuzz_weight_.at(point);
  if (s.fuzz_weight > 0.0f) {
    s.fuzz_roughness = fuzz_roughness_.at(point);
    s.fuzz_color = color(fuzz_color_, point, lambda);
  }
  s.coat_weight = coat_weight_.at(point);
  if (s.coat_weight > 0.0f) {
    s.coat_ior = coat_ior_.at(point);
    s.coat_darkening = coat_darkening_.at(point);
    s.coat_color = color(coat_color_, point, lambda);
    s.coat_facets = facets_of(coat_roughness_.at(point), coat_anisotropy_.at(point));
    s.coat_affects_specular = coat_affects_specular_;
  }
  s.film_weight = film_weight_.at(point);
  if (s.film_weight > 0.0f) s.film = {film_ior_.at(point), 1000.0f * film_thickness_.at(point)};
}

void PrincipledInputs::set_base(const SurfaceInteraction& point, SampledWavelengths& lambda,
                                PrincipledSurface& s) const {
  s.metal_color = s.diffuse_color = color(base_color_, point, lambda) * base_weight_.at(point);
  s.metalness = metalness_.at(point);
  s.diffuse_roughness = diffuse_roughness_.at(point);
  s.specular_weight = specular_weight_.at(point);
  s.specular_color = color(specular_color_, point, lambda);
  s.facets = facets_of(roughness_.at(point), anisotropy_.at(point));
  if (s.coat_affects_specular)
    s.facets = roughened(s.facets, s.coat_facets, s.coat_weight, s.coat_ior);
  s.transmission = transmission_.at(point);
  if (s.transmission > 0.0f) s.transmission_color = color(transmission_color_, point, lambda);
  s.ior = ior_.at(point);
  // A texture must not make a boundary vanish at a point: rays then go straight (may_go_straight).
  if (!ior_.constant() && s.ior == 1.0f) s.ior = 1.0f + 1e-6f;
  if (abbe_ > 0.0f && s.refracts()) {
    const float ior = dispersed(s.ior, lambda.hero());
    s.ior = ior == 1.0f ? 1.0f + 1e-6f : ior;
    lambda.terminate_secondary();
  }
  s.diffuse_transmission = diffuse_transmission_.at(point);
  if (s.diffuse_transmission > 0.0f)
    s.diffuse_transmission_color = color(diffuse_transmission_color_, point, lambda);
  s.subsurface = subsurface_.at(point);
  if (s.subsurface > 0.0f) s.subsurface_color = color(subsurface_color_, point, lambda);
}

SampledSpectrum PrincipledInputs::free_path(const SurfaceInteraction& point,
                                            const SampledWavelengths& lambda) const {
  // Wavelengths without a path of their own get one too short to be seen beside the longest.
  constexpr float kMinShare = 1e-3f;
  const SampledSpectrum path = radius_scale_.at(point, lambda) * radius_.at(point);
  return clamp(path, std::max(kMinShare * path.max_component(), 0.0f), kInfinity);
}

bool PrincipledInputs::may_transmit() const {
  return transmission_.may_differ_from(0.0f) && metalness_.may_differ_from(1.0f);
}

bool PrincipledInputs::may_be_opaque_dielectric() const {
  return transmission_.may_differ_from(1.0f) && metalness_.may_differ_from(1.0f);
}

bool PrincipledInputs::may_scatter_below() const {
  return !thin_walled_ && subsurface_.may_differ_from(0.0f) && radius_.may_differ_from(0.0f) &&
         !radius_scale_.is_black() && may_be_opaque_dielectric();
}

bool PrincipledInputs::may_have_facets() const {
  if (metalness_.may_differ_from(0.0f) || film_weight_.may_differ_from(0.0f)) return true;
  // Below a coat the relative index is not 1 where that of the base is.
  const bool boundary = specular_weight_.may_differ_from(0.0f) &&
                        (ior_.may_differ_from(1.0f) || coat_may_affect_specular());
  return boundary || (may_transmit() && ior_.may_differ_from(1.0f));
}

bool PrincipledInputs::may_go_straight() const {
  if (!may_transmit()) return false;
  if (ior_.constant() == 1.0f) return true;
  const std::optional<TrowbridgeReitz> facets = constant_facets();
  return thin_walled_ && (!facets || facets->smooth());
}

std::optional<TrowbridgeReitz> PrincipledInputs::constant_facets() const {
  const auto roughness = roughness_.constant(), anisotropy = anisotropy_.constant();
  if (!roughness || !anisotropy) return std::nullopt;
  const TrowbridgeReitz base = facets_of(*roughness, *anisotropy);
  if (!coat_may_affect_specular()) return base;
  const auto coat = constant_coat_facets();
  if (!coat) return std::nullopt;
  if (coat->smooth()) return base;
  if (!coat_weight_.constant() || !coat_ior_.constant()) return std::nullopt;
  return roughened(base, *coat, *coat_weight_.constant(), *coat_ior_.constant());
}

std::optional<TrowbridgeReitz> PrincipledInputs::constant_coat_facets() const {
  const auto roughness = coat_roughness_.constant(), anisotropy = coat_anisotropy_.constant();
  if (!roughness || !anisotropy) return std::nullopt;
  return facets_of(*roughness, *anisotropy);
}

float PrincipledInputs::index_at_550_nm() const {
  return ior_.constant() ? dispersed(*ior_.constant(), 550.0f) : 1.5f;
}

}  // namespace nephroid

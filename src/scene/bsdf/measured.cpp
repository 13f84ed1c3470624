// Look-ups and sampling of measured reflection; see measured.h.
#include "scene/bsdf/measured.h"

#include "core/warps.h"

namespace nephroid {
namespace {

/// Cosines are clamped to at least this: f times cosine keeps the table's value, and both stay
/// finite.
constexpr float kMinCosine = 1e-6f;
/// Smaller projected areas count as no surface.
constexpr float kMinArea = 1e-6f;

/// Polar angle of a unit vector, exact next to the pole.
float polar_angle(const Vec3f& w) {
  return std::atan2(std::hypot(w.x, w.y), w.z);
}

float square_from_polar(float theta) {
  return safe_sqrt(theta * (2.0f * kInvPi));
}
float polar_from_square(float x) {
  return x * x * (0.5f * kPi);
}
/// Maps any azimuth into [0,1).
float square_from_azimuth(float phi) {
  const float y = (phi + kPi) * kInv2Pi;
  return y - std::floor(y);
}
float azimuth_from_square(float y) {
  return (2.0f * y - 1.0f) * kPi;
}

/// Facet normals closer to the pole than this (1.6e-5 radians) use the density at this distance,
/// where it is still finite and not zero.
constexpr float kPole = 3.2e-3f;

/// [R2] Solid angle of directions per area of the square of facet normals, for light that a facet
/// at x >= kPole mirrors at cosine `cos_facet`.
float directions_per_square(float x, float cos_facet) {
  const float normals = 2.0f * sqr(kPi) * x * std::sin(polar_from_square(x));
  return 4.0f * std::max(cos_facet, kMinCosine) * normals;
}

}  // namespace

/// An outgoing direction, turned or mirrored into the measured range of azimuths.
struct MeasuredBrdf::View {
  Vec3f w;
  float flip_x = 1, flip_y = 1;  ///< signs that `w` and the original direction differ by
  float phi = 0;                 ///< azimuth that facets are relative to; 0 unless isotropic
  float area = 0;                ///< projected area of the facets
  GridMix mix;

  Vec3f flipped(const Vec3f& v) const { return {v.x * flip_x, v.y * flip_y, v.z}; }
};

MeasuredBrdf::MeasuredBrdf(MeasuredTables t)
    : phi_(std::move(t.phi)),
      theta_(std::move(t.theta)),
      wavelengths_(std::move(t.wavelengths)),
      isotropic_(phi_.size() <= 2),
      values_are_ratios_(t.values_are_ratios),
      symmetry_(isotropic_ ? 1
                           : std::max(1, static_cast<int>(std::lround(
                                             2.0f * kPi / (phi_.back() - phi_.front()))))),
      facets_(std::move(t.facets)),
      projected_area_(std::move(t.projected_area)),
      visible_facets_(std::move(t.visible_facets)),
      luminance_(std::move(t.luminance)) {
  nodes_.width = t.spectra.width;
  nodes_.height = t.spectra.height;
  // All wavelengths of a node are stored side by side, since they are looked up together.
  const size_t nodes = nodes_.grid_size(), count = wavelengths_.size();
  const size_t grids = phi_.size() * theta_.size();
  spectra_.resize(t.spectra.values.size());
  means_.assign(grids * count, 0.0f);
  for (size_t g = 0; g < grids; ++g) {
    for (size_t l = 0; l < count; ++l) {
      const float* from = &t.spectra.values[(g * count + l) * nodes];
      double sum = 0.0;
      for (size_t n = 0; n < nodes; ++n) {
        spectra_[(g * nodes + n) * count + l] = from[n];
        sum += from[n];
      }
      means_[g * count + l] = static_cast<float>(sum / static_cast<double>(nodes));
    }
  }
}

WavelengthPlaces MeasuredBrdf::places(const SampledWavelengths& lambda) const {
  WavelengthPlaces places;
  for (int i = 0; i < kSpectrumSamples; ++i) places[i] = wavelengths_.find(lambda.lambda(i));
  return places;
}

MeasuredBrdf::View MeasuredBrdf::view_from(const Vec3f& wo) const {
  View view;
  float phi = std::atan2(wo.y, wo.x);
  if (symmetry_ > 1) {
    // Half a turn, and for four-fold symmetry also a mirror, map the direction to the table's
    // azimuths: the first image inside the table is taken, or else the nearest.
    float nearest = kInfinity;
    for (const Vec2f& flip : {Vec2f(1, 1), Vec2f(-1, -1), Vec2f(1, -1), Vec2f(-1, 1)}) {
      if (symmetry_ == 2 && flip.x != flip.y) continue;
      const float tried = std::atan2(wo.y * flip.y, wo.x * flip.x);
      const float outside = std::max({phi_.front() - tried, tried - phi_.back(), 0.0f});
      if (!(outside < nearest)) continue;
      nearest = outside;
      phi = tried;
      view.flip_x = flip.x;
      view.flip_y = flip.y;
    }
  }
  view.w = view.flipped(wo);
  view.phi = isotropic_ ? phi : 0.0f;
  const float theta = polar_angle(view.w);
  view.area = projected_area_({square_from_polar(theta), square_from_azimuth(phi)});
  const ParameterAxis::Place a = phi_.find(phi), b = theta_.find(theta);
  const size_t thetas = theta_.size();
  view.mix.add(a.lower * thetas + b.lower, (1.0f - a.t) * (1.0f - b.t));
  view.mix.add(a.lower * thetas + b.upper, (1.0f - a.t) * b.t);
  view.mix.add(a.upper * thetas + b.lower, a.t * (1.0f - b.t));
  view.mix.add(a.upper * thetas + b.upper, a.t * b.t);
  return view;
}

/// The facet normal m on the unit square, clamped off the pole.
Vec2f MeasuredBrdf::facet_at(const View& view, const Vec3f& m) const {
  return {std::max(kPole, square_from_polar(polar_angle(m))),
          square_from_azimuth(std::atan2(m.y, m.x) - view.phi)};
}

SampledSpectrum MeasuredBrdf::ratio(const View& view, const Vec2f& u,
                                    const WavelengthPlaces& places) const {
  const GridCell cell(nodes_, u);
  const size_t width = nodes_.width, size = nodes_.grid_size(), count = wavelengths_.size();
  SampledSpectrum sum;
  for (int k = 0; k < view.mix.count; ++k) {
    for (size_t corner = 0; corner < 4; ++corner) {
      const size_t dx = corner & 1, dy = corner >> 1;
      const float weight =
          view.mix.weight[k] * (dx ? cell.s : 1.0f - cell.s) * (dy ? cell.t : 1.0f - cell.t);
      const size_t node = view.mix.grid[k] * size + (cell.y + dy) * width + cell.x + dx;
      const float* spectrum = &spectra_[node * count];
      SampledSpectrum here;
      for (int i = 0; i < kSpectrumSamples; ++i) {
        const ParameterAxis::Place& place = places[i];
        here.set(i, lerp(place.t, spectrum[place.lower], spectrum[place.upper]));
      }
      sum += here * weight;
    }
  }
  return clamp(sum, 0.0f, kMaxValue);
}

float MeasuredBrdf::factor(const View& view, const Vec2f& facet, float cos_i) const {
  const float c = std::max(cos_i, kMinCosine);
  if (!values_are_ratios_) return 1.0f / c;
  if (!(view.area > kMinArea)) return 0.0f;
  return std::max(0.0f, facets_(facet)) / (4.0f * view.area * c);
}

BsdfEval MeasuredBrdf::evaluate(const Vec3f& wo, const Vec3f& wi,
                                const WavelengthPlaces& places) const {
  const View view = view_from(wo);
  const Vec3f half = view.w + view.flipped(wi);
  if (!(length_squared(half) > 0.0f)) return {};
  const Vec3f m = normalize(half);
  const Vec2f facet = facet_at(view, m);
  const BilinearWarp::Point u = visible_facets_.invert(facet, view.mix);

  // [R1]
  BsdfEval e;
  e.f = ratio(view, u.p, places) * factor(view, facet, wi.z);
  // [R3]
  e.pdf_w = u.density * luminance_.density(u.p, view.mix) /
            directions_per_square(facet.x, dot(view.w, m));
  return e;
}

std::optional<MeasuredBrdf::Sample> MeasuredBrdf::sample(const Vec3f& wo, const Vec2f& u,
                                                         const WavelengthPlaces& places) const {
  const View view = view_from(wo);
  const BilinearWarp::Point bright = luminance_.sample({u.y, u.x}, view.mix);
  const BilinearWarp::Point normal = visible_facets_.sample(bright.p, view.mix);

  const float theta = polar_from_square(normal.p.x);
  const float phi = azimuth_from_square(normal.p.y) + view.phi;
  const float sin_theta = std::sin(theta);
  const Vec3f m(sin_theta * std::cos(phi), sin_theta * std::sin(phi), std::cos(theta));
  const float cos_facet = dot(view.w, m);
  const Vec3f wi = normalize(m * (2.0f * cos_facet) - view.w);
  if (!(wi.z > 0.0f) || !(cos_facet > 0.0f)) return std::nullopt;

  Sample s;
  s.wi = view.flipped(wi);
  if (normal.p.x > kPole) {
    s.f = ratio(view, bright.p, places) * factor(view, normal.p, wi.z);
    s.pdf_w = bright.density * normal.density / directions_per_square(normal.p.x, cos_facet);
  } else {
    const BsdfEval e = evaluate(wo, s.wi, places);
    s.f = e.f;
    s.pdf_w = e.pdf_w;
  }
  if (!(s.pdf_w > 0.0f)) return std::nullopt;
  return s;
}

SampledSpectrum MeasuredBrdf::albedo(const Vec3f& wo, const WavelengthPlaces& places) const {
  const View view = view_from(wo);
  SampledSpectrum sum;
  for (int k = 0; k < view.mix.count; ++k) {
    const float* mean = &means_[view.mix.grid[k] * wavelengths_.size()];
    for (size_t i = 0; i < places.size(); ++i) {
      const int lane = static_cast<int>(i);
      sum.set(lane, sum[lane] + view.mix.weight[k] * lerp(places[i].t, mean[places[i].lower],
                                                          mean[places[i].upper]));
    }
  }
  return clamp(sum, 0.0f, 1.0f);
}

float MeasuredBsdf::share_of_tables(TransportMode mode) {
  return mode == TransportMode::kRadiance ? 1.0f : 0.9f;
}

BsdfEval MeasuredBsdf::eval_above(const Vec3f& wo, const Vec3f& wi, TransportMode mode) const {
  BsdfEval e = brdf_->evaluate(wo, wi, places_);
  if (mode == TransportMode::kImportance) e.f = brdf_->evaluate(wi, wo, places_).f;
  const float tables = share_of_tables(mode);
  e.pdf_w = tables * e.pdf_w + (1.0f - tables) * wi.z * kInvPi;
  return e;
}

BsdfEval MeasuredBsdf::eval(const Vec3f& wo, const Vec3f& wi, TransportMode mode, EventClass c,
                            ClassMask among) const {
  if (c != EventClass::kGlossy || !contains(among, c) || wo.z == 0.0f || wi.z == 0.0f ||
      (wo.z > 0.0f) != (wi.z > 0.0f))
    return {};
  const float side = wo.z > 0.0f ? 1.0f : -1.0f;
  return eval_above(wo * side, wi * side, mode);
}

std::optional<BsdfSample> MeasuredBsdf::sample(const Vec3f& wo, float uc, const Vec2f& u,
                                               TransportMode mode, ClassMask among) const {
  if (wo.z == 0.0f || !contains(among, EventClass::kGlossy)) return std::nullopt;
  const float side = wo.z > 0.0f ? 1.0f : -1.0f;
  const Vec3f o = wo * side;
  BsdfSample s;
  s.event = EventClass::kGlossy;
  if (mode == TransportMode::kRadiance) {
    const auto chosen = brdf_->sample(o, u, places_);
    if (!chosen) return std::nullopt;
    s.wi = chosen->wi;
    s.f = chosen->f;
    s.pdf_w = chosen->pdf_w;
  } else {
    if (uc < share_of_tables(mode)) {
      const auto chosen = brdf_->sample(o, u, places_);
      if (!chosen) return std::nullopt;
      s.wi = chosen->wi;
    } else {
      s.wi = square_to_cosine_hemisphere(u);
    }
    if (!(s.wi.z > 0.0f)) return std::nullopt;
    const BsdfEval e = eval_above(o, s.wi, mode);
    s.f = e.f;
    s.pdf_w = e.pdf_w;
  }
  s.wi *= side;
  return s;
}

}  // namespace nephroid

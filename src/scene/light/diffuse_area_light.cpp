// The diffuse area light: a primitive that emits the same radiance in all directions of its
// outside, or of both sides. The radiance is uniform, or an image over the shape's uv.
#include <cmath>

#include "core/warps.h"
#include "scene/light/light_table.h"
#include "scene/shape/plane_rectangle.h"
#include "scene/texture/image_placement.h"
#include "scene/texture/rgb_spectrum.h"

namespace nephroid {

namespace {

/// Emission shared by the lights of one shape.
struct AreaEmission {
  EmissionSpectrum radiance;  ///< radiance, or for an image its illuminant; times all scales
  ImagePtr image;             ///< null if uniform
  ImagePlacement placement;   ///< of the image
  Rgb factor;                 ///< of the image
  float image_mean = 1;       ///< mean of all values of the image
  bool two_sided = false;
  FloatTexturePtr alpha;   ///< null if the surface is opaque everywhere
  bool invisible = false;  ///< alpha is 0 everywhere: no ray can see or hit the light
  bool lets_pass = false;  ///< rays may pass through, by alpha or by the material

  SampledSpectrum at(const Vec2f& uv, const SampledWavelengths& lambda) const {
    if (!image) return radiance.sample(lambda);
    const Rgb c = product(image->bilinear(placement.in_image(uv), placement.wrap()), factor);
    return RgbEmission(image->color_space(), c).sample(lambda) * radiance.sample(lambda);
  }
};

class DiffuseAreaLight final : public Light {
 public:
  DiffuseAreaLight(std::shared_ptr<const AreaEmission> emission, ShapePtr shape, uint32_t primitive,
                   float power_scale)
      : emission_(std::move(emission)),
        shape_(std::move(shape)),
        rectangle_(emission_->image || emission_->alpha ? std::nullopt
                                                        : shape_->rectangle(primitive)),
        primitive_(primitive),
        scale_(power_scale),
        area_(shape_->area(primitive)) {}

  bool is_delta() const override { return emission_->invisible; }
  bool is_area() const override { return true; }

  std::optional<LightSample> sample_towards(const Vec3f& from, const Vec2f& u,
                                            const SampledWavelengths& lambda) const override {
    const auto point = rectangle_ ? rectangle_->sample_towards(from, u)
                                  : shape_->sample_towards(primitive_, from, u);
    if (!point || !(point->pdf > 0.0f)) return std::nullopt;
    const Vec3f d = point->p - from;
    if (!(length_squared(d) > 0.0f)) return std::nullopt;
    return light_of(*point, normalize(d), lambda);
  }

  bool has_whole_surface() const override { return !emission_->lets_pass; }

  std::optional<LightSample> seen_along(const Vec3f& from, const Vec3f& wi, float time,
                                        const SampledWavelengths& lambda) const override {
    if (!has_whole_surface()) return std::nullopt;
    Ray ray;
    ray.o = from;
    ray.d = wi;
    ray.time = time;
    const auto hit = shape_->intersect(primitive_, ray, 0.0f);
    if (!hit) return std::nullopt;
    SurfaceInteraction at;
    shape_->fill(primitive_, hit->uv, ray, hit->t, at);
    if (!(length_squared(at.p - from) > 0.0f)) return std::nullopt;
    const float pdf_w = pdf_towards(from, wi, at.p, at.ng);
    if (!std::isfinite(pdf_w)) return std::nullopt;
    return light_of({at.p, at.p_error, at.ng, at.uv, pdf_w}, wi, lambda);
  }

  float pdf_towards(const Vec3f& from, const Vec3f&, const Vec3f& p,
                    const Vec3f& ng) const override {
    if (emission_->invisible) return 0.0f;
    return rectangle_ ? rectangle_->pdf_towards(from, p, ng)
                      : shape_->pdf_towards(primitive_, from, p, ng);
  }

  SampledSpectrum radiance(const Vec3f&, const Vec3f& ng, const Vec2f& uv, const Vec3f& w,
                           const SampledWavelengths& lambda) const override {
    if (!emits_towards(ng, w)) return SampledSpectrum();
    return emission_->at(uv, lambda) * scale_;
  }

  std::optional<EmissionSample> sample_emission(const Vec2f& u_position, const Vec2f& u_direction,
                                                const SampledWavelengths& lambda) const override {
    const auto point = shape_->sample_area(primitive_, u_position);
    if (!point || !(point->pdf > 0.0f)) return std::nullopt;
    // If both sides emit, the first half of the square is the outside.
    Vec2f u = u_direction;
    float side = 1.0f;
    if (emission_->two_sided) {
      side = u.x < 0.5f ? 1.0f : -1.0f;
      u.x = std::min(u.x < 0.5f ? 2.0f * u.x : 2.0f * u.x - 1.0f, kOneMinusEpsilon);
    }
    const Vec3f local = square_to_cosine_hemisphere(u);
    if (!(local.z > 0.0f)) return std::nullopt;
    EmissionSample e;
    e.ray.d = normalize(Frame::from_z(point->ng * side).to_world(local));
    e.ray.o = offset_ray_origin(point->p, point->p_error, point->ng, e.ray.d);
    e.radiance = emission_->at(point->uv, lambda) * (scale_ * coverage(*point));
    if (e.radiance.is_black()) return std::nullopt;
    e.pdf_a = point->pdf;
    e.pdf_w = cosine_hemisphere_pdf_w(local.z) * (emission_->two_sided ? 0.5f : 1.0f);
    e.cos_theta = local.z;
    e.from_inside = side < 0.0f;
    if (!emission_->invisible) e.coverage = coverage(*point);
    e.p = point->p;
    e.p_error = point->p_error;
    e.ng = point->ng;
    e.uv = point->uv;
    return e;
  }

  EmissionDensity emission_pdf(const Vec3f& ng, const Vec3f& w) const override {
    if (!emits_towards(ng, w)) return {};
    return {1.0f / area_,
            cosine_hemisphere_pdf_w(abs_dot(ng, w)) * (emission_->two_sided ? 0.5f : 1.0f)};
  }

  float power() const override {
    return kPi * (emission_->two_sided ? 2.0f : 1.0f) * area_ * mean_radiance();
  }

  std::optional<LightBounds> bounds() const override {
    LightBounds b;
    b.bounds = shape_->bounds(primitive_);
    shape_->normal_bounds(primitive_, &b.axis, &b.cos_theta_o);
    b.power = kPi * area_ * mean_radiance();
    b.cos_theta_e = 0.0f;
    b.two_sided = emission_->two_sided;
    if (const auto point = shape_->sample_area(primitive_, {0.5f, 0.5f});
        point && b.is_flat() && !b.two_sided)
      b.depth = dot(b.axis, b.center() - point->p);
    return b;
  }

 private:
  /// The light of a point, whose pdf is pdf_w, seen in unit direction `wi`.
  std::optional<LightSample> light_of(const ShapeSample& point, const Vec3f& wi,
                                      const SampledWavelengths& lambda) const {
    if (!emits_towards(point.ng, -wi)) return std::nullopt;
    LightSample s;
    s.wi = wi;
    s.radiance = emission_->at(point.uv, lambda) * (scale_ * coverage(point));
    if (s.radiance.is_black()) return std::nullopt;
    s.pdf_w = point.pdf;
    s.p = point.p;
    s.p_error = point.p_error;
    s.ng = point.ng;
    s.delta = emission_->invisible;
    return s;
  }
  bool emits_towards(const Vec3f& ng, const Vec3f& w) const {
    return emission_->two_sided || dot(ng, w) > 0.0f;
  }
  float mean_radiance() const {
    return emission_->radiance.mean() * emission_->image_mean * scale_;
  }
  /// Probability that the surface is opaque here. A walk that hits it has tested this already.
  float coverage(const ShapeSample& point) const {
    if (!emission_->alpha) return 1.0f;
    TextureContext context;
    context.p = point.p;
    context.n = point.ng;
    context.uv = point.uv;
    return std::clamp(emission_->alpha->eval(context), 0.0f, 1.0f);
  }

  std::shared_ptr<const AreaEmission> emission_;
  ShapePtr shape_;
  std::optional<PlaneRectangle> rectangle_;  ///< the primitive, if a rectangle without use of uv
  uint32_t primitive_;
  float scale_;  ///< scale for "power", by this primitive's area
  float area_;
};

/// Mean of r, g and b over an image, weighted; negative values count as 0.
double weighted_mean(const Image& image, const Rgb& weights) {
  double sum = 0.0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Rgb c = image.texel(x, y, WrapMode::kClamp);
      for (int k = 0; k < 3; ++k) sum += std::max(0.0f, c[k]) * weights[k];
    }
  return sum / (static_cast<double>(image.width()) * image.height());
}

struct UniformOrImage {
  EmissionColor emission;
  ImagePtr image;
  Rgb factor{1, 1, 1};
  double luminance = 1.0;  ///< mean luminance of the image, in units of its illuminant
};

UniformOrImage read_area_emission(const DirectiveDescription& description, SceneFiles& files) {
  const ParameterSet& p = description.parameters;
  UniformOrImage e;
  if (p.get_string("filename", "").empty()) {
    e.emission = read_emission(p, "L", files, "srgb");
    return e;
  }
  if (const Parameter* colour = p.find("L"))
    throw SceneError(colour->where,
                     "an area light has both \"L\" and \"filename\", expected one of them");
  e.image = read_light_image(p, files);
  const RgbColorSpace& space = e.image->color_space();
  e.emission.spectrum = {std::shared_ptr<const void>(), &space.illuminant()};
  e.emission.scale = image_emission_scale(p, space);
  e.factor = read_factor(p);
  e.luminance = weighted_mean(*e.image, product(luminance_weights(space), e.factor));
  return e;
}

}  // namespace

std::vector<LightPtr> make_area_lights(const DirectiveDescription& description, ShapePtr shape,
                                       SceneFiles& files, const TextureLibrary&,
                                       FloatTexturePtr alpha, bool lets_pass,
                                       Diagnostics& diagnostics) {
  const FormatType& type = area_light_type(description);
  const ParameterSet& p = description.parameters;
  const UniformOrImage e = read_area_emission(description, files);
  const bool two_sided = p.get_bool("twosided", false);
  const float power = p.get_float("power", -1.0f);
  light_name(p);  // throws if "name" is no string; scene_labels.h uses it
  const ParameterSet none;
  const ImagePlacement placement(e.image ? p : none, "", WrapMode::kClamp);
  warn_of_unused_flux(p, diagnostics);
  p.report_unused("area light \"" + description.type + "\"", type, diagnostics);

  const std::optional<float> opacity = alpha ? alpha->constant() : 1.0f;
  const bool invisible = opacity && *opacity <= 0.0f;
  if (invisible || (opacity && *opacity >= 1.0f)) alpha = nullptr;
  lets_pass |= invisible || alpha;
  const float image_mean =
      e.image ? static_cast<float>(weighted_mean(*e.image, e.factor * (1 / 3.0f))) : 1.0f;
  const auto emission = std::make_shared<const AreaEmission>(
      AreaEmission{EmissionSpectrum(*e.emission.spectrum, e.emission.scale), e.image, placement,
                   e.factor, image_mean, two_sided, std::move(alpha), invisible, lets_pass});

  std::vector<LightPtr> lights;
  const uint32_t count = shape->primitive_count();
  if (power > 0.0f && count > 1)
    diagnostics.warn(p.find("power")->where,
                     "each of the " + std::to_string(count) +
                         " primitives of a shape is a light of its own and emits all of \"power\"");
  for (uint32_t i = 0; i < count; ++i) {
    float scale = 1.0f;
    if (power > 0.0f) {
      // Watts (lumens) of this light at luminance 1.
      const double one = e.luminance * (two_sided ? 2.0 : 1.0) * shape->area(i) * kPi;
      scale = scale_to(*p.find("power"), power, one, 1.0f);
    }
    lights.push_back(std::make_unique<DiffuseAreaLight>(emission, shape, i, scale));
  }
  return lights;
}

}  // namespace nephroid

// The infinite light with an image: a map of the sphere (sphere_map.h), constant within each pixel,
// so its density by pixel means is exact. Next-event estimation samples only radiance above the
// average and leaves the rest to BSDF sampling (MIS compensation: Karlik et al. 2019), but not in
// scenes with scattering media. Photons start in proportion to the whole radiance.
#include "core/parallel.h"
#include "scene/light/direction_map.h"
#include "scene/light/infinite_emission.h"
#include "scene/light/light_table.h"
#include "scene/light/piecewise_constant_2d.h"
#include "scene/light/sphere_map.h"

namespace nephroid {

namespace {

class ImageInfiniteLight final : public Light {
 public:
  ImageInfiniteLight(const Image& image, const Transform& local_to_world, float scale)
      : sphere_map_(image.width(), image.height()),
        map_(local_to_world),
        illuminant_(image.color_space().illuminant(), scale),
        pixels_(static_cast<size_t>(image.width()) * image.height()) {
    const int width = sphere_map_.width(), height = sphere_map_.height();
    // Emission of a pixel: its value times its solid angle, in units of the mean solid angle.
    std::vector<float> weights(pixels_.size());
    parallel_chunks(height, 8, [&](int64_t, int64_t begin, int64_t end) {
      for (int y = static_cast<int>(begin); y < end; ++y)
        for (int x = 0; x < width; ++x) {
          const Rgb c = image.texel(x, y, WrapMode::kClamp);
          pixels_[index(x, y)] = RgbEmission(image.color_space(), c);
          weights[index(x, y)] = positive_mean(c) * sphere_map_.relative_solid_angle(y);
        }
    });
    distribution_ = PiecewiseConstant2D(weights, width, height);
    const float mean = static_cast<float>(distribution_.mean());
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        float& w = weights[index(x, y)];
        w = std::max(0.0f, w - mean * sphere_map_.relative_solid_angle(y));
      }
    direct_ = PiecewiseConstant2D(std::move(weights), width, height);
    if (!(direct_.mean() > 1e-3 * distribution_.mean())) direct_ = distribution_;
  }

  bool is_infinite() const override { return true; }
  bool emits_through_disk() const override { return true; }

  std::optional<LightSample> sample_towards(const Vec3f& from, const Vec2f& u,
                                            const SampledWavelengths& lambda) const override {
    const auto direction = sample_direction(direct_, u);
    if (!direction) return std::nullopt;
    LightSample s;
    s.radiance = pixel_radiance(direction->pixel, lambda);
    s.wi = direction->w;
    s.pdf_w = direction->pdf_w;
    s.p = point_outside(from, s.wi, sphere_);
    s.infinite = true;
    return s;
  }

  float pdf_towards(const Vec3f&, const Vec3f& wi, const Vec3f&, const Vec3f&) const override {
    const Vec3f local = map_.to_local(wi);
    const Vec2i pixel = sphere_map_.pixel(local);
    return density(direct_.pdf(pixel.x, pixel.y), pixel.y, local);
  }

  SampledSpectrum radiance_at_infinity(const Vec3f&, const Vec3f& w,
                                       const SampledWavelengths& lambda) const override {
    const Vec2i pixel = sphere_map_.pixel(map_.to_local(w));
    return pixel_radiance(index(pixel.x, pixel.y), lambda);
  }

  std::optional<EmissionSample> sample_emission(const Vec2f& u_position, const Vec2f& u_direction,
                                                const SampledWavelengths& lambda) const override {
    const auto direction = sample_direction(distribution_, u_direction);
    if (!direction) return std::nullopt;
    return emission_through_disk(-direction->w, direction->pdf_w,
                                 pixel_radiance(direction->pixel, lambda), u_position, sphere_);
  }

  EmissionDensity emission_pdf(const Vec3f&, const Vec3f& w) const override {
    const Vec3f local = map_.to_local(-w);
    const Vec2i pixel = sphere_map_.pixel(local);
    return {disk_pdf_a(sphere_), density(distribution_.pdf(pixel.x, pixel.y), pixel.y, local)};
  }

  float power() const override {
    // In this order, since either of the first two can be enormous and the other tiny.
    return illuminant_.mean() * static_cast<float>(distribution_.mean()) * 4.0f * kPi * kPi *
           sqr(sphere_.radius);
  }
  std::optional<LightBounds> bounds() const override { return std::nullopt; }
  void set_scene_sphere(const SceneSphere& sphere) override { sphere_ = sphere; }
  void leave_out_nothing() override { direct_ = distribution_; }

 private:
  struct Direction {
    Vec3f w;  ///< towards the light
    float pdf_w = 0;
    size_t pixel = 0;
  };

  size_t index(int x, int y) const { return static_cast<size_t>(y) * sphere_map_.width() + x; }

  /// pdf_w in the world from the density per area of the unit square, in a pixel of `row`.
  float density(float pdf_square, int row, const Vec3f& local) const {
    return pdf_square * kInv4Pi / (map_.jacobian(local) * sphere_map_.relative_solid_angle(row));
  }

  SampledSpectrum pixel_radiance(size_t pixel, const SampledWavelengths& lambda) const {
    return pixels_[pixel].sample(lambda) * illuminant_.sample(lambda);
  }

  std::optional<Direction> sample_direction(const PiecewiseConstant2D& distribution,
                                            const Vec2f& u) const {
    const auto sample = distribution.sample(u);
    if (!sample) return std::nullopt;
    const Vec3f local = sphere_map_.direction(sample->point);
    const float pdf_w = density(sample->pdf, sample->y, local);
    // pdf_w underflows where another pixel is brighter by 30 orders of magnitude.
    if (!(pdf_w > 0.0f)) return std::nullopt;
    return Direction{map_.to_world(local), pdf_w, index(sample->x, sample->y)};
  }

  SphereMap sphere_map_;
  DirectionMap map_;
  EmissionSpectrum illuminant_;  ///< illuminant of the image, times all scales
  std::vector<RgbEmission> pixels_;
  PiecewiseConstant2D distribution_;  ///< in proportion to radiance
  PiecewiseConstant2D direct_;        ///< by radiance above the average, for next-event estimation
  SceneSphere sphere_;
};

}  // namespace

LightPtr make_image_infinite_light(const LightDescription& description, const LightScope& scope) {
  const ParameterSet& p = description.parameters;
  if (const Parameter* colour = p.find("L"))
    throw SceneError(colour->where,
                     "an infinite light has both \"L\" and an image, expected one of them");
  const ImagePtr image = read_environment_image(p, scope.files);
  const float scale = sphere_emission_scale(p, *image);
  return std::make_unique<ImageInfiniteLight>(*image, Transform(description.transform.start),
                                              scale);
}

}  // namespace nephroid

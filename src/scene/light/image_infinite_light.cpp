// The infinite light with an image: an equal-area octahedral map of the sphere, constant within
// each pixel, so that the density in proportion to the pixels' mean values is exact. Light sampling
// takes only what is brighter than the average: the rest is found well by BSDF sampling, which it
// is weighed against (Karlik et al. 2019, "MIS compensation"). Photons start in proportion to the
// whole.
#include "core/parallel.h"
#include "scene/light/direction_map.h"
#include "scene/light/equal_area_map.h"
#include "scene/light/infinite_emission.h"
#include "scene/light/light_table.h"
#include "scene/light/piecewise_constant_2d.h"

namespace nephroid {

namespace {

class ImageInfiniteLight final : public Light {
 public:
  ImageInfiniteLight(const Image& image, const Transform& local_to_world, float scale)
      : size_(image.width()),
        map_(local_to_world),
        illuminant_(image.color_space().illuminant(), scale),
        pixels_(static_cast<size_t>(size_) * size_) {
    std::vector<float> weights(pixels_.size());
    parallel_chunks(size_, 8, [&](int64_t, int64_t begin, int64_t end) {
      for (int y = static_cast<int>(begin); y < end; ++y)
        for (int x = 0; x < size_; ++x) {
          const Rgb c = image.texel(x, y, WrapMode::kClamp);
          pixels_[index(x, y)] = RgbEmission(image.color_space(), c);
          weights[index(x, y)] = positive_mean(c);
        }
    });
    distribution_ = PiecewiseConstant2D(weights, size_, size_);
    const float mean = static_cast<float>(distribution_.mean());
    for (float& w : weights) w = std::max(0.0f, w - mean);
    direct_ = PiecewiseConstant2D(std::move(weights), size_, size_);
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
    const Vec2i pixel = pixel_of(local);
    return direct_.pdf(pixel.x, pixel.y) * kInv4Pi / map_.jacobian(local);
  }

  SampledSpectrum radiance_at_infinity(const Vec3f&, const Vec3f& w,
                                       const SampledWavelengths& lambda) const override {
    const Vec2i pixel = pixel_of(map_.to_local(w));
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
    const Vec2i pixel = pixel_of(local);
    return {disk_pdf_a(sphere_),
            distribution_.pdf(pixel.x, pixel.y) * kInv4Pi / map_.jacobian(local)};
  }

  float power() const override {
    // Either of the first two may be enormous and the other tiny.
    return illuminant_.mean() * static_cast<float>(distribution_.mean()) * 4.0f * kPi * kPi *
           sqr(sphere_.radius);
  }
  std::optional<LightBounds> bounds() const override { return std::nullopt; }
  void set_scene_sphere(const SceneSphere& sphere) override { sphere_ = sphere; }

 private:
  struct Direction {
    Vec3f w;  ///< towards the light
    float pdf_w = 0;
    size_t pixel = 0;
  };

  size_t index(int x, int y) const { return static_cast<size_t>(y) * size_ + x; }

  Vec2i pixel_of(const Vec3f& local) const {
    const Vec2f st = equal_area_sphere_to_square(local) * static_cast<float>(size_);
    return {std::clamp(static_cast<int>(st.x), 0, size_ - 1),
            std::clamp(static_cast<int>(st.y), 0, size_ - 1)};
  }

  SampledSpectrum pixel_radiance(size_t pixel, const SampledWavelengths& lambda) const {
    return pixels_[pixel].sample(lambda) * illuminant_.sample(lambda);
  }

  std::optional<Direction> sample_direction(const PiecewiseConstant2D& distribution,
                                            const Vec2f& u) const {
    const auto sample = distribution.sample(u);
    if (!sample) return std::nullopt;
    const Vec3f local = equal_area_square_to_sphere(sample->point);
    const float pdf_w = sample->pdf * kInv4Pi / map_.jacobian(local);
    // It underflows where another pixel is brighter by 30 orders of magnitude.
    if (!(pdf_w > 0.0f)) return std::nullopt;
    return Direction{map_.to_world(local), pdf_w, index(sample->x, sample->y)};
  }

  int size_;
  DirectionMap map_;
  EmissionSpectrum illuminant_;  ///< times all scales
  std::vector<RgbEmission> pixels_;
  PiecewiseConstant2D distribution_;  ///< by radiance
  PiecewiseConstant2D direct_;        ///< by radiance above the average, for next-event estimation
  SceneSphere sphere_;
};

}  // namespace

LightPtr make_image_infinite_light(const LightDescription& description, const LightScope& scope) {
  const ParameterSet& p = description.parameters;
  if (const Parameter* colour = p.find("L"))
    throw SceneError(colour->where,
                     "an infinite light has both \"L\" and \"filename\", expected one of them");
  const ImagePtr image = read_sphere_image(p, scope.files, "an infinite light");
  const float scale = sphere_emission_scale(p, *image);
  return std::make_unique<ImageInfiniteLight>(*image, Transform(description.transform.start),
                                              scale);
}

}  // namespace nephroid

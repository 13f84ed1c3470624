// The projection light: a slide projector, a point whose intensity is a perspective image along +z,
// constant within each pixel. Directions are sampled in proportion to the pixels' power.
#include "scene/light/light_table.h"
#include "scene/light/piecewise_constant_2d.h"
#include "scene/light/point_emitter.h"

namespace nephroid {

namespace {

/// The image as a rectangle in the plane z = 1. x and y (downwards) run as in the image.
struct Slide {
  int width = 1, height = 1;
  float half_x = 1, half_y = 1;

  /// `fov` in degrees spans the shorter side.
  Slide(int image_width, int image_height, float fov) : width(image_width), height(image_height) {
    const double half = std::tan(fov * (kPiDouble / 360.0));
    const double aspect = static_cast<double>(width) / height;
    half_x = static_cast<float>(aspect > 1.0 ? half * aspect : half);
    half_y = static_cast<float>(aspect > 1.0 ? half : half / aspect);
  }
  double area() const { return 4.0 * half_x * half_y; }
  /// The point of the plane at (u, v) of the image, each in [0,1]; not normalised.
  Vec3f point(float u, float v) const {
    return {(2.0f * u - 1.0f) * half_x, (2.0f * v - 1.0f) * half_y, 1.0f};
  }
  /// Solid angle per area in the plane, at a point of it: the cube of the cosine.
  static double solid_angle_per_area(const Vec3f& on_plane) {
    const double r2 =
        1.0 + sqr(static_cast<double>(on_plane.x)) + sqr(static_cast<double>(on_plane.y));
    return 1.0 / (r2 * std::sqrt(r2));
  }
  double solid_angle_per_area(int x, int y) const {
    return solid_angle_per_area(point((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                                      (static_cast<float>(y) + 0.5f) / static_cast<float>(height)));
  }
};

class ProjectionLight final : public PointEmitter {
 public:
  ProjectionLight(const Transform& local_to_world, const Image& image, const Slide& slide,
                  float scale)
      : PointEmitter(local_to_world),
        slide_(slide),
        illuminant_(image.color_space().illuminant(), scale) {
    std::vector<float> weights;
    double sum = 0.0;
    for (int y = 0; y < slide.height; ++y)
      for (int x = 0; x < slide.width; ++x) {
        const Rgb c = image.texel(x, y, WrapMode::kClamp);
        pixels_.emplace_back(image.color_space(), c);
        weights.push_back(static_cast<float>(positive_mean(c) * slide.solid_angle_per_area(x, y)));
        sum += positive_mean(c);
      }
    distribution_ = PiecewiseConstant2D(std::move(weights), slide.width, slide.height);
    const double pixels = static_cast<double>(slide.width) * slide.height;
    bounds_.power = kPi * illuminant_.mean() * static_cast<float>(sum / pixels);
    if (map_.keeps_angles()) {
      bounds_.axis = map_.to_world(Vec3f(0, 0, 1));
      // Up to the corners, with a margin for rounding.
      bounds_.cos_theta_o = normalize(slide.point(1.0f, 1.0f)).z;
      bounds_.cos_theta_e = 0.9999f;
    }
  }

  std::optional<EmissionSample> sample_emission(const Vec2f&, const Vec2f& u_direction,
                                                const SampledWavelengths& lambda) const override {
    const auto s = distribution_.sample(u_direction);
    if (!s) return std::nullopt;
    const Vec3f on_plane = slide_.point(s->point.x, s->point.y);
    const Vec3f local = normalize(on_plane);
    if (local.z < kNearest) return std::nullopt;
    const double pdf_w = s->pdf / (slide_.area() * Slide::solid_angle_per_area(on_plane));
    return emission(local, static_cast<float>(pdf_w), pixel(s->x, s->y, lambda));
  }

  float power() const override {
    return static_cast<float>(illuminant_.mean() * slide_.area() * distribution_.mean());
  }

 private:
  SampledSpectrum intensity(const Vec3f& local, const SampledWavelengths& lambda) const override {
    const std::optional<Vec2i> at = pixel_towards(local);
    return at ? pixel(at->x, at->y, lambda) : SampledSpectrum();
  }
  float direction_pdf(const Vec3f& local) const override {
    const std::optional<Vec2i> at = pixel_towards(local);
    if (!at) return 0.0f;
    const double per_area = Slide::solid_angle_per_area(local / local.z);
    return static_cast<float>(distribution_.pdf(at->x, at->y) / (slide_.area() * per_area));
  }
  /// The pixel in direction `local`. Empty outside of the image.
  std::optional<Vec2i> pixel_towards(const Vec3f& local) const {
    if (local.z < kNearest) return std::nullopt;
    const float u = 0.5f + 0.5f * local.x / (local.z * slide_.half_x);
    const float v = 0.5f + 0.5f * local.y / (local.z * slide_.half_y);
    if (!(u >= 0.0f && u <= 1.0f && v >= 0.0f && v <= 1.0f)) return std::nullopt;
    return Vec2i{
        std::min(static_cast<int>(u * static_cast<float>(slide_.width)), slide_.width - 1),
        std::min(static_cast<int>(v * static_cast<float>(slide_.height)), slide_.height - 1)};
  }
  SampledSpectrum pixel(int x, int y, const SampledWavelengths& lambda) const {
    return pixels_[static_cast<size_t>(y) * slide_.width + x].sample(lambda) *
           illuminant_.sample(lambda);
  }

  /// Smallest emitted cosine: excludes directions almost in the plane of the lens.
  static constexpr float kNearest = 1e-3f;

  Slide slide_;
  EmissionSpectrum illuminant_;  ///< illuminant of the image, times all scales
  std::vector<RgbEmission> pixels_;
  PiecewiseConstant2D distribution_;  ///< density over the image, by power
};

/// Lumens of the light if its luminous intensity is the image's luminance.
double lumens(const Image& image, const Slide& slide) {
  const Rgb weights = luminance_weights(image.color_space());
  double sum = 0.0;
  for (int y = 0; y < slide.height; ++y)
    for (int x = 0; x < slide.width; ++x) {
      const Rgb c = image.texel(x, y, WrapMode::kClamp);
      double luminance = 0.0;
      for (int k = 0; k < 3; ++k) luminance += std::max(0.0f, c[k]) * weights[k];
      sum += luminance * slide.solid_angle_per_area(x, y);
    }
  return sum * slide.area() / (static_cast<double>(slide.width) * slide.height);
}

}  // namespace

LightPtr make_projection_light(const LightDescription& description, const LightScope& scope) {
  const ParameterSet& p = description.parameters;
  if (p.get_string("filename", "").empty())
    throw SceneError(description.where,
                     "the projection light has no \"filename\", expected an image");
  const float fov = p.get_float("fov", 90.0f);
  if (!(fov > 0.0f && fov < 180.0f))
    throw SceneError(p.find("fov")->where,
                     "the \"fov\" of a projection light must lie between 0 and 180 degrees");
  const ImagePtr image = read_light_image(p, scope.files);
  const Slide slide(image->width(), image->height(), fov);
  float scale = image_emission_scale(p, image->color_space());
  const float power = p.get_float("power", -1.0f);
  if (power > 0.0f) scale = scale_to(*p.find("power"), power, lumens(*image, slide), scale);
  const Transform upright(Mat44d().setScale(Vec3d(1, -1, 1)));
  return std::make_unique<ProjectionLight>(upright * Transform(description.transform.start), *image,
                                           slide, scale);
}

}  // namespace nephroid

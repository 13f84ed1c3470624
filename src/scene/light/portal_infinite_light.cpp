// The infinite light with a portal, a rectangle such as a window: in rooms, most samples of a whole
// sky would hit the outside of the walls. The map is resampled in coordinates in which the portal
// is a rectangle from every point, and sampled within it. Paper: Bitterli, Novak & Jarosz 2015,
// Portal-Masked Environment Map Sampling.
#include <array>

#include "core/counted.h"
#include "core/parallel.h"
#include "scene/light/direction_map.h"
#include "scene/light/infinite_emission.h"
#include "scene/light/light_table.h"
#include "scene/light/sphere_map.h"
#include "scene/light/windowed_distribution.h"

namespace nephroid {

namespace {

/// The rectangle, and the rectified coordinates (u, v) of outward directions through it. They are
/// the direction's angles with the portal's normal z, projected to the xz and yz planes, from 0 at
/// -90 degrees to 1 at 90 degrees.
class Portal {
 public:
  using Window = WindowedDistribution::Window;

  /// `corners` of a rectangle, in order. Outside is where (c3 - c0) x (c1 - c0) points.
  explicit Portal(const std::array<Vec3f, 4>& corners)
      : origin_(corners[0]),
        opposite_(corners[2]),
        side_x_(Vec3d(corners[3]) - Vec3d(corners[0])),
        side_y_(Vec3d(corners[1]) - Vec3d(corners[0])),
        x_(side_x_.normalized()),
        y_(side_y_.normalized()),
        z_(x_.cross(y_).normalized()) {}

  double area() const { return side_x_.length() * side_y_.length(); }
  /// A point of the rectangle; `u` in [0,1]^2.
  Vec3f point(const Vec2f& u) const { return Vec3f(origin_ + side_x_ * u.x + side_y_ * u.y); }

  /// Cosine between a direction and the portal's normal.
  double cosine(const Vec3f& w) const { return z_.dot(Vec3d(w)); }

  struct Rectified {
    double u = 0, v = 0;
    double solid_angle = 0;  ///< solid angle per area in (u, v), [P3]
  };
  /// Empty for directions that do not lead outwards. `world` need not be of unit length.
  std::optional<Rectified> rectified(const Vec3d& world) const {
    const Vec3d w(x_.dot(world), y_.dot(world), z_.dot(world));
    if (!(w.z > 0.0)) return std::nullopt;
    return rectified_from_angles(std::atan2(w.x, w.z), std::atan2(w.y, w.z));
  }
  /// The unit direction at (u, v), and its cosine with the normal.
  struct Direction {
    Vec3f w;
    double cosine = 0, solid_angle = 0;
  };
  Direction direction(double u, double v) const {
    const double a = (u - 0.5) * kPiDouble, b = (v - 0.5) * kPiDouble;
    const double ca = std::max(0.0, std::cos(a)), cb = std::max(0.0, std::cos(b));
    const Vec3d w(std::sin(a) * cb, ca * std::sin(b), ca * cb);
    const double l = w.length();
    Direction d;
    if (!(l > 0.0)) return d;
    d.w = Vec3f((x_ * w.x + y_ * w.y + z_ * w.z) / l);
    d.cosine = w.z / l;
    d.solid_angle = sqr(kPiDouble) * w.z / (l * l * l);
    return d;
  }

  /// The part of the map visible from `p`. Empty if `p` is outside.
  std::optional<Window> window(const Vec3f& p) const {
    const auto a = rectified(origin_ - Vec3d(p)), b = rectified(opposite_ - Vec3d(p));
    if (!a || !b) return std::nullopt;
    return Window{std::min(a->u, b->u), std::min(a->v, b->v), std::max(a->u, b->u),
                  std::max(a->v, b->v)};
  }

 private:
  static Rectified rectified_from_angles(double a, double b) {
    Rectified r;
    r.u = std::clamp(a / kPiDouble + 0.5, 0.0, 1.0);
    r.v = std::clamp(b / kPiDouble + 0.5, 0.0, 1.0);
    const double ca = std::cos(a), cb = std::cos(b);
    // Squared length of the vector (sin a cos b, cos a sin b, cos a cos b).
    const double l2 = sqr(std::sin(a) * cb) + sqr(ca);
    r.solid_angle = sqr(kPiDouble) * ca * cb / (l2 * std::sqrt(l2));
    return r;
  }

  Vec3d origin_, opposite_;
  Vec3d side_x_, side_y_;
  Vec3d x_, y_, z_;
};

bool contains(const Portal::Window& w, double u, double v) {
  return u >= w.x0 && u <= w.x1 && v >= w.y0 && v <= w.y1;
}

class PortalInfiniteLight final : public Light {
 public:
  PortalInfiniteLight(const Image& sphere, const Transform& local_to_world, const Portal& portal,
                      float scale)
      : size_(sphere.width() == 1 ? kColourSize : sphere.height()),
        portal_(portal),
        illuminant_(sphere.color_space().illuminant(), scale),
        pixels_(static_cast<size_t>(size_) * size_) {
    const DirectionMap map(local_to_world);
    const SphereMap sphere_map(sphere.width(), sphere.height());
    std::vector<float> weights(pixels_.size());
    std::vector<double> through(size_, 0.0);
    parallel_chunks(size_, 8, [&](int64_t, int64_t begin, int64_t end) {
      for (int y = static_cast<int>(begin); y < end; ++y)
        for (int x = 0; x < size_; ++x) {
          const Portal::Direction d = portal_.direction((x + 0.5) / size_, (y + 0.5) / size_);
          const Rgb c = sphere_map.bilinear(sphere, map.to_local(d.w));
          pixels_[index(x, y)] = RgbEmission(sphere.color_space(), c);
          const double weight = positive_mean(c) * d.solid_angle;
          weights[index(x, y)] = static_cast<float>(weight);
          through[y] += weight * d.cosine;
        }
    });
    double sum = 0.0;
    for (const double t : through) sum += t;
    flux_ = static_cast<float>(illuminant_.mean() * portal_.area() * sum /
                               static_cast<double>(pixels_.size()));
    distribution_ = WindowedDistribution(std::move(weights), size_, size_);
  }

  bool is_infinite() const override { return true; }

  std::optional<LightSample> sample_towards(const Vec3f& from, const Vec2f& u,
                                            const SampledWavelengths& lambda) const override {
    const auto window = portal_.window(from);
    if (!window) return std::nullopt;
    const auto chosen = sample_direction(u, *window);
    if (!chosen) return std::nullopt;
    LightSample s;
    s.radiance = pixel_radiance(chosen->pixel, lambda);
    s.wi = chosen->w;
    s.pdf_w = chosen->pdf_w;
    s.p = point_outside(from, s.wi, sphere_);
    s.infinite = true;
    return s;
  }

  float pdf_towards(const Vec3f& from, const Vec3f& wi, const Vec3f&, const Vec3f&) const override {
    const auto window = portal_.window(from);
    const auto r = portal_.rectified(Vec3d(wi));
    if (!window || !r || !contains(*window, r->u, r->v) || !(r->solid_angle > 0.0)) return 0.0f;
    return static_cast<float>(distribution_.pdf(cell(r->u), cell(r->v), *window) / r->solid_angle);
  }

  SampledSpectrum radiance_at_infinity(const Vec3f& from, const Vec3f& w,
                                       const SampledWavelengths& lambda) const override {
    const auto window = portal_.window(from);
    const auto r = portal_.rectified(Vec3d(w));
    if (!window || !r || !contains(*window, r->u, r->v)) return SampledSpectrum();
    return pixel_radiance(index(cell(r->u), cell(r->v)), lambda);
  }

  std::optional<EmissionSample> sample_emission(const Vec2f& u_position, const Vec2f& u_direction,
                                                const SampledWavelengths& lambda) const override {
    const auto chosen = sample_direction(u_direction, Portal::Window());
    if (!chosen) return std::nullopt;
    EmissionSample e;
    e.ray.o = portal_.point(u_position);
    e.ray.d = -chosen->w;
    e.radiance = pixel_radiance(chosen->pixel, lambda);
    e.pdf_a = static_cast<float>(1.0 / portal_.area());
    e.pdf_w = chosen->pdf_w;
    e.cos_theta = static_cast<float>(std::max(0.0, portal_.cosine(chosen->w)));
    e.from_behind = true;
    return e;
  }

  EmissionDensity emission_pdf(const Vec3f&, const Vec3f& w) const override {
    const auto r = portal_.rectified(Vec3d(-w));
    const double cosine = portal_.cosine(-w);
    if (!r || !(cosine > 0.0) || !(r->solid_angle > 0.0)) return {};
    const double pdf = distribution_.pdf(cell(r->u), cell(r->v), Portal::Window());
    return {static_cast<float>(1.0 / (portal_.area() * cosine)),
            static_cast<float>(pdf / r->solid_angle)};
  }

  float power() const override { return flux_; }
  std::optional<LightBounds> bounds() const override { return std::nullopt; }
  void set_scene_sphere(const SceneSphere& sphere) override { sphere_ = sphere; }

 private:
  struct Direction {
    Vec3f w;  ///< pointing outwards
    float pdf_w = 0;
    size_t pixel = 0;
  };

  /// Map size for a single colour, which looks the same at any size and is sampled better in parts.
  static constexpr int kColourSize = 64;

  size_t index(int x, int y) const { return static_cast<size_t>(y) * size_ + x; }
  int cell(double u) const { return std::min(static_cast<int>(u * size_), size_ - 1); }

  SampledSpectrum pixel_radiance(size_t pixel, const SampledWavelengths& lambda) const {
    return pixels_[pixel].sample(lambda) * illuminant_.sample(lambda);
  }

  std::optional<Direction> sample_direction(const Vec2f& u, const Portal::Window& window) const {
    const auto s = distribution_.sample(u, window);
    if (!s) return std::nullopt;
    const Portal::Direction d = portal_.direction(s->x, s->y);
    if (!(d.solid_angle > 0.0)) return std::nullopt;
    const auto pdf_w = static_cast<float>(s->pdf / d.solid_angle);
    // pdf_w underflows where another pixel is brighter by 30 orders of magnitude.
    if (!(pdf_w > 0.0f)) return std::nullopt;
    return Direction{d.w, pdf_w, index(s->column, s->row)};
  }

  int size_;
  Portal portal_;
  EmissionSpectrum illuminant_;      ///< illuminant of the image, times all scales
  std::vector<RgbEmission> pixels_;  ///< the rectified map
  WindowedDistribution distribution_;
  float flux_ = 0.0f;  ///< flux through the portal
  SceneSphere sphere_;
};

/// Reads the four corners, which are in world space whatever the light's transform. Throws
/// SceneError if they are no rectangle.
Portal read_portal(const ParameterSet& p) {
  const std::vector<Vec3f> c = p.get_point3s("portal");
  const SourceLocation& where = p.find("portal")->where;
  if (c.size() != 4)
    throw SceneError(where, "the \"portal\" of an infinite light has " +
                                counted(c.size(), "corner") + ", expected 4");
  const auto edge = [&](size_t a, size_t b) { return (Vec3d(c[b]) - Vec3d(c[a])).normalized(); };
  const Vec3d e01 = edge(0, 1), e12 = edge(1, 2), e32 = edge(3, 2), e03 = edge(0, 3);
  // The tolerances are pbrt-v4's.
  constexpr double kTolerance = 1e-3;
  const bool parallel =
      std::abs(e01.dot(e32) - 1.0) <= kTolerance && std::abs(e12.dot(e03) - 1.0) <= kTolerance;
  const bool square = std::abs(e01.dot(e12)) <= kTolerance && std::abs(e03.dot(e01)) <= kTolerance;
  if (!parallel || !square)
    throw SceneError(where,
                     "the \"portal\" of an infinite light is not a rectangle, expected its four "
                     "corners in order");
  return Portal({c[0], c[1], c[2], c[3]});
}

/// One pixel of a colour without "filename". As in pbrt-v4 it becomes an sRGB colour: other spectra
/// lose their shape and keep their luminance.
ImagePtr image_of_colour(const ParameterSet& p, const LightScope& scope) {
  const Parameter* colour = p.find("L");
  const EmissionColor e = read_emission(p, "L", scope.files, scope.color_space);
  if (colour && colour->type != "rgb")
    scope.diagnostics.warn(colour->where,
                           "\"L\" of an infinite light with a portal is converted to rgb");
  const RgbColorSpace& space = RgbColorSpace::srgb();
  const Rgb c = space.from_xyz(spectrum_to_xyz(*e.spectrum));
  return std::make_shared<Image>(1, 1, 3, Image::Floats{c.r, c.g, c.b}, space);
}

}  // namespace

LightPtr make_portal_infinite_light(const LightDescription& description, const LightScope& scope) {
  const ParameterSet& p = description.parameters;
  const Portal portal = read_portal(p);
  const bool has_file = !p.get_string("filename", "").empty();
  const Parameter* colour = p.find("L");
  if (has_file && colour)
    scope.diagnostics.warn(
        colour->where, "\"L\" of an infinite light with a portal and a \"filename\" is ignored");
  const ImagePtr image =
      has_file ? read_environment_image(p, scope.files) : image_of_colour(p, scope);
  return std::make_unique<PortalInfiniteLight>(*image, Transform(description.transform.start),
                                               portal, sphere_emission_scale(p, *image));
}

}  // namespace nephroid

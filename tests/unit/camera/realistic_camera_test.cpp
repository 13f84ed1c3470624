// The realistic camera against theory (thin lens formula, sharpness, irradiance on the film) and
// against brute-force uniform sampling of the rear element instead of exit pupils.
#include <cmath>
#include <fstream>

#include "core/sampler.h"
#include "scene/camera/aperture_shape.h"
#include "scene/camera/lens_system.h"
#include "unit/camera/camera_fixture.h"

namespace nephroid {
namespace {

std::shared_ptr<const ApertureShape> lens_stop(const std::string& shape) {
  SceneFiles files;
  return make_aperture_shape(shape, files, {});
}

using testing_support::camera_error;
using testing_support::camera_of;

// The tables in lenses/, in metres.
LensSystem thin_lens() {
  return {{{0.1, 5e-5, 1.5, 0.002}, {-0.1, 0.1, 1, 0.002}}, nullptr};
}
std::vector<LensSurface> symmetric_surfaces(double stop_radius) {
  return {{0.025, 0.004, 1.6, 0.010},
          {0.040, 0.006, 1.0, 0.008},
          {0, 0.006, 0, stop_radius},
          {-0.040, 0.004, 1.6, 0.008},
          {-0.025, 0.060, 1.0, 0.010}};
}

Vec2f random_point(uint64_t stream, int i) {
  const uint64_t h = hash_combine(stream, static_cast<uint64_t>(i));
  return {bits_to_unit_float(static_cast<uint32_t>(h >> 32)),
          bits_to_unit_float(static_cast<uint32_t>(h))};
}

TEST(LensSystem, ThinLensFormula) {
  for (const double distance : {0.5, 1.0, 3.0, 1000.0}) {
    LensSystem lens = thin_lens();
    ASSERT_TRUE(lens.focus(distance, 1e-5));
    // 1/s + 1/s' = 1/f, where s + s' is the distance from the film.
    const double image = (distance - std::sqrt(distance * distance - 0.4 * distance)) / 2;
    EXPECT_NEAR(lens.rear_z(), image, 2e-5) << distance;
    const auto passed = lens.trace_from_film({{0, 0, 0}, {1e-4, 2e-4, lens.rear_z()}});
    ASSERT_TRUE(passed);
    const LensRay& r = passed->ray;
    const Vec3d at = r.o + r.d * ((distance - r.o.z) / r.d.z);
    EXPECT_LT(std::hypot(at.x, at.y) / distance, 1e-6) << distance;
  }
  LensSystem lens = thin_lens();
  EXPECT_FALSE(lens.focus(0.399, 1e-5));  // no image forms nearer than 4 f
}

TEST(LensSystem, RaysGoBackTheWayTheyCame) {
  const LensSystem lens(symmetric_surfaces(0.006), nullptr);
  int passed = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec2f u = random_point(1, i), v = random_point(2, i);
    const Vec3d film(0.02 * static_cast<double>(u.x), 0.01 * static_cast<double>(u.y), 0);
    const Vec3d rear(0.008 * (2 * static_cast<double>(v.x) - 1),
                     0.008 * (2 * static_cast<double>(v.y) - 1), lens.rear_z());
    const auto out = lens.trace_from_film({film, rear - film});
    if (!out) continue;
    ++passed;
    const auto back = lens.trace_from_scene({out->ray.o + out->ray.d, -out->ray.d});
    ASSERT_TRUE(back);
    const Vec3d at = back->o - back->d * (back->o.z / back->d.z);
    EXPECT_LT((at - film).length(), 1e-12);
  }
  EXPECT_GT(passed, 20);
}

// Every point of the rear plane that passes light is within the pupil's bounds, also if the stop's
// shape is rotated against them. The bounds are not much larger.
TEST(LensSystem, PupilBoundsHoldAllThatPasses) {
  for (const char* shape_name : {"", "star", "square"}) {
    const LensSystem lens(symmetric_surfaces(0.004), lens_stop(shape_name));
    int passed = 0;
    for (int zone = 0; zone < 8; ++zone) {
      const PupilBounds b = lens.bound_exit_pupil(0.002 * zone, 0.002 * (zone + 1));
      double widest = 0;
      for (int i = 0; i < 4000; ++i) {
        const Vec2f u = random_point(3, i), v = random_point(4, i);
        const double r = 0.002 * (zone + static_cast<double>(u.x));
        const double phi = 2 * static_cast<double>(kPi) * static_cast<double>(u.y);
        const double x = 0.015 * (2 * static_cast<double>(v.x) - 1);
        const double y = 0.015 * (2 * static_cast<double>(v.y) - 1);
        const Vec3d film(r * std::cos(phi), r * std::sin(phi), 0);
        const Vec3d rear(x * std::cos(phi) - y * std::sin(phi),
                         x * std::sin(phi) + y * std::cos(phi), lens.rear_z());
        if (!lens.trace_from_film({film, rear - film})) continue;
        ++passed;
        widest = std::max(widest, std::abs(y));
        EXPECT_TRUE(x >= b.x0 && x <= b.x1 && y >= b.y0 && y <= b.y1)
            << zone << ' ' << x << ' ' << y;
      }
      const double limit = widest > 0 && *shape_name == '\0' ? 1.15 * widest : 1;
      EXPECT_LT(b.y1, limit) << zone;
    }
    EXPECT_GT(passed, 500) << shape_name;
  }
}

constexpr const char* kThin =
    "Camera \"realistic\" \"string lensfile\" \"lenses/thin.dat\" \"float focusdistance\" 1";

TEST(RealisticCamera, SharpAtTheDistanceInFocusOnly) {
  const auto c = camera_of(kThin, 60, 40);
  const double image = (1 - std::sqrt(0.6)) / 2, object = 1 - image;
  const double pixel = 0.035 / std::sqrt(60.0 * 60 + 40 * 40);
  double blur_near = 0;
  for (int i = 0; i < 50; ++i) {
    const auto r = c->generate_ray({33, 16}, random_point(5, i), 0);
    if (!r) continue;
    const auto at = [&](float z) { return r->ray.o + r->ray.d * ((z - r->ray.o.z) / r->ray.d.z); };
    // Three pixels right of the centre and four above it, magnified.
    EXPECT_NEAR(at(1).x, 3 * pixel * object / image, 4e-5);
    EXPECT_NEAR(at(1).y, 4 * pixel * object / image, 4e-5);
    blur_near = std::max(blur_near, static_cast<double>(std::abs(at(0.6f).x - at(1).x * 0.55f)));
  }
  EXPECT_GT(blur_near, 20 * 4e-5);
  EXPECT_NEAR(c->footprint().spread, pixel / image, 2e-3 * pixel / image);
}

// A thin lens of radius R over a film at s': E / L = pi R^2 cos^4 / s'^2.
TEST(RealisticCamera, LightOnTheFilmBehindAThinLens) {
  const auto c = camera_of(kThin, 40, 40, 120);
  const double image = (1 - std::sqrt(0.6)) / 2;
  for (const Vec2f& film : {Vec2f(20, 20), Vec2f(38, 20), Vec2f(3, 35)}) {
    constexpr int kSide = 100;
    double sum = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
      const auto r = c->generate_ray(film,
                                     {(static_cast<float>(i % kSide) + 0.5f) / kSide,
                                      (static_cast<float>(i) / kSide + 0.5f / kSide) / kSide},
                                     0);
      if (r) sum += static_cast<double>(r->weight);
    }
    const double pixel = 0.12 / std::sqrt(2.0) / 40;
    const double off =
        pixel * std::hypot(static_cast<double>(film.x) - 20, static_cast<double>(film.y) - 20);
    const double cosine = image / std::hypot(image, off);
    const double expected =
        static_cast<double>(kPi) * 0.002 * 0.002 * std::pow(cosine, 4) / (image * image);
    EXPECT_NEAR(sum / (kSide * kSide), expected, 0.02 * expected) << film.x;
  }
}

struct Light {
  double mean = 0, error = 0;
};
Light light_of(const std::vector<double>& values) {
  Light l;
  const double n = static_cast<double>(values.size());
  for (const double v : values) l.mean += v / n;
  for (const double v : values) l.error += (v - l.mean) * (v - l.mean);
  l.error = std::sqrt(l.error / (n - 1) / n);
  return l;
}

/// The symmetric lens focused at 2 m, sampled over the plane before its rear element and slightly
/// beyond, because the element is curved.
class BruteForce {
 public:
  explicit BruteForce(double stop_radius, const char* shape = "")
      : lens_(symmetric_surfaces(stop_radius), lens_stop(shape)) {
    EXPECT_TRUE(lens_.focus(2, 35e-6));
  }
  /// The camera's film point; empty if blocked.
  std::optional<CameraRay> generate(const Vec2f& film, int width, int height,
                                    const Vec2f& u) const {
    const double pixel = 0.035 / std::hypot(width, height);
    const Vec3d from(pixel * (0.5 * width - static_cast<double>(film.x)),
                     pixel * (static_cast<double>(film.y) - 0.5 * height), 0);
    const double r = 1.5 * lens_.rear_radius(), z = lens_.rear_z();
    const Vec3d to(r * (2 * static_cast<double>(u.x) - 1), r * (2 * static_cast<double>(u.y) - 1),
                   z);
    const auto passed = lens_.trace_from_film({from, to - from});
    if (!passed) return std::nullopt;
    CameraRay c;
    c.ray.o = Vec3f(passed->ray.o);
    c.ray.d = Vec3f(passed->ray.d);
    const double cosine = z / (to - from).length();
    c.weight = passed->share * static_cast<float>(std::pow(cosine, 4) * 4 * r * r / (z * z));
    return c;
  }

 private:
  LensSystem lens_;
};

std::string symmetric(const std::string& stop_mm, const std::string& shape) {
  return "Camera \"realistic\" \"string lensfile\" \"lenses/symmetric.dat\" \"float "
         "focusdistance\" "
         "2 \"float aperturediameter\" " +
         stop_mm + " \"string aperture\" \"" + shape + "\"";
}

TEST(RealisticCamera, AgreesWithUniformSamplingOfTheRearElement) {
  struct Case {
    const char* stop_mm;
    double stop_radius;
    const char* shape;
  };
  for (const Case& k : {Case{"12", 0.006, ""}, Case{"4", 0.002, ""}, Case{"8", 0.004, "star"}}) {
    const auto camera = camera_of(symmetric(k.stop_mm, k.shape), 60, 40);
    const BruteForce brute(k.stop_radius, k.shape);
    for (const Vec2f& film : {Vec2f(30, 20), Vec2f(50, 12), Vec2f(1, 1)}) {
      std::vector<double> ours, theirs;
      for (int i = 0; i < 20000; ++i) {
        const auto a = camera->generate_ray(film, random_point(6, i), 0);
        const auto b = brute.generate(film, 60, 40, random_point(7, i));
        ours.push_back(a ? static_cast<double>(a->weight) : 0);
        theirs.push_back(b ? static_cast<double>(b->weight) : 0);
      }
      const Light a = light_of(ours), b = light_of(theirs);
      EXPECT_GT(b.mean, 0);
      EXPECT_LT(a.error, b.error);
      EXPECT_NEAR(a.mean, b.mean, 4.9 * std::hypot(a.error, b.error)) << k.shape << film.x;
    }
  }
}

// Two samples of the same distribution: exit points of passing rays at the front, in a grid of
// cells.
TEST(RealisticCamera, ChiSquareOfThePupil) {
  const auto camera = camera_of(symmetric("12", ""), 60, 40);
  const BruteForce brute(0.006);
  constexpr int kCells = 12, kSamples = 60000;
  for (const Vec2f& film : {Vec2f(30, 20), Vec2f(55, 8)}) {
    std::vector<double> counts[2];
    double total[2] = {0, 0};
    for (int which = 0; which < 2; ++which) {
      counts[which].assign(kCells * kCells, 0);
      for (int i = 0; i < kSamples; ++i) {
        const auto r = which == 0 ? camera->generate_ray(film, random_point(8, i), 0)
                                  : brute.generate(film, 60, 40, random_point(9, i));
        if (!r) continue;
        const auto cell = [](float x) {
          return std::clamp(static_cast<int>((x / 0.01f + 1) / 2 * kCells), 0, kCells - 1);
        };
        ++counts[which][static_cast<size_t>(cell(r->ray.o.x) * kCells + cell(r->ray.o.y))];
        ++total[which];
      }
    }
    double chi2 = 0, dof = -1;
    const double ratio = std::sqrt(total[1] / total[0]);
    for (size_t i = 0; i < counts[0].size(); ++i) {
      const double n = counts[0][i] + counts[1][i];
      if (n < 10) continue;
      const double d = ratio * counts[0][i] - counts[1][i] / ratio;
      chi2 += d * d / n;
      ++dof;
    }
    ASSERT_GT(dof, 20);
    // The quantile at level 1e-5, by Wilson & Hilferty.
    const double v = 2 / (9 * dof);
    EXPECT_LT(chi2, dof * std::pow(1 - v + 4.265 * std::sqrt(v), 3)) << film.x;
  }
}

TEST(RealisticCamera, WrongOnesAreRefused) {
  EXPECT_EQ(camera_error("Camera \"realistic\""),
            "test.pbrt:1:1: the realistic camera has no \"lensfile\", expected a lens table");
  EXPECT_EQ(
      camera_error("Camera \"realistic\" \"string lensfile\" \"lenses/none.dat\"").substr(0, 16),
      "test.pbrt:1:20: ");
  EXPECT_NE(
      camera_error(std::string(kThin) + " \"float aperturediameter\" 0").find("must be positive"),
      std::string::npos);
  EXPECT_NE(camera_error("Camera \"realistic\" \"string lensfile\" \"lenses/thin.dat\" \"float "
                         "focusdistance\" 0.3")
                .find("cannot be focused"),
            std::string::npos);
  EXPECT_NE(camera_error(symmetric("4", "no_such_shape.png")).find("test.pbrt:1:"),
            std::string::npos);
}

TEST(RealisticCamera, LensTablesAreReadWithLineAndColumn) {
  const std::string path = ::testing::TempDir() + "nephroid_lens_test.dat";
  const auto error = [&](const std::string& table) {
    std::ofstream(path) << table;
    return camera_error("Camera \"realistic\" \"string lensfile\" \"" + path + "\"");
  };
  EXPECT_EQ(
      error("# head\n10 1 1.5 5\n10 x1 1 5\n").substr(path.size()),
      ":3:4: \"x1\" is not a number, expected four numbers per surface: radius, thickness, index "
      "of refraction, diameter");
  EXPECT_EQ(error("10 1 1.5").substr(path.size()),
            ": the lens table has 3 numbers, expected four per surface");
  EXPECT_NE(error("").find("0 numbers"), std::string::npos);
  EXPECT_NE(error("10 1 1.5 -5").find("surface 1"), std::string::npos);
  std::remove(path.c_str());
}

}  // namespace
}  // namespace nephroid

// Directions of emitted rays against their densities, for every kind of light. Over each part of
// the sphere, the mean of 1/density is the lit solid angle. emission_pdf must agree with both.
#include "unit/light/light_fixture.h"

namespace nephroid::testing_light {
namespace {

/// True for directions into which the light emits.
using Lit = std::function<bool(const Vec3f&)>;

/// True if emission_pdf() of the sampled ray returns the sample's own densities.
bool says_same_densities(const Light& light, const EmissionSample& e) {
  const EmissionDensity density = light.emission_pdf(e.ng, e.ray.d);
  // Through a portal, one is measured across the ray, the other on the portal.
  const float across = e.from_behind ? e.cos_theta : 1.0f;
  return std::abs(density.pdf_w - e.pdf_w) <= 1e-3f * e.pdf_w &&
         std::abs(density.pdf_a * across - e.pdf_a) <= 1e-3f * e.pdf_a;
}

void expect_density(const Light& light, const Lit& lit, const std::string& name) {
  constexpr int kRows = 8, kColumns = 16, kSub = 24, kCount = 100000;
  const auto bin_of = [](const Vec3f& w) {
    const int row = static_cast<int>((w.z + 1) / 2 * kRows);
    const int column = static_cast<int>((std::atan2(w.y, w.x) / (2 * kPi) + 0.5f) * kColumns);
    return std::clamp(row, 0, kRows - 1) * kColumns + std::clamp(column, 0, kColumns - 1);
  };
  std::vector<double> expected(kRows * kColumns);
  // Odd offsets keep borders of lit regions off the points.
  for (int y = 0; y < kRows * kSub; ++y)
    for (int x = 0; x < kColumns * kSub; ++x) {
      const Vec3f w = testing_bsdf::spherical((y + 0.4871) / (kRows * kSub) * 2 - 1,
                                              ((x + 0.5137) / (kColumns * kSub) - 0.5) * 2 * M_PI);
      if (lit(w)) expected[bin_of(w)] += 4 * M_PI / (kRows * kSub) / (kColumns * kSub);
    }
  std::vector<Mean> found(kRows * kColumns);
  std::vector<int> counts(kRows * kColumns);
  int strangers = 0;
  TestRandom random(3);
  for (int i = 0; i < kCount; ++i) {
    const Vec2f u = random.next2();
    const auto e = light.sample_emission(u, random.next2(), test_wavelengths());
    ASSERT_TRUE(e) << name;
    strangers += !says_same_densities(light, *e);
    const int bin = bin_of(e->ray.d);
    found[bin].add(1.0 / e->pdf_w);
    ++counts[bin];
  }
  // Rounding may decide between two pixels of an image.
  EXPECT_LE(strangers, 20) << name;
  int tested = 0;
  const double cell = 4 * M_PI / (kRows * kColumns);
  for (int bin = 0; bin < kRows * kColumns; ++bin) {
    if (expected[bin] == 0) {
      EXPECT_LE(counts[bin], 20) << name << ", bin " << bin;
    } else if (counts[bin] >= 200) {
      ++tested;
      Mean& m = found[bin];
      m.n = kCount;  // samples elsewhere count as 0
      // Borders of lit regions are located to a point or two.
      const double border = expected[bin] < 0.999 * cell ? 0.03 * cell : 1e-4 * cell;
      EXPECT_TRUE(agrees(m, expected[bin], border / 4.5)) << name << ", bin " << bin;
    }
  }
  EXPECT_GE(tested, 6) << name;
}

/// Lit directions at a point around a light.
Lit seen_from_around(const Light& light, const Vec3f& p) {
  return [&light, p](const Vec3f& w) {
    const auto s = light.sample_towards(p + w, {0.5f, 0.5f}, test_wavelengths());
    return s && !s->radiance.is_black();
  };
}

class Emission : public ::testing::Test {
 protected:
  void SetUp() override {
    std::vector<float> rgb;
    for (int i = 0; i < 64; ++i)
      for (const int period : {5, 3, 7}) rgb.push_back(1.0f + static_cast<float>(i % period));
    write_square(scratch.file("a.exr"), 8, rgb);
  }
  LightPtr make(const std::string& text) const {
    return light_of(text, {{0, 0, 0}, 2}, scratch.path().string());
  }
  ScratchDirectory scratch;
};

TEST_F(Emission, OfLightsAtAPoint) {
  for (const char* transform : {"", "Rotate 40 1 2 3", "Scale 1 2 0.5 Rotate 20 1 1 0"})
    for (const char* light : {"\"point\"", "\"spot\" \"float coneangle\" 70",
                              "\"projection\" \"string filename\" \"a.exr\" \"float fov\" 110",
                              "\"goniometric\" \"string filename\" \"a.exr\""}) {
      const LightPtr lamp = make(std::string(transform) + " LightSource " + light);
      expect_density(*lamp, seen_from_around(*lamp, {0, 0, 0}),
                     std::string(transform) + " " + light);
    }
}

TEST_F(Emission, OfTheSky) {
  for (const char* transform : {"", "Scale 1 2 0.5 Rotate 20 1 1 0"})
    for (const char* light : {"\"infinite\"", "\"infinite\" \"string filename\" \"a.exr\""})
      expect_density(
          *make(std::string(transform) + " LightSource " + light),
          [](const Vec3f&) { return true; }, std::string(transform) + " " + light);
  // Through a portal, all directions into the scene are lit.
  for (const char* image : {"", "\"string filename\" \"a.exr\""}) {
    const LightPtr light = make(std::string("LightSource \"infinite\" \"point3 portal\" "
                                            "[-1 -1 1  -1 0 2  1 0 2  1 -1 1] ") +
                                image);
    expect_density(
        *light, [](const Vec3f& w) { return w.z - w.y < 0; }, std::string("portal ") + image);
  }
}

TEST_F(Emission, OfShapes) {
  const ShapePtr disk =
      make_disk(Transform(Mat44d().setAxisAngle(Vec3d(1, 0, 0), 0.4)), true, 0, 1, 0, 360);
  const Vec3f n = disk->sample_area(0, {0.5f, 0.4f})->ng;
  expect_density(
      *area_light_of("", disk), [&](const Vec3f& w) { return dot(w, n) > 0; }, "disk");
  expect_density(
      *area_light_of("\"bool twosided\" true", disk), [](const Vec3f&) { return true; },
      "two sides");
}

}  // namespace
}  // namespace nephroid::testing_light

// From the entry to the exit of light in a subsurface material: means over probes must equal the
// area integrals of the profile, for any other objects along the probe. Planes, slabs and spheres
// have one-dimensional integrals.
#include "transport/subsurface_walk.h"

#include <gtest/gtest.h>

#include "input/pbrt_parser.h"
#include "scene/bsdf/tabulated_bssrdf.h"
#include "unit/bsdf/statistics.h"

namespace nephroid {
namespace {

using testing_bsdf::Mean;
using testing_bsdf::TestRandom;

// Free paths of 0.15 to 0.5 and different albedos: wavelengths differ.
const std::string kColoured =
    "Material \"subsurface\" \"spectrum sigma_a\" [ 360 0.4 830 0.05 ] "
    "\"spectrum sigma_s\" [ 360 6 830 2 ] ";

std::string quad(float size, float y, bool up = true) {
  char text[300];
  std::snprintf(text, sizeof text,
                "%sShape \"trianglemesh\" \"point3 P\" [%g %g %g  %g %g %g  %g %g %g  %g %g %g] "
                "\"integer indices\" [0 1 2 0 2 3]\n",
                up ? "" : "ReverseOrientation\n", -size, y, -size, -size, y, size, size, y, size,
                size, y, -size);
  return text;
}

/// A scene, and a point on it where light enters.
struct Entry {
  std::unique_ptr<Scene> scene;
  SurfaceInteraction hit;
  const Material* material = nullptr;
  SampledWavelengths lambda = SampledWavelengths::sample_visible(0.43f);
  BsdfArena arena;
  const TabulatedBssrdf* bssrdf = nullptr;

  Entry(const std::string& world, const Vec3f& from, const Vec3f& towards, bool hero_only = false) {
    Diagnostics diagnostics;
    const SceneDescription d =
        parse_pbrt_string("WorldBegin\n" + world, "test.pbrt", ".", diagnostics);
    scene = build_scene(d, {}, diagnostics);
    Ray ray;
    ray.o = from;
    ray.d = towards;
    EXPECT_TRUE(scene->intersect(ray, hit));
    material = scene->materials[static_cast<size_t>(hit.material)]->resolve(hit);
    if (hero_only) lambda.terminate_secondary();
    bssrdf = dynamic_cast<const TabulatedBssrdf*>(material->make_bssrdf(hit, lambda, arena));
    EXPECT_NE(bssrdf, nullptr);
  }

  float longest_reach() const {
    float reach = 0;
    for (int i = 0; i < kSpectrumSamples; ++i) reach = std::max(reach, bssrdf->reach(i));
    return reach;
  }
  /// Integral of 2 pi r Sp(r) h(r) from `a` to `b` or the longest reach.
  template <class H>
  double profile_integral(int i, double a, double b, H&& h) const {
    b = std::min<double>(b, longest_reach());
    if (a >= b) return 0.0;
    // The profile is steep near its middle: steps grow by a constant ratio.
    constexpr int kSteps = 4000;
    const double start = std::max(a, 1e-6);
    double sum = 0.0, r0 = start;
    for (int k = 1; k <= kSteps; ++k) {
      const double r1 = start * std::pow(b / start, k / double{kSteps}), r = 0.5 * (r0 + r1);
      sum += (r1 - r0) * 2 * M_PI * r * bssrdf->profile(i, static_cast<float>(r)) * h(r);
      r0 = r1;
    }
    return sum;
  }

  struct Result {
    Mean weight[kSpectrumSamples];
    int rays = 0, found = 0;
  };
  /// Means of weight times h(exit) over `count` walks.
  template <class H>
  Result walk(int count, H&& h) const {
    Result result;
    TestRandom random(17);
    for (int n = 0; n < count; ++n) {
      const float u_axis = random.next();
      const Vec2f u = random.next2();
      const auto exit =
          find_subsurface_exit(*scene, hit, *material, *bssrdf, u_axis, u, random.next());
      for (int i = 0; i < kSpectrumSamples; ++i)
        result.weight[i].add(exit ? exit->weight[i] * h(exit->surface) : 0.0);
      if (!exit) continue;
      ++result.found;
      result.rays += exit->rays;
    }
    return result;
  }
};

double one(const SurfaceInteraction&) {
  return 1.0;
}
double unity(double) {
  return 1.0;
}

/// `allowed` is the relative error of the expectation, which neglects something.
void expect_means(const Entry::Result& found, const std::vector<double>& expected,
                  const std::string& what, double allowed = 1e-3) {
  EXPECT_GT(found.found, 1000) << what;
  for (size_t i = 0; i < expected.size(); ++i) {
    const Mean& m = found.weight[i];
    EXPECT_NEAR(m.mean(), expected[i], 4.5 * m.error() + allowed * expected[i]) << what << i;
    EXPECT_LT(m.error(), 0.02 * expected[i]) << what << " is too noisy to tell";
  }
}

constexpr int kWalks = 40000;

std::vector<double> plane_integrals(const Entry& e) {
  std::vector<double> v;
  for (int i = 0; i < kSpectrumSamples; ++i)
    v.push_back(e.profile_integral(i, 0.0, kInfinity, unity));
  return v;
}

TEST(SubsurfaceWalk, PlaneGivesTheIntegralOfTheProfile) {
  const Entry e(kColoured + quad(300, 0), {0.1f, 5, 0.2f}, {0, -1, 0});
  const auto expected = plane_integrals(e);
  expect_means(e.walk(kWalks, one), expected, "plane ");
  // Except for the part beyond the reach, it is the effective albedo.
  EXPECT_LT(e.longest_reach(), 100.0f);
  const BssrdfTable table(0.0f, 1.33f);
  for (int i = 0; i < kSpectrumSamples; ++i) {
    const float u = (e.lambda.lambda(i) - 360) / (830 - 360);
    const float a = lerp(u, 0.4f, 0.05f), s = lerp(u, 6.0f, 2.0f);
    const float seen = table.effective_albedo(table.albedo_weights(s / (a + s)));
    EXPECT_NEAR(expected[static_cast<size_t>(i)], seen, 0.003f * seen);
  }
}

TEST(SubsurfaceWalk, HeroAloneGivesTheSame) {
  const Entry e(kColoured + quad(300, 0), {0.1f, 5, 0.2f}, {0, -1, 0}, true);
  expect_means(e.walk(kWalks, one), {e.profile_integral(0, 0.0, kInfinity, unity)}, "hero ", 1e-3);
  EXPECT_EQ(e.walk(1000, one).weight[1].sum, 0.0);
}

TEST(SubsurfaceWalk, SlabAddsItsOtherSide) {
  // Across a gap of h the area element is again 2 pi r dr, from r = h on.
  for (const float h : {0.05f, 0.4f, 1.5f}) {
    const Entry e(kColoured + quad(300, 0) + quad(300, -h, false), {0.1f, 5, 0.2f}, {0, -1, 0});
    std::vector<double> expected = plane_integrals(e);
    for (int i = 0; i < kSpectrumSamples; ++i)
      expected[static_cast<size_t>(i)] += e.profile_integral(i, h, kInfinity, unity);
    expect_means(e.walk(kWalks, one), expected, "slab " + std::to_string(h) + " ");
  }
}

TEST(SubsurfaceWalk, SphereGivesTheIntegralOverTheSphere) {
  // On a sphere of radius R the area element is 2 pi r dr, with chords r up to 2 R. The second
  // weight is the cosine of a distant light above the entry.
  for (const float radius : {0.2f, 1.0f, 4.0f}) {
    const Entry e(kColoured + "Shape \"sphere\" \"float radius\" " + std::to_string(radius),
                  {0, 9, 0}, {0, -1, 0});
    std::vector<double> all, lit;
    for (int i = 0; i < kSpectrumSamples; ++i) {
      all.push_back(e.profile_integral(i, 0.0, 2.0 * radius, unity));
      lit.push_back(e.profile_integral(i, 0.0, 2.0 * radius, [&](double r) {
        return std::max(0.0, 1.0 - 0.5 * r * r / (radius * radius));
      }));
    }
    const std::string what = "sphere " + std::to_string(radius) + " ";
    expect_means(e.walk(kWalks, one), all, what);
    expect_means(e.walk(kWalks, [](const SurfaceInteraction& s) { return std::max(0.0f, s.ng.y); }),
                 lit, what + "lit ");
  }
}

TEST(SubsurfaceWalk, ProbesThroughTheEntryItselfHaveADensity) {
  // The exits are the entry and the opposite point: both are at distance 0 from the middle of the
  // probe, where the density was once taken as 0 and weights were millions.
  const Entry e(kColoured + "Shape \"sphere\" \"float radius\" 0.5\n", {0, 3, 0}, {0, -1, 0});
  for (const float u_choice : {0.2f, 0.8f}) {
    const auto exit =
        find_subsurface_exit(*e.scene, e.hit, *e.material, *e.bssrdf, 0.7f, {0.0f, 0.3f}, u_choice);
    ASSERT_TRUE(exit);
    for (int i = 0; i < kSpectrumSamples; ++i) EXPECT_LT(exit->weight[i], 30) << u_choice;
  }
  for (int i = 0; i < kSpectrumSamples; ++i)
    EXPECT_NEAR(e.bssrdf->profile(i, 0), e.bssrdf->profile(i, 1e-5f),
                0.01f * e.bssrdf->profile(i, 0));
}

TEST(SubsurfaceWalk, OtherThingsAlongTheProbeDoNotMatter) {
  const std::string clutter = "Material \"diffuse\"\n" + quad(300, 0.07f) + quad(300, -0.03f) +
                              "Material \"interface\"\n" + quad(300, 0.02f) +
                              "Material \"subsurface\" \"float scale\" 2\n" + quad(300, -0.2f);
  const Entry e(clutter + kColoured + quad(300, 0), {0.1f, 0.01f, 0.2f}, {0, -1, 0});
  const Entry::Result found = e.walk(kWalks, one);
  expect_means(found, plane_integrals(e), "clutter ");
  EXPECT_GT(found.rays, 3 * found.found);
}

TEST(SubsurfaceWalk, InstancesAreFoundInWorldUnits) {
  const Entry e("ObjectBegin \"o\"\n" + kColoured + quad(100, 0.1f) + quad(100, 0.0f, false) +
                    "ObjectEnd\nTranslate 3 1 2 Rotate 30 0 1 0 Scale 4 4 4\n"
                    "ObjectInstance \"o\"\n",
                {3, 9, 2}, {0, -1, 0});
  std::vector<double> expected = plane_integrals(e);
  for (int i = 0; i < kSpectrumSamples; ++i)
    expected[static_cast<size_t>(i)] += e.profile_integral(i, 0.4, kInfinity, unity);
  expect_means(e.walk(kWalks, one), expected, "instance ");
}

TEST(SubsurfaceWalk, MixedMaterialsLetLightOutWhereTheyAreSubsurface) {
  const std::string mix =
      "MakeNamedMaterial \"a\" \"string type\" \"diffuse\"\n"
      "MakeNamedMaterial \"b\" \"string type\" \"subsurface\" "
      "\"spectrum sigma_a\" [ 360 0.1 830 0.1 ] "
      "\"spectrum sigma_s\" [ 360 4 830 2 ]\n"
      "Material \"mix\" \"string materials\" [ \"a\" \"b\" ] "
      "\"float amount\" 0.3\n";
  // The choice is a hash of point and direction: search for a subsurface one.
  for (float x = 0.0f; x < 5.0f; x += 0.1f) {
    Diagnostics diagnostics;
    const SceneDescription d =
        parse_pbrt_string("WorldBegin\n" + mix + quad(300, 0), "test.pbrt", ".", diagnostics);
    const auto scene = build_scene(d, {}, diagnostics);
    Ray ray;
    ray.o = Vec3f(x, 5, 0.2f);
    ray.d = Vec3f(0, -1, 0);
    SurfaceInteraction hit;
    ASSERT_TRUE(scene->intersect(ray, hit));
    SampledWavelengths lambda = SampledWavelengths::sample_visible(0.43f);
    BsdfArena arena;
    const Material* material = scene->materials[static_cast<size_t>(hit.material)]->resolve(hit);
    if (!material->make_bssrdf(hit, lambda, arena)) continue;
    const Entry e(mix + quad(300, 0), ray.o, ray.d);
    std::vector<double> expected = plane_integrals(e);
    for (double& v : expected) v *= 0.3;
    expect_means(e.walk(kWalks, one), expected, "mix ");
    return;
  }
  FAIL() << "the mix never shows its subsurface material";
}

TEST(SubsurfaceWalk, ExitsAreReadyForTheNextVertex) {
  const Entry e(kColoured + "Shape \"sphere\" \"float radius\" 1", {0.4f, 9, 0.1f}, {0, -1, 0});
  TestRandom random(3);
  int found = 0;
  for (int n = 0; n < 300; ++n) {
    const float u_axis = random.next();
    const Vec2f u = random.next2();
    const float u_choice = random.next();
    const auto exit =
        find_subsurface_exit(*e.scene, e.hit, *e.material, *e.bssrdf, u_axis, u, u_choice);
    if (!exit) continue;
    ++found;
    const SurfaceInteraction& s = exit->surface;
    EXPECT_NEAR(length(s.p), 1.0f, 1e-5f);
    EXPECT_NEAR(dot(s.wo, s.shading.z), 1.0f, 1e-6f);
    EXPECT_NEAR(dot(s.ng, normalize(s.p)), 1.0f, 1e-5f);
    EXPECT_FLOAT_EQ(s.distance, length(s.p - e.hit.p));
    EXPECT_LT(s.distance, e.longest_reach() * 1.0001f);
    const auto again =
        find_subsurface_exit(*e.scene, e.hit, *e.material, *e.bssrdf, u_axis, u, u_choice);
    ASSERT_TRUE(again);
    EXPECT_TRUE(again->weight == exit->weight);
    EXPECT_EQ(again->surface.p, s.p);
    BsdfArena arena;
    const Bsdf* out = e.bssrdf->exit_bsdf(arena);
    const auto sample = out->sample(s.shading.to_local(s.wo), 0.5f, {0.3f, 0.6f},
                                    TransportMode::kRadiance, ClassMask::kAll);
    ASSERT_TRUE(sample);
    EXPECT_GT(dot(s.shading.to_world(sample->wi), s.ng), 0.0f);
  }
  EXPECT_GT(found, 100);
}

TEST(SubsurfaceWalk, WhiteFurnaceReturnsTheEffectiveAlbedo) {
  // A plane has the requested reflectance, which is that of the medium.
  for (const float reflectance : {0.2f, 0.5f, 0.9f}) {
    const Entry e(
        "Material \"subsurface\" \"spectrum mfp\" [ 360 0.02 830 0.05 ] "
        "\"spectrum reflectance\" [ 360 " +
            std::to_string(reflectance) + " 830 " + std::to_string(reflectance) + " ]\n" +
            quad(300, 0),
        {0.1f, 5, 0.2f}, {0, -1, 0});
    expect_means(e.walk(kWalks, one), std::vector<double>(kSpectrumSamples, reflectance), "white ",
                 3e-3);
  }
}

}  // namespace
}  // namespace nephroid

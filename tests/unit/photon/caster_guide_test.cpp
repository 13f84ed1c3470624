// Guiding towards casters from rough surfaces: samples follow the density of the cones, however
// narrow. A guide contains the casters it learned and omits those that a vertex cannot reach.
#include "photon/caster_guide.h"

#include <gtest/gtest.h>

#include "scene/bsdf/diffuse.h"
#include "transport/guided_direction.h"
#include "unit/photon/useful_starts.h"

namespace nephroid {
namespace {

using testing_bsdf::Mean;
using testing_bsdf::spherical;
using testing_bsdf::TestRandom;
using testing_guide::add_cluster;

Vec3f random_direction(TestRandom& random) {
  const Vec2f u = random.next2();
  return spherical(2 * double{u.x} - 1, 2 * M_PI * double{u.y});
}

/// Octants of the sphere.
size_t octant(const Vec3f& w) {
  return (w.x > 0 ? 1u : 0u) + (w.y > 0 ? 2u : 0u) + (w.z > 0 ? 4u : 0u);
}

CasterCones overlapping_cones() {
  CasterCones cones;
  cones.add(normalize(Vec3f(0.2f, 0.3f, 0.9f)), 0.4f, 2);
  cones.add(normalize(Vec3f(0.6f, 0.1f, 0.5f)), 0.2f, 1);
  cones.add(normalize(Vec3f(-0.6f, -0.9f, 0.1f)), 0.05f, 3);
  return cones;
}

TEST(CasterCones, AreADensityThatSamplesFollow) {
  const CasterCones cones = overlapping_cones();
  TestRandom random(1);
  constexpr int kSamples = 200000;
  constexpr double kSphere = 4 * M_PI;
  Mean whole;
  std::array<Mean, 8> by_density, by_samples;
  for (int i = 0; i < kSamples; ++i) {
    const Vec3f w = random_direction(random);
    const double p = double{cones.pdf_w(w)} * kSphere;
    whole.add(p);
    float uc = random.next();
    const Vec3f s = cones.sample(uc, random.next2());
    ASSERT_TRUE(uc >= 0 && uc < 1) << uc;
    ASSERT_NEAR(length(s), 1, 1e-6);
    for (size_t k = 0; k < by_density.size(); ++k) {
      by_density[k].add(octant(w) == k ? p : 0);
      by_samples[k].add(octant(s) == k);
    }
  }
  EXPECT_NEAR(whole.mean(), 1, 4 * whole.error());
  for (size_t k = 0; k < by_density.size(); ++k)
    EXPECT_NEAR(by_samples[k].mean(), by_density[k].mean(),
                4 * std::hypot(by_samples[k].error(), by_density[k].error()) + 1e-9)
        << k;
}

// The random number that chose a cone can be reused.
TEST(CasterCones, LeaveARandomNumber) {
  const CasterCones cones = overlapping_cones();
  std::array<int, 4> quarters{};
  constexpr int kSamples = 12000;
  for (int i = 0; i < kSamples; ++i) {
    float uc = (static_cast<float>(i) + 0.5f) / kSamples;
    cones.sample(uc, {0.3f, 0.4f});
    ++quarters[static_cast<size_t>(uc * 4)];
  }
  for (const int n : quarters) EXPECT_NEAR(n, kSamples / 4, 4);
}

// A density that misses the sample's own cone would make its weight thousands of times too large.
TEST(CasterCones, HoldWhatTheySampleHoweverNarrow) {
  TestRandom random(2);
  for (const float narrowness : {1e-2f, 1e-5f, 1e-8f, 1e-11f}) {
    for (int i = 0; i < 20000; ++i) {
      CasterCones cones;
      cones.add(random_direction(random), narrowness, 1);
      float uc = random.next();
      // Half of the samples lie on the rim, where rounding decides.
      Vec2f u = random.next2();
      if (i % 2 == 0) u.x = kOneMinusEpsilon;
      const Vec3f w = cones.sample(uc, u);
      ASSERT_NEAR(cones.pdf_w(w) * (2 * kPi * narrowness), 1, 1e-4) << narrowness;
    }
  }
}

/// A vertex on a floor whose normal is +z, lit from above.
struct LitVertex {
  explicit LitVertex(const Vec3f& p) {
    surface.p = p;
    surface.ng = Vec3f(0, 0, 1);
    surface.wo = normalize(Vec3f(0.3f, -0.2f, 0.8f));
    surface.shading = Frame::from_z_and_tangent(surface.ng, Vec3f(1, 0, 0));
  }
  CasterCones cones(const CasterGuide& guide, const Bsdf& bsdf) const {
    static const auto scene = testing_guide::scene_with("");
    const WalkVertex vertex{surface, *scene->materials.back(), bsdf,
                            surface.shading.to_local(surface.wo), ClassMask::kDiffuse};
    return guide.at(vertex, ClassMask::kAll);
  }
  SurfaceInteraction surface;
};

struct Glasses {
  Vec3f left{-2, 0, 1}, right{3, 1, 0.5f};
  std::vector<UsefulStart> met;
  CasterGuide guide;
  Glasses() {
    TestRandom random(3);
    add_cluster(met, 0, left, 0.2f, 300, random);
    add_cluster(met, 0, right, 0.4f, 100, random);
    guide = CasterGuide(met, 10);
  }
};

TEST(CasterGuide, HoldsWhereCastersWereMet) {
  const Glasses glasses;
  // As many as pay off.
  ASSERT_GE(glasses.guide.places(), 2u);
  size_t around = 0;
  for (const UsefulStart& m : glasses.met) {
    size_t balls = 0, wide = 0;
    for (const CasterGuide::Ball& b : glasses.guide.balls()) {
      if (!(length(m.first_hit - b.center) <= b.radius)) continue;
      ++(b.radius < 1 ? balls : wide);
    }
    EXPECT_GE(balls, 1u);
    around += wide;
  }
  // One place around both, in case there is more between them.
  EXPECT_EQ(around, glasses.met.size());
}

TEST(CasterGuide, AimsAtCastersThatAVertexReaches) {
  const Glasses glasses;
  const DiffuseBsdf paper{SampledSpectrum(0.5f)};
  const DiffuseTransmissionBsdf thin{SampledSpectrum(0.3f), SampledSpectrum(0.3f)};
  TestRandom random(4);
  const auto shares = [&](const LitVertex& v, const Bsdf& bsdf) {
    const CasterCones cones = v.cones(glasses.guide, bsdf);
    std::array<int, 2> towards{};
    if (cones.empty()) return towards;
    for (int i = 0; i < 1000; ++i) {
      float uc = random.next();
      const Vec3f w = cones.sample(uc, random.next2());
      const Vec3f to_left = normalize(glasses.left - v.surface.p),
                  to_right = normalize(glasses.right - v.surface.p);
      towards[0] += dot(w, to_left) > 0.9f;
      towards[1] += dot(w, to_right) > 0.9f;
    }
    return towards;
  };
  const auto between = shares(LitVertex({0, 0, 0}), paper);
  EXPECT_GT(between[0], 100);
  EXPECT_GT(between[1], 100);
  // Inside one glass, which guiding cannot help: only the other one is a target.
  const LitVertex within(glasses.left + Vec3f(0.05f, 0.02f, -0.03f));
  const auto inside = shares(within, thin);
  EXPECT_LT(inside[0], 10);
  EXPECT_GT(inside[1], 900);
  EXPECT_EQ(within.cones(glasses.guide, thin).pdf_w(normalize(glasses.left - within.surface.p)), 0);
  // From above: paper scatters nothing down, a translucent sheet does.
  EXPECT_EQ(shares(LitVertex({0, 0, 4}), paper)[0], 0);
  EXPECT_GT(shares(LitVertex({0, 0, 4}), thin)[0], 100);
}

TEST(CasterGuide, GuidesNothingWhereNothingWasLearned) {
  const DiffuseBsdf paper{SampledSpectrum(0.5f)};
  EXPECT_TRUE(CasterGuide().empty());
  EXPECT_TRUE(CasterGuide({}, 10).empty());
  EXPECT_TRUE(LitVertex({0, 0, 0}).cones(CasterGuide(), paper).empty());
}

}  // namespace
}  // namespace nephroid

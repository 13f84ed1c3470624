// Merging at one visible point, with hand-made photons and known results.
#include "photon/merge.h"

#include <gtest/gtest.h>

#include "input/pbrt_parser.h"
#include "owned_routes.h"
#include "scene/bsdf/diffuse.h"
#include "source_directory.h"

namespace nephroid {
namespace {

constexpr float kReflectance = 0.6f, kTransmittance = 0.3f, kMergeRadius = 0.1f;
constexpr int kAnyDepth = 100;

// Rounded as in a photon.
SampledSpectrum ramp() {
  SampledSpectrum s;
  for (int i = 0; i < kSpectrumSamples; ++i) s.set(i, 1.0f + static_cast<float>(i));
  return PackedSpectrum(s).unpacked();
}

const Scene& one_material() {
  static const std::unique_ptr<Scene> scene = [] {
    Diagnostics diagnostics;
    return build_scene(
        parse_pbrt_string("WorldBegin Material \"diffuse\" Shape \"sphere\"", "test.pbrt",
                          testing_support::source_directory() + "/tests", diagnostics),
        {}, diagnostics);
  }();
  return *scene;
}

OwnedRoutes all_photons() {
  return testing_support::owned_routes(one_material(), {"photons=.*:photons"});
}

// Results of a merge.
struct Merged {
  SampledSpectrum reflected;
  uint32_t found = 0;
};

// A visible point at the origin of a floor with normal +z, seen from above.
struct VisiblePoint {
  SurfaceInteraction surface;
  DiffuseBsdf reflecting{SampledSpectrum(kReflectance)};
  DiffuseTransmissionBsdf both{SampledSpectrum(kReflectance), SampledSpectrum(kTransmittance)};
  bool translucent = false;
  Vec3f wo = normalize(Vec3f(0.3f, -0.2f, 0.8f));

  VisiblePoint() {
    surface.p = Vec3f(0, 0, 0);
    surface.ng = Vec3f(0, 0, 1);
    surface.wo = wo;
    surface.shading = Frame::from_z_and_tangent(surface.ng, Vec3f(1, 0, 0));
  }
  Merged merge(const std::vector<Photon>& photons, const OwnedRoutes& owned, int eye_events = 1,
               int max_depth = kAnyDepth, int eye_left = kAllWavelengths) const {
    const Bsdf& bsdf = translucent ? static_cast<const Bsdf&>(both) : reflecting;
    const WalkVertex vertex{surface, *one_material().materials.back(), bsdf,
                            surface.shading.to_local(wo), ClassMask::kDiffuse};
    PartSums sums(*owned.routes, owned.group);
    const MergePoint at{vertex,     owned.routes->start(), ClassMask::kRough,
                        eye_events, SampledSpectrum(1.0f), eye_left};
    Merged merged;
    merged.found = merge_photons(PhotonGrid(photons), owned, at, max_depth, kMergeRadius, sums);
    for (const SampledSpectrum& sum : sums.sums()) merged.reflected += sum;
    return merged;
  }
  // Merges the nearest photons of set 0.
  Merged merge_near(const std::vector<Photon>& photons, size_t wanted, float max_radius,
                    float* radius) const {
    const OwnedRoutes owned = all_photons();
    const WalkVertex vertex{surface, *one_material().materials.back(), reflecting,
                            surface.shading.to_local(wo), ClassMask::kDiffuse};
    PartSums sums(*owned.routes, owned.group);
    const MergePoint at{vertex, owned.routes->start(), ClassMask::kRough, 1, SampledSpectrum(1.0f)};
    std::vector<PhotonGrid::Neighbour> scratch;
    const NearestMerge near = merge_nearest(PhotonGrid(photons), owned, at, kAnyDepth,
                                            {wanted, max_radius, 0}, scratch, sums);
    Merged merged{{}, near.found};
    *radius = near.radius;
    for (const SampledSpectrum& sum : sums.sums()) merged.reflected += sum;
    return merged;
  }
  // All light belongs to one route.
  Merged merge(const std::vector<Photon>& photons, int eye_left = kAllWavelengths) const {
    return merge(photons, all_photons(), 1, kAnyDepth, eye_left);
  }
};

// Light state of a photon straight from a lamp, for routes with a single state.
LightState straight_from(const OwnedRoutes& owned) {
  return owned.routes->emitted(light_symbol(LightKind::kShape, 0));
}

Photon photon_from(const Vec3f& wi) {
  Photon photon;
  photon.p = Vec3f(0.02f, 0.03f, 0);
  photon.wi = PackedDirection(wi);
  photon.ng = PackedDirection(Vec3f(0, 0, 1));
  photon.flux = PackedSpectrum(ramp());
  photon.state = straight_from(all_photons());
  return photon;
}

void expect_spectrum(const SampledSpectrum& found, const SampledSpectrum& expected,
                     const std::string& what) {
  for (int i = 0; i < kSpectrumSamples; ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-5f * (1.0f + expected[i]))
        << what << ", wavelength " << i;
}

TEST(Merge, SumsFluxTimesTheBsdf) {
  const VisiblePoint point;
  const Merged m = point.merge({photon_from({0, 0, 1}), photon_from({0.5f, 0.3f, 0.4f})});
  EXPECT_EQ(m.found, 2u);
  expect_spectrum(m.reflected, ramp() * (2 * kReflectance * kInvPi), "two photons");
}

TEST(Merge, PhotonsAlongTheSurfaceDoNotCount) {
  // Packing changes their cosine by a large part, or its sign.
  const VisiblePoint point;
  EXPECT_EQ(point.merge({photon_from({1, 0, 5e-4f}), photon_from({1, 0, -5e-4f})}).found, 0u);
  EXPECT_EQ(point.merge({photon_from(normalize(Vec3f(1, 0, 5e-3f)))}).found, 1u);
}

TEST(Merge, PhotonsBeyondTheRadiusDoNotCount) {
  const VisiblePoint point;
  Photon inside = photon_from({0, 0, 1}), outside = inside;
  inside.p = Vec3f(0.0999f, 0, 0);
  outside.p = Vec3f(0.1001f, 0, 0);
  EXPECT_EQ(point.merge({inside, outside}).found, 1u);
}

TEST(Merge, PhotonsOfAWallDoNotCountOnTheFloor) {
  const VisiblePoint point;
  Photon wall = photon_from({0.7f, 0, 0.7f});
  wall.ng = PackedDirection(Vec3f(1, 0, 0));
  Photon steep = wall;
  steep.ng = PackedDirection(normalize(Vec3f(1, 0, 0.9f)));  // 48 degrees
  const Merged none = point.merge({wall, steep});
  EXPECT_EQ(none.found, 0u);
  EXPECT_TRUE(none.reflected.is_black());
  Photon slanted = wall;
  slanted.ng = PackedDirection(normalize(Vec3f(0.5f, 0, 1)));  // 27 degrees: the same bent surface
  EXPECT_EQ(point.merge({wall, slanted}).found, 1u);
}

TEST(Merge, ThePhotonsOwnCosineIsTheDensityOfItsLanding) {
  // On a curved surface, the density of a beam's photons is proportional to the cosine at each
  // photon.
  const VisiblePoint point;
  Photon bent = photon_from({0.6f, 0, 0.8f});
  bent.ng = PackedDirection(normalize(Vec3f(0.4f, 0, 1)));
  const Merged m = point.merge({bent});
  const float share =
      dot(bent.wi.unpacked(), point.surface.ng) / dot(bent.wi.unpacked(), bent.ng.unpacked());
  expect_spectrum(m.reflected, ramp() * (kReflectance * kInvPi * share), "bent surface");
}

TEST(Merge, ANormalThatPointsTheOtherWayIsTheSameSurface) {
  const VisiblePoint point;
  Photon flipped = photon_from({0.5f, 0.3f, 0.4f});
  flipped.ng = PackedDirection(Vec3f(0, 0, -1));
  const Merged m = point.merge({flipped});
  EXPECT_EQ(m.found, 1u);
  expect_spectrum(m.reflected, ramp() * (kReflectance * kInvPi), "flipped");
}

TEST(Merge, TheSideOfArrivalSelectsReflectionOrTransmission) {
  VisiblePoint point;
  for (const float normal : {1.0f, -1.0f}) {
    Photon above = photon_from({0.2f, 0.3f, 0.9f}), below = photon_from({0.2f, 0.3f, -0.9f});
    above.ng = below.ng = PackedDirection(Vec3f(0, 0, normal));
    point.translucent = true;
    expect_spectrum(point.merge({above}).reflected, ramp() * (kReflectance * kInvPi), "above");
    expect_spectrum(point.merge({below}).reflected, ramp() * (kTransmittance * kInvPi), "below");
    point.translucent = false;
    expect_spectrum(point.merge({above}).reflected, ramp() * (kReflectance * kInvPi), "above");
    EXPECT_TRUE(point.merge({below}).reflected.is_black()) << "an opaque floor, lit from below";
  }
}

TEST(Merge, WhatIsLeftStandsForAllWavelengths) {
  const VisiblePoint point;
  // The mean over all pairs of heroes is that of all wavelengths.
  SampledSpectrum mean_one_dropped, mean_both_dropped;
  const SampledSpectrum expected_whole = ramp() * (kReflectance * kInvPi);
  const Photon whole = photon_from({0, 0, 1});
  expect_spectrum(point.merge({whole}).reflected, expected_whole, "none dropped");
  constexpr float kShare = 1.0f / kSpectrumSamples;
  for (int a = 0; a < kSpectrumSamples; ++a) {
    Photon hero = whole;
    hero.left = static_cast<int8_t>(a);
    SampledSpectrum expected;
    expected.set(a, expected_whole[a] * kSpectrumSamples);
    const Merged of_photon = point.merge({hero});
    expect_spectrum(of_photon.reflected, expected, "the photon's");
    expect_spectrum(point.merge({whole}, a).reflected, expected, "the eye's");
    expect_spectrum(point.merge({whole, hero}).reflected, expected_whole + expected, "one of each");
    mean_one_dropped = mean_one_dropped + of_photon.reflected * kShare;
    for (int b = 0; b < kSpectrumSamples; ++b) {
      const Merged both = point.merge({hero}, b);
      EXPECT_EQ(both.found, a == b ? 1u : 0u);
      EXPECT_EQ(both.reflected.is_black(), a != b);
      mean_both_dropped = mean_both_dropped + both.reflected * (kShare * kShare);
    }
  }
  expect_spectrum(mean_one_dropped, expected_whole, "one dropped");
  expect_spectrum(mean_both_dropped, expected_whole, "both dropped");
}

TEST(Merge, TheDepthLimitCountsTheEventsOfBothSides) {
  const VisiblePoint point;
  const OwnedRoutes owned = all_photons();
  for (int max_depth = 1; max_depth <= 6; ++max_depth)
    for (int eye_events = 1; eye_events <= 7; ++eye_events)
      for (int photon_events = 0; photon_events <= 7; ++photon_events) {
        Photon photon = photon_from({0, 0, 1});
        photon.events = static_cast<uint16_t>(photon_events);
        const Merged m = point.merge({photon}, owned, eye_events, max_depth);
        EXPECT_EQ(m.found, eye_events + photon_events <= max_depth ? 1u : 0u)
            << eye_events << " and " << photon_events << " events of " << max_depth;
        EXPECT_EQ(m.reflected.is_black(), m.found == 0);
      }
}

TEST(Merge, PhotonsOfAnotherRouteArePassedOver) {
  const VisiblePoint point;
  const std::vector<std::string> texts{"caustic=C.*[DG]S+[DG]?L:photons", "rest=.*:sppm"};
  const OwnedRoutes caustic = testing_support::owned_routes(one_material(), texts, 0);
  const OwnedRoutes rest = testing_support::owned_routes(one_material(), texts, 1);
  struct Case {
    const char* light_side;  // events from the light on
    bool is_caustic;
  };
  const Case cases[] = {{"", false},  {"D", false},  {"S", true},    {"SS", true},
                        {"DS", true}, {"DD", false}, {"DDS", false}, {"SD", true}};
  std::vector<Photon> all;
  for (const Case& c : cases) {
    Photon photon = photon_from({0, 0, 1});
    photon.state = straight_from(caustic);
    for (const char* e = c.light_side; *e; ++e)
      photon.state = caustic.routes->light_next(
          photon.state,
          event_symbol(*e == 'D' ? EventClass::kDiffuse : EventClass::kSpecular, false, 0));
    all.push_back(photon);
    EXPECT_EQ(point.merge({photon}, caustic).found, c.is_caustic ? 1u : 0u)
        << "light side \"" << c.light_side << "\"";
    EXPECT_EQ(point.merge({photon}, rest).found, c.is_caustic ? 0u : 1u)
        << "light side \"" << c.light_side << "\"";
  }
  EXPECT_EQ(point.merge(all, caustic).found, 4u);
  EXPECT_EQ(point.merge(all, rest).found, 4u);
}

TEST(MergeNearest, IsAConeToTheLastPhoton) {
  const VisiblePoint point;
  std::vector<Photon> photons(4, photon_from({0, 0, 1}));
  for (size_t i = 0; i < photons.size(); ++i)
    photons[i].p = Vec3f(0.01f * static_cast<float>(i + 1), 0, 0);
  float radius = 0;
  const Merged m = point.merge_near(photons, 3, 0.1f, &radius);
  EXPECT_EQ(m.found, 3u);
  EXPECT_NEAR(radius, 0.03f, 1e-7f);
  // Weights 1 - 1/3, 1 - 2/3 and 0.
  const float cone = 3 / (kPi * sqr(0.03f));
  expect_spectrum(m.reflected, ramp() * (kReflectance * kInvPi * cone), "three of four");
  // Too few photons: the largest radius, for the cone as well.
  const Merged all = point.merge_near(photons, 50, 0.1f, &radius);
  EXPECT_EQ(all.found, 4u);
  EXPECT_EQ(radius, 0.1f);
  expect_spectrum(all.reflected, ramp() * (kReflectance * kInvPi * 3 / (kPi * 0.01f) * 3.0f),
                  "all");
}

TEST(MergeNearest, OtherSetsChooseTheRadiusAndNoMore) {
  const VisiblePoint point;
  std::vector<Photon> photons(4, photon_from({0, 0, 1}));
  for (size_t i = 0; i < photons.size(); ++i)
    photons[i].p = Vec3f(0.01f * static_cast<float>(i + 1), 0, 0);
  photons[0].set = 5;
  // A photon rejected for its normal does not affect the radius.
  photons[1].ng = PackedDirection(Vec3f(1, 0, 0));
  float radius = 0;
  const Merged m = point.merge_near(photons, 3, 0.1f, &radius);
  EXPECT_EQ(m.found, 3u);
  EXPECT_NEAR(radius, 0.04f, 1e-7f);
  const float cone = 3 / (kPi * sqr(0.04f));
  expect_spectrum(m.reflected, ramp() * (kReflectance * kInvPi * cone * 0.25f), "one of set 0");
}

}  // namespace
}  // namespace nephroid

// Photon maps and hit points: emission once, the owner of photons, and memory.
// tests/analytic/photon_map_test.cpp compares light with closed forms.
#include "integrator/photon_mapping/photon_map.h"

#include <gtest/gtest.h>

#include "core/errors.h"
#include "estimators.h"
#include "integrator/photon_mapping/ppm.h"
#include "integrator/presets/integrator_table.h"
#include "photon/photon.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

const std::string kRoom = R"(
  LookAt 0 3 -5  0 0.4 0  0 1 0
  Camera "perspective" "float fov" 30
  Film "rgb" "integer xresolution" 8 "integer yresolution" 8
  PixelFilter "box"
  WorldBegin
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [10 9 8]
    Translate 0 4 0 Rotate 90 1 0 0 Shape "disk" "float radius" 0.7
  AttributeEnd
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-6 0 -6  6 0 -6  -6 0 6  6 0 6]
  Shape "bilinearmesh" "point3 P" [-6 0 2  6 0 2  -6 4 2  6 4 2]
  Material "dielectric" Translate 0 0.9 0 Shape "sphere" "float radius" 0.6)";

std::vector<EstimatorStatistics> statistics_after(const Scene& scene, const Plan& plan,
                                                  const IntegratorOptions& options,
                                                  uint32_t passes) {
  EstimatorSet set = make_estimators(plan, options, scene);
  Film film = film_for(scene, set);
  for (uint32_t pass = 0; pass < passes; ++pass) set.render_pass({1, pass}, scene, film);
  return set.statistics();
}

TEST(PhotonMap, IsTracedOnceAndEachRouteHasItsOwn) {
  const auto scene = scene_from_text(kRoom);
  IntegratorOptions options;
  options.edit<PhotonMapOptions>().map_photons = 16 * 2048;
  for (const uint32_t passes : {1u, 5u, 20u}) {
    const auto statistics = statistics_after(*scene, "photonmap", options, passes);
    ASSERT_EQ(statistics.size(), 3u);
    EXPECT_EQ(statistics[0].photon_paths, 16u * 2048u);
    EXPECT_EQ(statistics[1].photon_paths, 16u * 2048u);
    EXPECT_GT(statistics[0].photons_stored, 100u);
    EXPECT_GT(statistics[1].photons_stored, 2 * statistics[0].photons_stored);
    EXPECT_GT(statistics[1].photon_bytes, statistics[1].photons_stored * sizeof(Photon));
    EXPECT_EQ(statistics[1].bytes, statistics[1].photon_bytes + statistics[1].pixel_bytes);
    EXPECT_EQ(statistics[1].photon_bytes,
              statistics_after(*scene, "photonmap", options, 1)[1].photon_bytes);
    ASSERT_EQ(statistics[0].notes.size(), 1u);
    EXPECT_NE(statistics[0].notes[0].find("'caustic'"), std::string::npos);
    EXPECT_EQ(statistics[2].photon_paths, 0u);
  }
  // The default is the photons of 16 passes.
  options.edit<PhotonMapOptions>().map_photons = 0;
  options.photons_per_pass = 1024;
  EXPECT_EQ(statistics_after(*scene, "photonmap", options, 2)[1].photon_paths, 16u * 1024u);
  // The memory limit ends emission.
  options.edit<PhotonMapOptions>().map_photons = 1 << 20;
  options.memory_photons = 5000;
  const auto small = statistics_after(*scene, "photonmap", options, 2)[1];
  EXPECT_LT(small.photon_paths, 100000u);
  EXPECT_GE(small.photons_stored, 5000u);
}

TEST(PhotonMap, SaysThatPassesDoNotConverge) {
  const auto scene = scene_from_text(kRoom);
  const EstimatorSet set = make_integrator("photonmap", {}, *scene);
  EXPECT_FALSE(set.estimators[0]->descriptor().capabilities.consistent);
  EXPECT_TRUE(set.estimators[0]->descriptor().capabilities.independent_passes);
  EXPECT_TRUE(set.estimators[2]->descriptor().capabilities.consistent);
}

TEST(PhotonMap, APassDoesNotKnowWhichCameBefore) {
  const auto scene = scene_from_text(kRoom);
  IntegratorOptions options;
  options.edit<PhotonMapOptions>().map_photons = 16 * 1024;
  const Plan plan = plan_of({"seen=C[DG].*:photonmap", "rest=.*:path"});
  const Film all = render(*scene, plan, options, 3, 3, 15);
  Film sum = render(*scene, plan, options, 3, 1, 15);
  double difference = 0, total = 0;
  const Film second = render(*scene, plan, options, 3, 2, 16);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      const double both = (static_cast<double>(sum.route_value(0, x, y).g) +
                           2 * static_cast<double>(second.route_value(0, x, y).g)) /
                          3;
      difference += std::abs(both - static_cast<double>(all.route_value(0, x, y).g));
      total += both;
    }
  EXPECT_GT(total, 0);
  EXPECT_LT(difference, 1e-6 * total);
}

TEST(Memory, IsCountedByAllThatHoldIt) {
  const auto scene = scene_from_text(kRoom);
  IntegratorOptions options;
  options.photons_per_pass = 4096;
  const auto held = [&](const char* name, uint32_t passes) {
    EstimatorStatistics sum;
    for (const EstimatorStatistics& s : statistics_after(*scene, name, options, passes)) {
      EXPECT_LE(s.bytes, s.photon_bytes + s.pixel_bytes) << name;
      EXPECT_GE(s.bytes, std::max(s.photon_bytes, s.pixel_bytes)) << name;
      sum.photon_bytes += s.photon_bytes;
      sum.pixel_bytes += s.pixel_bytes;
    }
    return sum;
  };
  for (const char* name : {"sppm", "ppm", "photonmap", "doidge2012", "vertex", "vcm"}) {
    EXPECT_GT(held(name, 1).photon_bytes, 0u) << name;
    EXPECT_GT(held(name, 1).pixel_bytes, 0u) << name;
  }
  // Pixels that are completed one by one need no memory.
  EXPECT_GT(held("bpm", 1).photon_bytes, 0u);
  EXPECT_EQ(held("bpm", 1).pixel_bytes, 0u);
  for (const char* name : {"bdpt", "mlt", "pssmlt"}) {
    EXPECT_EQ(held(name, 1).photon_bytes, 0u) << name;
    EXPECT_GE(held(name, 1).pixel_bytes, 64u * sizeof(Rgb)) << name;
    EXPECT_EQ(held(name, 3).pixel_bytes, held(name, 1).pixel_bytes) << name;
  }
  EXPECT_EQ(held("path-only", 1).pixel_bytes, 0u);
}

// An edge between two tiles runs through the pixel. All passes of a set share time and hero
// wavelength. If each set saw only its own strip, the pixel would consist of sixteen such pairs for
// any number of passes.
const std::string kEdge = R"(
  LookAt 0 1 0  0 0 0  0 0 1
  Camera "perspective" "float fov" 40
  Film "rgb" "integer xresolution" 1 "integer yresolution" 1
  PixelFilter "box"
  WorldBegin
  LightSource "distant" "point3 from" [0 1 0] "point3 to" [0 0 0]
  Material "diffuse" "rgb reflectance" [0.5 0.5 0.5]
  Shape "bilinearmesh" "point3 P" [-1 0 -1  0 0 -1  -1 0 1  0 0 1]
  Material "diffuse" "rgb reflectance" [0.1 0.1 0.1]
  Shape "bilinearmesh" "point3 P" [0 0 -1  1 0 -1  0 0 1  1 0 1])";

TEST(PhotonMap, EachSetSeesTheWholeOfAPixel) {
  const auto scene = scene_from_text(kEdge);
  IntegratorOptions options;
  options.edit<PhotonMapOptions>().map_photons = 16 * 4096;
  options.edit<PhotonMapOptions>().nearest_photons = kAllPhotons;
  options.radius = 0.25f;
  for (uint64_t seed = 0; seed < 3; ++seed) {
    EstimatorSet set =
        make_estimators(plan_of({"all=C[DG].*:photonmap", "rest=.*:path"}), options, *scene);
    LearningLoop map;
    std::vector<double> sets;
    double mean = 0;
    for (uint32_t k = 0; k < 16; ++k) {
      Film film = film_for(*scene, set);
      for (uint32_t round = 0; round < 64; ++round)
        map.render_pass(*set.estimators[0], {seed, k + 16 * round}, *scene, film);
      sets.push_back(picture_mean(film));
      mean += sets.back() / 16;
    }
    EXPECT_GT(mean, 0);
    // Seeing a single tile gives 5/3 or 1/3 of the mean.
    for (const double value : sets) EXPECT_NEAR(value, mean, 0.2 * mean) << "seed " << seed;
    const auto [least, most] = std::minmax_element(sets.begin(), sets.end());
    std::printf("sets: %.3f to %.3f of their mean\n", *least / mean, *most / mean);
  }
}

TEST(PhotonMap, WalksDoNotRepeatWhenTheirNumberTakesMoreThan32Bits) {
  const auto scene = scene_from_text(kEdge);
  IntegratorOptions options;
  options.edit<PhotonMapOptions>().map_photons = 16 * 256;
  options.camera_samples_per_pass = 1 << 12;
  const Plan plan = plan_of({"all=C[DG].*:photonmap", "rest=.*:path"});
  // Walks of the second render have the numbers 2^32 + k in their set.
  const Rgb first = render(*scene, plan, options, 1, 1, 0).value(0, 0);
  const Rgb later = render(*scene, plan, options, 1, 1, 16u << 20).value(0, 0);
  EXPECT_GT(first.g, 0.0f);
  EXPECT_NE(first.g, later.g);
}

TEST(HitPoints, MemoryGrowsWithThemAndNotWithPasses) {
  const auto scene = scene_from_text(kRoom);
  IntegratorOptions options;
  options.photons_per_pass = 4096;
  const auto kept = [&](const char* name, int hit_points, uint32_t passes) {
    options.edit<PpmOptions>().hit_points = hit_points;
    return statistics_after(*scene, name, options, passes)[1].pixel_bytes;
  };
  const uint64_t one = kept("ppm", 1, 1);
  EXPECT_EQ(one, kept("sppm", 1, 1));
  EXPECT_EQ(kept("ppm", 7, 1), 7 * one);
  EXPECT_EQ(kept("ppm", 7, 3), 7 * one);
  EXPECT_EQ(kept("sppm", 7, 3), one);
}

TEST(HitPoints, ConvergeOnlyIfWalksAreNew) {
  const auto scene = scene_from_text(kRoom);
  for (const bool stay : {false, true}) {
    const EstimatorSet set = make_integrator(stay ? "ppm" : "sppm", {}, *scene);
    for (size_t i = 0; i < set.estimators.size(); ++i) {
      const Capabilities capabilities = set.estimators[i]->descriptor().capabilities;
      const EstimatorTraits* const kind = set.routes->groups()[i].estimator;
      EXPECT_EQ(capabilities.consistent, kind != estimator_named("ppm"));
      EXPECT_EQ(capabilities.independent_passes, is_one_of(kind, {"path"}));
    }
  }
}

}  // namespace
}  // namespace nephroid

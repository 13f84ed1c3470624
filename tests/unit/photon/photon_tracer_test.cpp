// Photons from lights to surfaces: their number and flux, for any number of threads and batches.
#include "photon/photon_tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "core/parallel.h"
#include "input/pbrt_parser.h"
#include "owned_routes.h"
#include "photon/photon_histories.h"
#include "source_directory.h"

namespace nephroid {
namespace {

constexpr int64_t kPhotons = 1 << 16;

std::unique_ptr<Scene> scene_from_text(const std::string& text) {
  Diagnostics diagnostics;
  const SceneDescription d = parse_pbrt_string(
      text, "test.pbrt", testing_support::source_directory() + "/tests", diagnostics);
  return build_scene(d, {}, diagnostics);
}

PhotonTraceSettings settings(int max_events, uint32_t pass = 0, int64_t photons = kPhotons) {
  PhotonTraceSettings s;
  s.key = {7, pass};
  s.photons_per_pass = photons;
  s.lambda = SampledWavelengths::sample_visible(0.3f);
  s.max_events = max_events;
  return s;
}

OwnedRoutes all_photons(const Scene& scene) {
  return testing_support::owned_routes(scene, {"photons=.*:photons"});
}

PhotonTrace trace_all(const Scene& scene, const PhotonTraceSettings& s) {
  return trace_photons(scene, all_photons(scene), s, 0, s.photons_per_pass);
}

bool same(const Photon& a, const Photon& b) {
  return a.p == b.p && a.wi == b.wi && a.ng == b.ng && a.flux == b.flux && a.state == b.state &&
         a.left == b.left && a.events == b.events;
}

void expect_same(const std::vector<Photon>& a, const std::vector<Photon>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) ASSERT_TRUE(same(a[i], b[i])) << "photon " << i;
}

// A lamp of every kind above a floor, with glass, a coated ball and a sheet of alpha 0.5.
const char* const kMany = R"(
  WorldBegin
  AttributeBegin
    Translate 0 3 0 Rotate 90 1 0 0
    AreaLightSource "diffuse" "rgb L" [9 8 7]
    Shape "disk" "float radius" 0.5
  AttributeEnd
  LightSource "point" "rgb I" [2 3 4] "point3 from" [2 2 -3]
  LightSource "infinite" "rgb L" [0.1 0.2 0.3]
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-4 0 -4  4 0 -4  -4 0 4  4 0 4]
  Shape "bilinearmesh" "point3 P" [-4 0.4 -4  4 0.4 -4  -4 0.4 4  4 0.4 4] "float alpha" 0.5
  Material "dielectric" "spectrum eta" "glass-SF11"
  AttributeBegin Translate -0.8 1.2 0 Shape "sphere" "float radius" 0.6 AttributeEnd
  Material "coateddiffuse" "rgb reflectance" [0.2 0.5 0.3] "float roughness" 0
  AttributeBegin Translate 0.8 1.2 0 Shape "sphere" "float radius" 0.6 AttributeEnd
)";

TEST(PhotonTracer, ThreadsDoNotMatter) {
  const auto scene = scene_from_text(kMany);
  std::vector<PhotonTrace> traces;
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    traces.push_back(trace_all(*scene, settings(8, 2, 10000)));
  }
  ASSERT_GT(traces[0].photons.size(), 1000u);
  for (const PhotonTrace& t : traces) {
    expect_same(t.photons, traces[0].photons);
    EXPECT_EQ(t.rays, traces[0].rays);
    EXPECT_EQ(t.useful_paths, traces[0].useful_paths);
    EXPECT_EQ(t.specular_paths, traces[0].specular_paths);
    EXPECT_EQ(t.paths, 10000u);
  }
}

TEST(PhotonTracer, BatchesAreTheSamePhotons) {
  const auto scene = scene_from_text(kMany);
  const PhotonTraceSettings s = settings(8, 1, 10000);
  const PhotonTrace whole = trace_all(*scene, s);
  const OwnedRoutes owned = all_photons(*scene);
  std::vector<Photon> joined;
  for (const auto& [begin, end] :
       {std::pair<int64_t, int64_t>{0, 1024}, {1024, 5120}, {5120, 10000}}) {
    const PhotonTrace part = trace_photons(*scene, owned, s, begin, end);
    joined.insert(joined.end(), part.photons.begin(), part.photons.end());
  }
  expect_same(joined, whole.photons);
}

TEST(PhotonTracer, AMemoryLimitOnlyCutsThePassIntoBatches) {
  const auto scene = scene_from_text(kMany);
  const PhotonTraceSettings s = settings(4, 0, 150000);
  const PhotonTrace whole = trace_all(*scene, s);
  const OwnedRoutes owned = all_photons(*scene);
  std::vector<Photon> joined;
  uint64_t paths = 0;
  int batches = 0;
  for (int64_t begin = 0; begin < s.photons_per_pass; ++batches) {
    const int64_t before = begin;
    const PhotonTrace part = trace_batch(*scene, owned, s, 1, begin);
    ASSERT_GT(begin, before);
    joined.insert(joined.end(), part.photons.begin(), part.photons.end());
    paths += part.paths;
  }
  EXPECT_GE(batches, 3);
  EXPECT_EQ(paths, 150000u);
  expect_same(joined, whole.photons);
}

TEST(PhotonTracer, PassesAndSeedsHaveTheirOwnPhotons) {
  const auto scene = scene_from_text(kMany);
  const PhotonTrace a = trace_all(*scene, settings(4, 0, 2048)),
                    b = trace_all(*scene, settings(4, 1, 2048));
  PhotonTraceSettings other = settings(4, 0, 2048);
  other.key.seed = 8;
  const PhotonTrace c = trace_all(*scene, other);
  ASSERT_FALSE(a.photons.empty() || b.photons.empty() || c.photons.empty());
  EXPECT_FALSE(same(a.photons[0], b.photons[0]));
  EXPECT_FALSE(same(a.photons[0], c.photons[0]));
}

TEST(PhotonTracer, AFloorReceivesWhatTheLampSendsThere) {
  // Two parallel disks on one axis, radii r1 and r2 at distance h. The share (s - sqrt(s^2 - 4
  // (r2/r1)^2)) / 2 of pi A L arrives, with s = 1 + (h^2 + r2^2)/r1^2.
  const auto scene = scene_from_text(R"(
    WorldBegin
    AttributeBegin
      AreaLightSource "diffuse" "spectrum L" [300 2 900 3]
      Material "diffuse" "rgb reflectance" [0 0 0]
      Translate 0 3 0 Rotate 90 1 0 0
      Shape "disk" "float radius" 0.8
    AttributeEnd
    Material "diffuse" "rgb reflectance" [0.5 0.5 0.5]
    Rotate -90 1 0 0 Shape "disk" "float radius" 2.5
  )");
  const PhotonTraceSettings s = settings(1);
  const PhotonTrace trace = trace_all(*scene, s);
  ASSERT_EQ(scene->lights.size(), 1u);
  const SampledSpectrum radiance = scene->lights[0]->radiance(
      Vec3f(0, 3, 0), Vec3f(0, -1, 0), Vec2f(0.5f, 0.5f), Vec3f(0, -1, 0), s.lambda);
  const double r1 = 0.8, r2 = 2.5, h = 3, z = 1 + (h * h + r2 * r2) / (r1 * r1);
  const double share = 0.5 * (z - std::sqrt(z * z - 4 * (r2 / r1) * (r2 / r1)));
  SampledSpectrum sum;
  for (const Photon& photon : trace.photons) {
    EXPECT_NEAR(photon.p.y, 0, 1e-5f);
    EXPECT_EQ(photon.events, 0);
    sum += photon.flux.unpacked();
  }
  EXPECT_EQ(trace.useful_paths, trace.photons.size());
  EXPECT_NEAR(static_cast<double>(trace.photons.size()) / kPhotons, share, 0.005 * share);
  for (int i = 0; i < kSpectrumSamples; ++i) {
    const double expected =
        static_cast<double>(kPi * kPi) * r1 * r1 * static_cast<double>(radiance[i]) * share;
    ASSERT_GT(expected, 0.0);
    EXPECT_NEAR(static_cast<double>(sum[i]) / kPhotons, expected, 0.005 * expected)
        << "wavelength " << i;
  }
}

TEST(PhotonTracer, RouletteKeepsTheMean) {
  // A point light in a hollow ball: after k reflections all of its light times rho^k is on the
  // ball.
  const auto scene = scene_from_text(R"(
    WorldBegin
    LightSource "point" "spectrum I" [300 1 900 1] "point3 from" [0.1 0.2 -0.1]
    Material "diffuse" "spectrum reflectance" [360 0.3 830 0.8]
    Shape "sphere" "float radius" 1
  )");
  const PhotonTraceSettings s = settings(6);
  const PhotonTrace trace = trace_all(*scene, s);
  std::vector<SampledSpectrum> sums(6);
  std::vector<double> counts(6, 0.0);
  for (const Photon& photon : trace.photons) {
    ASSERT_LT(photon.events, 6);
    sums[photon.events] += photon.flux.unpacked() / static_cast<float>(kPhotons);
    counts[photon.events] += 1;
  }
  EXPECT_EQ(counts[0], kPhotons);
  for (size_t k = 1; k < sums.size(); ++k) {
    EXPECT_LT(counts[k], counts[k - 1]) << "nobody was killed, so nothing is tested";
    // The number of survivors is binomial at each step: allow six standard deviations of their sum.
    double variance = 0;
    for (size_t j = 1; j <= k; ++j) variance += 1 / counts[j];
    for (int i = 0; i < kSpectrumSamples; ++i) {
      const float rho = 0.3f + 0.5f * (s.lambda.lambda(i) - 360.0f) / 470.0f;
      const double expected = static_cast<double>(sums[0][i]) *
                              std::pow(static_cast<double>(rho), static_cast<double>(k));
      EXPECT_NEAR(sums[k][i], expected, 6 * std::sqrt(variance) * expected)
          << k << " reflections, wavelength " << i;
    }
  }
}

TEST(PhotonTracer, APartlyPresentSheetStoresTheLightThatItShows) {
  // Photons and eye paths meet the sheet with probability alpha. Stored photons represent the whole
  // irradiance; the rest goes on to the floor.
  const auto flux = [](const char* alpha, float height) {
    const auto scene = scene_from_text(std::string(R"(
      WorldBegin
      LightSource "distant" "spectrum L" [300 1 900 1] "point3 from" [0 1 0] "point3 to" [0 0 0]
      Material "diffuse" "spectrum reflectance" [300 0.5 900 0.5]
      Shape "bilinearmesh" "point3 P" [-1 0 -1  1 0 -1  -1 0 1  1 0 1]
      Shape "bilinearmesh" "point3 P" [-1 1 -1  1 1 -1  -1 1 1  1 1 1] )") +
                                       alpha);
    double sum = 0;
    for (const Photon& photon : trace_all(*scene, settings(1)).photons)
      if (std::abs(photon.p.y - height) < 1e-3f)
        sum += static_cast<double>(photon.flux.unpacked()[0]);
    return sum;
  };
  const double solid = flux("", 1);
  EXPECT_GT(solid, 0);
  EXPECT_EQ(flux("", 0), 0);
  EXPECT_NEAR(flux("\"float alpha\" 0.25", 1), solid, 0.04 * solid);
  EXPECT_NEAR(flux("\"float alpha\" 0.25", 0), 0.75 * solid, 0.02 * solid);
}

TEST(PhotonTracer, AMapEndsWithAWholeChunkOfEachSetAndKeepsItAll) {
  const auto scene = scene_from_text(kMany);
  const OwnedRoutes owned = all_photons(*scene);
  std::vector<PhotonTraceSettings> sets;
  for (uint32_t s = 0; s < 3; ++s) sets.push_back(settings(8, s, 5000));
  const PhotonMapTrace whole = trace_map(*scene, owned, sets, int64_t{1} << 40);
  EXPECT_EQ(whole.paths_of_set, 5000);
  EXPECT_EQ(whole.trace.paths, 15000u);
  const auto of_set = [](const PhotonMapTrace& map, int set) {
    std::vector<Photon> photons;
    for (const Photon& photon : map.trace.photons)
      if (photon.set == set) photons.push_back(photon);
    return photons;
  };
  for (int s = 0; s < 3; ++s)
    expect_same(of_set(whole, s),
                trace_photons(*scene, owned, sets[static_cast<size_t>(s)], 0, 5000).photons);

  // With less memory it is the beginning of the same map, with every photon of its paths.
  const int64_t limit = static_cast<int64_t>(whole.trace.photons.size()) / 2;
  const PhotonMapTrace half = trace_map(*scene, owned, sets, limit);
  EXPECT_EQ(half.paths_of_set % kPhotonChunk, 0);
  EXPECT_LT(half.paths_of_set, 5000);
  EXPECT_GE(static_cast<int64_t>(half.trace.photons.size()), limit);
  EXPECT_EQ(half.trace.paths, 3 * static_cast<uint64_t>(half.paths_of_set));
  for (int s = 0; s < 3; ++s)
    expect_same(
        of_set(half, s),
        trace_photons(*scene, owned, sets[static_cast<size_t>(s)], 0, half.paths_of_set).photons);
}

// A recorded light path is the one that left the photon: it passes through the photon's place.
TEST(PhotonTracer, RecordsTheLightPathOfEachPhoton) {
  const auto scene = scene_from_text(kMany);
  const OwnedRoutes owned = all_photons(*scene);
  constexpr int64_t kPaths = 3000;
  const PhotonTraceSettings s = settings(8, 2, kPaths);
  PhotonHistories photons(
      kPaths,
      [&](int64_t j, std::vector<Photon>& into) {
        trace_photons_of_path(*scene, owned, s, j, into);
      },
      [&](int64_t j) { return record_photon_path(*scene, owned, s, j); });
  ASSERT_GT(photons.maps().surfaces().size(), 500u);
  for (const Photon& photon : photons.maps().surfaces().photons()) {
    const LightPathRecord& path = photons.of(photon);
    EXPECT_EQ(owned.symbols->lamp(path.light), photon.lamp);
    ASSERT_GE(path.walk.events.size(), photon.events);
    const auto place =
        std::ranges::find(path.walk.vertices, int{photon.events}, &WalkRecord::Vertex::events);
    ASSERT_NE(place, path.walk.vertices.end());
    EXPECT_EQ(place->p, photon.p);
  }
}

TEST(PhotonTracer, TracesSinglePathsAsItTracesAll) {
  const auto scene = scene_from_text(kMany);
  const PhotonTraceSettings s = settings(8, 1, 2000);
  std::vector<Photon> photons;
  for (int64_t j = 0; j < s.photons_per_pass; ++j)
    trace_photons_of_path(*scene, all_photons(*scene), s, j, photons);
  expect_same(photons, trace_all(*scene, s).photons);
}

}  // namespace
}  // namespace nephroid

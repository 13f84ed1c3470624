// Learned values of path+photons are a function of scene, film, options and seed. The bits do not
// depend on threads, the order of passes, or their split among processes.
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "lamp_in_a_tube.h"
#include "lit_patch.h"
#include "rendering.h"
#include "same_bits.h"

namespace nephroid {
namespace {

using namespace testing_support;

// A small lamp, and a glass ball on a much larger floor: photon emission is guided, and tiles
// differ in noise.
const std::string kGlassBall = R"(
  LookAt 0 3 -4  0 0.3 0  0 1 0
  Camera "perspective" "float fov" 45
  Film "rgb" "integer xresolution" 20 "integer yresolution" 16
  WorldBegin
  AttributeBegin
    Translate 1.5 3 0.5 Rotate 90 1 0 0
    AreaLightSource "diffuse" "rgb L" [90 80 70]
    Shape "disk" "float radius" 0.1
  AttributeEnd
  # Most photons come from here, of no use to the picture.
  AttributeBegin
    Translate 40 3 0.5 Rotate 90 1 0 0
    AreaLightSource "diffuse" "rgb L" [90 80 70]
    Shape "disk" "float radius" 1
  AttributeEnd
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-4 0 -4  48 0 -4  -4 0 4  48 0 4]
  Material "dielectric" "spectrum eta" "glass-SF11"
  Translate 0 0.6 0 Shape "sphere" "float radius" 0.4
)";

// Trials choose to merge photons of all light.
const std::string kTube =
    lamp_in_a_tube(R"(LookAt 0 1.4 -4  0 1.2 0  0 1 0 Camera "perspective" "float fov" 50)", 32);

// Camera paths are guided. The hair, out of view, prevents photons of all light, with which nothing
// would be guided.
const std::string kPatch = lit_patch(R"(
  Material "hair" "float eumelanin" 0.3
  Shape "curve" "point3 P" [20 0 0  20 1 0  20 2 0  20 3 0] "float width" 0.01
  Material "dielectric")",
                                     40);

struct Rendered {
  std::vector<Film> film;  ///< one film
  std::vector<std::string> notes;
};

/// Renders passes in this order, each part by new estimators.
Rendered render_parts(const std::string& text, const std::vector<std::vector<uint32_t>>& parts,
                      const IntegratorOptions& options = {}) {
  const auto scene = scene_from_text(text);
  Rendered result;
  for (const std::vector<uint32_t>& part : parts) {
    EstimatorSet set = make_estimators(plan_named("mixed"), options, *scene);
    if (result.film.empty()) result.film.push_back(film_for(*scene, set));
    for (const uint32_t pass : part) set.render_pass({5, pass}, *scene, result.film[0]);
    for (const EstimatorStatistics& s : set.statistics())
      for (const std::string& note : s.notes) result.notes.push_back(note);
  }
  return result;
}

bool says(const Rendered& r, const std::string& words) {
  return std::any_of(r.notes.begin(), r.notes.end(), [&](const std::string& note) {
    return note.find(words) != std::string::npos;
  });
}

TEST(PathAndPhotons, HasTheSameBitsForAnyNumberOfThreads) {
  for (const std::string& text : {kGlassBall, kTube, kPatch}) {
    std::vector<Rendered> found;
    for (const int threads : {1, 2, 3, 7}) {
      const ThreadLimit limit(threads);
      found.push_back(render_parts(text, {{0, 1, 2}}));
      expect_same_bits(found.back().film[0], found[0].film[0],
                       std::to_string(threads) + " threads");
      EXPECT_EQ(found.back().notes, found[0].notes);
    }
    // Without learning the test would prove little.
    const std::string notes = ::testing::PrintToString(found[0].notes);
    const bool all_light = says(found[0], "photons render all ");
    EXPECT_EQ(all_light, text == kTube) << notes;
    EXPECT_NE(says(found[0], "photon emission guided to"), all_light) << notes;
    EXPECT_NE(says(found[0], "camera paths per pixel"), all_light) << notes;
    EXPECT_FALSE(says(found[0], ", 1 to 1 depending on the tile")) << notes;
    EXPECT_TRUE(says(found[0], "camera paths guided at") || text != kPatch) << notes;
  }
}

TEST(PathAndPhotons, HasTheSameBitsForAnyOrderAndAnyRanges) {
  for (const std::string& text : {kGlassBall, kTube, kPatch}) {
    const Rendered whole = render_parts(text, {{0, 1, 2, 3, 4}});
    for (const auto& [name, parts] : {std::pair<const char*, std::vector<std::vector<uint32_t>>>{
                                          "backwards", {{4, 3, 2, 1, 0}}},
                                      {"the first one in the middle", {{2, 0, 4, 1, 3}}},
                                      {"ranges", {{3, 4}, {0}, {1, 2}}}})
      expect_same_bits(render_parts(text, parts).film[0], whole.film[0], name);
  }
}

TEST(PathAndPhotons, LearnsTheSameHoweverFewPhotonsFitInMemory) {
  IntegratorOptions batched;
  batched.memory_photons = 64;
  for (const std::string& text : {kGlassBall, kTube}) {
    const Rendered whole = render_parts(text, {{0, 1}}),
                   parts = render_parts(text, {{0, 1}}, batched);
    EXPECT_EQ(whole.notes, parts.notes);
    const PixelBounds& bounds = whole.film[0].bounds();
    for (int y = bounds.y0; y < bounds.y1; ++y)
      for (int x = bounds.x0; x < bounds.x1; ++x) {
        const Rgb a = whole.film[0].value(x, y), b = parts.film[0].value(x, y);
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(a[c], b[c], 1e-4 * (0.01 + std::abs(a[c])));
      }
  }
}

TEST(PathAndPhotons, LearnsAnewForEachSeed) {
  const auto scene = scene_from_text(kGlassBall);
  EstimatorSet both = make_estimators(plan_named("mixed"), {}, *scene),
               one = make_estimators(plan_named("mixed"), {}, *scene);
  Film a = film_for(*scene, one), b = film_for(*scene, both), other = film_for(*scene, both);
  one.render_pass({6, 1}, *scene, a);
  both.render_pass({5, 1}, *scene, other);
  both.render_pass({6, 1}, *scene, b);
  expect_same_bits(a, b, "seed 6 after seed 5");
}

}  // namespace
}  // namespace nephroid

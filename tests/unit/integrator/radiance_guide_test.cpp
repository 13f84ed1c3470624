// Directional densities learned from camera paths: samples follow them, they favour the light,
// separately on each side of a surface, and nothing is guided where it does not pay.
#include "integrator/learning/radiance_guide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/warps.h"
#include "unit/bsdf/statistics.h"

namespace nephroid {
namespace {

using testing_bsdf::TestRandom;

constexpr int kRecords = 30000;

/// Paths from a diffuse unit square (or its underside) into light of the given radiance.
std::vector<RadianceRecord> walks(const std::function<float(const Vec3f& p, const Vec3f& w)>& light,
                                  bool below = false) {
  std::vector<RadianceRecord> records;
  TestRandom random(below ? 2 : 1);
  const Frame frame = Frame::from_z(Vec3f(0, 0, below ? -1.0f : 1.0f));
  for (int i = 0; i < kRecords; ++i) {
    const Vec2f place = random.next2();
    const Vec3f p(place.x, place.y, 0), local = square_to_cosine_hemisphere(random.next2());
    const Vec3f w = frame.to_world(local);
    RadianceRecord r = RadianceRecord::at(p, frame.z, false, w, cosine_hemisphere_pdf_w(local.z));
    r.carried = 1;
    r.found = light(p, w);
    records.push_back(r);
  }
  return records;
}

/// A cap of a tenth of the upper hemisphere is a hundred times as bright as the rest.
float spot(const Vec3f& axis, const Vec3f& w) {
  return dot(normalize(axis), w) > 0.9f ? 1.0f : 0.01f;
}

TEST(RadianceGuide, LooksWhereTheLightIs) {
  // The left half of the floor is lit from the right, and the right half from the left.
  const Vec3f from_left(1, 0, 1), from_right(-1, 0, 1);
  const RadianceGuide guide(walks([&](const Vec3f& p, const Vec3f& w) {
    return spot(p.x < 0.5f ? from_left : from_right, w);
  }));
  EXPECT_GT(guide.guided(), 0.9);
  for (const float x : {0.2f, 0.8f}) {
    const DirectionTree tree = guide.at(Vec3f(x, 0.5f, 0), Vec3f(0, 0, 1), false);
    ASSERT_FALSE(tree.empty());
    EXPECT_GT(tree.share(), 0.4f);
    const Vec3f axis = normalize(x < 0.5f ? from_left : from_right);
    TestRandom random(3);
    int inside = 0;
    for (int i = 0; i < 10000; ++i) {
      float uc = random.next();
      inside += dot(axis, tree.sample(uc, random.next2())) > 0.9f;
    }
    // Cosine sampling would hit the cap one time in fourteen.
    EXPECT_GT(inside, 5000) << x;
  }
}

TEST(RadianceGuide, IsADensityThatSamplesFollow) {
  const RadianceGuide guide(
      walks([](const Vec3f&, const Vec3f& w) { return spot(Vec3f(1, 1, 2), w); }));
  const DirectionTree tree = guide.at(Vec3f(0.3f, 0.3f, 0), Vec3f(0, 0, 1), false);
  ASSERT_FALSE(tree.empty());
  // In the unit square, per cell of a grid: counts of samples against the mean density, whose
  // leaves are power-of-two cells.
  constexpr int kGrid = 16, kFine = 8, kSamples = 200000;
  std::vector<double> observed(kGrid * kGrid, 0.0), expected(kGrid * kGrid, 0.0);
  TestRandom random(4);
  for (int i = 0; i < kSamples; ++i) {
    float uc = random.next();
    const Vec3f w = tree.sample(uc, random.next2());
    const RadianceRecord r = RadianceRecord::at(Vec3f(0, 0, 0), Vec3f(0, 0, 1), false, w, 1);
    ASSERT_NEAR(length(w), 1, 1e-5);
    ASSERT_FLOAT_EQ(tree.pdf_w(w), tree.pdf_w(r.square));
    const int x = std::min(kGrid - 1, static_cast<int>(r.square.x * kGrid)),
              y = std::min(kGrid - 1, static_cast<int>(r.square.y * kGrid));
    observed[static_cast<size_t>(y * kGrid + x)] += 1;
  }
  for (int y = 0; y < kGrid * kFine; ++y)
    for (int x = 0; x < kGrid * kFine; ++x) {
      const Vec2f at((static_cast<float>(x) + 0.5f) / (kGrid * kFine),
                     (static_cast<float>(y) + 0.5f) / (kGrid * kFine));
      expected[static_cast<size_t>(y / kFine * kGrid + x / kFine)] +=
          4 * M_PI * static_cast<double>(tree.pdf_w(at)) * kSamples / sqr(kGrid * kFine);
    }
  EXPECT_GT(testing_bsdf::chi_square_test(observed, expected), 1e-3);
}

TEST(RadianceGuide, KeepsTheSidesOfASurfaceApart) {
  const Vec3f above(1, 0, 1), below(0, 1, -1);
  std::vector<RadianceRecord> records =
      walks([&](const Vec3f&, const Vec3f& w) { return spot(above, w); });
  const std::vector<RadianceRecord> others =
      walks([&](const Vec3f&, const Vec3f& w) { return spot(below, w); }, true);
  records.insert(records.end(), others.begin(), others.end());
  const RadianceGuide guide(std::move(records));
  const Vec3f p(0.5f, 0.5f, 0);
  const DirectionTree up = guide.at(p, Vec3f(0, 0, 1), false),
                      down = guide.at(p, Vec3f(0, 0, -1), false);
  ASSERT_FALSE(up.empty());
  ASSERT_FALSE(down.empty());
  EXPECT_GT(up.pdf_w(normalize(above)), 1);
  EXPECT_LT(up.pdf_w(normalize(below)), 0.01f);
  EXPECT_GT(down.pdf_w(normalize(below)), 1);
  EXPECT_LT(down.pdf_w(normalize(above)), 0.01f);
}

// In uniform light the BSDF of a diffuse floor is optimal. Without light, or without records, there
// is nothing to learn.
TEST(RadianceGuide, LeavesAloneWhatItCannotMend) {
  const RadianceGuide even(walks([](const Vec3f&, const Vec3f&) { return 1.0f; }));
  EXPECT_FALSE(even.guides());
  EXPECT_TRUE(even.at(Vec3f(0.5f, 0.5f, 0), Vec3f(0, 0, 1), false).empty());
  const RadianceGuide black(walks([](const Vec3f&, const Vec3f&) { return 0.0f; }));
  EXPECT_FALSE(black.guides());
  EXPECT_FALSE(RadianceGuide(std::vector<RadianceRecord>{}).guides());
  EXPECT_FALSE(RadianceGuide().guides());
  const RadianceGuide guide(
      walks([](const Vec3f&, const Vec3f& w) { return spot(Vec3f(1, 1, 2), w); }));
  EXPECT_TRUE(guide.at(Vec3f(0.5f, 0.5f, 0), Vec3f(1, 0, 0), false).empty());
  EXPECT_TRUE(guide.at(Vec3f(0.5f, 0.5f, 0), Vec3f(0, 0, 1), true).empty())
      << "no glossy one was seen";
  std::vector<RadianceRecord> few =
      walks([](const Vec3f&, const Vec3f& w) { return spot(Vec3f(1, 1, 2), w); });
  few.resize(200);
  EXPECT_FALSE(RadianceGuide(std::move(few)).guides());
}

// A polished floor: guiding the diffuse base must not take samples from the mirror.
TEST(RadianceGuide, CountsWhatOtherLobesLose) {
  const auto diffuse = [](const Vec3f&, const Vec3f& w) { return spot(Vec3f(1, 1, 2), w); };
  std::vector<RadianceRecord> records = walks(diffuse);
  const size_t count = records.size();
  for (size_t i = 0; i < count; ++i) {
    RadianceRecord mirrored = records[i];
    mirrored.pdf_w = 0;
    mirrored.found = 2;
    records.push_back(mirrored);
  }
  EXPECT_FALSE(RadianceGuide(std::move(records)).guides());
}

// The tree is built in the order of the records: the same records give the same guide.
TEST(RadianceGuide, IsAFunctionOfItsRecords) {
  const auto make = [] {
    return RadianceGuide(
        walks([](const Vec3f& p, const Vec3f& w) { return spot(p + Vec3f(0, 0, 1), w); }));
  };
  const RadianceGuide a = make(), b = make();
  EXPECT_EQ(a.bytes(), b.bytes());
  TestRandom random(5);
  for (int i = 0; i < 1000; ++i) {
    const Vec2f u = random.next2();
    const Vec3f w = square_to_cosine_hemisphere(random.next2());
    const Vec3f p(u.x, u.y, 0), n(0, 0, 1);
    if (a.at(p, n, false).empty()) continue;
    EXPECT_EQ(a.at(p, n, false).pdf_w(w), b.at(p, n, false).pdf_w(w));
  }
}

}  // namespace
}  // namespace nephroid

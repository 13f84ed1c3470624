// Targets of guided emission, made of useful starts: their positions, sizes and probabilities.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/warps.h"
#include "photon/emission_guide.h"
#include "unit/photon/useful_starts.h"

namespace nephroid {
namespace {

using testing_bsdf::TestRandom;
using testing_guide::add_cluster;
using testing_guide::scene_with;

const char* const kPoint = R"(LightSource "point" "rgb I" [2 3 4] "point3 from" [0.3 2.5 0])";

TEST(EmissionTargets, HasATargetAroundEachStart) {
  const auto scene = scene_with(kPoint);
  TestRandom random(7);
  // From a single cluster to many more clusters than targets.
  for (const int clusters : {1, 2, 30, 45, 200})
    for (const int each : {1, 7, 40}) {
      std::vector<UsefulStart> starts;
      for (int c = 0; c < clusters; ++c) {
        const Vec2f at = random.next2();
        add_cluster(starts, 0, {6 * at.x - 3, 0, 6 * at.y - 3}, 0.02f, each, random);
      }
      const EmissionGuide guide(*scene, starts, 1e9);
      ASSERT_GE(guide.targets().size(), 1u);
      ASSERT_LE(guide.targets().size(), static_cast<size_t>(EmissionGuide::kMaxTargets));
      for (const auto& target : guide.targets()) {
        EXPECT_GE(target.radius, 1e-4f * scene->sphere.radius);
        EXPECT_LE(target.radius, 1.6f * scene->sphere.radius);
      }
      // Wider targets, around several places, cover everything anyway.
      const auto places = guide.targets().first(guide.places());
      for (const UsefulStart& start : starts)
        EXPECT_TRUE(std::any_of(places.begin(), places.end(), [&](const EmissionGuide::Target& t) {
          return length(t.center - start.first_hit) <= t.radius * 1.001f;
        }));
    }
}

// Paths at the rim of a place, where no start was found, have bounded weights as well.
TEST(EmissionTargets, HasWiderBallsAroundTightOnes) {
  const auto scene = scene_with(kPoint);
  TestRandom random(9);
  std::vector<UsefulStart> starts;
  for (int i = 0; i < 2000; ++i) {
    const Vec2f at = square_to_disk(random.next2());
    starts.push_back({0, {0.1f * at.x, 0, 0.1f * at.y}, 1});
  }
  const EmissionGuide guide(*scene, starts, 1e7);
  ASSERT_GT(guide.places(), 1u);
  ASSERT_EQ(guide.targets().size(), 2 * guide.places() - 1);
  int aimed = 0, around = 0;
  for (int i = 0; i < 100000; ++i) {
    const auto choice = guide.choose(*scene, (static_cast<float>(i) + 0.5f) / 100000);
    aimed += choice->target >= 0;
    around += choice->target >= static_cast<int>(guide.places());
  }
  EXPECT_NEAR(static_cast<double>(around) / aimed, 0.125, 0.001);
  // Ten percent beyond the farthest start, in all directions.
  const Vec3f lamp(0.3f, 2.5f, 0);
  double inside = 0;
  for (int i = 0; i < 360; ++i) {
    const auto density = [&](float r) {
      const float phi = static_cast<float>(i) * kPi / 180;
      const Vec3f at(r * std::cos(phi), 0, r * std::sin(phi));
      return guide.density(*scene, 0, lamp, normalize(at - lamp), 1 / (4 * double{kPi}));
    };
    inside = std::max(inside, density(0.05f));
    EXPECT_GT(density(0.11f), density(3) * 20) << i;
  }
  EXPECT_GT(inside, 100 / (4 * double{kPi}));
}

TEST(EmissionTargets, GivesFewStartsAsMuchRoomAsTheyStandFor) {
  const Vec3f hit(0.3f, 0.5f, 0.0f);
  const auto radius = [&](const char* light, size_t count, float weight, double paths) {
    const auto scene = scene_with(light);
    const std::vector<UsefulStart> starts(count, {0, hit, weight});
    const EmissionGuide guide(*scene, starts, paths);
    EXPECT_EQ(guide.targets().size(), 1u);
    return static_cast<double>(guide.targets()[0].radius);
  };
  // A small ball of radius r at distance d covers r^2 / (4 d^2) of all directions.
  EXPECT_NEAR(radius(kPoint, 1, 1, 10000), 2 * 2.0 * 0.01, 1e-6);
  EXPECT_NEAR(radius(kPoint, 4, 1, 10000), 2 * 2.0 * 0.02, 1e-6);
  EXPECT_NEAR(radius(kPoint, 4, 0.25f, 10000), 2 * 2.0 * 0.01, 1e-6) << "a path that was aimed";
  EXPECT_NEAR(radius(kPoint, 64, 1, 640000), 2 * 2.0 * 0.01 / 8, 1e-6) << "so many know the place";
  const char* sky = R"(LightSource "infinite" "rgb L" [0.1 0.2 0.3])";
  const double scene_radius = static_cast<double>(scene_with(sky)->sphere.radius);
  EXPECT_NEAR(radius(sky, 1, 1, 10000), 0.01 * scene_radius, 1e-5);
}

TEST(EmissionTargets, GivesACrowdTargetsOfItsOwnWhateverLiesAround) {
  const auto scene = scene_with(kPoint);
  TestRandom random(8);
  std::vector<UsefulStart> starts;
  const Vec3f crowd(0.8f, 0, 0.5f);
  add_cluster(starts, 0, crowd, 0.05f, 500, random);
  add_cluster(starts, 0, {0, 0, 0}, 3, 24, random);
  const EmissionGuide guide(*scene, starts, 1e5);
  const auto small = [&](int target) {
    if (target < 0) return false;
    const EmissionGuide::Target& t = guide.targets()[static_cast<size_t>(target)];
    return length(t.center - crowd) < 0.05f && t.radius < 0.2f;
  };
  int aimed = 0, of_crowd = 0;
  for (int i = 0; i < 10000; ++i) {
    const auto choice = guide.choose(*scene, (static_cast<float>(i) + 0.5f) / 10000);
    aimed += choice->target >= 0;
    of_crowd += small(choice->target);
  }
  EXPECT_GT(of_crowd, 0.05 * aimed);
}

}  // namespace
}  // namespace nephroid

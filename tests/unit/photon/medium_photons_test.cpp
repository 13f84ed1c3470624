// Photons of media against brute force: every photon whose disc the ray crosses is found once, in
// the same order each time.
#include "photon/medium_photons.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/sampler.h"
#include "photon/photon_maps.h"
#include "unit/bsdf/statistics.h"

namespace nephroid {
namespace {

using testing_bsdf::TestRandom;

Vec3f point_in_unit_cube(TestRandom& random) {
  const float x = random.next(), y = random.next();
  return {x, y, random.next()};
}

/// Anywhere, in a tiny cluster, and many at the same place.
std::vector<Photon> scattered_photons(int count, const Vec3f& origin, float scale) {
  TestRandom random(17);
  std::vector<Photon> photons(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) {
    Vec3f p = point_in_unit_cube(random);
    if (i % 4 == 1) p = Vec3f(0.3f, 0.3f, 0.3f) + p * 0.001f;
    if (i % 4 == 2) p = Vec3f(0.6f, 0.5f, 0.4f);
    photons[i].p = origin + p * scale;
    photons[i].events = static_cast<uint16_t>(i);
    photons[i].medium = 0;
  }
  return photons;
}

void expect_same_as_brute_force(int count, const Vec3f& origin, float scale) {
  const std::vector<Photon> photons = scattered_photons(count, origin, scale);
  // Wider on one side.
  const auto radius_at = [&](const Vec3f& p) {
    return scale * (0.001f + 0.1f * std::max((p.x - origin.x) / scale, 0.0f));
  };
  const MediumPhotons map(photons, radius_at);
  TestRandom random(5);
  size_t all = 0;
  for (int q = 0; q < 200; ++q) {
    Ray ray;
    ray.o = origin + (point_in_unit_cube(random) * 1.6f - Vec3f(0.3f)) * scale;
    ray.d = normalize(point_in_unit_cube(random) - Vec3f(0.5f));
    if (q % 5 == 0) ray.d = Vec3f(0, q % 10 == 0 ? 1.0f : -1.0f, 0);
    const float t_max = q % 3 == 0 ? kInfinity : 0.5f * scale;
    std::vector<int> expected, found, again;
    for (const Photon& photon : photons) {
      const Vec3f way = photon.p - ray.o;
      const float t = dot(way, ray.d);
      if (t > 0 && t < t_max && length_squared(way - ray.d * t) < sqr(radius_at(photon.p)))
        expected.push_back(photon.events);
    }
    map.query(ray, t_max, [&](const Photon& photon, float t, float d2, float radius) {
      found.push_back(photon.events);
      EXPECT_EQ(radius, radius_at(photon.p));
      EXPECT_LT(d2, sqr(radius));
      EXPECT_TRUE(t > 0 && t < t_max);
    });
    map.query(ray, t_max,
              [&](const Photon& photon, float, float, float) { again.push_back(photon.events); });
    EXPECT_EQ(found, again);
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, expected) << "ray " << q << " of " << count;
    all += found.size();
  }
  if (count > 100) {
    EXPECT_GT(all, 50u);
  }
}

TEST(MediumPhotons, AreThoseOfBruteForce) {
  for (const int count : {0, 1, 2, 5, 40, 3000})
    expect_same_as_brute_force(count, Vec3f(0, 0, 0), 1);
  expect_same_as_brute_force(500, Vec3f(100, -30, 7), 0.2f);
  expect_same_as_brute_force(500, Vec3f(0, 0, 0), 1e6f);
}

TEST(PhotonMaps, DividePhotonsAndKnowTheirPlaces) {
  std::vector<Photon> photons = scattered_photons(300, Vec3f(0, 0, 0), 1);
  for (size_t i = 0; i < photons.size(); i += 3) photons[i].medium = -1;
  const PhotonMaps maps(
      photons, [](const Vec3f&) { return 0.1f; }, true);
  EXPECT_EQ(maps.surfaces().size(), 100u);
  EXPECT_EQ(maps.media().photons().size(), 200u);
  for (const auto* some : {&maps.surfaces().photons(), &maps.media().photons()})
    for (const Photon& photon : *some) {
      EXPECT_EQ(photons[maps.place_of(photon)].events, photon.events);
      EXPECT_EQ(photons[maps.place_of(photon)].p, photon.p);
    }
}

}  // namespace
}  // namespace nephroid

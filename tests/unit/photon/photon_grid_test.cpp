// The photon grid against brute force: every photon in range found once, none lost, whatever the
// scale, the position and the number of levels.
#include "photon/photon_grid.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/sampler.h"

namespace nephroid {
namespace {

struct Numbers {
  uint64_t state;
  float operator()() {
    return bits_to_unit_float(
        static_cast<uint32_t>(mix_bits(++state * 0x9e3779b97f4a7c15ull) >> 32));
  }
};

// Half of the photons lie on a plane, a quarter in a tiny cluster, the rest anywhere.
std::vector<Photon> make_photons(int count, const Vec3f& origin, float scale, uint64_t seed) {
  Numbers u{seed * 1000003};
  std::vector<Photon> photons(static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) {
    Vec3f p(u(), u(), u());
    if (i % 2 == 0) p.z = 0.5f;
    if (i % 4 == 1) p = Vec3f(0.3f, 0.3f, 0.3f) + p * 0.001f;
    photons[static_cast<size_t>(i)].p = origin + p * scale;
    photons[static_cast<size_t>(i)].events = static_cast<uint16_t>(i);
  }
  return photons;
}

void compare(int count, const Vec3f& origin, float scale, int levels) {
  const std::vector<Photon> photons = make_photons(count, origin, scale, 17);
  const PhotonGrid grid(photons, levels);
  ASSERT_EQ(grid.size(), photons.size());
  Numbers u{99};
  for (int q = 0; q < 200; ++q) {
    // Some queries sit exactly on a photon, some outside of the box.
    Vec3f c = origin + Vec3f(u(), u(), u()) * (1.4f * scale) - Vec3f(0.2f * scale);
    if (q % 3 == 0) c = photons[static_cast<size_t>(u() * static_cast<float>(count))].p;
    const float r = scale * std::pow(10.0f, -4.0f + 4.3f * u());
    std::vector<int> expected, found;
    for (const Photon& p : photons) {
      const Vec3f d = p.p - c;
      if (dot(d, d) <= r * r) expected.push_back(p.events);
    }
    grid.query(c, r, [&](const Photon& p, float d2) {
      found.push_back(p.events);
      EXPECT_LE(d2, r * r);
    });
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, expected) << "query " << q << " radius " << r;
  }
}

TEST(PhotonGrid, FindsWhatBruteForceFinds) {
  compare(5000, Vec3f(0, 0, 0), 1.0f, 64);
}
TEST(PhotonGrid, OneLevelOnly) {
  compare(3000, Vec3f(-3, 2, 1), 1.0f, 1);
}
TEST(PhotonGrid, TwoLevels) {
  compare(3000, Vec3f(-3, 2, 1), 1.0f, 2);
}
TEST(PhotonGrid, TinyScene) {
  compare(2000, Vec3f(1e-3f, 0, 0), 1e-4f, 64);
}
TEST(PhotonGrid, HugeScene) {
  compare(2000, Vec3f(5e3f, -1e4f, 0), 1e4f, 64);
}
TEST(PhotonGrid, FarFromTheOrigin) {
  compare(2000, Vec3f(1000, 1000, 1000), 1.0f, 64);
}
TEST(PhotonGrid, FewPhotons) {
  for (const int n : {1, 2, 3, 7}) compare(n, Vec3f(0, 0, 0), 1.0f, 64);
}

TEST(PhotonGrid, AllPhotonsInOnePoint) {
  std::vector<Photon> photons(100);
  for (Photon& p : photons) p.p = Vec3f(5, -7, 11);
  const PhotonGrid grid(photons);
  int found = 0;
  grid.query(Vec3f(5, -7, 11), 1e-3f, [&](const Photon&, float) { ++found; });
  EXPECT_EQ(found, 100);
  grid.query(Vec3f(5, -7, 12), 1e-3f, [&](const Photon&, float) { ADD_FAILURE(); });
}

TEST(PhotonGrid, Empty) {
  const PhotonGrid grid({});
  grid.query(Vec3f(0, 0, 0), 1.0f, [&](const Photon&, float) { ADD_FAILURE(); });
}

TEST(PhotonGrid, OrderOfPhotonsInACellIsKept) {
  std::vector<Photon> photons(50);
  for (size_t i = 0; i < photons.size(); ++i) {
    photons[i].p = Vec3f(1, 1, 1);
    photons[i].events = static_cast<uint16_t>(i);
  }
  photons.push_back({});
  const PhotonGrid grid(photons);
  int next = 0;
  grid.query(Vec3f(1, 1, 1), 0.1f, [&](const Photon& p, float) { EXPECT_EQ(p.events, next++); });
  EXPECT_EQ(next, 50);
}

}  // namespace
}  // namespace nephroid

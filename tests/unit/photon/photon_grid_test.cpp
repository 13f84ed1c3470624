// The photon grid against brute force: every photon in range is found once, at any scale and
// position.
#include "photon/photon_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

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

// Half of the photons are on a plane, a quarter in a tiny cluster, the rest anywhere.
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

void compare(int count, const Vec3f& origin, float scale) {
  const std::vector<Photon> photons = make_photons(count, origin, scale, 17);
  const PhotonGrid grid(photons);
  ASSERT_EQ(grid.size(), photons.size());
  Numbers u{99};
  for (int q = 0; q < 200; ++q) {
    // Some queries are exactly on a photon, some outside the box.
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
  compare(5000, Vec3f(0, 0, 0), 1.0f);
  compare(3000, Vec3f(-3, 2, 1), 1.0f);
}
// If rounding of a query's ends exceeds the slack of its cells, it may span three.
TEST(PhotonGrid, EndsOfQueriesThatAreRounded) {
  constexpr float kUnit = 0x1p-23f;  // the spacing of floats above 1
  std::vector<Photon> photons(220);
  for (size_t i = 0; i < photons.size(); ++i)
    photons[i].p = Vec3f(1 + static_cast<float>(i / 10) * kUnit, 0, 0);
  const PhotonGrid grid(photons);
  for (int place = 0; place < 22; ++place)
    for (int tenths = 1; tenths < 200; ++tenths) {
      const Vec3f c(1 + static_cast<float>(place) * kUnit, 0, 0);
      const float radius = 0.1f * static_cast<float>(tenths) * kUnit;
      size_t expected = 0, found = 0;
      for (const Photon& p : photons) {
        const Vec3f d = p.p - c;
        expected += dot(d, d) <= radius * radius;
      }
      grid.query(c, radius, [&](const Photon&, float) { ++found; });
      ASSERT_EQ(found, expected) << place << " radius " << radius;
    }
}
// Photons, centres and rims of queries on cell boundaries of every size.
TEST(PhotonGrid, BoundariesOfCells) {
  constexpr int kSide = 16;
  std::vector<Photon> photons(kSide * kSide * kSide + 1);
  for (size_t i = 0; i < photons.size(); ++i) photons[i].events = static_cast<uint16_t>(i);
  for (size_t i = 0; i + 1 < photons.size(); ++i)
    photons[i].p = Vec3f(static_cast<float>(i % kSide), static_cast<float>(i / kSide % kSide),
                         static_cast<float>(i / kSide / kSide));
  // This photon makes the box exactly as many quanta wide as exist.
  photons.back().p = Vec3f(static_cast<float>((1 << PhotonGrid::kCoordinateBits) - 1) / 65536);
  const PhotonGrid grid(photons);
  for (const float radius : {0.0f, 1.0f, 1.5f, 2.0f, 3.0f, 4.0f, 8.0f})
    for (size_t i = 0; i < photons.size(); i += 7) {
      const Vec3f c = photons[i].p + Vec3f(i % 2 == 0 ? 0.0f : 0.5f, 0, 0);
      std::vector<int> expected, found;
      for (const Photon& p : photons) {
        const Vec3f d = p.p - c;
        if (dot(d, d) <= radius * radius) expected.push_back(p.events);
      }
      grid.query(c, radius, [&](const Photon& p, float) { found.push_back(p.events); });
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, expected) << "photon " << i << " radius " << radius;
    }
}
TEST(PhotonGrid, TinyScene) {
  compare(2000, Vec3f(1e-3f, 0, 0), 1e-4f);
}
TEST(PhotonGrid, HugeScene) {
  compare(2000, Vec3f(5e3f, -1e4f, 0), 1e4f);
}
TEST(PhotonGrid, FarFromTheOrigin) {
  compare(2000, Vec3f(1000, 1000, 1000), 1.0f);
}
TEST(PhotonGrid, FewPhotons) {
  for (const int n : {1, 2, 3, 7}) compare(n, Vec3f(0, 0, 0), 1.0f);
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

TEST(PhotonGrid, SortsAsAStableSortOfCellsDoes) {
  // For positions on a line, cells are ordered along it.
  std::vector<Photon> photons(1000);
  for (size_t i = 0; i < photons.size(); ++i) {
    photons[i].p = Vec3f(static_cast<float>(i * 7919 % 37), 2, 3);
    photons[i].events = static_cast<uint16_t>(i);
  }
  std::vector<size_t> order(photons.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return photons[a].p.x < photons[b].p.x; });
  const PhotonGrid grid(photons);
  ASSERT_EQ(grid.size(), order.size());
  for (size_t i = 0; i < order.size(); ++i) {
    EXPECT_EQ(grid.photons()[i].events, photons[order[i]].events) << i;
    EXPECT_EQ(grid.photons()[i].p, photons[order[i]].p) << i;
  }
}

TEST(PhotonGrid, SaysWhatItTakes) {
  EXPECT_EQ(PhotonGrid({}).bytes(), 0u);
  std::vector<Photon> photons(4096);
  for (size_t i = 0; i < photons.size(); ++i)
    photons[i].p = Vec3f(static_cast<float>(i % 64), static_cast<float>(i / 64), 0);
  photons.shrink_to_fit();
  const double of_each =
      static_cast<double>(PhotonGrid(photons).bytes()) / static_cast<double>(photons.size());
  EXPECT_GE(of_each, sizeof(Photon) + 36.0) << "the sort, which is over when the cells are made";
  EXPECT_LE(of_each, sizeof(Photon) + 20.0 + 64.0);
}

// The nearest photons by sorting all of them. Of two at the same distance, the first one counts.
std::vector<PhotonGrid::Neighbour> nearest_of_all(const PhotonGrid& grid, const Vec3f& c,
                                                  float radius, size_t wanted, int every) {
  std::vector<PhotonGrid::Neighbour> all;
  for (uint32_t i = 0; i < grid.size(); ++i) {
    const Vec3f d = grid.photons()[i].p - c;
    if (dot(d, d) <= radius * radius && grid.photons()[i].events % every == 0)
      all.push_back({dot(d, d), i});
  }
  std::sort(all.begin(), all.end());
  all.resize(std::min(all.size(), wanted));
  return all;
}

TEST(PhotonGrid, NearestAreThoseOfBruteForce) {
  const Vec3f origin(2, -1, 0.5f);
  std::vector<Photon> photons = make_photons(3000, origin, 2, 5);
  for (size_t i = 0; i < 200; ++i) photons[i].p = photons[200 + i].p;  // pairs at the same position
  const PhotonGrid grid(photons);
  Numbers u{7};
  std::vector<PhotonGrid::Neighbour> found;
  int full = 0, cut = 0;
  for (int q = 0; q < 300; ++q) {
    Vec3f c = origin + Vec3f(u(), u(), u()) * 2.4f - Vec3f(0.2f);
    if (q % 3 == 0) c = photons[static_cast<size_t>(u() * 3000)].p;
    const float radius = 2 * std::pow(10.0f, -3.0f + 3.3f * u());
    const size_t wanted = 1 + static_cast<size_t>(u() * 120);
    const int every = 1 + q % 4;  // only every such photon counts
    grid.nearest(
        c, radius, wanted, [&](const Photon& p) { return p.events % every == 0; }, found);
    ASSERT_EQ(found, nearest_of_all(grid, c, radius, wanted, every)) << "query " << q;
    ++(found.size() == wanted ? full : cut);
  }
  EXPECT_GT(full, 50);
  EXPECT_GT(cut, 50);
}

TEST(PhotonGrid, NearestOfNothing) {
  std::vector<PhotonGrid::Neighbour> found(3);
  const auto all = [](const Photon&) { return true; };
  PhotonGrid({}).nearest(Vec3f(0, 0, 0), 1, 5, all, found);
  EXPECT_TRUE(found.empty());
  const PhotonGrid grid(make_photons(10, Vec3f(0, 0, 0), 1, 1));
  grid.nearest(Vec3f(0, 0, 0), 0, 5, all, found);
  EXPECT_TRUE(found.empty());
  grid.nearest(Vec3f(0, 0, 0), 100, 50, all, found);
  EXPECT_EQ(found.size(), 10u);
}

}  // namespace
}  // namespace nephroid

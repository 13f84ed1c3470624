// Wavelengths and time of a pass: in any sixteen passes from a multiple of sixteen on, each quarter
// of the spectrum meets each quarter of the time.
#include "integrator/photons/photon_pass.h"

#include <gtest/gtest.h>

#include <set>

#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

TEST(PhotonPass, HasAllWavelengthsAtAllTimes) {
  constexpr uint32_t kPasses = 16;
  const auto scene = scene_from_text(R"(Film "rgb" "integer xresolution" 4 "integer yresolution" 4
    WorldBegin LightSource "point" Shape "sphere")");
  const EstimatorSet set = make_estimators(Plan("sppm"), {}, *scene);
  const Film film = film_for(*scene, set);
  for (const uint64_t seed : {1, 2, 3})
    for (const uint32_t first : {0u, 16u, 1600u}) {
      std::vector<std::pair<float, float>> moments;  // the first wavelength grows with its number
      for (uint32_t i = 0; i < kPasses; ++i) {
        const PhotonPass pass = start_photon_pass({seed, first + i}, *scene, film.format(), {});
        moments.emplace_back(pass.trace.lambda.lambda(0), pass.u_time);
      }
      std::sort(moments.begin(), moments.end());
      std::set<std::pair<uint32_t, int>> cells;
      for (uint32_t i = 0; i < kPasses; ++i)
        cells.emplace(i / 4, static_cast<int>(4 * moments[i].second));
      EXPECT_EQ(cells.size(), kPasses) << "seed " << seed << ", passes from " << first;
    }
}

// [P5]: without dispersion, colour depends on the positions of wavelengths in their intervals;
// behind a prism it depends on the heroes.
TEST(WavelengthsOfPass, PlacesAreEvenlySpacedAndHeroesInAllIntervals) {
  for (const uint64_t seed : {1, 2, 3})
    for (const uint32_t count : {2u, 4u, 8u, 16u, 64u, 256u})
      for (const uint32_t block : {0u, 1u, 5u, 77u}) {
        SCOPED_TRACE(::testing::Message() << count << " passes from " << block * count);
        std::vector<double> places;
        std::set<int> intervals;
        for (uint32_t pass = block * count; pass < (block + 1) * count; ++pass) {
          const double hero = double{wavelengths_and_time_of_pass({seed, pass}).x};
          const double place = hero * kSpectrumSamples;
          places.push_back(place - std::floor(place));
          intervals.insert(static_cast<int>(hero * count));
        }
        EXPECT_EQ(intervals.size(), count);
        std::ranges::sort(places);
        for (size_t i = 1; i < places.size(); ++i)
          EXPECT_NEAR(places[i] - places[i - 1], 1.0 / count, 1e-5);
      }
}

TEST(WavelengthsOfPass, HasNoPlaceThatItPrefers) {
  double sum = 0;
  for (uint64_t seed = 0; seed < 1000; ++seed)
    sum += double{wavelengths_and_time_of_pass({seed, 3}).x};
  EXPECT_NEAR(sum / 1000, 0.5, 0.04);
}

}  // namespace
}  // namespace nephroid

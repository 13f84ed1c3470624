// What estimators learn is all that their passes depend on beside scene, options and pass key: a
// value that was written and read again, and another estimator of the same plan, give the same
// bits.
#include <gtest/gtest.h>

#include "determinism/scene_of_all_kinds.h"
#include "integrator/photon_mapping/photon_map.h"
#include "rendering.h"
#include "same_bits.h"
#include "session/checkpoint/checkpoint.h"

namespace nephroid {
namespace {

using namespace testing_support;

class LearnedBits : public ::testing::TestWithParam<std::string> {};

/// The value after its bytes have been through a file.
std::shared_ptr<const Learned> copied(const Estimator& estimator, const FilmFormat& format,
                                      const std::shared_ptr<const Learned>& value) {
  if (!value) return nullptr;
  ByteWriter written, again;
  value->write(written);
  ByteReader reader(written.bytes());
  const auto copy = estimator.read_learned(reader, format);
  EXPECT_TRUE(reader.at_end());
  copy->write(again);
  EXPECT_EQ(written.bytes(), again.bytes());
  return copy;
}

TEST_P(LearnedBits, AValueThatWasWrittenAndReadGivesTheSamePasses) {
  const auto scene = scene_from_text(kScene);
  IntegratorOptions options;
  options.edit<PhotonMapOptions>().map_photons = 1 << 14;
  EstimatorSet whole = make_estimators(plan_named(GetParam()), options, *scene),
               from_values = make_estimators(plan_named(GetParam()), options, *scene);
  Film expected = film_for(*scene, whole), found = film_for(*scene, from_values);
  for (const uint32_t pass : {0u, 1u}) whole.render_pass({5, pass}, *scene, expected);
  const FilmFormat& format = expected.format();
  for (size_t i = 0; i < whole.estimators.size(); ++i) {
    const Estimator& estimator = *whole.estimators[i];
    const auto& value = whole.learned[i].learn(estimator, 5, *scene, format);
    from_values.learned.emplace_back().use(copied(estimator, format, value));
  }
  for (const uint32_t pass : {0u, 1u}) from_values.render_pass({5, pass}, *scene, found);
  expect_same_bits(found, expected, GetParam());
}

TEST_P(LearnedBits, BytesThatAreCutOffAreRefused) {
  const auto scene = scene_from_text(kScene);
  IntegratorOptions options;
  options.edit<PhotonMapOptions>().map_photons = 1 << 12;
  EstimatorSet set = make_estimators(plan_named(GetParam()), options, *scene);
  const Film film = film_for(*scene, set);
  set.learned.resize(set.estimators.size());
  for (size_t i = 0; i < set.estimators.size(); ++i) {
    const Estimator& estimator = *set.estimators[i];
    const auto value = estimator.learn(*scene, film.format(), 5, unwatched);
    if (!value) continue;
    ByteWriter written;
    value->write(written);
    const std::span<const std::byte> bytes(written.bytes());
    for (size_t kept = 0; kept < bytes.size(); kept += 1 + bytes.size() / 50) {
      ByteReader reader(bytes.first(kept));
      EXPECT_THROW(estimator.read_learned(reader, film.format()), IoError) << kept;
    }
  }
}

TEST_P(LearnedBits, AStateHoldsWhatIsLearnedAndNothingIsLearnedAgain) {
  const auto scene = scene_from_text(kScene);
  IntegratorOptions options;
  options.edit<PhotonMapOptions>().map_photons = 1 << 12;
  EstimatorSet set = make_estimators(plan_named(GetParam()), options, *scene),
               other = make_estimators(plan_named(GetParam()), options, *scene);
  Film film = film_for(*scene, set), of_other = film_for(*scene, other);
  set.render_pass({5, 0}, *scene, film);
  const RenderState state = state_of(*scene, set, film), to = state_of(*scene, other, of_other);
  for (size_t i = 0; i < state.streams.size(); ++i) {
    if (!state.streams[i].is_optional()) continue;
    const std::vector<uint32_t> words = state.streams[i].save();
    to.streams[i].load(words);
    EXPECT_EQ(to.streams[i].save(), words);
    if (words.empty()) continue;
    for (const size_t kept : {size_t{1}, words.size() / 2, words.size() - 1})
      EXPECT_THROW(to.streams[i].load(std::span(words).first(kept)), IoError) << kept;
    to.streams[i].load(words);
  }
  set.render_pass({5, 1}, *scene, film);
  other.render_pass({5, 1}, *scene, of_other);
  for (size_t i = 0; i < set.estimators.size(); ++i) {
    if (set.estimators[i]->descriptor().capabilities.learned_is_light) continue;
    EXPECT_EQ(set.learned[i].learn(*set.estimators[i], 5, *scene, film.format()) == nullptr,
              other.learned[i].learn(*other.estimators[i], 5, *scene, film.format()) == nullptr);
    EXPECT_EQ(other.statistics()[i].learning_rays, 0u) << "learned again";
  }
}

INSTANTIATE_TEST_SUITE_P(Plans, LearnedBits, ::testing::ValuesIn(plan_names()),
                         [](const auto& test) { return test_name(test.param); });

}  // namespace
}  // namespace nephroid

// Passes depend only on scene, options, pass key and learned values: a value written and read
// again, or another estimator of the same plan, gives the same bits.
#include <gtest/gtest.h>

#include "determinism/scene_of_all_kinds.h"
#include "integrator/metropolis/metropolis_options.h"
#include "integrator/photon_mapping/photon_map.h"
#include "rendering.h"
#include "same_bits.h"
#include "session/checkpoint/checkpoint.h"

namespace nephroid {
namespace {

using namespace testing_support;

class LearnedBits : public ::testing::TestWithParam<std::string> {};

/// The value after serialization.
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

/// Reads the bytes and uses them for a pass. False if they are refused.
bool can_be_used(EstimatorSet& set, size_t number, std::span<const std::byte> bytes,
                 const Scene& scene, Film& film) {
  Estimator& estimator = *set.estimators[number];
  ByteReader reader(bytes);
  try {
    const auto value = estimator.read_learned(reader, film.format());
    estimator.render_pass({5, 0}, value.get(), scene, film, unwatched);
    EstimatorStatistics statistics;
    value->add_to(statistics);
  } catch (const IoError&) {
    return false;
  }
  return true;
}

TEST_P(LearnedBits, BytesThatAreDamagedAreRefusedOrDoNoHarm) {
  std::string text = kScene;
  const std::string size = "xresolution\" 24 \"integer yresolution\" 20";
  text.replace(text.find(size), size.size(), "xresolution\" 6 \"integer yresolution\" 5");
  const auto scene = scene_from_text(text);
  IntegratorOptions options;
  // Few photons, except where their number is learned.
  options.photons_per_pass = GetParam() == "mixed" ? 0 : 1 << 12;
  options.edit<MetropolisOptions>().mutations = 1;
  EstimatorSet set = make_estimators(plan_named(GetParam()), options, *scene);
  Film film = film_for(*scene, set);
  for (size_t i = 0; i < set.estimators.size(); ++i) {
    if (set.estimators[i]->descriptor().capabilities.learned_is_light) continue;
    const auto value = set.estimators[i]->learn(*scene, film.format(), 5, unwatched);
    if (!value) continue;
    ByteWriter written;
    value->write(written);
    EXPECT_TRUE(can_be_used(set, i, written.bytes(), *scene, film));
    for (size_t at = 0; at < written.bytes().size(); at += 1 + written.bytes().size() / 60)
      for (const std::byte damage : {std::byte{0xff}, std::byte{0}}) {
        std::vector<std::byte> bytes = written.bytes();
        bytes[at] = damage;
        can_be_used(set, i, bytes, *scene, film);
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
    ASSERT_FALSE(words.empty());
    if (words.size() == 1) continue;  // there is nothing to learn
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

// Every feature of the scene format still looks as it did. Each tiny scene of the folder "features"
// is rendered with several seeds. Pixels and the whole picture are compared with the stored mean of
// many more seeds, at exact levels, so that red means changed. tools/update_regression writes what
// is stored.
#include <gtest/gtest.h>

#include <boost/math/distributions/students_t.hpp>
#include <fstream>
#include <sstream>

#include "regression/feature_scene.h"

namespace nephroid {
namespace {

using namespace testing_support;

/// A correct picture is rejected for one in ten thousand choices of the seeds.
constexpr double kFalseAlarm = 1e-4;
constexpr int kSeeds = 12;

/// Statistics of a number over independent renders.
struct Measured {
  double mean = 0;
  double variance = 0;  ///< variance of the mean
  int seeds = 0;
};

Measured measured(const std::vector<double>& values) {
  const Estimate e = estimate_of(values);
  return {e.mean, e.error * e.error, static_cast<int>(values.size())};
}

/// Probability that the means of two measurements of one number are so far apart: Welch's t.
double probability(const Measured& a, const Measured& b) {
  const double variance = a.variance + b.variance, distance = std::abs(a.mean - b.mean);
  // Without noise only rounding remains.
  if (distance <= 1e-5 * (1e-3 + std::abs(b.mean))) return 1;
  if (!(variance > 0)) return 0;
  const auto square = [](double x) { return x * x; };
  const double freedom =
      square(variance) / (square(a.variance) / (a.seeds - 1) + square(b.variance) / (b.seeds - 1));
  const boost::math::students_t t(freedom);
  return 2 * boost::math::cdf(boost::math::complement(t, distance / std::sqrt(variance)));
}

/// Level of each of `count` tests, so that all pass with the wanted probability (Sidak).
double level_of(size_t count) {
  return -std::expm1(std::log1p(-kFalseAlarm) / static_cast<double>(count));
}

/// The stored picture of a scene.
class Reference {
 public:
  explicit Reference(const std::string& name)
      : picture_(read_picture(kFeatureFolder + name + ".exr")) {
    seeds_ = static_cast<int>(numbers("seeds").at(0));
    passes_ = static_cast<uint32_t>(numbers("passes").at(0));
    for (const std::string& channel : picture_.channels)
      if (channel.starts_with("mean.")) channels_.push_back(channel.substr(5));
  }

  uint32_t passes() const { return passes_; }  ///< passes of each seed
  const std::vector<std::string>& channels() const { return channels_; }
  int width() const { return picture_.width(); }
  int height() const { return picture_.height(); }

  Measured pixel(const std::string& channel, size_t index) const {
    const auto value = [&](const std::string& layer) {
      const auto c = static_cast<size_t>(picture_.find_channel(layer + "." + channel));
      return static_cast<double>(picture_.pixels[index * picture_.channels.size() + c]);
    };
    return {value("mean"), value("variance"), seeds_};
  }
  /// The mean of channel R, G or B over the whole picture.
  Measured whole(size_t channel) const {
    return {numbers("picture_mean").at(channel), numbers("picture_variance").at(channel), seeds_};
  }

 private:
  std::vector<double> numbers(const std::string& key) const {
    for (const auto& [name, text] : picture_.metadata)
      if (name == key) {
        std::istringstream in(text);
        return {std::istream_iterator<double>(in), {}};
      }
    throw IoError("the stored picture has no attribute " + key);
  }

  Picture picture_;
  std::vector<std::string> channels_;
  int seeds_ = 0;
  uint32_t passes_ = 0;
};

/// Compares a channel pixel by pixel with what is stored and reports the worst difference.
void expect_same_pixels(const SeedValues& found, const Reference& reference,
                        const std::string& channel) {
  const double level = level_of(found.size() * reference.channels().size());
  size_t worst = 0, different = 0;
  double least = 1;
  for (size_t i = 0; i < found.size(); ++i) {
    const Measured stored = reference.pixel(channel, i);
    Measured now = measured(found[i]);
    // Few seeds may all miss rare light. The stored variance is a lower limit for theirs.
    const double usual = stored.variance * stored.seeds / now.seeds;
    if (usual > now.variance) now = {now.mean, usual, stored.seeds};
    const double p = probability(now, stored);
    if (p < level) ++different;
    if (p < least) {
      least = p;
      worst = i;
    }
  }
  const auto width = static_cast<size_t>(reference.width());
  EXPECT_EQ(different, 0u) << "pixels of " << channel << " differ, most of all x " << worst % width
                           << ", y " << worst / width << ": " << measured(found[worst]).mean
                           << " against " << reference.pixel(channel, worst).mean;
}

class Feature : public ::testing::TestWithParam<std::string> {};

TEST_P(Feature, LooksAsStoredWithPath) {
  const Reference reference(GetParam());
  const auto scene = load_feature(GetParam());
  std::vector<Picture> pictures;
  for (uint64_t seed = 1; seed <= kSeeds; ++seed)
    pictures.push_back(feature_picture(*scene, seed, reference.passes()));
  ASSERT_EQ(pictures[0].width(), reference.width());
  ASSERT_EQ(pictures[0].height(), reference.height());
  for (const std::string& channel : reference.channels())
    expect_same_pixels(channel_values(pictures, channel), reference, channel);
  for (size_t c = 0; c < 3; ++c) {
    const SeedValues pixels = channel_values(pictures, std::string(1, "RGB"[c]));
    const Measured now = measured(picture_means(pixels)), stored = reference.whole(c);
    EXPECT_GT(probability(now, stored), level_of(3))
        << "mean of "
        << "RGB"[c] << ": " << now.mean << " against " << stored.mean;
    EXPECT_LT(std::sqrt(now.variance), 0.02 * now.mean) << "too noisy to tell";
  }
}

// Photons blur pixels, not the picture: compares the mean of the three channels, extrapolated to a
// radius of zero.
TEST_P(Feature, HasTheStoredMeanWithMixed) {
  const auto scene = load_feature(GetParam());
  if (!scene->media.empty()) return;  // caustics inside media are not photons'
  const Reference reference(GetParam());
  IntegratorOptions options = feature_options(*scene, "mixed");
  options.radius = 1;
  options.camera_samples_per_pass = 8;
  options.photons_per_pass = 4096;
  const Measured now = measured(unbiased_block_values(*scene, "mixed", options, kSeeds, 4, 1)[0]);
  Measured stored{0, 0, reference.whole(0).seeds};
  for (size_t c = 0; c < 3; ++c) {
    stored.mean += reference.whole(c).mean / 3;
    // The channels are correlated: the mean's deviation is at most their mean deviation.
    stored.variance += std::sqrt(reference.whole(c).variance) / 3;
  }
  stored.variance *= stored.variance;
  EXPECT_GT(probability(now, stored), kFalseAlarm)
      << "mean: " << now.mean << " against " << stored.mean << " +- " << std::sqrt(now.variance);
  EXPECT_LT(std::sqrt(now.variance), 0.02 * now.mean) << "too noisy to tell";
}

TEST(GltfExtensions, HaveASceneEach) {
  const std::vector<std::string> names = feature_names();
  for (const gltf::Feature& extension : gltf::extension_table()) {
    if (extension.support == gltf::FeatureSupport::kIgnored) continue;
    ASSERT_TRUE(std::binary_search(names.begin(), names.end(), extension.name)) << extension.name;
    std::ifstream file(feature_file(extension.name), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_NE(text.find(std::string("\"") + extension.name), std::string::npos) << extension.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Feature, ::testing::ValuesIn(feature_names()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace nephroid

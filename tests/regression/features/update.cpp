// Writes SCENE.exr, which feature_test.cpp compares with, for each scene named on the command line:
// channel means over many seeds and their variances. Metadata hold the number of seeds, their
// passes, and mean and variance of the whole picture's colours. tools/update_regression runs it. It
// must not know the test's seeds except that they are small.
#include <cstdio>

#include "film/exr_file.h"
#include "regression/feature_scene.h"

namespace {

using namespace nephroid;
using namespace nephroid::testing_support;

constexpr int kSeeds = 96;
constexpr uint32_t kPasses = 48;
constexpr uint64_t kFirstSeed = 1000000;

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g ", value);
  return text;
}

void update(const std::string& name) {
  const auto scene = load_feature(name);
  std::vector<Picture> pictures;
  for (uint64_t seed = kFirstSeed; seed < kFirstSeed + kSeeds; ++seed)
    pictures.push_back(feature_picture(*scene, seed, kPasses));
  Picture out;
  out.full_width = pictures[0].full_width;
  out.full_height = pictures[0].full_height;
  out.window = pictures[0].window;
  std::string means, variances;
  std::vector<std::vector<Estimate>> layers;
  for (const std::string& channel : compared_channels(pictures[0])) {
    const SeedValues pixels = channel_values(pictures, channel);
    std::vector<Estimate> estimates;
    for (const auto& values : pixels) estimates.push_back(estimate_of(values));
    layers.push_back(std::move(estimates));
    out.channels.insert(out.channels.end(), {"mean." + channel, "variance." + channel});
    if (channel != "R" && channel != "G" && channel != "B") continue;
    const Estimate whole = estimate_of(picture_means(pixels));
    means += text_of(whole.mean);
    variances += text_of(whole.error * whole.error);
  }
  for (size_t i = 0; i < layers[0].size(); ++i)
    for (const auto& layer : layers) {
      out.pixels.push_back(static_cast<float>(layer[i].mean));
      out.pixels.push_back(static_cast<float>(layer[i].error * layer[i].error));
    }
  out.metadata = {{"seeds", std::to_string(kSeeds)},
                  {"passes", std::to_string(kPasses)},
                  {"picture_mean", means},
                  {"picture_variance", variances}};
  write_exr(kFeatureFolder + name + ".exr", out);
  std::printf("%s: %s\n", name.c_str(), means.c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** arguments) {
  try {
    for (int i = 1; i < count; ++i) update(arguments[i]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

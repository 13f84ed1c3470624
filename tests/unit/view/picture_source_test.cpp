// A picture file as what the page shows.
#include "view/picture_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/errors.h"
#include "film/atomic_file.h"
#include "film/metadata_keys.h"
#include "unit/view/decoded_frame.h"
#include "unit/view/small_exr.h"
#include "view/answers.h"
#include "view/temporary_directory.h"

namespace nephroid {
namespace {

using testing_support::decode;
using testing_support::DecodedFrame;
using testing_support::small_picture;
using testing_support::write_small_exr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinite = std::numeric_limits<float>::infinity();

const std::vector<std::string> kChannels = {
    "R",   "G", "B",        "caustic.R", "caustic.G", "caustic.B", "N.X",    "N.Y",
    "N.Z", "Z", "stderr.R", "stderr.G",  "stderr.B",  "bias.Y",    "samples"};

class PictureView : public ::testing::Test {
 protected:
  /// The view of a picture; one at a time.
  PictureSource& view_of(const Picture& picture) {
    write_small_exr(path_, picture);
    source_.emplace(path_);
    return *source_;
  }
  Answers& answers_of(const Picture& picture) {
    answers_.emplace(view_of(picture), comparisons_, "");
    return *answers_;
  }

  TemporaryDirectory directory_;
  std::string path_ = directory_.file("cup.exr");
  std::optional<PictureSource> source_;
  Comparisons comparisons_;
  std::optional<Answers> answers_;
};

float first_of(PictureSource& source, const std::string& layer, size_t value = 0) {
  const DecodedFrame frame = decode(*source.frame({layer}, 0, 0));
  return frame.values.at(value) * frame.header["layers"][0]["scale"].get<float>();
}

float pixel_of(const Picture& picture, const std::string& channel, size_t pixel) {
  return picture.pixels.at(pixel * picture.channels.size() +
                           static_cast<size_t>(picture.find_channel(channel)));
}

TEST_F(PictureView, SaysWhatTheFileHolds) {
  Picture picture = small_picture(kChannels);
  picture.metadata = {{kIntegratorKey, "mixed"}, {kChoicesKey, "one line\nanother\n"}};
  const LiveState state = view_of(picture).state();
  EXPECT_EQ(state.name, path_);
  EXPECT_FALSE(state.is_scene);
  EXPECT_EQ(state.status, LiveStatus::kDone);
  EXPECT_EQ(state.width, 4);
  EXPECT_EQ(state.height, 3);
  EXPECT_EQ(state.window, (PixelBounds{1, 1, 4, 3}));
  EXPECT_EQ(state.settings.integrator, "mixed");
  EXPECT_EQ(state.report, (std::vector<std::string>{"one line", "another"}));
}

TEST_F(PictureView, ListsLayersWithTheirChannels) {
  const LiveState state = view_of(small_picture(kChannels)).state();
  std::vector<std::string> layers;
  for (const LiveLayer& layer : state.layers) layers.push_back(layer.name + " " + layer.channels);
  std::ranges::sort(layers);
  EXPECT_EQ(layers, (std::vector<std::string>{"N XYZ", "Z Z", "bias Y", "caustic RGB",
                                              "picture RGB", "samples N", "stderr RGB"}));
}

TEST_F(PictureView, IncompleteLayersAreNone) {
  PictureSource& source =
      view_of(small_picture({"R", "G", "B", "half.R", "half.G", "other.X", "depth"}));
  ASSERT_EQ(source.state().layers.size(), 1u);
  EXPECT_EQ(decode(*source.frame({"half", "other"}, 0, 0)).header["layers"].size(), 0u);
}

TEST_F(PictureView, NeedsColours) {
  write_small_exr(path_, small_picture({"Y", "Z"}));
  EXPECT_THROW(PictureSource source(path_), UsageError);
  EXPECT_THROW(PictureSource source(directory_.file("none.exr")), IoError);
}

TEST_F(PictureView, FramesHaveTheValuesOfTheFile) {
  PictureSource& source = view_of(small_picture(kChannels));
  const DecodedFrame frame = decode(*source.frame({"picture"}, 0, 0));
  EXPECT_EQ(frame.header["window"], (std::vector<int>{1, 1, 4, 3}));
  ASSERT_EQ(frame.values.size(), 18u);
  EXPECT_NEAR(first_of(source, "picture", 2), 2, 1e-3);        // B of the first pixel
  EXPECT_NEAR(first_of(source, "picture", 3 * 5), 0.5, 1e-3);  // R of the last one
  EXPECT_NEAR(first_of(source, "caustic", 3 * 5), 3.5, 2e-3);  // its caustic
  EXPECT_NEAR(first_of(source, "Z", 5), 9.5, 1e-2);
  EXPECT_NEAR(first_of(source, "bias", 1), 13.1, 1e-2);
  EXPECT_NEAR(first_of(source, "samples", 2), 14.2, 1e-2);
}

TEST_F(PictureView, AFrameIsSentOnce) {
  PictureSource& source = view_of(small_picture(kChannels));
  EXPECT_FALSE(source.frame({"picture"}, 1, 1).has_value());
  EXPECT_TRUE(source.frame({"picture"}, 1, 0).has_value());
  EXPECT_TRUE(source.frame({"picture"}, 7, 1).has_value()) << "of another view";
  EXPECT_EQ(source.wait_for_news(0, 60), 1u);
}

TEST_F(PictureView, ProbesPixelsOfTheWindow) {
  PictureSource& source = view_of(small_picture(kChannels));
  const ProbedPixel probed = source.probe(3, 2);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(probed.value[c], static_cast<float>(c) + 0.5f);
    EXPECT_EQ(probed.standard_error[c], static_cast<float>(c) + 10.5f);
  }
  EXPECT_EQ(probed.samples, 14u);
  EXPECT_THROW(source.probe(0, 1), UsageError);
  EXPECT_THROW(source.probe(4, 1), UsageError);
  PictureSource& plain = view_of(small_picture({"R", "G", "B"}));
  EXPECT_EQ(plain.probe(1, 1).samples, 0u);
}

TEST_F(PictureView, HasNoRenderToChangeOrInspect) {
  Answers& answers = answers_of(small_picture(kChannels));
  EXPECT_EQ(source_->live(), nullptr);
  EXPECT_THROW(answers.inspect({}, R"({"x":1,"y":1})"), UsageError);
  EXPECT_THROW(answers.pick({}, R"({"x":1,"y":1})"), UsageError);
  EXPECT_THROW(answers.camera({}, R"({"eye":[0,0,0]})"), UsageError);
  EXPECT_THROW(answers.render({}, R"({"action":"pause"})"), UsageError);
  EXPECT_THROW(answers.save({{"kind", "scene"}}, ""), UsageError);
}

TEST_F(PictureView, WritesWhatItHasRead) {
  Picture picture = small_picture(kChannels);
  picture.metadata = {{kIntegratorKey, "mixed"}};
  view_of(picture).write(directory_.file("copy.exr"));
  const Picture copy = read_picture(directory_.file("copy.exr"));
  EXPECT_EQ(copy.window, picture.window);
  EXPECT_EQ(value_of(copy.metadata, kIntegratorKey), "mixed");
  ASSERT_EQ(copy.channels.size(), kChannels.size());
  for (const char* channel : {"R", "B", "Z", "samples"}) {
    const auto from = static_cast<size_t>(picture.find_channel(channel));
    const auto to = static_cast<size_t>(copy.find_channel(channel));
    for (size_t p = 0; p < 6; ++p)
      EXPECT_EQ(copy.pixels[p * kChannels.size() + to], picture.pixels[p * kChannels.size() + from])
          << channel;
  }
}

TEST_F(PictureView, ColoursAreThoseOfThePicture) {
  const Picture colors = view_of(small_picture(kChannels)).colors({});
  EXPECT_EQ(colors.channels, (std::vector<std::string>{"R", "G", "B"}));
  ASSERT_EQ(colors.pixels.size(), 18u);
  EXPECT_EQ(colors.pixels[3 * 5 + 1], 1.5f);
}

/// Pictures of other programs may hold anything.
TEST_F(PictureView, NumbersThatAreNotFiniteDoNoHarm) {
  Picture picture = small_picture(kChannels);
  const std::vector<float> strange = {kNan, kInfinite, -kInfinite, 3e38f, -3e38f, 1e-45f};
  for (size_t i = 0; i < picture.pixels.size(); ++i)
    picture.pixels[i] = strange[(i / kChannels.size() + i) % strange.size()];
  Answers& answers = answers_of(picture);
  for (const LiveLayer& layer : source_->state().layers) {
    const DecodedFrame frame = decode(*source_->frame({layer.name}, 0, 0));
    EXPECT_TRUE(std::isfinite(frame.header["layers"][0]["scale"].get<float>())) << layer.name;
  }
  for (int y = 1; y < 3; ++y)
    for (int x = 1; x < 4; ++x) {
      const Answer probed = answers.probe({{"x", std::to_string(x)}, {"y", std::to_string(y)}}, "");
      EXPECT_TRUE(nlohmann::json::accept(probed.body)) << probed.body;
    }
  answers.snapshot({}, "{}");
  EXPECT_TRUE(nlohmann::json::accept(answers.compare({{"with", "A"}}, "").body));
  for (const char* kind : {"relmse", "flip"})
    EXPECT_EQ(answers.heat({{"with", "A"}, {"kind", kind}}, "").body.substr(1, 3), "PNG");
  EXPECT_EQ(answers.save({{"kind", "png"}}, "").body.substr(1, 3), "PNG");
  EXPECT_EQ(answers.first_picture({}, "").body.substr(1, 3), "PNG");
}

TEST_F(PictureView, SavedFilesHaveAllDigits) {
  const Picture picture = small_picture(kChannels);  // 0.1 needs more than 16 bits
  Answers& answers = answers_of(picture);
  const std::string path = directory_.file("saved.exr");
  const Answer saved_file = answers.save({{"kind", "exr"}}, "");
  write_file_atomically(path, std::as_bytes(std::span(saved_file.body)));
  const Picture saved = read_picture(path);
  for (const std::string& name : kChannels)
    for (size_t p = 0; p < 6; ++p)
      EXPECT_EQ(pixel_of(saved, name, p), pixel_of(picture, name, p)) << name;
}

TEST_F(PictureView, ManySamplesAreStillANumber) {
  Picture picture = small_picture(kChannels);
  const size_t samples = kChannels.size() - 1;
  picture.pixels[samples] = kInfinite;
  picture.pixels[kChannels.size() + samples] = kNan;
  picture.pixels[2 * kChannels.size() + samples] = -3;
  PictureSource& source = view_of(picture);
  EXPECT_GE(source.probe(1, 1).samples, uint64_t{1} << 59);
  EXPECT_EQ(source.probe(2, 1).samples, 0u);
  EXPECT_EQ(source.probe(3, 1).samples, 0u);
}

}  // namespace
}  // namespace nephroid

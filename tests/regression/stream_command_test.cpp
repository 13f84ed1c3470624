// `nephroid render --stream` with the real program: its frames, and how soon it ends.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "film/image_io.h"
#include "regression/piped_program.h"
#include "regression/scene_folder.h"
#include "source_directory.h"

namespace nephroid::testing_support {
namespace {

constexpr int kSignalStatus = 128;

struct Frame {
  nlohmann::json header;
  std::string payload;
  std::string kind() const { return header.at("kind"); }
};

/// The next frame, as docs/stream.md tells how to read it; empty at the end of the stream.
std::optional<Frame> next_frame(PipedProgram& program) {
  const std::string prefix = program.read(24);
  if (prefix.size() < 24) return std::nullopt;
  uint32_t version = 0;
  uint64_t header_bytes = 0, payload_bytes = 0;
  std::memcpy(&version, prefix.data() + 4, 4);
  std::memcpy(&header_bytes, prefix.data() + 8, 8);
  std::memcpy(&payload_bytes, prefix.data() + 16, 8);
  EXPECT_EQ(prefix.substr(0, 4), "NPHF");
  EXPECT_EQ(version, 1u);
  Frame frame;
  frame.header = nlohmann::json::parse(program.read(header_bytes));
  frame.payload = program.read(payload_bytes);
  EXPECT_EQ(frame.payload.size(), payload_bytes);
  return frame;
}

std::vector<Frame> all_frames(PipedProgram& program) {
  std::vector<Frame> frames;
  while (std::optional<Frame> frame = next_frame(program)) frames.push_back(std::move(*frame));
  return frames;
}

float value_at(const Frame& frame, size_t index) {
  float value = 0;
  std::memcpy(&value, frame.payload.data() + index * sizeof(float), sizeof(float));
  return value;
}

double seconds_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

class StreamCommand : public ::testing::Test {
 protected:
  std::vector<std::string> arguments(const std::vector<std::string>& more) const {
    std::vector<std::string> all{"render", kRoom, "--resolution", "24x16",
                                 "-t",     "2",   "-D",           "photons=2000"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  /// An endless render that has shown its first picture.
  std::unique_ptr<PipedProgram> shown() const {
    auto program = std::make_unique<PipedProgram>(
        folder_.path(), std::vector<std::string>{"render", kRoom, "--resolution", "640x480",
                                                 "--stream", "picture", "--time", "10m"});
    for (;;) {
      const std::optional<Frame> frame = next_frame(*program);
      if (!frame || frame->kind() == "picture") return program;
    }
  }

  const std::string kRoom = source_directory() + "/scenes/caustic-room/scene.pbrt";
  const testing::TemporaryDirectory folder_;
};

TEST_F(StreamCommand, LastPictureIsThatOfTheFile) {
  PipedProgram program(folder_.path(), arguments({"--passes", "2", "--stream", "Z,picture,caustic",
                                                  "-o", "a.exr", "--float"}));
  const std::vector<Frame> frames = all_frames(program);
  EXPECT_EQ(program.wait(), 0);
  ASSERT_GE(frames.size(), 2u);
  EXPECT_EQ(frames.back().kind(), "end");
  EXPECT_EQ(frames.back().header.at("passes"), 2);
  EXPECT_EQ(frames.back().header.at("reason"), "passes");
  const Frame& last = frames[frames.size() - 2];
  ASSERT_EQ(last.kind(), "picture");
  EXPECT_EQ(last.header.at("last"), true);
  EXPECT_EQ(last.header.at("window"), (std::vector<int>{0, 0, 24, 16}));
  EXPECT_EQ(last.header.at("layers").dump(),
            R"([{"channels":"Z","name":"Z"},{"channels":"RGB","name":"picture"},)"
            R"({"channels":"RGB","name":"caustic"}])");

  const Picture file = read_picture(folder_.path("a.exr"));
  const size_t pixels = 24 * 16;
  ASSERT_EQ(last.payload.size(), pixels * 7 * sizeof(float));
  const std::vector<std::string> channels = {"R", "G", "B", "caustic.R", "caustic.G", "caustic.B"};
  const auto in_file = [&](const std::string& name, size_t pixel) {
    return file.pixels[pixel * file.channels.size() + file.find_channel(name)];
  };
  for (size_t i = 0; i < pixels; ++i) {
    EXPECT_EQ(value_at(last, i), in_file("Z", i));
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(value_at(last, pixels + 3 * i + c), in_file(channels[c], i));
      EXPECT_EQ(value_at(last, pixels * 4 + 3 * i + c), in_file(channels[3 + c], i));
    }
  }
}

TEST_F(StreamCommand, WritesNoFileUnlessAsked) {
  PipedProgram program(folder_.path(), arguments({"--passes", "1", "--stream", "picture"}));
  const std::vector<Frame> frames = all_frames(program);
  EXPECT_EQ(program.wait(), 0);
  EXPECT_TRUE(names_in(folder_.path()).empty());
  EXPECT_EQ(frames.back().header.at("report").get<std::string>().find("wrote"), std::string::npos);
}

TEST_F(StreamCommand, UnknownLayerIsAnErrorInAFrame) {
  PipedProgram program(folder_.path(), arguments({"--stream", "picture,caustics"}));
  const std::vector<Frame> frames = all_frames(program);
  EXPECT_EQ(program.wait(), kUsage);
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].kind(), "error");
  EXPECT_EQ(frames[0].header.at("text"),
            "--stream: there is no layer 'caustics', expected some of: picture, emission, caustic, "
            "diffuse, albedo, N, Z, stderr, bias, samples");
}

TEST_F(StreamCommand, ErrorsAndWarningsOfTheSceneAreFrames) {
  SceneFolder folder;
  const auto frames_of = [&](const std::string& scene, int status) {
    folder.write("scene.pbrt", scene);
    PipedProgram program(folder.path(""), {"render", "scene.pbrt", "--stream", "picture"});
    std::vector<Frame> frames = all_frames(program);
    EXPECT_EQ(program.wait(), status);
    return frames;
  };
  const std::vector<Frame> wrong = frames_of(kHead + "Shape \"ball\"\n", kScene);
  ASSERT_FALSE(wrong.empty());
  EXPECT_EQ(wrong.back().kind(), "error");
  EXPECT_EQ(wrong.back().header.at("text").get<std::string>().rfind("scene.pbrt:7:1: ", 0), 0u);

  const std::vector<Frame> odd =
      frames_of(kHead + "Shape \"sphere\" \"float size\" 2\n" + kTriangle, 0);
  EXPECT_TRUE(std::ranges::any_of(odd, [](const Frame& frame) {
    return frame.kind() == "warning" &&
           frame.header.at("text").get<std::string>().find("size") != std::string::npos;
  }));
}

// The promise is 0.3 s on an idle machine; tests share theirs.
constexpr double kSoon = 1.5;

TEST_F(StreamCommand, EndsSoonAtASignal) {
  const auto program = shown();
  EXPECT_LT(seconds_of([&] {
              program->send(SIGTERM);
              all_frames(*program);
              EXPECT_EQ(program->wait(), kSignalStatus + SIGTERM);
            }),
            kSoon);
}

TEST_F(StreamCommand, EndsSoonWithoutAReader) {
  const auto program = shown();
  program->close_output();
  EXPECT_LT(seconds_of([&] { EXPECT_EQ(program->wait(), kSignalStatus + SIGPIPE); }), kSoon);
}

TEST_F(StreamCommand, EndsSoonAtASignalIfTheReaderDoesNotRead) {
  const auto program = shown();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // the pipe is full by now
  EXPECT_LT(seconds_of([&] {
              program->send(SIGTERM);
              EXPECT_EQ(program->wait(), kSignalStatus + SIGTERM);
            }),
            kSoon);
}

}  // namespace
}  // namespace nephroid::testing_support

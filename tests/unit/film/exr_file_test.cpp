// A picture with the state of its render: what is written comes back, and what is missing, of
// another size or damaged is said.
#include "film/exr_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "core/errors.h"
#include "film/state_file.h"
#include "unit/film/scratch_directory.h"

namespace nephroid {
namespace {

/// Arrays of every shape over a picture of 37 x 21 pixels.
struct Memory {
  static constexpr int kWidth = 37, kHeight = 21;
  std::vector<std::array<uint32_t, 12>> sums;
  std::vector<double> one_each;
  std::vector<uint64_t> few;
  std::vector<uint32_t> stream;
  size_t most_words = 5000;

  explicit Memory(uint32_t seed)
      : sums(kWidth * kHeight), one_each(kWidth * kHeight), few(3), stream(2500) {
    uint32_t x = seed;
    const auto next = [&x] { return x = x * 1664525u + 1013904223u; };
    for (auto& item : sums)
      for (uint32_t& word : item) word = next() % 3 == 0 ? 0 : next();
    for (double& value : one_each) value = next();
    for (uint64_t& value : few) value = uint64_t{next()} << 32 | next();
    for (uint32_t& word : stream) word = next();
  }
  RenderState state() {
    RenderState state;
    state.add("sums", std::span(sums));
    state.add("one.each", std::span(one_each));
    state.add("few", std::span(few));
    state.streams.push_back(
        {"stream", most_words, [this] { return stream; },
         [this](std::span<const uint32_t> words) { stream.assign(words.begin(), words.end()); }});
    return state;
  }
  bool operator==(const Memory& o) const {
    return sums == o.sums && one_each == o.one_each && few == o.few && stream == o.stream;
  }
};

Picture some_picture() {
  Picture picture;
  picture.full_width = 100;
  picture.full_height = 50;
  picture.window = {5, 7, 5 + Memory::kWidth, 7 + Memory::kHeight};
  picture.channels = {"R", "G", "B", "bias.Y"};
  picture.pixels.resize(static_cast<size_t>(picture.window.area()) * 4);
  std::iota(picture.pixels.begin(), picture.pixels.end(), 0.0f);
  picture.color_space = RgbColorSpace::find("rec2020");
  picture.metadata = {{"nephroid:passes", "0..7"}};
  return picture;
}

std::string error_of_load(const std::string& path, Memory& memory) {
  try {
    StateFile(path).load(memory.state());
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

TEST(ExrFile, StateComesBackAndThePictureIsAsWithoutIt) {
  const ScratchDirectory directory;
  const std::string path = directory.file("a.exr"), slim = directory.file("slim.exr");
  for (const size_t words : {size_t{0}, size_t{1}, size_t{1023}, size_t{1024}, size_t{2500}}) {
    Memory saved(1), loaded(2);
    saved.stream.resize(words);
    const RenderState state = saved.state();
    write_exr(path, some_picture(), &state);
    StateFile file(path);
    EXPECT_TRUE(file.has_state());
    EXPECT_EQ(value_of(file.metadata(), "nephroid:passes"), "0..7");
    EXPECT_EQ(file.window(), some_picture().window);
    EXPECT_EQ(file.resolution(), Vec2i(100, 50));
    file.load(loaded.state());
    EXPECT_TRUE(saved == loaded) << words;
  }
  write_exr(slim, some_picture());
  EXPECT_FALSE(StateFile(slim).has_state());
  for (const std::string& each : {path, slim}) {
    const Picture read = read_picture(each), wanted = some_picture();
    EXPECT_EQ(read.channels, wanted.channels);
    EXPECT_EQ(read.pixels, wanted.pixels);
    EXPECT_EQ(read.window, wanted.window);
    EXPECT_EQ(read.full_width, wanted.full_width);
    EXPECT_EQ(read.color_space, wanted.color_space);
  }
}

TEST(ExrFile, SaysWhatDoesNotFit) {
  const ScratchDirectory directory;
  const std::string path = directory.file("a.exr");
  Memory saved(1);
  RenderState state = saved.state();
  write_exr(path, some_picture(), &state);
  Memory other(2);
  other.few.push_back(1);
  EXPECT_NE(error_of_load(path, other).find("'few' has a size"), std::string::npos);
  other = Memory(2);
  other.sums.pop_back();
  EXPECT_NE(error_of_load(path, other).find("'sums' has a size"), std::string::npos);
  other = Memory(2);
  other.most_words = 2499;
  EXPECT_NE(error_of_load(path, other).find("'stream' has a size"), std::string::npos);
  state.arrays.erase(state.arrays.begin() + 1);
  write_exr(path, some_picture(), &state);
  other = Memory(2);
  EXPECT_NE(error_of_load(path, other).find("'one.each' is missing"), std::string::npos);
}

// Wherever bits fall: the file cannot be read, or it says that it is damaged, or nothing that is
// loaded has changed.
TEST(ExrFile, NoticesDamage) {
  const ScratchDirectory directory;
  const std::string path = directory.file("a.exr"), broken = directory.file("b.exr");
  Memory saved(1);
  const RenderState state = saved.state();
  write_exr(path, some_picture(), &state);
  std::ifstream in(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  int noticed = 0, tried = 0;
  for (size_t at = 0; at < bytes.size(); at += 1 + at / 60, ++tried) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (at % 8)));
    if (at % 7 == 0) damaged.resize(at);
    std::ofstream(broken, std::ios::binary | std::ios::trunc) << damaged;
    Memory loaded(2);
    if (!error_of_load(broken, loaded).empty())
      ++noticed;
    else
      EXPECT_TRUE(saved == loaded) << "byte " << at;
  }
  EXPECT_GT(noticed, tried / 2);
}

/// The n-th place of `what` in the file becomes `by`, of the same length.
void replace_in(const std::string& path, const std::string& what, const std::string& by,
                int n = 1) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  size_t at = bytes.find(what);
  for (int i = 1; i < n && at != std::string::npos; ++i) at = bytes.find(what, at + 1);
  ASSERT_NE(at, std::string::npos) << what;
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes.replace(at, by.size(), by);
}

// The metadata say which passes a picture has.
TEST(ExrFile, NoticesDamageOfTexts) {
  const ScratchDirectory directory;
  const std::string path = directory.file("a.exr");
  Memory saved(1), loaded(2);
  const RenderState state = saved.state();
  write_exr(path, some_picture(), &state);
  EXPECT_EQ(error_of_load(path, loaded), "");
  replace_in(path, "0..7", "0..3");
  EXPECT_NE(error_of_load(path, loaded).find("metadata are damaged"), std::string::npos);
}

// Earlier builds had another hash under another key: their states are refused, and not as damaged.
TEST(ExrFile, SaysThatAnEarlierBuildWroteIt) {
  const ScratchDirectory directory;
  const std::string path = directory.file("a.exr");
  Memory saved(1), loaded(2);
  const RenderState state = saved.state();
  write_exr(path, some_picture(), &state);
  replace_in(path, "nephroid:texts.xxh3", "nephroid:texts.fnv1");
  const std::string error = error_of_load(path, loaded);
  EXPECT_NE(error.find("it was written by an earlier build"), std::string::npos) << error;
  EXPECT_EQ(error.find("damaged"), std::string::npos) << error;
}

// For parts of other kinds the library takes memory that nobody has looked at.
TEST(ExrFile, ReadsNoPartsOfOtherKinds) {
  const ScratchDirectory directory;
  const std::string path = directory.file("a.exr");
  Memory saved(1), loaded(2);
  const RenderState state = saved.state();
  using namespace std::string_literals;
  const std::string compression = "compression\0compression\0\1\0\0\0"s, type = "w000\0"s;
  write_exr(path, some_picture(), &state);
  replace_in(path, compression + '\1', compression + '\3', 2);
  EXPECT_NE(error_of_load(path, loaded).find("is no part of this program's"), std::string::npos);
  write_exr(path, some_picture(), &state);
  replace_in(path, type + '\0', type + '\2', 2);
  EXPECT_NE(error_of_load(path, loaded).find("is no part of this program's"), std::string::npos);
}

// Wide pictures have large buffers, of which fewer threads may have two each.
TEST(ExrFile, TheEncoderHoldsNoMoreThanItMay) {
  constexpr size_t kChannels = 40, kWords = 100;
  limit_image_threads(1);
  const uint64_t two = encoder_bytes(100, kChannels, kWords);
  limit_image_threads(8);
  EXPECT_EQ(encoder_bytes(100, kChannels, kWords), 8 * two) << "all";
  EXPECT_EQ(encoder_bytes(1000, kChannels, kWords), 3 * 10 * two) << "some";
  EXPECT_EQ(encoder_bytes(10000, kChannels, kWords), 100 * two / 2) << "the caller's, one buffer";
  EXPECT_LE(30 * two, kMaxEncoderBytes);
  EXPECT_GT(40 * two, kMaxEncoderBytes);
  limit_image_threads(0);
}

// Whichever byte is the first that the disk has no room for: the tables of offsets come last.
TEST(ExrFile, AFullDiskIsAnErrorAndTheOldFileStays) {
  const ScratchDirectory directory;
  const std::string path = directory.file("a.exr");
  Memory saved(1);
  const RenderState state = saved.state();
  write_exr(path, some_picture(), &state);
  const auto size = static_cast<rlim_t>(std::filesystem::file_size(path));
  const auto before = std::filesystem::last_write_time(path);
  struct rlimit old {};
  getrlimit(RLIMIT_FSIZE, &old);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  for (const rlim_t room : {rlim_t{0}, rlim_t{100}, rlim_t{3000}, size / 2, size - 1}) {
    const struct rlimit limited { room, old.rlim_max };
    setrlimit(RLIMIT_FSIZE, &limited);
    EXPECT_THROW(write_exr(path, some_picture(), &state), IoError) << room;
    setrlimit(RLIMIT_FSIZE, &old);
  }
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(std::filesystem::last_write_time(path), before);
  size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(directory.path()))
    files += entry.is_regular_file();
  EXPECT_EQ(files, 1u);
}

TEST(ExrFile, LeavesTheOldFileWhereItCannotWrite) {
  const ScratchDirectory directory;
  EXPECT_THROW(write_exr(directory.file("nowhere/a.exr"), some_picture()), IoError);
  EXPECT_THROW(StateFile(directory.file("missing.exr")), IoError);
  std::ofstream(directory.file("text.exr")) << "no picture";
  EXPECT_THROW(StateFile(directory.file("text.exr")), IoError);
}

}  // namespace
}  // namespace nephroid

// A state as a file: data are read back; missing, damaged or wrongly sized data are reported.
#include "film/state_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/errors.h"
#include "film/packed_blocks.h"
#include "film/state_index.h"
#include "unit/film/scratch_directory.h"

namespace nephroid {
namespace {

/// Arrays of every shape over 37 x 21 pixels.
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

StateHead some_head() {
  return {{100, 50},
          {5, 7, 5 + Memory::kWidth, 7 + Memory::kHeight},
          {{"nephroid:passes", "0..7"}, {"nephroid:scene", "a\xff b"}}};
}

std::string error_of_load(const std::string& path, Memory& memory) {
  try {
    StateFile(path).load(memory.state());
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

TEST(StateFile, ComesBack) {
  const ScratchDirectory directory;
  const std::string path = directory.file("a.state");
  for (const size_t words : {size_t{0}, size_t{1}, size_t{1023}, size_t{2500}, size_t{200000}}) {
    Memory saved(1), loaded(2);
    saved.stream.resize(words, 7);
    loaded.most_words = saved.most_words = 200000;
    write_state(path, some_head(), saved.state());
    StateFile file(path);
    EXPECT_EQ(file.metadata(), some_head().metadata);
    EXPECT_EQ(file.window(), some_head().window);
    EXPECT_EQ(file.resolution(), Vec2i(100, 50));
    EXPECT_EQ(file.size(), std::filesystem::file_size(path));
    file.load(loaded.state());
    EXPECT_TRUE(saved == loaded) << words;
  }
}

TEST(StateFile, HasTheNameOfItsPicture) {
  EXPECT_EQ(state_path_beside("a/b.exr"), "a/b.state");
  EXPECT_EQ(state_path_beside("a/b.state"), "a/b.state");
  EXPECT_EQ(state_path_beside("a.b/c"), "a.b/c.state");
}

TEST(StateFile, SaysWhatDoesNotFit) {
  const ScratchDirectory directory;
  const std::string path = directory.file("a.state");
  Memory saved(1);
  RenderState state = saved.state();
  write_state(path, some_head(), state);
  Memory other(2);
  other.few.push_back(1);
  EXPECT_NE(error_of_load(path, other).find("'few' has the wrong size"), std::string::npos);
  other = Memory(2);
  other.sums.pop_back();
  EXPECT_NE(error_of_load(path, other).find("'sums' has the wrong size"), std::string::npos);
  other = Memory(2);
  other.most_words = 2499;
  EXPECT_NE(error_of_load(path, other).find("'stream' has the wrong size"), std::string::npos);
  state.arrays.erase(state.arrays.begin() + 1);
  write_state(path, some_head(), state);
  other = Memory(2);
  EXPECT_NE(error_of_load(path, other).find("'one.each' is missing"), std::string::npos);
  state = saved.state();
  state.add("more", std::span(saved.few));
  write_state(path, some_head(), state);
  EXPECT_NE(error_of_load(path, other).find("'more' is stored, which this render does not have"),
            std::string::npos);
}

TEST(StateFile, WhatIsOptionalMayBeMissingUnknownOrUnreadable) {
  const ScratchDirectory directory;
  const std::string path = directory.file("a.state");
  Memory saved(1), loaded(2);
  const auto with_optional = [](RenderState state, bool refuses) {
    state.streams.push_back({"optional.x", 10,
                             [] {
                               return std::vector<uint32_t>{1, 2};
                             },
                             [refuses](std::span<const uint32_t>) {
                               if (refuses) throw IoError("it makes no sense");
                             }});
    return state;
  };
  write_state(path, some_head(), saved.state());
  EXPECT_TRUE(StateFile(path).load(with_optional(loaded.state(), false)).empty()) << "missing";
  EXPECT_TRUE(saved == loaded);
  write_state(path, some_head(), with_optional(saved.state(), false));
  EXPECT_TRUE(StateFile(path).load(loaded.state()).empty()) << "unknown";
  EXPECT_EQ(StateFile(path).load(with_optional(loaded.state(), true)),
            std::vector<std::string>{
                path + ": cannot read this state of a render: 'optional.x': it makes no "
                       "sense"});
}

// Any flipped bit or early end is reported, or leaves the loaded data intact.
TEST(StateFile, NoticesDamage) {
  const ScratchDirectory directory;
  const std::string path = directory.file("a.state"), broken = directory.file("b.state");
  Memory saved(1);
  write_state(path, some_head(), saved.state());
  const std::string bytes = bytes_of(path);
  int noticed = 0, tried = 0;
  for (size_t at = 0; at < bytes.size(); at += 1 + at / 100) {
    for (const bool cut : {false, true}) {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << (at % 8)));
      if (cut) damaged.resize(at);
      std::ofstream(broken, std::ios::binary | std::ios::trunc) << damaged;
      Memory loaded(2);
      const std::string error = error_of_load(broken, loaded);
      ++tried;
      noticed += error.empty() ? 0 : 1;
      if (error.empty()) {
        EXPECT_TRUE(saved == loaded) << "byte " << at << (cut ? ", cut" : "");
      }
    }
  }
  EXPECT_GT(noticed, tried * 9 / 10) << "compressed blocks have bits that mean nothing";
}

// A file of another version is not reported as damaged.
TEST(StateFile, SaysThatAnotherVersionWroteIt) {
  const ScratchDirectory directory;
  const std::string path = directory.file("a.state");
  Memory saved(1), loaded(2);
  write_state(path, some_head(), saved.state());
  std::string bytes = bytes_of(path);
  ++bytes[7];
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
  EXPECT_NE(error_of_load(path, loaded).find("another version of this program"), std::string::npos);
}

TEST(StateFile, NamesTheFileThatItCannotRead) {
  const ScratchDirectory directory;
  EXPECT_THROW(StateFile(directory.file("missing.state")), IoError);
  EXPECT_THROW(StateFile(directory.path().string()), IoError);
  std::ofstream(directory.file("text.state")) << std::string(1000, 'x');
  try {
    StateFile file(directory.file("text.state"));
    FAIL() << "read";
  } catch (const IoError& error) {
    EXPECT_EQ(std::string(error.what()).find(directory.file("text.state")), 0u);
  }
}

// An index is accepted only if its blocks lie within the file.
TEST(StateIndex, ComesBackAndMustMakeSense) {
  StateIndex index{{8, 8}, {0, 0, 8, 8}, {{"key", "value"}}, {}};
  index.sections.push_back({"a", 12, 48 * 10000, 5, 100, {10, 20}});
  const auto read = [&](uint64_t file_bytes) {
    return StateIndex::from_bytes(index.to_bytes(), file_bytes);
  };
  const StateIndex same = read(130);
  EXPECT_EQ(same.metadata, index.metadata);
  EXPECT_EQ(same.sections[0].blocks, index.sections[0].blocks);
  EXPECT_THROW(read(129), IoError) << "its blocks end at 130";
  index.sections[0].bytes += 1;
  EXPECT_THROW(read(130), IoError) << "no whole items";
  index.sections[0].bytes = 48 * 20000;
  EXPECT_THROW(read(130), IoError) << "more blocks than it has";
  index.sections[0].bytes = 48 * 10000;
  index.sections[0].words = 0;
  EXPECT_THROW(read(130), IoError);
  index.sections.clear();
  index.window.x1 = 9;
  EXPECT_THROW(read(130), IoError) << "beyond the picture";
  const std::vector<std::byte> some(20);
  EXPECT_THROW(StateIndex::from_bytes(some, 130), IoError);
}

// Sums of pictures have zeros in their highest and lowest bytes.
TEST(PackedBlocks, BytesOfEqualPlacePackBetter) {
  std::vector<uint64_t> sums(1000);
  uint32_t x = 1;
  for (uint64_t& sum : sums) sum = uint64_t{x = x * 1664525u + 1013904223u} << 16;
  PackedBlock block;
  pack_block(std::as_bytes(std::span(sums)), sizeof(uint64_t), block);
  EXPECT_LT(block.packed.size(), 4100u) << "the four bytes that differ";
  std::vector<uint64_t> found(1000);
  const auto into = std::as_writable_bytes(std::span(found));
  EXPECT_TRUE(unpack_block(block, sizeof(uint64_t), into));
  EXPECT_EQ(found, sums);
  EXPECT_FALSE(unpack_block(block, sizeof(uint64_t), into.first(7992)));
  block.packed.resize(100);
  EXPECT_FALSE(unpack_block(block, sizeof(uint64_t), into));
}

}  // namespace
}  // namespace nephroid

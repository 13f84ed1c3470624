// Accepted metadata of pictures, and what merging refuses before it reads a state.
#include "session/checkpoint/checkpoint.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/errors.h"
#include "film/exr_file.h"
#include "session/checkpoint/merge_pictures.h"
#include "session/checkpoint/picture_description.h"
#include "session/checkpoint/version.h"
#include "unit/film/scratch_directory.h"

namespace nephroid {
namespace {

/// A picture of two pixels with some state. Only its metadata matter.
void write(const std::string& path, const Metadata& metadata) {
  Picture picture;
  picture.full_width = picture.window.x1 = 2;
  picture.full_height = picture.window.y1 = 1;
  picture.channels = {"R", "G", "B"};
  picture.pixels.resize(6);
  picture.metadata = metadata;
  write_exr(path, picture);
  std::vector<uint64_t> sums(2);
  RenderState state;
  state.add("sums", std::span(sums));
  write_state(state_path_beside(path), {{2, 1}, picture.window, metadata}, state);
}

TEST(Checkpoint, TimesAreFiniteAndNotNegative) {
  const ScratchDirectory directory;
  const std::string path = directory.file("a.exr");
  for (const std::string text : {"nan", "inf", "-1", "1e999", "abc", "1x", " 1", "0x10"}) {
    write(path, {{"nephroid:seconds", text}});
    EXPECT_THROW(seconds_of(open_state(path, "read it"), "nephroid:seconds"), IoError) << text;
  }
  write(path, {{"nephroid:seconds", "12.5"}});
  EXPECT_EQ(seconds_of(open_state(path, "read it"), "nephroid:seconds"), 12.5);
  EXPECT_EQ(seconds_of(open_state(path, "read it"), "nephroid:no_such_seconds"), 0);
}

TEST(PictureDescription, SaysWhatThePictureIsOf) {
  const ScratchDirectory directory;
  const std::string path = directory.file("a.exr");
  write(path, {{"nephroid:passes", "0..1,4..9"},
               {"nephroid:layout", "{\"passes_add_up\":true}"},
               {"nephroid:history", "2 passes in 1.000 s\n6 passes in 3.000 s\n"}});
  EXPECT_TRUE(is_picture(path));
  const std::string state = directory.file("a.state");
  const std::string passes = "8 passes (0..1,4..9), to be resumed or merged\n";
  const std::string history = "history:\n  2 passes in 1.000 s\n  6 passes in 3.000 s\n";
  const std::string ranges = "passes: 0..1,4..9\n";
  EXPECT_EQ(description_of_picture(path),
            "picture: " + path + "\nresolution: 2x1\nlayers: R, G, B\nstate: " + state + ": " +
                passes + history + ranges);
  EXPECT_EQ(description_of_picture(state),
            "state: " + state + "\nresolution: 2x1\nstate: " + passes + ranges + history);
  EXPECT_TRUE(is_picture(state));
  std::filesystem::remove(state);
  EXPECT_NE(description_of_picture(path).find("none, there is no " + state), std::string::npos);
  EXPECT_FALSE(is_picture(directory.file("none.exr")));
  EXPECT_FALSE(is_picture(directory.path()));
  const std::string empty = directory.file("empty.exr");
  std::ofstream(empty, std::ios::binary).flush();
  EXPECT_TRUE(is_picture(empty));
}

std::string refusal_of_merge(const std::string& version) {
  const ScratchDirectory directory;
  const std::string a = directory.file("a.exr"), b = directory.file("b.exr");
  write(a, {{"nephroid:version", version}, {"nephroid:passes", "0..1"}});
  write(b, {{"nephroid:version", version}, {"nephroid:passes", "2..3"}});
  try {
    merge_pictures({a, b}, directory.file("sum.exr"));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Merge, AddsUpPicturesOfThisVersionOnly) {
  const std::string mine = std::string(" rendered it, expected ") + kVersion;
  for (const std::string version : {"0.0.1", ""})
    EXPECT_NE(refusal_of_merge(version).find("version " + (version.empty() ? "?" : version) + mine),
              std::string::npos)
        << refusal_of_merge(version);
  // These are refused later, for their film.
  EXPECT_NE(refusal_of_merge(kVersion).find("its description of the film is damaged"),
            std::string::npos)
      << refusal_of_merge(kVersion);
}

}  // namespace
}  // namespace nephroid

// Identity of a render: differences by which two pictures belong to different renders.
#include "session/checkpoint/render_identity.h"

#include <gtest/gtest.h>

#include "session/checkpoint/version.h"

namespace nephroid {
namespace {

RenderIdentity made_up() {
  RenderIdentity identity = RenderIdentity::of_this_program();
  identity.scene = "cup.pbrt";
  identity.scene_hash = "0123456789abcdef";
  identity.integrator = "mixed";
  identity.options = "max-depth=5 radius=1 texture-cache=1G";
  identity.routes = "all = .* : path\n";
  FilmSettings settings;
  settings.width = 4;
  settings.height = 3;
  settings.crop = {1, 0, 4, 2};
  identity.set_film(Film(settings, FilmLayout::of_routes({"all"})), 7);
  return identity;
}

TEST(RenderIdentity, IsTheSameFromItsMetadata) {
  const RenderIdentity identity = made_up();
  const Metadata metadata = identity.to_metadata();
  EXPECT_EQ(value_of(metadata, "nephroid:version"), kVersion);
  EXPECT_EQ(value_of(metadata, "nephroid:film"), "4x3, columns 1 to 4, rows 0 to 2");
  EXPECT_EQ(value_of(metadata, "nephroid:seed"), "7");
  for (const auto& [key, value] : metadata) {
    EXPECT_TRUE(key.starts_with(kKeyPrefix)) << key;
    EXPECT_FALSE(value.empty()) << key;
  }
  const RenderIdentity again = RenderIdentity::from_metadata(metadata);
  EXPECT_TRUE(again.differences(identity, "here").empty());
  EXPECT_EQ(again.to_metadata(), metadata);
}

TEST(RenderIdentity, TellsEachDifference) {
  const RenderIdentity there = made_up();
  RenderIdentity here = there;
  here.seed = "8";
  here.outliers = "reject";
  here.options = "max-depth=5 radius=2 alpha=1 texture-cache=1G";
  EXPECT_EQ(there.differences(here, "here"),
            (std::vector<std::string>{"radius 1, here 2", "alpha nothing, here 1",
                                      "outliers nothing, here reject", "seed 7, here 8"}));
}

TEST(RenderIdentity, NamesAndCachesMakeNoDifference) {
  const RenderIdentity there = made_up();
  RenderIdentity here = there;
  here.scene = "copy.pbrt";
  here.integrator = "routes.txt";
  here.instruction_sets = "sse2, compiled for sse2";
  here.options = "max-depth=5 radius=1 texture-cache=1M";
  EXPECT_TRUE(there.differences(here, "here").empty());
}

TEST(RenderIdentity, JoinsInstructionSets) {
  EXPECT_EQ(joined_instruction_sets("a, b", "c, d"), "a, b; c, d");
  EXPECT_EQ(joined_instruction_sets("a, b; c, d", "c, d"), "a, b; c, d");
  EXPECT_EQ(joined_instruction_sets("", "c, d"), "c, d");
}

}  // namespace
}  // namespace nephroid

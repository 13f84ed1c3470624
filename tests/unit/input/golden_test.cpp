// Small whole scenes: each golden/NAME.pbrt must parse to what golden/NAME.txt says.
#include <gtest/gtest.h>

#include "input/file_bytes.h"
#include "input/pbrt_parser.h"
#include "source_directory.h"
#include "unit/input/scene_dump.h"

namespace nephroid {
namespace {

class GoldenTest : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Scenes, GoldenTest,
                         ::testing::Values("options", "parameters", "attributes", "objects",
                                           "files", "transforms"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(GoldenTest, ParsesToItsDump) {
  const std::string base =
      testing_support::source_directory() + "/tests/unit/input/golden/" + GetParam();
  Diagnostics diagnostics;
  const SceneDescription scene = parse_pbrt_file(base + ".pbrt", diagnostics);
  EXPECT_EQ(testing::dump(scene, diagnostics), read_file_bytes(base + ".txt"));
}

}  // namespace
}  // namespace nephroid

// The lights of a picture, and reasons for black pictures, from counts alone.
#include "session/report/lamp_report.h"

#include <gtest/gtest.h>

#include "unit/film/one_part.h"

namespace nephroid {
namespace {

using Lines = std::vector<std::string>;

EstimatorStatistics of(const std::vector<LampLight>& lamps) {
  EstimatorStatistics s;
  s.tells_lamps = true;
  s.lamp_passes = 1;
  s.lamps = lamps;
  return s;
}

TEST(LampReport, SharesAreOfAllEstimatorsBrightestFirst) {
  const auto one = of({{"a", 1, 5}, {"b", 5, 5}}), two = of({{"a", 1, 5}, {"b", 1, 5}});
  EXPECT_EQ(lamp_report({one, two, of({})}), Lines{"light by lamp: b 75 %, a 25 % (first passes)"});
}

TEST(LampReport, NothingIsSaidWhereSomeAreNotTold) {
  EXPECT_EQ(lamp_report({of({{"a", 1, 5}}), EstimatorStatistics()}), Lines{});
  EXPECT_EQ(lamp_report({of({})}), Lines{}) << "the first passes were rendered elsewhere";
  EXPECT_EQ(lamp_report({}), Lines{});
}

TEST(LampReport, DarkOnesHaveTheirReason) {
  const Lines lines = lamp_report({of({{"boxed", 0, 1200}, {"sky", 2, 0}, {"turned away", 0, 0}})});
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0], "light by lamp: sky 100 %, boxed 0 %, turned away 0 % (first passes)");
  EXPECT_EQ(
      lines[1].find("note: boxed brought no light in the first passes: all 1.2 k shadow rays"), 0u)
      << lines[1];
  EXPECT_EQ(lines[2].find("note: turned away brought no light in the first passes: no shadow ray"),
            0u)
      << lines[2];
}

TEST(LampReport, ManyAreSummedUp) {
  std::vector<LampLight> lamps;
  for (int i = 0; i < 50; ++i) {
    lamps.push_back({"l" + std::to_string(i), i < 6 ? 0.0 : 1.0, 0});
    if (i == 20) lamps.back().light = 57;
  }
  const Lines lines = lamp_report({of(lamps)});
  ASSERT_EQ(lines.size(), 5u) << "three dark ones by name";
  EXPECT_EQ(lines[0],
            "light by lamp: l20 57 %, l6 1 %, l7 1 %, l8 1 %, l9 1 %, 45 others 39 % (first "
            "passes)");
  EXPECT_EQ(lines[4], "note: 3 more lights brought none");
  lamps.erase(lamps.begin(), lamps.begin() + 2);
  EXPECT_EQ(lamp_report({of(lamps)}).at(4), "note: 1 more light brought none");
}

TEST(BlackPicture, HasNoErrorAndACause) {
  const std::string start = "the picture is black, so that no error can be estimated";
  EXPECT_EQ(black_picture_report({EstimatorStatistics()}), start);
  EXPECT_EQ(black_picture_report({of({})}), start + ": the scene has no light");
  EXPECT_EQ(black_picture_report({of({{"lamp", 0, 40}})})
                .find(start + ": all 40 shadow rays to the only light, lamp, "),
            0u);
  EXPECT_EQ(black_picture_report({of({{"a", 0, 0}, {"b", 0, 0}})})
                .find(start + ": no shadow ray went to its 2 lights"),
            0u);
}

TEST(BlackPicture, IsBlackInEveryPixel) {
  FilmSettings settings;
  settings.width = 3;
  settings.height = 2;
  Film film(settings, FilmLayout::of_routes({"a"}));
  EXPECT_TRUE(is_black(film));
  film.add(0, 2, 1, std::vector<Rgb>{{0, 1, 0}});
  film.add_estimates(0, 1);
  EXPECT_FALSE(is_black(film));
}

}  // namespace
}  // namespace nephroid

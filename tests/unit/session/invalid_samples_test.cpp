#include "session/report/invalid_samples.h"

#include <gtest/gtest.h>

#include <limits>

#include "film/film_settings.h"
#include "input/pbrt_parser.h"
#include "unit/film/one_part.h"

namespace nephroid {
namespace {

using testing_support::add_one;

TEST(FaultReport, TellsRoutePixelAndWhatIsSeenThere) {
  Diagnostics diagnostics;
  const auto scene = build_scene(
      parse_pbrt_string("LookAt 0 0 -5  0 0 0  0 1 0\nCamera \"perspective\"\n"
                        "Film \"rgb\" \"integer xresolution\" 20 \"integer yresolution\" 20\n"
                        "  \"float cropwindow\" [0.25 1 0.25 1]\nWorldBegin\n"
                        "MakeNamedMaterial \"glass\" \"string type\" \"dielectric\"\n"
                        "NamedMaterial \"glass\"\nShape \"sphere\"\n",
                        "t.pbrt", ".", diagnostics),
      {}, diagnostics);
  Film film(film_settings(scene->film), FilmLayout::of_routes({"diffuse", "caustic"}));
  EXPECT_TRUE(invalid_samples(*scene, film).empty());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  add_one(film, 1, 10, 10, {nan, 0, 0});
  add_one(film, 1, 12, 17, {0, 1, std::numeric_limits<float>::infinity()});
  add_one(film, 0, 5, 5, {0, nan, 0});
  film.count_saturated(3);
  const std::vector<std::string> lines = invalid_samples(*scene, film);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0],
            "1 estimate of route diffuse was not finite and was left out; first at pixel "
            "5,5, where the camera sees nothing");
  EXPECT_EQ(lines[1].find("2 estimates of route caustic were not finite and were left out; "
                          "first at pixel 10,10, where the camera sees material glass "
                          "at ("),
            0u)
      << lines[1];
  EXPECT_EQ(
      lines[2],
      "3 pixel values (light, features or error estimates) reached the limit of a sum or were not "
      "finite");
}

}  // namespace
}  // namespace nephroid

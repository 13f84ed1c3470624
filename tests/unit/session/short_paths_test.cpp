// Notes on light that a small max-depth leaves out.
#include "session/settings/short_paths.h"

#include <gtest/gtest.h>

#include "rendering.h"

namespace nephroid {
namespace {

constexpr const char* kGlass = "Material \"dielectric\"";
constexpr const char* kMetal = "Material \"conductor\"";

/// The joined notes for a scene with two spheres, one of them diffuse.
std::string notes_of(int depth, const std::string& material, bool on_command_line = false) {
  const auto scene = testing_support::scene_from_text(
      "Camera \"perspective\" WorldBegin LightSource \"infinite\" Shape \"sphere\"\n" + material +
      " Shape \"sphere\"");
  RenderSettings settings;
  if (on_command_line)
    settings = render_settings({{"max-depth", std::to_string(depth)}});
  else
    settings.integrator.max_depth = depth;
  std::string all;
  for (const std::string& note : notes_of_short_paths(*scene, settings)) all += note;
  return all;
}

TEST(ShortPaths, GlassNeedsThreeEvents) {
  EXPECT_EQ(notes_of(3, kGlass), "");
  EXPECT_EQ(notes_of(2, kGlass),
            "the scene's maxdepth 2 ends paths behind dielectric1 (test.pbrt:2:1): it "
            "lights nothing behind it and only lights are seen through it, expected at least 3 "
            "scattering events");
  EXPECT_EQ(notes_of(1, kGlass, true),
            "-D max-depth=1 ends paths inside dielectric1 (test.pbrt:2:1): it lights "
            "nothing behind it and only lights in it are seen, expected at least 3 scattering "
            "events");
  EXPECT_NE(notes_of(2,
                     "MakeNamedMaterial \"a\" \"string type\" \"dielectric\" MakeNamedMaterial "
                     "\"b\" \"string type\" \"diffuse\" Material \"mix\" \"string materials\" "
                     "[\"a\" \"b\"]")
                .find("behind a ("),
            std::string::npos);
}

TEST(ShortPaths, MirrorsNeedTwo) {
  EXPECT_EQ(notes_of(2, kMetal), "");
  EXPECT_NE(
      notes_of(1, kMetal).find("it reflects only lights, expected at least 2 scattering events"),
      std::string::npos);
  // Light passes straight through thin glass.
  EXPECT_EQ(notes_of(2, "Material \"thindielectric\""), "");
  EXPECT_NE(notes_of(1, "Material \"thindielectric\"").find("reflects"), std::string::npos);
}

TEST(ShortPaths, NothingIsSaidOfWhatIsNotThere) {
  EXPECT_EQ(notes_of(1, ""), "");
  EXPECT_EQ(notes_of(2, "Material \"dielectric\" Material \"diffuse\""), "");
  EXPECT_EQ(notes_of(2, "Material \"dielectric\" \"float eta\" 1"), "");
  EXPECT_NE(notes_of(0, "").find("only lights are visible"), std::string::npos);
}

}  // namespace
}  // namespace nephroid

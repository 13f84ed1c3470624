// Precedence: defaults, the scene's Integrator directive, then -D.
#include "session/settings/integrator_choice.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "integrator/presets/integrator_table.h"

namespace nephroid {
namespace {

Parameter number_parameter(const std::string& type, const std::string& name, double value) {
  Parameter parameter;
  parameter.type = type;
  parameter.name = name;
  parameter.numbers = {value};
  return parameter;
}

ParameterSet pbrt_sppm() {
  ParameterSet set;
  set.list.push_back(number_parameter("integer", "maxdepth", 12));
  set.list.push_back(number_parameter("integer", "photonsperiteration", 5000));
  set.list.push_back(number_parameter("float", "radius", 0.01));
  return set;
}

bool has_note(const IntegratorChoice& choice, const std::string& part) {
  return std::any_of(choice.notes.begin(), choice.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

TEST(IntegratorChoice, SceneDepthIsTakenAndRadiusIsNot) {
  const IntegratorChoice choice = choose_integrator("mixed", "sppm", pbrt_sppm(), {});
  EXPECT_EQ(choice.name, "mixed");
  EXPECT_EQ(choice.settings.integrator.max_depth, 12);
  EXPECT_EQ(choice.settings.integrator.radius, IntegratorOptions().radius);
  EXPECT_EQ(choice.settings.integrator.photons_per_pass, IntegratorOptions().photons_per_pass);
  EXPECT_TRUE(has_note(choice, "radius"));
  EXPECT_FALSE(has_note(choice, "maxdepth"));
}

TEST(IntegratorChoice, ScenePhotonCountOnlyWithTheScenesIntegrator) {
  const IntegratorChoice choice = choose_integrator("scene", "sppm", pbrt_sppm(), {});
  EXPECT_EQ(choice.name, integrator_for_scene_name("sppm"));
  EXPECT_EQ(choice.settings.integrator.photons_per_pass, 5000);
}

TEST(IntegratorChoice, CommandLineIsOverTheScene) {
  const IntegratorChoice choice = choose_integrator(
      "scene", "sppm", pbrt_sppm(),
      render_settings({{"max-depth", "3"}, {"photons", "7"}, {"max-depth", "4"}}));
  EXPECT_EQ(choice.settings.integrator.max_depth, 4);
  EXPECT_EQ(choice.settings.integrator.photons_per_pass, 7);
}

TEST(IntegratorChoice, SceneWithoutDepthIsNoted) {
  EXPECT_TRUE(has_note(choose_integrator("mixed", "path", {}, {}), "maxdepth"));
  EXPECT_FALSE(has_note(
      choose_integrator("mixed", "path", {}, render_settings({{"max-depth", "5"}})), "maxdepth"));
  EXPECT_FALSE(has_note(choose_integrator("mixed", "", {}, {}), "maxdepth"));
  EXPECT_FALSE(has_note(choose_integrator("mixed", "path", {}, {}, false), "maxdepth"))
      << "a scene of another program";
}

TEST(IntegratorChoice, SceneWithoutAnEquivalent) {
  EXPECT_THROW(choose_integrator("scene", "function", {}, {}), UsageError);
  EXPECT_EQ(choose_integrator("scene", "", {}, {}).name, integrator_for_scene_name("volpath"));
}

}  // namespace
}  // namespace nephroid

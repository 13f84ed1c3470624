// Defaults, the scene's Integrator line and -D, in that order.
#include "session/settings/integrator_settings.h"

#include <gtest/gtest.h>

#include <algorithm>

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

// The text decides whether two pictures are of one render.
TEST(IntegratorSettings, WhatDiffersHasAnotherText) {
  for (const std::string key : {"alpha", "radius", "specular-alpha", "mutations", "large-step"}) {
    IntegratorOptions a, b;
    apply_settings({parse_setting(key + "=0.6667")}, &a);
    apply_settings({parse_setting(key + "=0.66670007")}, &b);
    EXPECT_NE(settings_text(a), settings_text(b)) << key;
  }
  IntegratorOptions said;
  apply_settings({parse_setting("alpha=0.6666667")}, &said);
  EXPECT_EQ(said.alpha, IntegratorOptions().alpha);
}

TEST(IntegratorSettings, EveryKeyIsStoredWhereItBelongs) {
  IntegratorOptions o;
  apply_settings({parse_setting("max-depth=7"),
                  parse_setting("radius=1.5"),
                  parse_setting("photons=1000"),
                  parse_setting("alpha=0.75"),
                  parse_setting("specular-alpha=0.2"),
                  parse_setting("camera-samples=3"),
                  parse_setting("point-lights=5"),
                  parse_setting("hit-points=6"),
                  parse_setting("map-photons=5000"),
                  parse_setting("nearest=40"),
                  parse_setting("technique=2,3,raw"),
                  parse_setting("memory-photons=99"),
                  parse_setting("outlier-neighbours=5"),
                  parse_setting("mutations=2.5"),
                  parse_setting("chain-length=77"),
                  parse_setting("large-step=0.25"),
                  parse_setting("guide=no"),
                  parse_setting("guide-walks=no"),
                  parse_setting("specular-trees=yes"),
                  parse_setting("texture-cache=1.5M")},
                 &o);
  EXPECT_EQ(o.max_depth, 7);
  EXPECT_EQ(o.radius, 1.5f);
  EXPECT_EQ(o.photons_per_pass, 1000);
  EXPECT_EQ(o.alpha, 0.75f);
  EXPECT_EQ(o.specular_band.low, 0.2f);
  EXPECT_EQ(o.specular_band.high, 0.2f);
  EXPECT_EQ(o.camera_samples_per_pass, 3);
  EXPECT_EQ(o.point_lights, 5);
  EXPECT_EQ(o.hit_points, 6);
  EXPECT_EQ(o.map_photons, 5000);
  EXPECT_EQ(o.nearest_photons, 40);
  EXPECT_EQ(o.memory_photons, 99);
  EXPECT_EQ(o.outlier_neighbours, 5);
  EXPECT_EQ(o.mutations, 2.5f);
  EXPECT_EQ(o.chain_length, 77);
  EXPECT_EQ(o.large_step, 0.25f);
  EXPECT_FALSE(o.guides_photons);
  EXPECT_FALSE(o.guides_walks);
  EXPECT_TRUE(o.specular_trees);
  EXPECT_EQ(o.texture_memory, 1536 * 1024);
  EXPECT_EQ(settings_text(o),
            "max-depth=7 radius=1.5 photons=1000 alpha=0.75 specular-alpha=0.2 camera-samples=3 "
            "point-lights=5 technique=2,3,raw hit-points=6 map-photons=5000 nearest=40 "
            "memory-photons=99 outlier-neighbours=5 mutations=2.5 chain-length=77 large-step=0.25 "
            "guide=no guide-walks=no specular-trees=yes "
            "texture-cache=1536K");
}

TEST(IntegratorSettings, SpecularAlphaMayBeARange) {
  IntegratorOptions o;
  apply_settings({parse_setting("specular-alpha=0.01..0.2")}, &o);
  EXPECT_EQ(o.specular_band.low, 0.01f);
  EXPECT_EQ(o.specular_band.high, 0.2f);
  EXPECT_NE(settings_text(o).find(" specular-alpha=0.01..0.2 "), std::string::npos);
  try {
    parse_setting("specular-alpha=0.2..0.01");
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(),
                 "-D specular-alpha: '0.2..0.01' is not valid, expected a number from 0 to 1, or a "
                 "range of them as in 0..1");
  }
}

TEST(IntegratorSettings, ATechniqueIsAPairOfNumbersOrMergesAlone) {
  const auto choice = [](const std::string& text) {
    IntegratorOptions o;
    apply_settings({parse_setting("technique=" + text)}, &o);
    EXPECT_NE(settings_text(o).find(" technique=" + text + " "), std::string::npos) << text;
    return o.technique;
  };
  EXPECT_TRUE(choice("all").makes(0, 2) && choice("all").makes(5, 1) && choice("all").merges());
  EXPECT_TRUE(choice("1,*").makes(1, 4) && !choice("1,*").makes(2, 4));
  EXPECT_TRUE(choice("*,1").makes(3, 1) && !choice("*,1").makes(3, 2) && !choice("*,1").merges());
  EXPECT_TRUE(choice("merged").merges() && !choice("merged").makes(1, 2));
  EXPECT_FALSE(choice("2,3,raw").weighted);
  EXPECT_FALSE(choice("all,raw").weighted);
  for (const char* text : {"technique=", "technique=1", "technique=1,0", "technique=-1,2",
                           "technique=1,2,3", "technique=raw", "technique=1,2,weighted"})
    EXPECT_THROW(parse_setting(text), UsageError) << text;
}

TEST(IntegratorSettings, DocumentedDefaultsAreTheRealOnes) {
  const IntegratorOptions defaults;
  for (const IntegratorSetting& setting : integrator_settings()) {
    const std::string text = setting.default_text;
    EXPECT_EQ(text.substr(0, text.find(',')), setting.print(defaults)) << setting.key;
  }
}

TEST(IntegratorSettings, Errors) {
  for (const char* text : {"max-depth", "=3", "depth=3", "MAX-DEPTH=3", ""}) {
    try {
      parse_setting(text);
      ADD_FAILURE() << text;
    } catch (const UsageError& error) {
      // All keys are listed.
      for (const IntegratorSetting& setting : integrator_settings())
        EXPECT_NE(std::string(error.what()).find(setting.key), std::string::npos) << error.what();
    }
  }
  for (const char* text :
       {"max-depth=", "max-depth=-1", "max-depth=1.5", "radius=-1", "alpha=0", "alpha=1.1",
        "photons=-1", "specular-alpha=2", "specular-alpha=0.1..", "specular-alpha=0.2..0.1",
        "memory-photons=0", "texture-cache=", "texture-cache=M", "texture-cache=1T",
        "texture-cache=-1", "texture-cache=2000G", "texture-cache=nan"})
    EXPECT_THROW(parse_setting(text), UsageError) << text;
}

TEST(IntegratorSettings, SceneDepthIsTakenAndRadiusIsNot) {
  const IntegratorChoice choice = choose_integrator("mixed", "sppm", pbrt_sppm(), {});
  EXPECT_EQ(choice.name, "mixed");
  EXPECT_EQ(choice.options.max_depth, 12);
  EXPECT_EQ(choice.options.radius, IntegratorOptions().radius);
  EXPECT_EQ(choice.options.photons_per_pass, IntegratorOptions().photons_per_pass);
  EXPECT_TRUE(has_note(choice, "radius"));
  EXPECT_FALSE(has_note(choice, "maxdepth"));
}

TEST(IntegratorSettings, ScenePhotonCountOnlyWithTheScenesIntegrator) {
  const IntegratorChoice choice = choose_integrator("scene", "sppm", pbrt_sppm(), {});
  EXPECT_EQ(choice.name, integrator_for_scene_name("sppm"));
  EXPECT_EQ(choice.options.photons_per_pass, 5000);
}

TEST(IntegratorSettings, CommandLineIsOverTheScene) {
  const IntegratorChoice choice = choose_integrator(
      "scene", "sppm", pbrt_sppm(), {{"max-depth", "3"}, {"photons", "7"}, {"max-depth", "4"}});
  EXPECT_EQ(choice.options.max_depth, 4);
  EXPECT_EQ(choice.options.photons_per_pass, 7);
}

TEST(IntegratorSettings, SceneWithoutDepthIsNoted) {
  EXPECT_TRUE(has_note(choose_integrator("mixed", "path", {}, {}), "maxdepth"));
  EXPECT_FALSE(has_note(choose_integrator("mixed", "path", {}, {{"max-depth", "5"}}), "maxdepth"));
}

TEST(IntegratorSettings, SceneWithoutAnEquivalent) {
  EXPECT_THROW(choose_integrator("scene", "function", {}, {}), UsageError);
  EXPECT_EQ(choose_integrator("scene", "", {}, {}).name, integrator_for_scene_name("volpath"));
}

}  // namespace
}  // namespace nephroid

// The keys of -D and their values.
#include "session/settings/integrator_settings.h"

#include <gtest/gtest.h>

#include "integrator/bidirectional/technique_choice.h"
#include "integrator/learning/guiding_options.h"
#include "integrator/metropolis/metropolis_options.h"
#include "integrator/path/path_options.h"
#include "integrator/photon_mapping/photon_map.h"
#include "integrator/photon_mapping/ppm.h"
#include "integrator/virtual_lights/point_lights.h"

namespace nephroid {
namespace {

// The text identifies settings: pictures of one render must have the same.
TEST(IntegratorSettings, WhatDiffersHasAnotherText) {
  for (const std::string key : {"alpha", "radius", "specular-alpha", "mutations", "large-step"}) {
    RenderSettings a, b;
    apply_settings({parse_setting(key + "=0.6667")}, &a);
    apply_settings({parse_setting(key + "=0.66670007")}, &b);
    EXPECT_NE(settings_text(a), settings_text(b)) << key;
  }
  RenderSettings said;
  apply_settings({parse_setting("alpha=0.6666667")}, &said);
  EXPECT_EQ(said.integrator.shrink_alpha, IntegratorOptions().shrink_alpha);
}

TEST(IntegratorSettings, EveryKeyIsStoredWhereItBelongs) {
  RenderSettings s;
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
                 &s);
  EXPECT_EQ(s.integrator.max_depth, 7);
  EXPECT_EQ(s.integrator.radius, 1.5f);
  EXPECT_EQ(s.integrator.photons_per_pass, 1000);
  EXPECT_EQ(s.integrator.shrink_alpha, 0.75f);
  EXPECT_EQ(s.scene.specular_band.low, 0.2f);
  EXPECT_EQ(s.scene.specular_band.high, 0.2f);
  EXPECT_EQ(s.integrator.camera_samples_per_pass, 3);
  EXPECT_EQ(s.integrator.own<PointLightsOptions>().connections, 5);
  EXPECT_EQ(s.integrator.own<PpmOptions>().hit_points, 6);
  EXPECT_EQ(s.integrator.own<PhotonMapOptions>().map_photons, 5000);
  EXPECT_EQ(s.integrator.own<PhotonMapOptions>().nearest_photons, 40);
  EXPECT_EQ(s.integrator.memory_photons, 99);
  EXPECT_EQ(s.scene.outlier_neighbours, 5);
  EXPECT_EQ(s.integrator.own<MetropolisOptions>().mutations, 2.5f);
  EXPECT_EQ(s.integrator.own<MetropolisOptions>().chain_length, 77);
  EXPECT_EQ(s.integrator.own<MetropolisOptions>().large_step, 0.25f);
  EXPECT_FALSE(s.integrator.own<GuidingOptions>().photons);
  EXPECT_FALSE(s.integrator.own<GuidingOptions>().walks);
  EXPECT_TRUE(s.integrator.own<PathOptions>().specular_trees);
  EXPECT_EQ(s.scene.texture_memory, 1536u * 1024);
  EXPECT_EQ(settings_text(s),
            "max-depth=7 photons=1000 camera-samples=3 radius=1.5 specular-alpha=0.2 alpha=0.75 "
            "memory-photons=99 outlier-neighbours=5 texture-cache=1536K specular-trees=yes "
            "guide=no technique=2,3,raw guide-walks=no mutations=2.5 chain-length=77 "
            "large-step=0.25 map-photons=5000 nearest=40 hit-points=6 point-lights=5");
}

TEST(IntegratorSettings, SpecularAlphaMayBeARange) {
  RenderSettings s;
  apply_settings({parse_setting("specular-alpha=0.01..0.2")}, &s);
  EXPECT_EQ(s.scene.specular_band.low, 0.01f);
  EXPECT_EQ(s.scene.specular_band.high, 0.2f);
  EXPECT_NE(settings_text(s).find(" specular-alpha=0.01..0.2 "), std::string::npos);
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
    RenderSettings s;
    apply_settings({parse_setting("technique=" + text)}, &s);
    EXPECT_NE(settings_text(s).find(" technique=" + text + " "), std::string::npos) << text;
    return s.integrator.own<TechniqueChoice>();
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
  const RenderSettings defaults;
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
      // The message lists all keys.
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

TEST(IntegratorSettings, ALimitOfMemoryBoundsCaches) {
  constexpr uint64_t kMiB = 1 << 20;
  const RenderSettings limited = render_settings({}, 256 * kMiB);
  EXPECT_EQ(limited.scene.texture_memory, 64 * kMiB);
  EXPECT_EQ(limited.integrator.memory_photons, static_cast<int64_t>(64 * kMiB / kBytesPerPhoton));
  EXPECT_TRUE(limited.given.empty());
  const RenderSettings told = render_settings({{"texture-cache", "2G"}}, 256 * kMiB);
  EXPECT_EQ(told.scene.texture_memory, 2048 * kMiB);
  EXPECT_TRUE(told.gives("texture-cache"));
  EXPECT_EQ(settings_text(render_settings({}, uint64_t{1} << 40)), settings_text(RenderSettings()));
}

}  // namespace
}  // namespace nephroid

// Keys of -D that no estimator uses are reported; all others are not.
#include "session/settings/unused_settings.h"

#include <gtest/gtest.h>

#include "rendering.h"
#include "session/settings/integrator_settings.h"

namespace nephroid {
namespace {

using namespace testing_support;

std::vector<std::string> warnings(const SettingList& settings, const Plan& plan) {
  const auto scene = scene_from_text(R"(Film "rgb" "integer xresolution" 4 "integer yresolution" 4
    WorldBegin LightSource "point" Shape "sphere")");
  return unused_settings(render_settings(settings).given,
                         *make_estimators(plan, {}, *scene).routes);
}

TEST(UnusedSettings, AreSaid) {
  EXPECT_EQ(
      warnings({{"hit-points", "9"}, {"max-depth", "4"}}, "mixed"),
      std::vector<std::string>{"-D hit-points changes nothing here: no route is rendered by ppm"});
  EXPECT_EQ(warnings({{"technique", "1,2"}}, "mixed"),
            std::vector<std::string>{
                "-D technique changes nothing here: no route is rendered by bdpt, vcm, bpm"});
  EXPECT_EQ(warnings({{"guide", "no"}, {"mutations", "3"}}, "vcm").size(), 2u);
  EXPECT_EQ(warnings({{"specular-trees", "yes"}}, "pssmlt").size(), 1u);
}

TEST(UnusedSettings, OthersAreNot) {
  EXPECT_TRUE(warnings({{"hit-points", "9"}}, "ppm").empty());
  EXPECT_TRUE(warnings({{"technique", "1,2"}}, "bdpt").empty());
  EXPECT_TRUE(warnings({{"guide", "no"}, {"photons", "3"}}, "mixed").empty());
}

}  // namespace
}  // namespace nephroid

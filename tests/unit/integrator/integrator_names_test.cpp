// Integrators by name: the table's own names and those of pbrt-v4 scenes.
#include <gtest/gtest.h>

#include "integrator/presets/integrator_table.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

TEST(Integrators, AreFoundByName) {
  const auto scene = scene_from_text(R"(WorldBegin LightSource "point")");
  for (const std::string& name : integrator_names()) {
    const EstimatorSet set = make_integrator(name, {}, *scene);
    EXPECT_FALSE(set.estimators.empty()) << name;
    EXPECT_FALSE(set.layout.routes.empty()) << name;
  }
  EXPECT_THROW(make_integrator("metropolis", {}, *scene), UsageError);
  EXPECT_EQ(integrator_for_scene_name("volpath"), "path");
  EXPECT_EQ(integrator_for_scene_name("bdpt"), "bdpt");
  EXPECT_EQ(integrator_for_scene_name("metropolis"), "");
}

}  // namespace
}  // namespace nephroid

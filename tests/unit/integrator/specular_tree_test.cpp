// Specular trees grow only for routes and techniques that own their light.
// tests/agreement/specular_tree_test.cpp tests that they find all of it.
#include "integrator/path/specular_tree.h"

#include <gtest/gtest.h>

#include "ball_in_a_medium.h"
#include "integrator/bidirectional/path_pair.h"
#include "owned_routes.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

TEST(SpecularTree, IsNoPartOfTechniquesAskedForOneByOne) {
  const auto scene = scene_from_text(ball(kClear, ""));
  const OwnedRoutes owned = owned_routes(*scene, {"all=.*:vcm"});
  const auto grows = [&](const TechniqueChoice& technique, bool merges_only = false) {
    PairSettings settings{*scene, owned};
    settings.technique = technique;
    settings.merges_only = merges_only;
    return settings.has_trees();
  };
  EXPECT_TRUE(grows({}));
  EXPECT_FALSE(grows({}, true)) << "walks again for more photons";
  EXPECT_FALSE(grows({.s = 0, .t = 3}));
  EXPECT_FALSE(grows({.connects = false})) << "merged";
}

TEST(SpecularTree, IsGrownForRoutesThatOwnItsLight) {
  const auto scene = scene_from_text(ball(kClear, R"(Material "dielectric")"));
  const std::string rest = "rest=.*:path";
  for (const auto& [route, finds] : {std::pair{"of=CS+L:photons+light", true},
                                     {"of=C.*D.*L:photons+light", false},
                                     {"of=CS*L:photons+light", true},
                                     {"of=CL:photons+light", false}}) {
    const OwnedRoutes owned = owned_routes(*scene, {route, rest});
    EXPECT_EQ(SpecularTree(*scene, owned, 20).finds_something(), finds) << route;
  }
}

}  // namespace
}  // namespace nephroid

// The example of docs/how-to/add-an-integrator.md: the page quotes it verbatim, its picture equals
// that of path tracing for the same routes, and it reports what it cannot find.
#include <gtest/gtest.h>

#include "how_to/direct_lighting.h"
#include "integrator/presets/estimator_set.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

/// The table of estimators with one more row.
std::vector<const EstimatorDescriptor*> longer_table() {
  std::vector<const EstimatorDescriptor*> table(estimator_table().begin(), estimator_table().end());
  table.push_back(&DirectLighting::kDescriptor);
  return table;
}

RoutePlan plan_with_direct(const std::vector<std::string>& routes) {
  std::vector<const EstimatorTraits*> traits(estimator_traits().begin(), estimator_traits().end());
  traits.push_back(&DirectLighting::kDescriptor.traits);
  RoutePlan plan;
  for (const std::string& route : routes) plan.routes.push_back(parse_route(route, traits));
  return plan;
}

std::unique_ptr<Scene> world() {
  return scene_from_text(R"(
    LookAt 0 2 -4  0 0.5 0  0 1 0
    Camera "perspective" "float fov" 50
    Film "rgb" "integer xresolution" 24 "integer yresolution" 16
    WorldBegin
    LightSource "infinite" "rgb L" [0.2 0.3 0.4]
    AttributeBegin
      Translate 1 3 0 Rotate 90 1 0 0
      AreaLightSource "diffuse" "rgb L" [9 8 7] "bool twosided" true
      Shape "disk" "float radius" 0.5
    AttributeEnd
    Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
    Shape "bilinearmesh" "point3 P" [-3 0 -3  3 0 -3  -3 0 3  3 0 3]
    Material "conductor" "float roughness" 0.5
    AttributeBegin Translate -0.8 0.5 0 Shape "sphere" "float radius" 0.5 AttributeEnd
    Material "dielectric"
    AttributeBegin Translate 0.8 0.5 0 Shape "sphere" "float radius" 0.5 AttributeEnd)");
}

TEST(AddAnIntegrator, TheExampleStandsInTheDocumentation) {
  const std::string page = read_source_file("docs/how-to/add-an-integrator.md");
  for (const char* file : {"direct_lighting.h", "direct_lighting.cpp"}) {
    const std::string source = read_source_file(std::string("tests/how_to/") + file);
    EXPECT_NE(page.find("```cpp\n" + source + "```\n"), std::string::npos)
        << file << " is not in the page as it is";
  }
}

TEST(AddAnIntegrator, TheExampleRendersWhatPathTracingDoes) {
  const auto scene = world();
  const auto means = [&](const std::string& estimator, uint64_t first_seed) {
    return values_over_seeds(32, first_seed, [&](uint64_t seed) {
      const auto table = longer_table();
      EstimatorSet set = make_estimators(
          plan_with_direct({"direct=C[DG]?L:" + estimator, "rest=.*:path"}), {}, *scene, table);
      Film film = film_for(*scene, set);
      for (uint32_t pass = 0; pass < 16; ++pass) set.render_pass({seed, pass}, *scene, film);
      std::vector<double> blocks;
      const PixelBounds& b = film.bounds();
      for (int block = 0; block < 6; ++block) {
        double sum = 0;
        for (int y = 0; y < 8; ++y)
          for (int x = 0; x < 8; ++x)
            sum += film.route_value(0, b.x0 + block % 3 * 8 + x, b.y0 + block / 3 * 8 + y).g;
        blocks.push_back(sum / 64);
      }
      return blocks;
    });
  };
  const SeedValues direct = means("direct", 1), path = means("path", 100);
  for (size_t block = 0; block < direct.size(); ++block) {
    const Estimate a = estimate_of(direct[block]), b = estimate_of(path[block]);
    EXPECT_NEAR(a.mean, b.mean, kT31 * std::hypot(a.error, b.error)) << "block " << block;
    EXPECT_LT(a.error, max_error(0.01 * a.mean)) << "block " << block;
  }
}

TEST(AddAnIntegrator, TheExampleSaysWhatItCannotFind) {
  const auto scene = world();
  const auto table = longer_table();
  const auto warnings_of = [&](const std::vector<std::string>& routes) {
    return make_estimators(plan_with_direct(routes), {}, *scene, table).warnings;
  };
  EXPECT_TRUE(warnings_of({"direct=C[DG]?L:direct", "rest=.*:path"}).empty());
  const auto of_mirrors = warnings_of({"direct=C.?L:direct", "rest=.*:path"});
  ASSERT_EQ(of_mirrors.size(), 1u);
  EXPECT_NE(of_mirrors[0].find("looks for lights at rough surfaces only"), std::string::npos);
  const auto of_all = warnings_of({"all=.*:direct"});
  ASSERT_EQ(of_all.size(), 1u);
  EXPECT_NE(of_all[0].find("which it cannot find"), std::string::npos) << of_all[0];
}

}  // namespace
}  // namespace nephroid

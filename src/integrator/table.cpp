// The one table of integrators: name -> routes and the estimators that own them.
#include "core/errors.h"
#include "integrator/caustic_photons.h"
#include "integrator/path.h"
#include "integrator/sppm.h"
#include "scene/scene.h"

namespace nephroid {

namespace {

Preset make_path(const IntegratorOptions& options, const Scene&) {
  Preset preset;
  preset.route_names = {"diffuse"};
  preset.estimators.push_back(
      std::make_unique<PathEstimator>(Routes::all(Route::kDiffuse), Route::kDiffuse, 0, options));
  return preset;
}

Preset make_sppm(const IntegratorOptions& options, const Scene& scene) {
  const Routes routes = Routes::seen_emission().restricted_to(
      scene.has_volume_events ? ClassMask::kAll | ClassMask::kVolume : ClassMask::kAll);
  Preset preset;
  preset.route_names = {"emission", "photons"};
  preset.estimators.push_back(std::make_unique<PathEstimator>(routes, Route::kDiffuse, 0, options));
  preset.estimators.push_back(std::make_unique<Sppm>(1, options));
  return preset;
}

Preset make_mixed(const IntegratorOptions& options, const Scene&) {
  const Routes routes = Routes::doidge2012();
  Preset preset;
  preset.route_names = {"diffuse", "caustic"};
  preset.estimators.push_back(std::make_unique<PathEstimator>(routes, Route::kDiffuse, 0, options));
  preset.estimators.push_back(
      std::make_unique<CausticPhotons>(routes, Route::kCaustic, 1, options));
  return preset;
}

struct Row {
  const char* name;
  Preset (*make)(const IntegratorOptions&, const Scene&);
};
constexpr Row kTable[] = {{"mixed", make_mixed}, {"path", make_path}, {"sppm", make_sppm}};

// pbrt-v4's integrators and what stands for them here.
struct SceneName {
  const char* pbrt;
  const char* name;
};
constexpr SceneName kSceneNames[] = {
    {"path", "path"},          {"volpath", "path"},    {"simplepath", "path"},
    {"simplevolpath", "path"}, {"randomwalk", "path"}, {"sppm", "sppm"},
    {"bdpt", "mixed"},         {"mlt", "mixed"},       {"lightpath", "mixed"}};

}  // namespace

std::vector<std::string> integrator_names() {
  std::vector<std::string> names;
  for (const Row& row : kTable) names.emplace_back(row.name);
  return names;
}

std::string integrator_for_scene_name(const std::string& pbrt_name) {
  for (const SceneName& row : kSceneNames)
    if (pbrt_name == row.pbrt) return row.name;
  return {};
}

Preset make_integrator(const std::string& name, const IntegratorOptions& options,
                       const Scene& scene) {
  for (const Row& row : kTable)
    if (name == row.name) return row.make(options, scene);
  std::string expected;
  for (const Row& row : kTable) expected += std::string(expected.empty() ? "" : ", ") + row.name;
  throw UsageError("integrator \"" + name + "\" is unknown, expected one of " + expected);
}

}  // namespace nephroid

// The table of integrators: names with their route presets, and the substitutes for the scene
// format's integrators.
#include "integrator/presets/integrator_table.h"

#include "core/errors.h"
#include "integrator/presets/route_presets.h"

namespace nephroid {

namespace {

struct IntegratorRow {
  const char* name;
  const char* preset;  ///< name of the route preset
};
constexpr IntegratorRow kTable[] = {{"mixed", "mixed"},
                                    {"path", "path-only"},
                                    {"sppm", "sppm"},
                                    {"photonmap", "photonmap"},
                                    {"ppm", "ppm"},
                                    {"bdpt", "bdpt"},
                                    {"vcm", "vcm"},
                                    {"bpm", "bpm"},
                                    {"pssmlt", "pssmlt"},
                                    {"mlt", "mlt"},
                                    {"pointlights", "pointlights"},
                                    {"forecast", "forecast"},
                                    {"doidge2012", "doidge2012"}};

constexpr const char* kOwnChoice = "the program's own choice, with the same picture";

constexpr FormatParameter kDepth[] = {
    {"integer", "maxdepth", "100 (pbrt-v4: 5)", "",
     "scattering events of the whole path, in every integrator; at least 0"}};
constexpr FormatParameter kLightSampler[] = {
    {"string", "lightsampler", "bvh", "", kOwnChoice, Support::kNotNeeded}};
constexpr FormatParameter kRegularize[] = {
    {"bool", "regularize", "false", "", "caustics are rendered without it", Support::kWarned}};
constexpr FormatParameter kSimplePath[] = {
    {"bool", "samplebsdf", "true", "", kOwnChoice, Support::kNotNeeded},
    {"bool", "samplelights", "true", "", kOwnChoice, Support::kNotNeeded},
};
constexpr FormatParameter kBdpt[] = {
    {"bool", "visualizestrategies", "false", "", "of pbrt-v4's method", Support::kNotNeeded},
    {"bool", "visualizeweights", "false", "", "of pbrt-v4's method", Support::kNotNeeded},
};
constexpr FormatParameter kMlt[] = {
    {"integer", "bootstrapsamples", "100000", "", "of pbrt-v4's method", Support::kNotNeeded},
    {"integer", "chains", "1000", "", "of pbrt-v4's method", Support::kNotNeeded},
    {"integer", "mutationsperpixel", "100", "", "of pbrt-v4's method", Support::kNotNeeded},
    {"float", "largestepprobability", "0.3", "", "of pbrt-v4's method", Support::kNotNeeded},
    {"float", "sigma", "0.01", "", "of pbrt-v4's method", Support::kNotNeeded},
};
constexpr FormatParameter kSppm[] = {
    {"integer", "photonsperiteration", "chosen by the program", "paths",
     "with --integrator scene; 0 and less leave the choice to the program"},
    {"float", "radius", "chosen by the program", "scene units",
     "radii are chosen by the size of a pixel (-D radius=PIXELS)", Support::kWarned},
    {"integer", "seed", "6502", "", "the sampler's seed counts", Support::kNotNeeded},
};
constexpr FormatParameter kAmbientOcclusion[] = {
    {"bool", "cossample", "true", "", "of pbrt-v4's method", Support::kNotNeeded},
    {"float", "maxdistance", "infinity", "scene units", "of pbrt-v4's method", Support::kNotNeeded},
};
constexpr FormatParameter kFunction[] = {
    {"string", "function", "step", "", "of pbrt-v4's method", Support::kNotNeeded},
    {"string", "filename", "FUNCTION-mse.txt", "", "of pbrt-v4's method", Support::kNotNeeded},
    {"bool", "skipbad", "true", "", "of pbrt-v4's method", Support::kNotNeeded},
    {"string", "imagefilename", "none", "", "of pbrt-v4's method", Support::kNotNeeded},
};

// The format's integrators and their substitutes. The refused ones are errors only if the scene's
// integrator is asked for.
struct SceneRow : FormatType {
  const char* own_name;
};
constexpr SceneRow kSceneTable[] = {
    {{"path", {kDepth, kLightSampler, kRegularize}, "path"}, "path"},
    {{"volpath", {kDepth, kLightSampler, kRegularize}, "path; the default"}, "path"},
    {{"simplepath", {kDepth, kSimplePath}, "path"}, "path"},
    {{"simplevolpath", {kDepth}, "path"}, "path"},
    {{"randomwalk", {kDepth}, "path"}, "path"},
    {{"sppm", {kDepth, kSppm}, "sppm"}, "sppm"},
    {{"bdpt", {kDepth, kLightSampler, kRegularize, kBdpt}, "bdpt"}, "bdpt"},
    {{"mlt", {kDepth, kRegularize, kMlt}, "mlt"}, "mlt"},
    {{"lightpath", {kDepth}, "mixed"}, "mixed"},
    {{"ambientocclusion",
      {kAmbientOcclusion},
      "an error with --integrator scene; it draws no light",
      Support::kRefused},
     ""},
    {{"function",
      {kFunction},
      "an error with --integrator scene; it draws no scene",
      Support::kRefused},
     ""},
};

}  // namespace

std::vector<std::string> integrator_names() {
  std::vector<std::string> names;
  for (const IntegratorRow& row : kTable) names.emplace_back(row.name);
  return names;
}

std::string integrator_for_scene_name(const std::string& pbrt_name) {
  const SceneRow* row = find_row(kSceneTable, pbrt_name);
  return row ? row->own_name : "";
}

std::vector<FormatType> scene_integrator_types() {
  return format_types(kSceneTable);
}

RoutePlan plan_of_integrator(const std::string& name) {
  for (const IntegratorRow& row : kTable)
    if (name == row.name) return {*route_preset(row.preset), {}, false};
  std::string expected;
  for (const IntegratorRow& row : kTable)
    expected += std::string(expected.empty() ? "" : ", ") + row.name;
  throw UsageError("integrator \"" + name + "\" is unknown, expected one of " + expected);
}

EstimatorSet make_integrator(const std::string& name, const IntegratorOptions& options,
                             const Scene& scene) {
  return make_estimators(plan_of_integrator(name), options, scene);
}

}  // namespace nephroid

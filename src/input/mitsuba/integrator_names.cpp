#include "input/mitsuba/integrator_names.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "input/mitsuba/parameter_values.h"

namespace nephroid::mitsuba {
namespace {

struct IntegratorRow : Plugin {
  const char* pbrt = nullptr;  ///< name of pbrt-v4; null if there is none
};
using enum PluginSupport;
constexpr const char* kNoMethod = "this renderer has no such method";
constexpr IntegratorRow kIntegrators[] = {
    {{"integrator", "path"}, "path"},
    {{"integrator", "volpath"}, "volpath"},
    {{"integrator", "volpath_simple"}, "volpath"},
    {{"integrator", "volpathmis"}, "volpath"},
    {{"integrator", "prb"}, "path"},
    {{"integrator", "prb_basic"}, "path"},
    {{"integrator", "prbvolpath"}, "volpath"},
    {{"integrator", "direct", kLoaded, "path, with one scattering event"}, "path"},
    {{"integrator", "bdpt"}, "bdpt"},
    {{"integrator", "mlt"}, "mlt"},
    {{"integrator", "pssmlt"}, "mlt"},
    {{"integrator", "erpt"}, "mlt"},
    {{"integrator", "ptracer"}, "lightpath"},
    {{"integrator", "photonmapper"}, "sppm"},
    {{"integrator", "ppm"}, "sppm"},
    {{"integrator", "sppm"}, "sppm"},
    {{"integrator", "adaptive", kLoaded, "the integrator inside of it"}},
    {{"integrator", "irrcache", kLoaded, "the integrator inside of it"}},
    {{"integrator", "multichannel", kLoaded, "the integrator inside of it"}},
    {{"integrator", "aov", kLoaded, "the integrator inside of it"}},
    {{"integrator", "moment", kLoaded, "the integrator inside of it"}},
    {{"integrator", "stokes", kLoaded, "the integrator inside of it"}},
    {{"integrator", "vpl", kIgnored, kNoMethod}},
    {{"integrator", "ao", kIgnored, kNoMethod}},
    {{"integrator", "field", kIgnored, kNoMethod}},
    {{"integrator", "depth", kIgnored, kNoMethod}},
    {{"integrator", "motion", kIgnored, kNoMethod}},
};

/// Mitsuba counts the edges of a path, the renderer its scattering events; -1 is no limit.
void add_depth(PluginProperties& p, const std::string& type, ParameterSet& set) {
  const int depth = p.integer("max_depth", -1);
  if (type == "direct")
    add_integer(set, "maxdepth", 1);
  else if (depth >= 0)
    add_integer(set, "maxdepth", std::max(0, depth - 1));
}

}  // namespace

void write_integrator(ImportContext& context, const Object& object) {
  const auto* const row =
      std::find_if(std::begin(kIntegrators), std::end(kIntegrators),
                   [&](const IntegratorRow& r) { return object.type == r.name; });
  PluginProperties p(object, context);
  if (row != std::end(kIntegrators) && !row->pbrt && row->support == kLoaded) {
    if (const Object* nested = p.first_child("integrator")) write_integrator(context, *nested);
    return;
  }
  if (row == std::end(kIntegrators))
    context.diagnostics.warn(
        object.where, "integrator \"" + object.type +
                          "\" is unknown, expected one of Mitsuba; only its \"max_depth\" is used");
  else if (!row->pbrt)
    context.diagnostics.warn(object.where, "integrator \"" + object.type + "\": " + row->note +
                                               ", only its \"max_depth\" is used");
  const bool is_known = row != std::end(kIntegrators) && row->pbrt;
  DirectiveDescription integrator = directive(is_known ? row->pbrt : "volpath", object.where);
  add_depth(p, object.type, integrator.parameters);
  if (p.boolean("hide_emitters", false)) warn_approximated(p, "emitters are not hidden");
  // Other properties are of Mitsuba's methods.
  context.scene.integrator = std::move(integrator);
}

std::vector<Plugin> integrator_plugins() {
  return std::vector<Plugin>(std::begin(kIntegrators), std::end(kIntegrators));
}

}  // namespace nephroid::mitsuba

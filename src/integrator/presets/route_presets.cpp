// Papers: Doidge, Jones & Mora 2012; Jensen 1996 for caustics of lights only; Dammertz, Keller
// & Lensch 2010; Budge, Anderson & Joy 2008.
#include "integrator/presets/route_presets.h"

#include "integrator/presets/estimator_table.h"

namespace nephroid {

std::span<const RoutePreset> route_presets() {
  static const std::vector<RoutePreset> presets = {
      {"mixed",
       "path tracing of all that can be followed from the lights, whose caustics are photons as "
       "well, both weighed against each other",
       {"emission=C(.*M|.*H.*L):path", "caustic=C.*[DG]S+[DG]?L:path+photons",
        "diffuse=.*:path+photons"}},
      {"doidge2012",
       "caustics of lights and of surfaces that a light shines on are photons, the rest path "
       "tracing",
       {"caustic=C.*[DG]S+[DG]?L:photons", "diffuse=.*:path"}},
      {"doidge-last",
       "the routes of doidge2012, merged where the caustic falls and not where the eye first looks",
       {"caustic=C.*[DG]@S+[DG]?L:photons", "diffuse=.*:path"}},
      {"classic",
       "caustics of lights only are photons, the rest path tracing",
       {"caustic=C.*[DG]S+L:photons", "diffuse=.*:path"}},
      {"split",
       "caustics on what the eye sees directly are traced from the lights, those seen through "
       "specular surfaces are photons",
       {"caustic=C([DGV].*)?[DG]S+[DG]?L:lighttrace", "seen-caustic=CS.*[DG]S+[DG]?L:photons",
        "diffuse=.*:path"}},
      {"vertex",
       "caustics are photons that are both merged and connected to the camera",
       {"caustic=C.*[DG]S+[DG]?L:photons+light", "rest=.*:path"}},
      {"all-photons",
       "all light that meets a rough surface is photons",
       {"emission=C([SV]*L|.*M|.*H.*L):path", "photons=.*:photons"}},
      {"sppm",
       "all light that meets a rough surface is stochastic progressive photon mapping",
       {"emission=C([SV]*L|.*M|.*H.*L):path", "photons=.*:sppm"}},
      {"photonmap",
       "Jensen's photon maps: caustics are read from one directly, what lights a surface by way of "
       "others from another where gather rays end, the rest is path tracing",
       {"caustic=C[SV]*[DG]S+L:photonmap", "indirect=C[SV]*[DG][SV]*[DG]@.*:photonmap",
        "rest=.*:path"}},
      {"photonmap-direct",
       "the same without gather rays: both maps are read where the eye first looks",
       {"caustic=C[SV]*[DG]S+L:photonmap", "global=C[SV]*[DG]S*[DGV].*:photonmap", "rest=.*:path"}},
      {"ppm",
       "all light that meets a rough surface is progressive photon mapping with hit points that "
       "stay",
       {"emission=C([SV]*L|.*M|.*H.*L):path", "photons=.*:ppm"}},
      {"light-only",
       "whatever can be connected to the camera is traced from the lights, the rest path tracing",
       {"light=C([DGV].*L|O):lighttrace", "rest=.*:path"}},
      {"bdpt",
       "all light that can be followed from the lights is bidirectional path tracing",
       {"emission=C(L|.*M|.*H.*L):path", "bdpt=.*:bdpt"}},
      {"vcm",
       "the same by vertex connection and merging",
       {"emission=C(L|.*M|.*H.*L):path", "vcm=.*:vcm"}},
      {"bpm",
       "the same by bidirectional photon mapping",
       {"emission=C(L|.*M|.*H.*L):path", "bpm=.*:bpm"}},
      {"mlt",
       "all light that can be followed from the lights is Metropolis light transport",
       {"emission=C(L|.*M|.*H.*L):path", "mlt=.*:mlt"}},
      {"pssmlt", "everything is path tracing explored by Markov chains", {"light=.*:pssmlt"}},
      {"pointlights",
       "light between diffuse surfaces by virtual point lights, caustics by photons, the rest path "
       "tracing",
       {"caustic=C.*[DG]S+[DG]?L:photons", "diffuse=C[SV]*DD[DG]*L:pointlights", "rest=.*:path"}},
      {"forecast",
       "caustics of lights by path tracing that photons guide, the rest path tracing",
       {"caustic=C.*[DG]S+L:forecast", "diffuse=.*:path"}},
      {"path-only", "everything is path tracing", {"diffuse=.*:path"}},
  };
  return presets;
}

std::optional<std::vector<RouteDefinition>> route_preset(const std::string& name) {
  for (const RoutePreset& preset : route_presets())
    if (name == preset.name) {
      std::vector<RouteDefinition> routes;
      for (const char* text : preset.routes)
        routes.push_back(parse_route(text, estimator_traits(), "preset " + name));
      return routes;
    }
  return std::nullopt;
}

}  // namespace nephroid

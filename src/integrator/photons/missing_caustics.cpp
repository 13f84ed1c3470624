#include "integrator/photons/missing_caustics.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/counted.h"
#include "integrator/photons/photon_pass.h"

namespace nephroid {

namespace {

/// "dielectric1 (FILE:LINE:COLUMN), alpha 0.141; conductor1 ... and 2 more"
std::string list_of_glossy(const std::vector<GlossyMaterial>& materials) {
  constexpr size_t kMaxNamed = 3;
  std::string text;
  for (size_t i = 0; i < std::min(kMaxNamed, materials.size()); ++i) {
    text += (i == 0 ? "" : "; ") + materials[i].name;
    if (materials[i].alpha) text += fmt::format(", alpha {:.3g}", *materials[i].alpha);
  }
  if (materials.size() > kMaxNamed)
    text += fmt::format("; and {} more", materials.size() - kMaxNamed);
  return text;
}

/// `where` says which part of the picture shows these caustics.
std::string note_on_glossy(const OwnedRoutes& owned, const std::string& where) {
  const SceneSymbols& symbols = *owned.symbols;
  const bool one = symbols.glossy_materials().size() == 1;
  return fmt::format(
      "no material of the scene has a specular lobe. An alpha above -D "
      "specular-alpha={:.3g}..{:.3g} makes it glossy: {}. {} caustics are {}",
      symbols.specular_band().low, symbols.specular_band().high,
      list_of_glossy(symbols.glossy_materials()), one ? "Its" : "Their", where);
}

constexpr const char* kNoCaustics =
    "no material of the scene has a specular or glossy lobe: there are no caustics";
constexpr const char* kNoPhotonsNeeded = ", and no photons were needed";

void explain_lost_paths(const OwnedRoutes& owned, EstimatorStatistics& s) {
  const std::string of_all = " of " + counted(s.photon_paths, "photon path") + " ";
  if (s.photon_paths_specular == 0) {
    s.notes.push_back("0" + of_all + "met a specular surface");
    return;
  }
  const std::string met = std::to_string(s.photon_paths_specular) + of_all +
                          "met a specular surface, none reached a diffuse one behind it";
  s.notes.push_back(
      has_events(owned, EventClass::kDiffuse) || has_events(owned, EventClass::kGlossy)
          ? met + " within the maximum path depth (-D max-depth)"
          : met + ": the scene has no diffuse or glossy surface, where photons are merged");
}

}  // namespace

void explain_missing_caustics(const OwnedRoutes& owned, EstimatorStatistics& s) {
  if (has_events(owned, EventClass::kSpecular) && s.photon_paths > 0 &&
      (s.photon_paths_useful == 0 || s.photon_paths_specular == 0))
    explain_lost_paths(owned, s);
}

void explain_glossy_caustics(const OwnedRoutes& owned, bool by_path_tracing,
                             EstimatorStatistics& s) {
  if (has_events(owned, EventClass::kSpecular)) return;
  if (has_events(owned, EventClass::kGlossy))
    s.notes.push_back(note_on_glossy(
        owned, by_path_tracing ? "part of the diffuse light and rendered by path tracing"
                               : "part of the diffuse light"));
  else
    s.notes.push_back(std::string(kNoCaustics) + (by_path_tracing ? kNoPhotonsNeeded : ""));
}

void explain_darkness(const OwnedRoutes& owned, uint64_t found, EstimatorStatistics& s) {
  if (!photons_can_count(owned)) {
    if (has_events(owned, EventClass::kSpecular))
      s.notes.push_back("no path in this scene can belong to " + names_of_routes(owned) +
                        ", so no photons were traced for it");
    else if (has_events(owned, EventClass::kGlossy))
      s.notes.push_back(note_on_glossy(owned, "light of other routes"));
    else
      s.notes.push_back(std::string(kNoCaustics) + kNoPhotonsNeeded);
    return;
  }
  if (found > 0 || s.photon_paths == 0) return;
  if (s.photons_stored > 0) {
    // A pass may have been stopped before camera paths looked for photons.
    if (s.camera_paths > 0)
      s.notes.push_back(counted(s.photons_stored, "photon") +
                        " stored, none near a point that the camera sees");
  } else if (deposits_at_once(owned)) {
    s.notes.push_back("none of " + counted(s.photon_paths, "photon path") +
                      " met a surface where its route merges photons");
  } else {
    explain_lost_paths(owned, s);
  }
}

}  // namespace nephroid

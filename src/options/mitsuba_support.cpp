#include "options/mitsuba_support.h"

#include <fmt/format.h>

#include "input/mitsuba/plugin_tables.h"

namespace nephroid {
namespace {

using mitsuba::Plugin;
using mitsuba::PluginSupport;

constexpr const char* kMitsubaHead = R"(# Mitsuba scenes

Made from the tables of the importer by `tools/update_docs`; do not edit.

A file whose name ends in `.xml` is read as a scene of Mitsuba 0.5, 0.6, 2 or 3. `nephroid convert scene.xml scene.pbrt`
writes the imported scene in the format of pbrt-v4. Each plug-in is

- **loaded**: as in Mitsuba, except for what its line says (of integrators the nearest one here);
- **approximated**: loaded with a warning;
- **ignored**: left out with a warning;
- **refused**: an error with its line and column.

A property that a plug-in does not have is a warning, and an error with `--strict`. Names of properties may be written as in
Mitsuba 0.6 (`intIOR`) or as in Mitsuba 3 (`int_ior`), in scenes of any version.

- `<default>` values are replaced by `--define NAME=VALUE`. `<include>`, `<ref>` and `<alias>` are followed; objects may be used before
  they are defined.
- Files lie in the scene's folder or below it; `--allow-outside` permits others. They are looked up in the folders of `<path>`
  first.
- `--camera` chooses a sensor by its id or its index from 0. By default it is the first.
- The scene's integrator is used with `--integrator scene` only; its `max_depth` always counts.
)";

constexpr const char* kMitsubaTail = R"(
## Conventions

| what | Mitsuba | here |
| --- | --- | --- |
| camera | looks along local +z with +x to the left | +x to the right: the camera's x axis is mirrored, the world is not |
| angle of view | along x by default (`fov_axis`) | along the shorter side; the picture is the same |
| roughness | `alpha` of Beckmann by default, or GGX | GGX with the same alpha (`remaproughness` false) |
| backs of one-sided BSDFs | black, unless in `twosided` | like the front; a warning counts the open shapes that differ |
| environment maps | +y up, left edge at -z, then +x | the frame of the light is turned accordingly |
| texture coordinates | v = 0 at the upper edge of an image | v = 0 at the lower edge: meshes and mappings are turned over |
| images | sRGB, if they store integers, unless they are `raw` or have a `gamma` | the same, for all uses but normal maps |
| colours of vertices | sRGB in PLY files of 0.6, unless `srgb` is false; else linear | the same; bytes are parts of 255 |
| anisotropy of `principled` | alphas r² / a and r² a with a² = 1 - 0.9 `anisotropic` | the same alphas in the terms of OpenPBR |
| smooth normals | made for meshes without normals | made by the same rule, unless `face_normals` is true |
| mirrored meshes of files without normals | turned over, as normals are made in the world | the same |
| colours | rgb, or spectra in spectral variants | linear sRGB values become smooth spectra; a white emission is D65 |
| a spectrum of one value, as emission | white in 0.6, equal energy in 3 | the same, by the scene's version |
| spectra of wavelengths and black bodies, as emission | absolute | the same luminance |
| plastics | linear in the diffuse colour by default | a base colour with the same reflectance; `nonlinear` is exact |
| path depth | edges of a path | scattering events, one fewer |
| grids of volumes | values at the corners of the box (0.6, 2) or in the middle of cells (3) | by the scene's version |
| daylight | +y up in 0.6, +z up in 3 | by the scene's version |
)";

const char* word_of(PluginSupport support) {
  switch (support) {
    case PluginSupport::kLoaded:
      return "loaded";
    case PluginSupport::kApproximated:
      return "approximated";
    case PluginSupport::kIgnored:
      return "ignored";
    case PluginSupport::kRefused:
      break;
  }
  return "refused";
}

std::string row_of(const Plugin& plugin) {
  const bool has_note = *plugin.note != '\0';
  return fmt::format("| `{}` | {}{}{} |\n", plugin.name, word_of(plugin.support),
                     has_note ? ": " : "", plugin.note);
}

}  // namespace

std::string mitsuba_support_markdown() {
  std::string page = kMitsubaHead, tag;
  for (const Plugin& plugin : mitsuba::plugin_tables()) {
    if (tag != plugin.tag) {
      tag = plugin.tag;
      page += fmt::format("\n## {}\n\n| plug-in | |\n| --- | --- |\n", tag);
    }
    page += row_of(plugin);
  }
  return page + kMitsubaTail;
}

}  // namespace nephroid

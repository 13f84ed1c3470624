#include "options/scene_support.h"

#include <fmt/format.h>

#include <algorithm>

#include "input/directives.h"
#include "input/option_directive.h"
#include "integrator/presets/integrator_table.h"
#include "options/table_cell.h"
#include "scene/camera/camera_table.h"
#include "scene/film_description.h"
#include "scene/light/light_table.h"
#include "scene/material/table.h"
#include "scene/medium/medium_table.h"
#include "scene/pixel_filter.h"
#include "scene/sampler_description.h"
#include "scene/scene_options.h"
#include "scene/shape_table.h"
#include "scene/texture/texture_table.h"

namespace nephroid {
namespace {

constexpr const char* kPbrtHead =
    R"(# What of the pbrt-v4 format is rendered

Made from the tables of the scene loader by `tools/update_docs`; do not edit.

All of the format is read. Each name of it is

- **rendered**: as in pbrt-v4, with its parameters, defaults, units and conventions;
- **not needed**: the picture does not depend on it, it is taken without a word;
- **warned**: ignored with a warning `file:line:column: ...`;
- **refused**: an error with its place.

Names that the format does not have are errors where a picture makes no sense without them (types of
shapes, materials ...) and warnings elsewhere (parameters, options; errors with `--strict`), with the name
that was probably meant. Names of pbrt-v3 are upgraded, with one warning for the whole scene, where the
meaning is the same (`matte`, `glass`, `metal`, `mirror`, `float st`, `mapname` ...: `src/input/pbrt_v3.cpp`
has the table); else the error names the pbrt-v4 way. A parameter that has no effect together with the
others is warned of, too. Values of a wrong type or out of range are errors.

)";

constexpr const char* kPbrtTail = R"(
## Differences by intent

- `maxdepth` counts the scattering events of the whole path, camera and light side together, in every
  integrator, and is 100 where a scene does not say (pbrt-v4: 5).
- Filtered image lookups (trilinear, EWA) are bilinear on the finest level.
- Bump mapping takes differences over half a pixel of the image, or half of the finest octave of
  noise, and over 0.0005 in uv at most (pbrt-v4: over half a pixel of the picture).
- `radius` of an sppm integrator is in world units and is ignored: the first radius comes from the
  pixel's footprint.
- Mirroring a sphere, disk, cylinder or curve mirrors its outside, as it does for meshes and instances.
  In pbrt-v4 a transform that swaps handedness turns their normals around where rays meet them, but not
  where lamps are sampled.
- Infinite lights take latitude-longitude maps, too: +z is at the top and u = phi / (2 pi), as
  pbrt-v4's `imgtool makeequiarea` takes them, whose results look the same.
- Alpha strictly between 0 and 1 on area lights is applied once (pbrt-v4: twice where a ray that a BSDF
  chose hits the light).
- Cameras, shapes and instances move. Shapes that emit light, lights, media and textures stand at the
  start of their motion, with a warning.
- A negative value of a `density`, an emission or a coefficient in a scene file is an error; a negative
  voxel of a NanoVDB file counts as 0.
- The ray tracer does not see a curve that is nearer to the origin of a ray than its width.
- Photons, and the walks that merge them, scatter in media. `mixed` merges photons there if trials
  show that it pays, or if nothing else finds a caustic; other integrators merge at surfaces only.
  Paths that meet hair or another curve (H) are path traced in every integrator.
- Light that a surface reflects stays in its medium, whatever the `MediumInterface` of the surface
  says of that side.
- Realistic cameras cannot be used with routes of `lighttrace` and `photons+light`: light paths cannot be
  connected to them. `bdpt`, `vcm` and `mlt` do without that connection, and warn of light that nothing
  else finds.
- `Option "disablepixeljitter"` does not concern routes of `lighttrace`, `mlt` and `pssmlt`, nor what
  `photons+light`, `bdpt` and `vcm` connect to the camera: that light is always spread by the pixel filter.

## Known faults

- Alpha of instances and of moving shapes is looked up in world space (pbrt-v4: in the space of the
  object). For noise and for mappings other than uv that is another picture.
- A light without any parameter takes the colour space of the whole scene, an area light sRGB
  (pbrt-v4: that of the directive).
- Lamps whose alpha comes from vertex colours are sampled as if it were 1.
- A `displacement` image with `uvset` 1 makes no bumps.
- `principled` can reflect more light than arrives, by up to 44 %, where `specular_ior` is below 1
  or `thin_film_ior` is below the index of what lies over the film.
- Integrators disagree about `subsurface` on surfaces that are inside out: `mixed` was 5 % brighter
  than `path` on a disk and 28 % on a sphere.
)";

const char* word_for(Support support) {
  switch (support) {
    case Support::kRendered:
      return "rendered";
    case Support::kNotNeeded:
      return "not needed";
    case Support::kWarned:
      return "warned";
    case Support::kRefused:
      break;
  }
  return "refused";
}

std::string with_note(const std::string& first, const char* note) {
  return *note ? first + ": " + note : first;
}

/// The types that have the list; "all" if all of several types do.
std::string owners(const std::vector<FormatType>& types, const FormatParameters& list) {
  std::string names;
  bool all = true;
  for (const FormatType& type : types) {
    const bool has = std::any_of(type.parameters.begin(), type.parameters.end(),
                                 [&](const auto& own) { return own.data() == list.data(); });
    if (has) names += (names.empty() ? "" : ", ") + std::string(type.name);
    all = all && has;
  }
  return all && types.size() > 1 ? "all" : names;
}

std::string parameter_cells(const FormatParameter& p, Support least) {
  const Support support = std::max(p.support, least);
  return fmt::format("`{}` | {} | {} | {} | {}", p.name, table_cell(p.type), table_cell(p.fallback),
                     table_cell(p.unit), table_cell(with_note(word_for(support), p.note)));
}

std::string kind_section(const FormatKind& kind) {
  std::string text =
      fmt::format("\n## {}\n\n`{}`. {}\n\n", kind.heading, kind.directive, kind.about);
  text += "| type | |\n| --- | --- |\n";
  for (const FormatType& type : kind.types)
    text += fmt::format("| `\"{}\"` | {} |\n", type.name,
                        table_cell(with_note(word_for(type.support), type.note)));
  text += "\n| of | parameter | type | default | unit | |\n| --- | --- | --- | --- | --- | --- |\n";
  std::vector<const FormatParameter*> written;
  for (const FormatType& type : kind.types) {
    for (const FormatParameters& list : type.parameters) {
      if (list.empty() || std::find(written.begin(), written.end(), list.data()) != written.end())
        continue;
      written.push_back(list.data());
      const Support least =
          type.support == Support::kRefused ? Support::kRefused : Support::kRendered;
      for (const FormatParameter& p : list)
        text += fmt::format("| {} | {} |\n", owners(kind.types, list), parameter_cells(p, least));
    }
  }
  return text;
}

}  // namespace

std::vector<FormatKind> format_kinds() {
  return {
      {"Cameras", "Camera", "All move.", camera_types()},
      {"Films", "Film", "The command line may change resolution and crop.", film_types()},
      {"Pixel filters", "PixelFilter", "Filters are sampled, as in pbrt-v4.", pixel_filter_types()},
      {"Samplers", "Sampler",
       "The number of samples and the seed are taken, the points are the program's own.",
       sampler_types()},
      {"Integrators", "Integrator",
       "With `--integrator scene` the scene's choice; what stands for it here is behind the colon. "
       "Parameters count for the other integrators, too.",
       scene_integrator_types()},
      {"Accelerators", "Accelerator", "Nothing is taken of it.", accelerator_types()},
      {"Shapes", "Shape",
       "All move, and may stand in objects. A transform may swap handedness. Meshes are checked: "
       "indices out of range are errors, faces without area are removed with a warning; so are "
       "normals that are not finite, in whose place the faces have their own. Faces of PLY files "
       "with 5 to 16384 vertices are cut into triangles.",
       shape_types()},
      {"Materials", "Material",
       "Letters are those of the routes (docs/routes.md), per scattering event: S specular, G "
       "glossy, D diffuse, H hair, and on curves H for all of them. Photons merge at D and G.",
       material_types()},
      {"Textures", "Texture",
       "\"Values\" are floats or spectra, by the texture's type. Mappings other than uv and all "
       "noise take points in the space of the Texture directive.",
       texture_types()},
      {"Lights", "LightSource",
       "Colours are divided by their luminance, as in pbrt-v4. Every route ends at a light (L), "
       "whatever its type.",
       light_types()},
      {"Area lights", "AreaLightSource", "Of the shapes that follow.", area_light_types()},
      {"Media", "MakeNamedMedium",
       "Scattering in a medium is the letter V: photons scatter there where routes have it, else "
       "they are dimmed by the transmittance; only `mixed` merges them there.",
       medium_types()},
  };
}

std::string scene_support_markdown() {
  std::string text = kPbrtHead;
  text +=
      "## Directives\n\nAll are rendered.\n\n| directive | arguments | |\n| --- | --- | --- |\n";
  for (const FormatDirective& d : format_directives())
    text +=
        fmt::format("| `{}` | {} | {} |\n", d.name, table_cell(d.arguments), table_cell(d.note));
  text +=
      "\n## Options\n\n`Option`. Names are compared without case, \"-\" and \"_\". Of bools only "
      "true is warned of.\n\n| option | type | default | unit | |\n| --- | --- | --- | --- | --- "
      "|\n";
  for (const FormatParameter& option : format_options())
    text += fmt::format("| {} |\n", parameter_cells(option, Support::kRendered));
  for (const FormatKind& kind : format_kinds()) text += kind_section(kind);
  return text + kPbrtTail;
}

}  // namespace nephroid

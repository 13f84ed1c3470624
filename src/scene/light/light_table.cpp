// Light types by name, see light_table.h.
#include "scene/light/light_table.h"

namespace nephroid {

namespace {

struct Row {
  const char* name;
  LightMaker make;
};
constexpr Row kLights[] = {
    {"point", make_point_light},           {"spot", make_spot_light},
    {"distant", make_distant_light},       {"infinite", make_infinite_light},
    {"projection", make_projection_light}, {"goniometric", make_goniometric_light},
};

LightMaker maker_of(const LightDescription& description) {
  std::string names;
  for (const Row& row : kLights) {
    if (description.type == row.name) return row.make;
    names += (names.empty() ? "\"" : ", \"") + std::string(row.name) + "\"";
  }
  throw SceneError(description.where,
                   "unknown light \"" + description.type + "\", expected one of " + names);
}

}  // namespace

std::vector<LightPtr> make_lights(const SceneDescription& description, Diagnostics& diagnostics) {
  const LightScope scope{description.directory, description.color_space, diagnostics};
  std::vector<LightPtr> lights;
  for (const LightDescription& d : description.lights) {
    const LightMaker make = maker_of(d);
    if (!is_invertible(d.transform.start))
      throw SceneError(d.where, "the transform of this light has no inverse");
    if (d.transform.is_animated())
      diagnostics.warn(d.where,
                       "a light source cannot move, the start of its motion is used");
    lights.push_back(make(d, scope));
    const auto bounds = lights.back()->bounds();
    if (bounds && !(is_in_reach(bounds->bounds.min) && is_in_reach(bounds->bounds.max)))
      throw SceneError(d.where,
                       "light \"" + d.type + "\" is too far away, expected coordinates up to 1e17");
    d.parameters.report_unused("light \"" + d.type + "\"", diagnostics);
  }
  return lights;
}

}  // namespace nephroid

// Medium types by name, see medium_table.h.
#include "scene/medium/medium_table.h"

#include "input/spelling.h"

namespace nephroid {

namespace {

struct Row {
  const char* name;
  MediumMaker make;
};
constexpr Row kMedia[] = {
    {"homogeneous", make_homogeneous_medium}, {"uniformgrid", make_uniform_grid_medium},
    {"rgbgrid", make_rgb_grid_medium},        {"cloud", make_cloud_medium},
    {"nanovdb", make_nanovdb_medium},
};

MediumMaker maker_of(const MediumDescription& description) {
  std::string names;
  for (const Row& row : kMedia) {
    if (description.type == row.name) return row.make;
    names += (names.empty() ? "\"" : ", \"") + std::string(row.name) + "\"";
  }
  throw SceneError(description.where, "unknown medium type \"" + description.type + "\"" +
                                          did_you_mean(description.type, medium_names()) +
                                          " (expected one of " + names + ")");
}

}  // namespace

std::vector<std::string> medium_names() {
  std::vector<std::string> names;
  for (const Row& row : kMedia) names.emplace_back(row.name);
  return names;
}

std::vector<MediumPtr> make_media(const SceneDescription& description, Diagnostics& diagnostics) {
  const MediumScope scope{description.directory};
  std::vector<MediumPtr> media;
  for (const MediumDescription& d : description.media) {
    const MediumMaker make = maker_of(d);
    if (!is_invertible(d.transform.start))
      throw SceneError(d.where, "the transform of medium \"" + d.name + "\" has no inverse");
    if (d.transform.is_animated())
      diagnostics.warn(d.where,
                       "medium \"" + d.name + "\" moves: media stay where they are at the start");
    media.push_back(make(d, scope));
    d.parameters.report_unused("medium \"" + d.name + "\"", diagnostics);
  }
  return media;
}

}  // namespace nephroid

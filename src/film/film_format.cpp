#include "film/film_format.h"

#include <algorithm>
#include <set>
#include <utility>

namespace nephroid {

FilmLayout FilmLayout::of_routes(std::vector<std::string> names) {
  FilmLayout layout;
  for (int r = 0; r < static_cast<int>(names.size()); ++r) {
    layout.parts.push_back({r, {}});
    layout.groups.push_back(r);
  }
  layout.routes = std::move(names);
  return layout;
}

int FilmLayout::group_count() const {
  return groups.empty() ? 0 : *std::max_element(groups.begin(), groups.end()) + 1;
}

std::vector<FilmLayout::GroupLayer> FilmLayout::layers_of_groups() const {
  std::set<GroupLayer> layers;
  for (const Part& part : parts)
    for (const int aov : part.aovs) layers.insert({group_of(part), aov});
  return {layers.begin(), layers.end()};
}

FilmFormat::FilmFormat(const FilmSettings& settings, FilmLayout layout)
    : settings_(settings), layout_(std::move(layout)) {
  if (settings_.crop.width() <= 0 || settings_.crop.height() <= 0)
    settings_.crop = {0, 0, settings_.width, settings_.height};
  parts_of_group_.resize(layout_.group_count());
  for (size_t i = 0; i < layout_.parts.size(); ++i)
    parts_of_group_[layout_.group_of(layout_.parts[i])].push_back(static_cast<int>(i));
}

}  // namespace nephroid

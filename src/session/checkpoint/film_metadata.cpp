#include "session/checkpoint/film_metadata.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "session/checkpoint/render_identity.h"

namespace nephroid {
namespace {

using LayoutJson = nlohmann::json;

/// Upper bound of the compression ratio, that of a block of zeros.
constexpr double kMaxBytesPerByte = 20000;

LayoutJson layout_of(const StateFile& file) {
  return LayoutJson::parse(value_of(file.metadata(), kLayoutKey));
}

[[noreturn]] void senseless(const StateFile& file) {
  throw IoError(file.path() + ": cannot read its state: its description of the film is damaged");
}

}  // namespace

void add_film_metadata(const Film& film, bool passes_add_up, Metadata* metadata) {
  const FilmSettings& settings = film.settings();
  const FilmLayout& layout = film.layout();
  LayoutJson parts = LayoutJson::array();
  for (const FilmLayout::Part& part : layout.parts)
    parts.push_back(LayoutJson::array({part.route, part.aovs}));
  const LayoutJson json = {{"gbuffer", settings.gbuffer},
                           {"space", settings.color_space ? settings.color_space->name() : "srgb"},
                           {"routes", layout.routes},
                           {"aovs", layout.aovs},
                           {"groups", layout.groups},
                           {"merges", layout.merges},
                           {"parts", parts},
                           {"passes_add_up", passes_add_up}};
  metadata->emplace_back(kLayoutKey, json.dump());
}

Metadata picture_metadata_of(Metadata metadata) {
  std::erase_if(metadata, [](const auto& entry) { return entry.first == kLayoutKey; });
  return metadata;
}

Film film_of(const StateFile& file) {
  try {
    const LayoutJson json = layout_of(file);
    FilmSettings settings;
    settings.width = file.resolution().x;
    settings.height = file.resolution().y;
    settings.crop = file.window();
    settings.gbuffer = json.at("gbuffer").get<bool>();
    settings.color_space = RgbColorSpace::find(json.at("space").get<std::string>());
    FilmLayout layout;
    layout.routes = json.at("routes").get<std::vector<std::string>>();
    layout.aovs = json.at("aovs").get<std::vector<std::string>>();
    layout.groups = json.at("groups").get<std::vector<int>>();
    layout.merges = json.at("merges").get<std::vector<bool>>();
    for (const LayoutJson& part : json.at("parts"))
      layout.parts.push_back({part.at(0).get<int>(), part.at(1).get<std::vector<int>>()});
    const auto in = [](int i, size_t count) { return i >= 0 && static_cast<size_t>(i) < count; };
    bool fits = layout.groups.size() == layout.routes.size() && settings.color_space != nullptr &&
                std::all_of(layout.groups.begin(), layout.groups.end(),
                            [&](int g) { return in(g, layout.routes.size()); });
    for (const FilmLayout::Part& part : layout.parts) {
      fits &= in(part.route, layout.routes.size());
      for (const int aov : part.aovs) fits &= in(aov, layout.aovs.size());
    }
    if (!fits) throw std::runtime_error("bad layout");
    const double bytes = static_cast<double>(settings.crop.area()) *
                         static_cast<double>(Film::bytes_per_pixel(layout, settings.gbuffer));
    if (bytes > kMaxBytesPerByte * static_cast<double>(file.size()))
      throw std::runtime_error("bad window");
    return Film(settings, std::move(layout));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    senseless(file);
  }
}

bool passes_add_up(const StateFile& file) {
  try {
    return layout_of(file).at("passes_add_up").get<bool>();
  } catch (const std::exception&) {
    senseless(file);
  }
}

}  // namespace nephroid

#include "session/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "film/exr_file.h"
#include "film/film_output.h"
#include "session/checkpoint.h"

namespace nephroid {
namespace {

using Json = nlohmann::json;

constexpr const char* kLayoutKey = "nephroid:layout";
constexpr int64_t kMostPixels = int64_t{1} << 32;

/// A picture to be merged.
struct Input {
  std::string path;
  std::unique_ptr<StateFile> file;
  PassRanges passes;
};

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw UsageError(path + ": cannot merge: " + what);
}

Input open_input(const std::string& path) {
  Input input{path, std::make_unique<StateFile>(path), {}};
  if (!input.file->has_state())
    throw IoError(path +
                  ": cannot merge: it has no state, expected a picture that was rendered without "
                  "--no-state");
  const auto passes = PassRanges::parse(input.file->value_of("nephroid:passes"));
  if (!passes || passes->empty())
    throw IoError(path + ": cannot merge: it does not say which passes it has");
  input.passes = *passes;
  return input;
}

/// The film of a picture, empty. Throws IoError if its metadata make no sense.
Film film_of(const Input& input) {
  try {
    const Json json = Json::parse(input.file->value_of(kLayoutKey));
    if (!json.at("independent").get<bool>())
      refuse(input.path,
             "the passes of this integrator depend on each other; --resume goes on with it");
    FilmSettings settings;
    const auto size = json.at("size").get<std::vector<int>>();
    const auto crop = json.at("crop").get<std::vector<int>>();
    if (size.size() != 2 || crop.size() != 4) throw std::runtime_error("bad size");
    settings.width = size[0];
    settings.height = size[1];
    settings.crop = {crop[0], crop[1], crop[2], crop[3]};
    const auto extent = [](int a, int b) { return int64_t{b} - a; };
    if (extent(crop[0], crop[2]) <= 0 || extent(crop[1], crop[3]) <= 0 ||
        extent(crop[0], crop[2]) * extent(crop[1], crop[3]) > kMostPixels ||
        input.file->window() != settings.crop)
      throw std::runtime_error("bad crop");
    settings.gbuffer = json.at("gbuffer").get<bool>();
    settings.color_space = RgbColorSpace::find(json.at("space").get<std::string>());
    FilmLayout layout;
    layout.routes = json.at("routes").get<std::vector<std::string>>();
    layout.aovs = json.at("aovs").get<std::vector<std::string>>();
    layout.groups = json.at("groups").get<std::vector<int>>();
    layout.merges = json.at("merges").get<std::vector<bool>>();
    for (const Json& part : json.at("parts"))
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
    return Film(settings, std::move(layout));
  } catch (const Error&) {
    throw;
  } catch (const std::exception&) {
    throw IoError(input.path + ": cannot merge: what it says of its film makes no sense");
  }
}

void check_same_render(const Input& a, const Input& b) {
  const std::vector<std::string> different = differences(*a.file, b.file->metadata());
  if (different.empty()) return;
  std::string list;
  for (const std::string& line : different) list += "\n  " + line;
  refuse(a.path, "it is the picture of another render than " + b.path + ":" + list);
}

}  // namespace

void add_film_metadata(const Film& film, bool independent_passes, Metadata* metadata) {
  const FilmSettings& settings = film.settings();
  const PixelBounds& crop = film.bounds();
  const FilmLayout& layout = film.layout();
  Json parts = Json::array();
  for (const FilmLayout::Part& part : layout.parts)
    parts.push_back(Json::array({part.route, part.aovs}));
  const Json json = {{"size", {settings.width, settings.height}},
                     {"crop", {crop.x0, crop.y0, crop.x1, crop.y1}},
                     {"gbuffer", settings.gbuffer},
                     {"space", settings.color_space ? settings.color_space->name() : "srgb"},
                     {"routes", layout.routes},
                     {"aovs", layout.aovs},
                     {"groups", layout.groups},
                     {"merges", layout.merges},
                     {"parts", parts},
                     {"independent", independent_passes && film.rejection() == nullptr}};
  metadata->emplace_back(kLayoutKey, json.dump());
}

Merged merge_pictures(const std::vector<std::string>& inputs, const std::string& output) {
  std::vector<Input> files;
  for (const std::string& path : inputs) files.push_back(open_input(path));
  // The order of the arguments does not count.
  std::sort(files.begin(), files.end(), [](const Input& a, const Input& b) {
    return a.passes.ranges()[0].first < b.passes.ranges()[0].first;
  });
  Merged merged;
  std::string history;
  for (const Input& input : files) {
    check_same_render(input, files[0]);
    if (const auto both = merged.passes.overlap(input.passes))
      refuse(input.path,
             fmt::format("another picture has passes {}..{}, too", both->first, both->last));
    merged.passes.add(input.passes);
    merged.seconds += std::strtod(input.file->value_of("nephroid:seconds").c_str(), nullptr);
    history += input.file->value_of("nephroid:history");
    const std::string key = "nephroid:instruction_set";
    if (input.file->value_of(key) != files[0].file->value_of(key))
      merged.warnings.push_back(fmt::format(
          "{}: rendered with {}, {} with {}: the last bits of their passes may differ "
          "from those of one run",
          input.path, input.file->value_of(key), files[0].path, files[0].file->value_of(key)));
  }
  Film sum = film_of(files[0]);
  for (const Input& input : files) {
    Film film = film_of(input);
    input.file->load(film.state());
    sum.add(film);
  }
  Metadata metadata;
  for (const auto& [key, value] : files[0].file->metadata()) {
    const bool of_one_run = key == "nephroid:passes" || key == "nephroid:seconds" ||
                            key == "nephroid:history" || key == "nephroid:choices" ||
                            key.starts_with("nephroid:estimates:");
    if (key.starts_with("nephroid:") && !of_one_run) metadata.emplace_back(key, value);
  }
  metadata.emplace_back("nephroid:passes", merged.passes.text());
  metadata.emplace_back("nephroid:seconds", fmt::format("{:.3f}", merged.seconds));
  metadata.emplace_back("nephroid:history", history);
  for (size_t r = 0; r < sum.layout().routes.size(); ++r)
    metadata.emplace_back("nephroid:estimates:" + sum.layout().routes[r],
                          fmt::format("{}", sum.estimates(sum.layout().groups[r])));
  const RenderState state = sum.state();
  write_film(output, sum, std::move(metadata), 1, &state);
  return merged;
}

}  // namespace nephroid

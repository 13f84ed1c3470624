#include "input/obj/mtl_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <utility>

#include "input/number_text.h"
#include "input/obj/ignored_lines.h"
#include "input/obj/mtl_keywords.h"
#include "input/obj/text_lines.h"

namespace nephroid {
namespace {

template <class Map>
auto find_in(const Map& map, const std::string& key) {
  const auto found = map.find(key);
  return found == map.end() ? nullptr : &found->second;
}

/// Options of maps with their largest number of values.
struct MapOption {
  const char* name;
  int values;
  bool is_rendered;
};
constexpr MapOption kMapOptions[] = {
    {"-s", 3, true},      {"-o", 3, true},        {"-bm", 1, true},     {"-clamp", 1, true},
    {"-blendu", 1, true}, {"-blendv", 1, true},   {"-texres", 1, true}, {"-t", 3, false},
    {"-mm", 2, false},    {"-imfchan", 1, false}, {"-cc", 1, false},    {"-boost", 1, false},
    {"-type", 1, false},
};

class MtlReader {
 public:
  MtlReader(const std::string& path, Diagnostics& diagnostics)
      : path_(std::make_shared<const std::string>(path)),
        diagnostics_(diagnostics),
        ignored_(path_, mtl_keywords(), diagnostics) {}

  std::map<std::string, MtlMaterial> read(std::string_view bytes) {
    TextLines lines(bytes);
    for (TextLine line; lines.next(&line);) {
      line_ = line.number;
      read_line(line.text);
    }
    ignored_.report();
    return std::move(materials_);
  }

 private:
  SourceLocation here() const { return {path_, line_, 0}; }
  [[noreturn]] void fail(const std::string& message) const { throw SceneError(here(), message); }
  void warn(const std::string& message) { diagnostics_.warn(here(), message); }

  void read_line(std::string_view text);
  void begin_material(const std::string& name);
  double read_number(const std::string& keyword, std::string_view word) const;
  void read_color(const std::string& name, std::string_view text);
  void read_value(const std::string& name, std::string_view text);
  void read_map(const std::string& name, std::string_view text);
  /// Reads the values of an option from the front of `text`.
  void read_option(const MapOption& option, std::string_view* text, MtlMap* map);

  std::shared_ptr<const std::string> path_;
  Diagnostics& diagnostics_;
  IgnoredLines ignored_;
  int line_ = 0;
  std::map<std::string, MtlMaterial> materials_;
  MtlMaterial* current_ = nullptr;
};

void MtlReader::read_line(std::string_view text) {
  const std::string keyword(take_word(&text));
  if (keyword == "newmtl") return begin_material(std::string(stripped(text)));
  const MtlKeyword* known = find_mtl_keyword(keyword);
  if (!known || known->values == MtlKeyword::Values::kNone) return ignored_.add(keyword, line_);
  if (!current_) return warn("\"" + keyword + "\" is ignored: it stands before the first newmtl");
  switch (known->values) {
    case MtlKeyword::Values::kColor:
      return read_color(known->canonical, text);
    case MtlKeyword::Values::kNumber:
      return read_value(known->canonical, text);
    default:
      return read_map(known->canonical, text);
  }
}

void MtlReader::begin_material(const std::string& name) {
  const auto [entry, is_new] = materials_.try_emplace(name);
  if (!is_new)
    warn("material \"" + name + "\" was already given at " + entry->second.where.to_string() +
         ", the last one counts");
  entry->second = {};
  entry->second.name = name;
  entry->second.where = here();
  current_ = &entry->second;
}

double MtlReader::read_number(const std::string& keyword, std::string_view word) const {
  if (word.empty()) fail("\"" + keyword + "\" has no number, expected one");
  const std::optional<double> value = parse_number(word);
  if (!value || !std::isfinite(static_cast<float>(*value)))
    fail("\"" + std::string(word) + "\" is not a number, expected a finite one");
  return *value;
}

/// One number stands for three. Spectral files and xyz are not read.
void MtlReader::read_color(const std::string& name, std::string_view text) {
  std::string_view word = take_word(&text);
  if (word == "spectral" || word == "xyz")
    return warn("\"" + name + " " + std::string(word) + "\" is ignored, expected three numbers");
  MtlMaterial::Color color{};
  color.fill(std::max(0.0, read_number(name, word)));
  for (size_t i = 1; i < color.size(); ++i) {
    word = take_word(&text);
    if (word.empty() && i == 1) break;
    if (word.empty()) fail("\"" + name + "\" has 2 numbers, expected 3 or 1");
    color[i] = std::max(0.0, read_number(name, word));
  }
  current_->colors[name] = color;
}

void MtlReader::read_value(const std::string& name, std::string_view text) {
  std::string_view word = take_word(&text);
  if (name == "d" && word == "-halo") {
    warn("\"-halo\" of d is ignored: opacity does not depend on the direction");
    word = take_word(&text);
  }
  const double value = read_number(name, word);
  if (name == "Tr")
    current_->numbers["d"] = 1 - value;
  else
    current_->numbers[name] = value;
}

void MtlReader::read_option(const MapOption& option, std::string_view* text, MtlMap* map) {
  double values[3] = {};
  std::string first;
  int count = 0;
  for (; count < option.values; ++count) {
    std::string_view rest = *text;
    const std::string_view word = take_word(&rest);
    const std::optional<double> value = parse_number(word);
    const bool is_word = option.values == 1;  // options with one value may have a word
    if (!value && !is_word) break;
    if (count == 0) first = std::string(word);
    values[count] = value && std::isfinite(static_cast<float>(*value)) ? *value : 0;
    *text = rest;
  }
  const std::string name = option.name;
  if (name == "-s" && count > 0) {
    map->u_scale = values[0];
    map->v_scale = count > 1 ? values[1] : values[0];
  } else if (name == "-o") {
    map->u_offset = values[0];
    map->v_offset = values[1];
  } else if (name == "-bm") {
    map->bump = values[0];
  } else if (name == "-clamp") {
    map->clamps = first == "on";
  } else if (!option.is_rendered) {
    warn("\"" + name + "\" of a map is ignored");
  }
}

/// The name follows the options and may hold blanks.
void MtlReader::read_map(const std::string& name, std::string_view text) {
  MtlMap map;
  map.where = here();
  for (;;) {
    std::string_view rest = text;
    const std::string_view word = take_word(&rest);
    const MapOption* const option =
        std::find_if(std::begin(kMapOptions), std::end(kMapOptions),
                     [&](const MapOption& row) { return word == row.name; });
    if (option == std::end(kMapOptions)) break;
    text = rest;
    read_option(*option, &text, &map);
  }
  map.file = std::string(stripped(text));
  if (map.file.empty()) return warn("\"" + name + "\" names no file and is ignored");
  std::replace(map.file.begin(), map.file.end(), '\\', '/');
  current_->maps[name] = std::move(map);
}

}  // namespace

std::optional<MtlMaterial::Color> MtlMaterial::color(const std::string& keyword) const {
  const Color* found = find_in(colors, keyword);
  return found ? std::optional(*found) : std::nullopt;
}

std::optional<double> MtlMaterial::number(const std::string& keyword) const {
  const double* found = find_in(numbers, keyword);
  return found ? std::optional(*found) : std::nullopt;
}

const MtlMap* MtlMaterial::map(const std::string& keyword) const {
  return find_in(maps, keyword);
}

std::map<std::string, MtlMaterial> read_mtl(SceneFiles& files, const std::string& path,
                                            Diagnostics& diagnostics) {
  return MtlReader(path, diagnostics).read(files.read(path));
}

}  // namespace nephroid

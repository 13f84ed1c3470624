#include "input/gltf/textures.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "input/contained_file.h"
#include "input/gltf/uri.h"

namespace nephroid::gltf {
namespace {

/// A map of texture coordinates: (u, v, 1) times a 3x2 matrix. Rows are those of the matrix that
/// acts on columns: u' = m[0] u + m[1] v + m[2], v' = m[3] u + m[4] v + m[5].
using UvTransform = std::array<double, 6>;
constexpr UvTransform kIdentity = {1, 0, 0, 0, 1, 0};

/// KHR_texture_transform in coordinates whose v runs upwards, as pbrt's does: glTF's v runs down.
UvTransform uv_transform(const JsonValue& info) {
  const std::optional<JsonValue> transform = info.extension("KHR_texture_transform");
  if (!transform) return kIdentity;
  const auto offset = transform->get_numbers<2>("offset", {0, 0});
  const auto scale = transform->get_numbers<2>("scale", {1, 1});
  const double angle = transform->get_number("rotation", 0);
  const double c = std::cos(angle), s = std::sin(angle);
  // Scale first, then the rotation (counter-clockwise in the image), then the offset.
  const UvTransform down = {c * scale[0],  s * scale[1], offset[0],
                            -s * scale[0], c * scale[1], offset[1]};
  // With v = 1 - w on both sides.
  return {down[0], -down[1], down[2] + down[1], -down[3], down[4], 1 - down[4] - down[5]};
}

/// OpenGL's number of a wrap mode.
std::string wrap_mode(const JsonValue& sampler, const std::string& member) {
  constexpr size_t kClamp = 33071, kMirror = 33648, kRepeat = 10497;
  const size_t code = sampler.get_index(member, kRepeat);
  if (code == kClamp) return "clamp";
  if (code == kMirror) return "mirror";
  if (code != kRepeat)
    sampler.get(member).fail("unknown wrap mode " + std::to_string(code) +
                             ", expected 33071 (clamp), 33648 (mirror) or 10497 (repeat)");
  return "repeat";
}

/// The contents of a texture as one text, without its place.
std::string contents(const std::string& type, const std::string& value_type,
                     const ParameterSet& parameters) {
  std::string text = type + "|" + value_type;
  for (const Parameter& p : parameters.list) {
    text += "|" + p.name + "=";
    for (const double number : p.numbers) text += fmt::format("{} ", number);
    for (const std::string& string : p.strings) text += string;
    for (const bool flag : p.bools) text += flag ? "true" : "false";
  }
  return text;
}

}  // namespace

size_t uv_set_of(const JsonValue& info) {
  const size_t set = info.get_index("texCoord", 0);
  const std::optional<JsonValue> transform = info.extension("KHR_texture_transform");
  return transform ? transform->get_index("texCoord", set) : set;
}

std::optional<int> UvSets::place_of(size_t set) {
  for (size_t i = 0; i < sets_.size(); ++i)
    if (sets_[i] == set) return static_cast<int>(i);
  if (sets_.size() == 2) return std::nullopt;
  sets_.push_back(set);
  return static_cast<int>(sets_.size()) - 1;
}

std::optional<size_t> Textures::image_index(const JsonValue& texture) {
  if (const auto webp = texture.extension("EXT_texture_webp")) return webp->get_index("source");
  if (const auto source = texture.find_index("source")) return source;
  if (const auto basis = texture.extension("KHR_texture_basisu"))
    basis->fail(
        "images of KHR_texture_basisu (KTX2) cannot be read, expected PNG, JPEG or WebP "
        "(gltf-transform converts them)");
  return std::nullopt;
}

std::string Textures::image_file(size_t index, const JsonValue& wanted_by) {
  const auto known = image_files_.find(index);
  if (known != image_files_.end()) return known->second;
  const JsonValue& image = document_.item("images", index, wanted_by);
  const std::optional<JsonValue> uri = image.find("uri");
  std::string name;
  if (uri && !is_data_uri(uri->text())) {
    name = contained_file(document_.files(), file_of_uri(uri->text(), *uri),
                          document_.options().allow_outside, uri->where());
  } else {
    std::string bytes;
    if (uri) {
      bytes = document_.bytes_of_uri(*uri);
    } else {
      if (!image.find("bufferView"))
        image.fail("the image has neither \"uri\" nor \"bufferView\", expected one of them");
      const Bytes view = document_.buffer_view(image.get_index("bufferView"), image);
      bytes.assign(reinterpret_cast<const char*>(view.data()), view.size());
    }
    name = std::filesystem::path(document_.path()).filename().string() + "#/images/" +
           std::to_string(index);
    document_.files().add_in_memory(name, std::move(bytes));
  }
  return image_files_[index] = name;
}

std::string Textures::image_of(const JsonValue& info) {
  const JsonValue& texture = document_.item_of("textures", info, "index");
  const std::optional<size_t> image = image_index(texture);
  if (!image) texture.fail("this texture has no \"source\", expected the index of an image");
  return image_file(*image, texture);
}

void Textures::add_placement(ParameterList& list, const std::string& prefix, const JsonValue& info,
                             UvSets& uv_sets) {
  const JsonValue& texture = document_.item_of("textures", info, "index");
  std::string u = "repeat", v = "repeat";
  if (texture.find("sampler")) {
    const JsonValue& sampler = document_.item_of("samplers", texture, "sampler");
    u = wrap_mode(sampler, "wrapS");
    v = wrap_mode(sampler, "wrapT");
  }
  list.add_string(prefix + "uwrap", u);
  list.add_string(prefix + "vwrap", v);
  const UvTransform transform = uv_transform(info);
  if (transform != kIdentity)
    list.add_numbers("float", prefix + "uvtransform", {transform.begin(), transform.end()});
  const size_t set = uv_set_of(info);
  const std::optional<int> place = uv_sets.place_of(set);
  if (!place)
    document_.diagnostics().warn(
        info.where(), "the material uses more than two sets of texture coordinates, set " +
                          std::to_string(uv_sets.sets()[0]) + " is used here in place of set " +
                          std::to_string(set));
  if (place.value_or(0) == 1) list.add_numbers("integer", prefix + "uvset", {1});
}

void Textures::add_placed_image(ParameterList& list, const std::string& file_parameter,
                                const std::string& prefix, const JsonValue& info, UvSets& uv_sets) {
  list.add_string(file_parameter, image_of(info));
  add_placement(list, prefix, info, uv_sets);
}

std::string Textures::add(const std::string& type, const std::string& value_type,
                          ParameterList list) {
  const std::string key = contents(type, value_type, list.set());
  const auto known = known_.find(key);
  if (known != known_.end()) return known->second;
  TextureDescription texture;
  texture.type = type;
  texture.value_type = value_type;
  texture.name = "texture " + std::to_string(scene_.textures.size());
  texture.where = list.where();
  texture.parameters = list.take();
  scene_.textures.push_back(texture);
  return known_[key] = texture.name;
}

std::string Textures::color(const JsonValue& info, const Color& factor, bool times_vertex_color,
                            UvSets& uv_sets) {
  ParameterList list(info.where());
  add_placed_image(list, "filename", "", info, uv_sets);
  list.add_string("encoding", "sRGB");
  list.add_bool("forceencoding", true);
  if (factor != Color{1, 1, 1}) list.add_color("factor", factor);
  if (times_vertex_color) list.add_bool("vertexcolor", true);
  return add("imagemap", "spectrum", std::move(list));
}

std::string Textures::number(const JsonValue& info, const NumberLookup& lookup, UvSets& uv_sets) {
  ParameterList list(info.where());
  add_placed_image(list, "filename", "", info, uv_sets);
  list.add_string("encoding", "linear");
  list.add_bool("forceencoding", true);
  list.add_string("channel", std::string(1, lookup.channel));
  if (lookup.scale != 1) list.add_float("scale", lookup.scale);
  if (lookup.invert) list.add_bool("invert", true);
  if (lookup.cutoff) list.add_float("cutoff", *lookup.cutoff);
  if (lookup.times_vertex_color) list.add_bool("vertexcolor", true);
  return add("imagemap", "float", std::move(list));
}

std::string Textures::vertex_color(const Color& factor, const SourceLocation& where) {
  ParameterList list(where);
  if (factor != Color{1, 1, 1}) list.add_color("factor", factor);
  return add("vertexcolor", "spectrum", std::move(list));
}

std::string Textures::vertex_alpha(const NumberLookup& lookup, const SourceLocation& where) {
  ParameterList list(where);
  list.add_string("channel", std::string(1, lookup.channel));
  if (lookup.scale != 1) list.add_float("scale", lookup.scale);
  if (lookup.cutoff) list.add_float("cutoff", *lookup.cutoff);
  return add("vertexcolor", "float", std::move(list));
}

std::string Textures::mix(double at_0, double at_1, const std::string& amount,
                          const SourceLocation& where) {
  ParameterList list(where);
  list.add_float("tex1", at_0);
  list.add_float("tex2", at_1);
  list.add_texture("amount", amount);
  return add("mix", "float", std::move(list));
}

}  // namespace nephroid::gltf

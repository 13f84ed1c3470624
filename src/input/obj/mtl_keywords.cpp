#include "input/obj/mtl_keywords.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <string_view>

namespace nephroid {
namespace {

using MtlValues = MtlKeyword::Values;

struct Row {
  MtlKeyword keyword;
  FormatParameter page;
};

constexpr Row color(const char* name, const char* fallback, const char* note) {
  return {{MtlValues::kColor, name}, {"r g b", name, fallback, "", note}};
}
constexpr Row number(const char* name, const char* fallback, const char* note) {
  return {{MtlValues::kNumber, name}, {"number", name, fallback, "", note}};
}
constexpr Row map(const char* name, const char* note, const char* canonical = nullptr) {
  return {{MtlValues::kMap, canonical ? canonical : name}, {"file", name, "", "", note}};
}
constexpr Row ignored(const char* name, const char* note) {
  return {{}, {"", name, "", "", note, Support::kWarned}};
}
constexpr Row not_needed(const char* name, const char* note) {
  return {{}, {"", name, "", "", note, Support::kNotNeeded}};
}

constexpr const char* kNoAmbient = "ambient light stands for light that is rendered here";

constexpr Row kRows[] = {
    {{}, {"name", "newmtl", "", "", "begins a material"}},
    color("Kd", "0.8", "base_color, 1 with map_Kd; a metal without Kd takes Ks instead"),
    color("Ks", "0",
          "its largest component is specular_weight, its hue specular_color; without effect on "
          "glass and "
          "beside Pr, Pm, map_Pr or map_Pm"),
    color("Ke", "0", "luminance of both sides, cd/m^2, 1 with map_Ke: an area light"),
    color("Tf", "1", "transmission_color of glass"),
    number("Ns", "0",
           "alpha = sqrt(2 / (Ns + 2)); with illum 3 to 9 reflections are sharp without Ns or "
           "with Ns 200 or more"),
    number("Ni", "1.5", "specular_ior; 1 or less counts as 1.5 for highlights of what is no glass"),
    number("d", "1",
           "opacity. With illum 4, 6, 7 or 9 and Ni other than 1, the material is solid glass with "
           "transmission_weight 1 - d. With illum 6 or 7 and d 1 the weight is 1. --solid-glass "
           "makes glass of every d below 1"),
    number("Tr", "0", "1 - d"),
    number("illum", "2",
           "0 and 1: no highlight. 3 and 5: a metal if Kd is black. 4, 6, 7 and 9: see d"),
    number("Pr", "", "specular_roughness, instead of Ns"),
    number("Pm", "0", "base_metalness"),
    number("Ps", "0", "fuzz_weight"),
    number("Pc", "0", "coat_weight"),
    number("Pcr", "0", "coat_roughness"),
    number("aniso", "0", "specular_roughness_anisotropy"),
    map("map_Kd", "base_color; its factor is the largest part of Kd"),
    map("map_Ks", "specular_color"),
    map("map_Ke", "the image of the area light; Ke is its factor"),
    map("map_d", "opacity, the grey of the image; without effect on glass"),
    map("map_Pr", "specular_roughness"),
    map("map_Pm", "base_metalness"),
    map("norm", "normalmap"),
    map("bump", "displacement (bumps); -bm is its height in scene units"),
    map("map_bump", "bump", "bump"),
    ignored("anisor", "the direction of anisotropy is that of the texture coordinates"),
    ignored("map_Ns", "exponents of highlights cannot vary, use map_Pr"),
    ignored("map_Ps", "fuzz cannot vary"),
    ignored("map_Tr", "use map_d"),
    ignored("disp", "meshes are not displaced"),
    ignored("decal", "decals are not rendered"),
    ignored("refl", "reflections are rendered, not looked up"),
    not_needed("Ka", kNoAmbient),
    not_needed("map_Ka", kNoAmbient),
    not_needed("Km", "some programs write it to every file as the strength of bumps"),
    not_needed("sharpness", "reflections are rendered, not looked up"),
    not_needed("map_aat", "pictures are always antialiased"),
};

bool same_without_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::tolower(x) == std::tolower(y);
  });
}

}  // namespace

const MtlKeyword* find_mtl_keyword(const std::string& keyword) {
  for (const Row& row : kRows)
    if (same_without_case(row.page.name, keyword)) return &row.keyword;
  return nullptr;
}

FormatParameters mtl_keywords() {
  static constexpr auto kPages = [] {
    std::array<FormatParameter, std::size(kRows)> pages{};
    for (size_t i = 0; i < pages.size(); ++i) pages[i] = kRows[i].page;
    return pages;
  }();
  return kPages;
}

}  // namespace nephroid

#include "input/other_names.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace nephroid {
namespace {

/// A row applies if at least one of its names is a candidate.
struct OtherName {
  const char* written;  ///< lower case
  std::array<const char*, 3> names;
};
constexpr OtherName kOtherNames[] = {
    // materials
    {"glass", {"dielectric"}},
    {"water", {"dielectric"}},
    {"roughdielectric", {"dielectric"}},
    {"refractive", {"dielectric"}},
    {"thinglass", {"thindielectric"}},
    {"metal", {"conductor"}},
    {"mirror", {"conductor"}},
    {"roughconductor", {"conductor"}},
    {"disney", {"principled"}},
    {"pbr", {"principled"}},
    {"openpbr", {"principled"}},
    {"standard_surface", {"principled"}},
    {"plastic", {"coateddiffuse"}},
    {"roughplastic", {"coateddiffuse"}},
    {"substrate", {"coateddiffuse"}},
    {"phong", {"coateddiffuse"}},
    {"glossy", {"coateddiffuse"}},
    {"matte", {"diffuse"}},
    {"lambert", {"diffuse"}},
    {"lambertian", {"diffuse"}},
    {"translucent", {"diffusetransmission"}},
    {"sss", {"subsurface"}},
    {"null", {"interface"}},
    // parameters
    {"ior", {"eta"}},
    {"index", {"eta", "indices"}},
    {"kd", {"reflectance"}},
    {"kr", {"reflectance"}},
    {"kt", {"transmittance"}},
    {"color", {"reflectance", "L", "I"}},
    {"colour", {"reflectance", "L", "I"}},
    {"basecolor", {"reflectance"}},
    {"base_color", {"reflectance"}},
    {"albedo", {"reflectance"}},
    {"diffuse", {"reflectance"}},
    {"bumpmap", {"displacement"}},
    {"bump", {"displacement"}},
    {"mapname", {"filename"}},
    {"file", {"filename"}},
    {"image", {"filename"}},
    {"texture", {"filename"}},
    {"st", {"uv"}},
    {"texcoord", {"uv"}},
    {"texcoords", {"uv"}},
    {"vertices", {"P"}},
    {"positions", {"P"}},
    {"points", {"P"}},
    {"normals", {"N"}},
    {"faces", {"indices"}},
    {"triangles", {"indices"}},
    {"nlevels", {"levels"}},
    {"intensity", {"I", "L", "scale"}},
    {"radiance", {"L"}},
    {"emission", {"L"}},
    {"position", {"from"}},
    {"target", {"to"}},
    {"samples", {"pixelsamples"}},
    {"spp", {"pixelsamples"}},
    {"width", {"xresolution"}},
    {"height", {"yresolution"}},
    // lights
    {"env", {"infinite"}},
    {"envmap", {"infinite"}},
    {"environment", {"infinite"}},
    {"sky", {"infinite"}},
    {"dome", {"infinite"}},
    {"constant", {"infinite"}},
    {"sun", {"distant"}},
    {"directional", {"distant"}},
    {"omni", {"point"}},
    {"spotlight", {"spot"}},
    {"ies", {"goniometric"}},
    // spectra
    {"gold", {"metal-Au-eta", "metal-Au-k"}},
    {"au", {"metal-Au-eta", "metal-Au-k"}},
    {"silver", {"metal-Ag-eta", "metal-Ag-k"}},
    {"ag", {"metal-Ag-eta", "metal-Ag-k"}},
    {"copper", {"metal-Cu-eta", "metal-Cu-k"}},
    {"cu", {"metal-Cu-eta", "metal-Cu-k"}},
    {"aluminium", {"metal-Al-eta", "metal-Al-k"}},
    {"aluminum", {"metal-Al-eta", "metal-Al-k"}},
    {"al", {"metal-Al-eta", "metal-Al-k"}},
    {"brass", {"metal-CuZn-eta", "metal-CuZn-k"}},
    {"bk7", {"glass-BK7"}},
    {"glass", {"glass-BK7"}},
    {"d65", {"stdillum-D65"}},
};

/// The replacement for a name that is a type elsewhere, but a directive or another shape here.
struct Advice {
  const char* kind;
  const char* written;
  const char* instead;
};
constexpr Advice kAdvice[] = {
    {"light", "area", "AreaLightSource \"diffuse\" before a Shape"},
    {"light", "diffuse", "AreaLightSource \"diffuse\" before a Shape"},
    {"light", "mesh", "AreaLightSource \"diffuse\" before a Shape"},
    {"material", "area", "AreaLightSource \"diffuse\" before a Shape"},
    {"material", "emissive", "AreaLightSource \"diffuse\" before a Shape"},
    {"material", "emission", "AreaLightSource \"diffuse\" before a Shape"},
    {"material", "light", "AreaLightSource \"diffuse\" before a Shape"},
    {"shape", "cube", "Shape \"trianglemesh\""},
    {"shape", "box", "Shape \"trianglemesh\""},
    {"shape", "rectangle", "Shape \"bilinearmesh\""},
    {"shape", "quad", "Shape \"bilinearmesh\""},
    {"shape", "obj", "Shape \"plymesh\", a PLY file"},
    {"shape", "objmesh", "Shape \"plymesh\", a PLY file"},
    {"shape", "ply", "Shape \"plymesh\""},
};

bool is_same_word(std::string_view word, std::string_view lower) {
  return std::equal(word.begin(), word.end(), lower.begin(), lower.end(), [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == b;
  });
}

}  // namespace

std::string other_name(std::string_view word, const std::vector<std::string>& candidates,
                       std::string_view kind) {
  for (const Advice& row : kAdvice)
    if (kind == row.kind && is_same_word(word, row.written)) return row.instead;
  std::vector<std::string> names;
  for (const OtherName& row : kOtherNames) {
    if (!is_same_word(word, row.written)) continue;
    for (const char* const name : row.names)
      if (name && std::find(candidates.begin(), candidates.end(), name) != candidates.end())
        names.push_back("\"" + std::string(name) + "\"");
  }
  std::string text;
  for (size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  return text;
}

}  // namespace nephroid

#include "input/gltf/support.h"

#include <algorithm>

namespace nephroid::gltf {
namespace {

using enum FeatureSupport;

constexpr Feature kExtensions[] = {
    {"KHR_materials_ior", kLoaded, ""},
    {"KHR_materials_specular", kApproximated,
     "the factor changes the index, so it dims reflections along the normal and not those at "
     "grazing angles; factor and colour also scale metals at grazing angles, as in OpenPBR"},
    {"KHR_materials_transmission", kApproximated,
     "thin without KHR_materials_volume, as the specification says: no caustic, with a warning; "
     "`--solid-glass` makes it solid"},
    {"KHR_materials_volume", kLoaded,
     "a thickness above 0 makes the glass solid; the value and its texture do not matter to a ray "
     "tracer"},
    {"KHR_materials_dispersion", kLoaded, "of solid glass"},
    {"KHR_materials_clearcoat", kApproximated,
     "the coat has the normal map of the surface below, with a warning if its own is another"},
    {"KHR_materials_sheen", kApproximated, "the fuzz of OpenPBR stands for the Charlie lobe"},
    {"KHR_materials_iridescence", kLoaded, ""},
    {"KHR_materials_anisotropy", kApproximated,
     "exact without textures; of an anisotropy texture the strength counts and the directions do "
     "not, with a warning"},
    {"KHR_materials_emissive_strength", kLoaded, ""},
    {"KHR_materials_diffuse_transmission", kLoaded, ""},
    {"KHR_materials_unlit", kApproximated,
     "emits its base colour, and so lights others; colours of vertices are averaged over each "
     "primitive, with a warning"},
    {"KHR_materials_variants", kLoaded, "`--variant NAME`"},
    {"KHR_materials_pbrSpecularGlossiness", kApproximated,
     "a dielectric whose normal reflectance is the specular colour; it dims the diffuse colour by "
     "what it reflects, not by 1 - max(specular); with a specular texture its reflectance hardly "
     "grows at grazing angles, as that of a metal"},
    {"KHR_lights_punctual", kLoaded,
     "candela and lux; the exposure is chosen for the file's lights unless `--exposure` gives one, "
     "and `--exposure 0` shows a candela per square metre as 1; a light has no radius, "
     "\"range\" is not needed, the edge of a spot is pbrt's smooth step"},
    {"EXT_lights_image_based", kLoaded,
     "the sharpest cube with rotation and intensity; an image with alpha is RGBD, its colours are "
     "sRGB; blurred cubes are not needed, and the irradiance counts for the exposure only"},
    {"KHR_texture_transform", kLoaded, "a rotation does not turn the directions in a normal map"},
    {"KHR_mesh_quantization", kLoaded, ""},
    {"KHR_draco_mesh_compression", kLoaded, ""},
    {"EXT_meshopt_compression", kLoaded, ""},
    {"EXT_mesh_gpu_instancing", kLoaded, ""},
    {"EXT_texture_webp", kLoaded, ""},
    {"KHR_texture_basisu", kRefused,
     "KTX2 images cannot be read; a PNG or JPEG fallback is used if the file does not require "
     "them"},
    {"KHR_node_visibility", kLoaded, ""},
    {"KHR_xmp_json_ld", kIgnored, "metadata"},
    {"KHR_xmp", kIgnored, "metadata"},
};

constexpr Feature kFeatures[] = {
    {"containers", kLoaded,
     ".gltf with files or data URIs, .glb; files only from the scene's "
     "folder unless `--allow-outside` permits others"},
    {"scenes", kLoaded, "the scene that the file chooses, else the first, else all root nodes"},
    {"nodes", kLoaded,
     "matrices, or translation, rotation and scale, mirrored ones too; a mesh "
     "scaled to nothing is left out with a warning"},
    {"accessors", kLoaded, "all types, normalised, sparse, strided"},
    {"triangles, strips, fans", kLoaded, ""},
    {"points and lines", kIgnored, "they have no area: left out with a warning"},
    {"texture coordinates", kLoaded,
     "two sets per material; further ones are replaced by the first, with a warning"},
    {"vertex colours", kLoaded, "COLOR_0"},
    {"tangents", kLoaded,
     "made along u where a normal map needs them; averaged by angle as in "
     "MikkTSpace, but not split where mirrored halves meet"},
    {"samplers", kApproximated,
     "wrap modes are loaded; textures are filtered bilinearly at full resolution"},
    {"metallic-roughness", kLoaded, "Material \"principled\""},
    {"normal maps", kLoaded, "with scale"},
    {"occlusion maps", kIgnored, "occlusion is ray traced"},
    {"emission", kLoaded,
     "an area light; a candela per square metre for a factor of 1; a file whose only light is "
     "emission up to that gets the sky and the lamp of files without light"},
    {"alpha modes", kLoaded, "BLEND is coverage, MASK a cutoff"},
    {"double-sided", kApproximated,
     "all surfaces are visible from both sides; the flag only decides "
     "whether both sides emit"},
    {"cameras", kLoaded,
     "perspective and orthographic, `--camera NAME` or an index; a film of "
     "1280 pixels along the longer side; clipping planes are not needed"},
    {"morph targets", kLoaded,
     "positions, normals and tangents; others are ignored, with a warning"},
    {"skins", kLoaded, "at the start of the shutter"},
    {"animations", kLoaded,
     "all of a file at one moment, `--at`; nodes that move while the shutter is open, `--shutter`, "
     "are blurred between its two ends"},
};

const Feature* find_extension(const std::string& name) {
  const auto* const found = std::find_if(std::begin(kExtensions), std::end(kExtensions),
                                         [&](const Feature& f) { return name == f.name; });
  return found == std::end(kExtensions) ? nullptr : found;
}

}  // namespace

std::span<const Feature> extension_table() {
  return kExtensions;
}

std::span<const Feature> feature_table() {
  return kFeatures;
}

void check_extensions(const Document& document) {
  const JsonValue root = document.root();
  const auto required = root.find_array("extensionsRequired");
  const auto used = root.find_array("extensionsUsed");
  if (required)
    for (const JsonValue& name : required->elements()) {
      const Feature* feature = find_extension(name.text());
      if (!feature)
        name.fail("the file requires the extension \"" + name.text() +
                  "\", which is not supported");
      if (feature->support == kRefused)
        name.fail("the file requires the extension \"" + name.text() + "\": " + feature->note);
    }
  if (used)
    for (const JsonValue& name : used->elements())
      if (!find_extension(name.text()))
        document.diagnostics().warn(
            name.where(), "the extension \"" + name.text() + "\" is not supported, it is ignored");
}

}  // namespace nephroid::gltf

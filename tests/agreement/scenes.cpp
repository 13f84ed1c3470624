#include "agreement/scenes.h"

namespace nephroid {
namespace {

constexpr char kCamera[] = R"(LookAt 0 6 -3  0 0.4 0  0 1 0 Camera "perspective" "float fov" 32)";
constexpr char kLensCamera[] =
    R"(LookAt 0 6 -3  0 0.4 0  0 1 0
       Camera "perspective" "float fov" 32 "float lensradius" 0.15 "float focaldistance" 5)";
constexpr char kOrthographic[] =
    R"(LookAt 0 6 -3  0 0.4 0  0 1 0
       Camera "orthographic" "float screenwindow" [-1.8 1.8 -1.8 1.8])";
constexpr char kFlipped[] =
    R"(LookAt 0 6 -3  0 0.4 0  0 1 0
       Camera "perspective" "float fov" 32 "float screenwindow" [1 -1 1 -1])";

constexpr char kSceneLamp[] = R"(
  AttributeBegin
    AreaLightSource "diffuse" "rgb L" [10 9 8]
    Material "diffuse" "rgb reflectance" [0 0 0]
    Translate 2.2 3.2 0.5 Rotate 90 1 0 0
    Shape "disk" "float radius" 0.9
  AttributeEnd
)";
constexpr char kPointLight[] =
    R"(LightSource "point" "rgb I" [20 18 16] "point3 from" [2.2 3.2 0.5])";
constexpr char kSpotLight[] =
    R"(LightSource "spot" "rgb I" [40 36 32] "point3 from" [2.2 3.2 0.5] "point3 to" [0 0.6 0]
       "float coneangle" 35 "float conedeltaangle" 10)";
constexpr char kSceneSky[] = R"(LightSource "infinite" "rgb L" [0.5 0.6 0.7])";

constexpr char kProjector[] = R"(
  AttributeBegin
    Translate 0.8 3.4 0.3 Rotate 12 0 0 1 Rotate 90 1 0 0
    LightSource "projection" "string filename" "PICTURE" "float fov" 95 "float scale" 4
  AttributeEnd
)";
constexpr char kDiagram[] = R"(
  AttributeBegin
    Translate 1.2 3.2 0.5 Rotate 35 1 2 3
    LightSource "goniometric" "string filename" "PICTURE" "rgb I" [20 18 16]
  AttributeEnd
)";
// Above and to one side. One sheet hides part of the sky beyond it, another has alpha 0.5.
constexpr char kPortal[] = R"(
  AttributeBegin
    Rotate 40 1 0.3 0
    LightSource "infinite" "string filename" "PICTURE" "float scale" 2
      "point3 portal" [0.9 3 -0.8  2.9 3 -0.8  2.9 3 1.6  0.9 3 1.6]
  AttributeEnd
  AttributeBegin
    Material "diffuse"
    Shape "bilinearmesh" "point3 P" [2 4.5 -1  3.5 4.5 -1  2 4.5 0.6  3.5 4.5 0.6]
    Shape "bilinearmesh" "point3 P" [1 4.8 0  3 4.8 0  1 4.8 2  3 4.8 2] "float alpha" 0.5
  AttributeEnd
)";
// A cloud that fills the portal.
constexpr char kPortalInSmoke[] = R"(
  LightSource "infinite" "rgb L" [0.8 0.9 1] "float scale" 3
    "point3 portal" [0.9 3 -0.8  2.9 3 -0.8  2.9 3 1.6  0.9 3 1.6]
  MakeNamedMedium "smoke" "string type" "homogeneous" "float scale" 1
    "rgb sigma_a" [0.5 0.3 0.2] "rgb sigma_s" [0.2 0.3 0.4]
  AttributeBegin
    Material "interface" MediumInterface "smoke" ""
    Translate 1.9 3 0.4 Shape "sphere" "float radius" 1
  AttributeEnd
)";

constexpr char kSceneRoom[] = R"(
  Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  Shape "bilinearmesh" "point3 P" [-3.5 0 -3.5  3.5 0 -3.5  -3.5 0 3.5  3.5 0 3.5]
  Shape "bilinearmesh" "point3 P" [-3.5 0 -3.5  -3.5 0 3.5  -3.5 3 -3.5  -3.5 3 3.5]
)";

// Replaces BALL in a scene's text: a control cage of few triangles whose limit surface is a smooth
// ball of radius about 0.6.
constexpr char kSceneBall[] = R"(Shape "loopsubdiv" "integer levels" 2
  "integer indices" [0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5]
  "point3 P" [0.9 0 0  -0.9 0 0  0 0.9 0  0 -0.9 0  0 0 0.9  0 0 -0.9])";

constexpr char kSheetBelowGlass[] = R"(
  Shape "bilinearmesh" "point3 P" [-3 0.45 -3  3 0.45 -3  -3 0.45 3  3 0.45 3] "float alpha" 0.5
  Material "dielectric" "float eta" 1.5 Translate 0 1.2 0 Shape "sphere" "float radius" 0.6)";

// Caustics seen in a mirror: neither camera paths nor light tracing find them.
const std::vector<LeftOut> kMirroredCaustics = {
    {"light-only", "no connection finds C S D S L if the light is at a point"},
    {"forecast", "no walk from the eye finds C D S L if the light is at a point"}};

}  // namespace

const std::vector<AgreementScene> kAgreementScenes = {
    {.name = "diffuse", .world = R"(Translate 0 0.7 0 Shape "sphere" "float radius" 0.6)"},
    // Light scatters below the surface; photons are merged where it leaves, and start from there.
    {.name = "subsurface", .world = R"(AttributeBegin
       Material "subsurface" "rgb mfp" [0.2 0.12 0.07] "rgb reflectance" [0.8 0.6 0.5]
       Translate -0.4 0.6 0 Shape "sphere" "float radius" 0.5 AttributeEnd
       Material "dielectric" Translate 0.7 0.9 0.3 Shape "sphere" "float radius" 0.4)"},
    {.name = "rough_subsurface",
     .world = R"(Material "subsurface" "rgb mfp" [0.2 0.12 0.07] "rgb reflectance" [0.8 0.6 0.5]
       "float roughness" 0.3 Translate 0 0.7 0 Shape "sphere" "float radius" 0.6)"},
    // On curves nothing is merged, whatever the material, and every event is H.
    {.name = "subsurface_curve",
     .world = R"(AttributeBegin
       Material "subsurface" "rgb mfp" [0.2 0.12 0.07] "rgb reflectance" [0.8 0.6 0.5]
       Shape "curve" "string type" "cylinder" "float width" 0.5
         "point3 P" [-1.2 0.4 0.1  -0.4 0.6 -0.3  0.4 0.4 0.4  1.2 0.5 0.1] AttributeEnd
       Material "dielectric" "float eta" 1.5 Translate 0.1 1.4 0.1 Shape "sphere" "float radius" 0.5)",
     .passes = 6},
    // Caustics through media that absorb, scatter, or both, differently for each colour.
    {.name = "tea",
     .world = R"(MakeNamedMedium "tea" "string type" "homogeneous" "rgb sigma_a" [0.4 0.9 2]
       "rgb sigma_s" [0 0 0] MediumInterface "tea" "" Material "dielectric" "float eta" 1.33
       Translate 0 0.9 0 Shape "sphere" "float radius" 0.6)"},
    {.name = "fog",
     .world = R"(MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [0.05 0.1 0.2]
       "rgb sigma_s" [0.6 0.4 0.2] "float g" 0.4
       AttributeBegin MediumInterface "fog" "" Material "interface"
       Translate 0 0.9 0 Shape "sphere" "float radius" 0.85 AttributeEnd
       MediumInterface "" "fog" Material "dielectric" "float eta" 1.5
       Translate 0 0.9 0 Shape "sphere" "float radius" 0.5)"},
    {.name = "grid_fog",
     .world = R"(MakeNamedMedium "fog" "string type" "uniformgrid" "integer nx" 2 "integer ny" 2
       "integer nz" 2 "float density" [0.2 1 0.6 0.1 0.9 0.3 0.5 1] "point3 p0" [-1 -0.2 -1]
       "point3 p1" [1 2 1] "rgb sigma_a" [0.1 0.2 0.4] "rgb sigma_s" [1.5 1 0.5] "float g" -0.3
       AttributeBegin MediumInterface "fog" "" Material "interface"
       Translate 0 0.9 0 Shape "sphere" "float radius" 0.85 AttributeEnd
       MediumInterface "" "fog" Material "dielectric" "spectrum eta" "glass-SF11"
       Translate 0 0.9 0 Shape "sphere" "float radius" 0.5)"},
    // Glowing media emit no photons: path tracing finds all of their light, also through glass.
    {.name = "glowing_gas",
     .world = R"(MakeNamedMedium "fire" "string type" "homogeneous" "rgb sigma_a" [2 1.5 1]
       "rgb sigma_s" [0.5 0.5 0.5] "rgb Le" [1.2 0.7 0.3]
       AttributeBegin MediumInterface "fire" "" Material "interface"
       Translate -0.6 0.7 0 Shape "sphere" "float radius" 0.4 AttributeEnd
       Material "dielectric" "float eta" 1.5 Translate 0.5 0.9 0 Shape "sphere" "float radius" 0.5)"},
    // Light that passes a cut-out part of a container stays in its medium.
    {.name = "cut_out_container",
     .world = R"(MakeNamedMedium "ink" "string type" "homogeneous" "rgb sigma_a" [2 1 0.5]
       "rgb sigma_s" [0 0 0]
       AttributeBegin MediumInterface "ink" "" Material "interface"
       Translate 0 0.9 0 Shape "sphere" "float radius" 0.8 "float alpha" 0.5 AttributeEnd
       Material "dielectric" "float eta" 1.5 Translate 1 0.9 0.6 Shape "sphere" "float radius" 0.3)"},
    {.name = "half_hair",
     .world = R"(MakeNamedMaterial "hair" "string type" "hair" "float eumelanin" 0.3
       MakeNamedMaterial "skin" "string type" "diffuse" "rgb reflectance" [0.7 0.5 0.4]
       AttributeBegin Material "mix" "string materials" ["hair" "skin"] "float amount" 0.5
       Shape "curve" "point3 P" [-1.2 0.2 0.1  -0.4 0.4 -0.3  0.4 0.2 0.4  1.2 0.3 0.1]
         "float width" 0.35 AttributeEnd
       Translate 0.9 0.4 1 Shape "sphere" "float radius" 0.4)"},
    // Photons are not merged on hair, so caustics that touch it are path-traced.
    {.name = "hair", .world = R"(AttributeBegin Material "hair" "float eumelanin" 0.3
       Shape "curve" "point3 P" [-1.2 0.2 0.1  -0.4 0.4 -0.3  0.4 0.2 0.4  1.2 0.3 0.1]
         "float width" 0.35 AttributeEnd
       Material "dielectric" "float eta" 1.5 Translate 0.1 1.2 0.1 Shape "sphere" "float radius" 0.5)"},
    {.name = "glass", .world = R"(Material "dielectric" "float eta" 1.5 Translate 0 0.9 0
                 Shape "sphere" "float radius" 0.6)"},
    {.name = "bumped_glass",
     .world = R"(Texture "waves" "float" "imagemap" "string filename" "WAVES"
                   "string encoding" "linear"
                 Material "dielectric" "float eta" 1.5 "texture displacement" "waves"
                 Translate 0 0.9 0 Shape "sphere" "float radius" 0.6)"},
    {.name = "dispersive_glass",
     .world = R"(Material "dielectric" "spectrum eta" "glass-SF11" Translate 0 0.9 0
                 Shape "sphere" "float radius" 0.6)",
     .photons = 12288,
     .passes = 6,
     .passes_of_ppm = 16},
    {.name = "mirror", .world = R"(Material "conductor" "float roughness" 0 Translate 0 0.7 0
                 Shape "sphere" "float radius" 0.6)"},
    {.name = "glossy_threshold",
     .world = R"(Material "conductor" "float roughness" 0.04 "bool remaproughness" false
                 Translate 0 0.7 0 Shape "sphere" "float radius" 0.6)"},
    {.name = "glossy",
     .world = R"(Material "conductor" "float roughness" 0.2 "bool remaproughness" false
                 Translate 0 0.7 0 Shape "sphere" "float radius" 0.6)"},
    {.name = "coated",
     .world = R"(Material "coateddiffuse" "rgb reflectance" [0.2 0.5 0.7] "float roughness" 0
                 Translate 0 0.7 0 Shape "sphere" "float radius" 0.6)"},
    {.name = "coated_conductor",
     .world = R"(Material "coatedconductor" "float interface.roughness" 0
                   "float conductor.roughness" 0.2
                 Translate 0 0.7 0 Shape "sphere" "float radius" 0.6)"},
    {.name = "principled",
     .world = R"(AttributeBegin Material "principled" "float subsurface_weight" 0.6
         "float subsurface_radius" 0.2 "rgb subsurface_color" [0.8 0.6 0.5]
         "float coat_weight" 0.7 "rgb coat_color" [0.9 0.7 0.6] "float fuzz_weight" 0.3
       Translate -0.6 0.6 0 Shape "sphere" "float radius" 0.5 AttributeEnd
       Material "principled" "float transmission_weight" 0.8 "float specular_roughness" 0
         "rgb transmission_color" [0.9 0.6 0.4]
       Translate 0.7 0.9 0.3 Shape "sphere" "float radius" 0.5)"},
    {.name = "principled_pane_above_metal",
     .world = R"(AttributeBegin Material "principled" "float base_metalness" 0.7
         "rgb base_color" [0.9 0.6 0.3] "float specular_roughness" 0.4 "float coat_weight" 1
         "float thin_film_weight" 0.5
       Translate 0 0.7 0 Shape "sphere" "float radius" 0.6 AttributeEnd
       Material "principled" "bool geometry_thin_walled" true "float transmission_weight" 0.9
         "float specular_roughness" 0 "rgb transmission_color" [0.7 0.8 0.9]
         "float diffuse_transmission_weight" 0.5
       Shape "bilinearmesh" "point3 P" [-3.4 2.2 -3  3.4 2.2 -3  -3.4 2.2 3  3.4 2.2 3])",
     .photons = 8192},
    {.name = "measured_below_glass", .world = R"(Material "measured" "string filename" "MEASURED"
                 Shape "bilinearmesh" "point3 P" [-3 0.05 -3  3 0.05 -3  -3 0.05 3  3 0.05 3]
                 Material "dielectric" "float eta" 1.5 Translate 0 0.9 0
                 Shape "sphere" "float radius" 0.6)"},
    {.name = "thin_lens",
     .world = R"(Material "dielectric" Translate 0 0.9 0 Shape "sphere" "float radius" 0.6)",
     .camera = kLensCamera},
    {.name = "half_there_sheet_below_glass", .world = kSheetBelowGlass, .passes = 6},
    {.name = "half_interface_sheet_below_glass",
     .world = R"(MakeNamedMaterial "paint" "string type" "diffuse" "rgb reflectance" [0.7 0.6 0.5]
                 MakeNamedMaterial "gap" "string type" "interface"
                 Material "mix" "string materials" ["paint" "gap"] "float amount" 0.5
                 Shape "bilinearmesh" "point3 P" [-3 0.45 -3  3 0.45 -3  -3 0.45 3  3 0.45 3]
                 Material "dielectric" "float eta" 1.5 Translate 0 1.2 0
                 Shape "sphere" "float radius" 0.6)",
     .passes = 6},
    {.name = "mixed_receiver",
     .world = R"(MakeNamedMaterial "paint" "string type" "diffuse" "rgb reflectance" [0.7 0.6 0.5]
                 MakeNamedMaterial "metal" "string type" "conductor" "float roughness" 0
                 Material "mix" "string materials" ["paint" "metal"] "float amount" 0.5
                 Shape "bilinearmesh" "point3 P" [-3 0.45 -3  3 0.45 -3  -3 0.45 3  3 0.45 3]
                 Material "dielectric" "float eta" 1.5 Translate 0 1.2 0
                 Shape "sphere" "float radius" 0.6)",
     .photons = 8192},
    {.name = "thin_pane_above_mirror",
     .world = R"(Material "conductor" "float roughness" 0
                 AttributeBegin Translate 0 0.7 0 Shape "sphere" "float radius" 0.6 AttributeEnd
                 Material "thindielectric" "float eta" 1.5
                 Shape "bilinearmesh" "point3 P" [-3.4 2.2 -3  3.4 2.2 -3  -3.4 2.2 3  3.4 2.2 3])",
     .photons = 8192},
    {.name = "translucent_sheet_below_glass",
     .world = R"(Material "diffusetransmission" "rgb reflectance" [0.4 0.3 0.2]
                   "rgb transmittance" [0.2 0.4 0.5]
                 Shape "bilinearmesh" "point3 P" [-3 0.45 -3  3 0.45 -3  -3 0.45 3  3 0.45 3]
                 Material "dielectric" "float eta" 1.5 Translate 0 1.2 0
                 Shape "sphere" "float radius" 0.6)"},
    {.name = "point_light_and_nearly_smooth_metal",
     .world = R"(Material "conductor" "float roughness" 0.04 "bool remaproughness" false
                 Translate 0 0.7 0 Shape "sphere" "float radius" 0.6)",
     .light = kPointLight,
     .reference_passes = 32,
     .photons = 8192,
     .passes = 6},
    // No camera path finds the light of a point through smooth glass.
    {.name = "point_light_and_glass",
     .world = R"(Material "dielectric" "float eta" 1.5 Translate 0 0.9 0
                 Shape "sphere" "float radius" 0.6)",
     .light = kPointLight,
     .reference = "sppm",
     .passes = 6,
     .left_out = kMirroredCaustics},
    {.name = "spot_light_and_glass",
     .world = R"(Material "dielectric" "float eta" 1.5 Translate 0 0.9 0
                 Shape "sphere" "float radius" 0.6)",
     .light = kSpotLight,
     .reference = "sppm",
     .left_out = kMirroredCaustics},
    {.name = "spot_light_and_diffuse",
     .world = R"(Translate 0 0.7 0 Shape "sphere" "float radius" 0.6)",
     .light = kSpotLight},
    {.name = "sky_and_glass",
     .world = R"(Material "dielectric" "float eta" 1.5 Translate 0 0.9 0
                 Shape "sphere" "float radius" 0.6)",
     .light = kSceneSky,
     .photons = 9216,
     .passes = 6},
    {.name = "projection_light_and_diffuse",
     .world = R"(Translate 0 0.7 0 Shape "sphere" "float radius" 0.6)",
     .light = kProjector},
    {.name = "projection_light_and_glass",
     .world = R"(Material "dielectric" "float eta" 1.5 Translate 0 0.9 0
                 Shape "sphere" "float radius" 0.6)",
     .light = kProjector,
     .reference = "sppm",
     .photons = 9216,
     .passes = 6,
     .left_out = kMirroredCaustics},
    {.name = "goniometric_light_and_diffuse",
     .world = R"(Translate 0 0.7 0 Shape "sphere" "float radius" 0.6)",
     .light = kDiagram},
    {.name = "portal_and_glass",
     .world = R"(Material "dielectric" "float eta" 1.5 Translate 0 0.9 0
                 Shape "sphere" "float radius" 0.6)",
     .light = kPortal,
     .photons = 9216},
    {.name = "portal_in_smoke",
     .world = R"(Translate 0 0.7 0 Shape "sphere" "float radius" 0.6)",
     .light = kPortalInSmoke},
    {.name = "instance_of_smooth_glass",
     .world = R"(ObjectBegin "ball" Material "dielectric" "float eta" 1.5 BALL ObjectEnd
                 Translate 0 0.9 0 Rotate 30 1 2 3 ObjectInstance "ball")"},
    {.name = "instance_as_receiver",
     .world = R"(ObjectBegin "ball" Material "diffuse" "rgb reflectance" [0.7 0.6 0.5] BALL
                 ObjectEnd
                 AttributeBegin Scale 1.5 1 1.5 Translate -0.3 0.6 0 ObjectInstance "ball" AttributeEnd
                 Material "dielectric" "float eta" 1.5 Translate 0.7 1.9 0.2
                 Shape "sphere" "float radius" 0.5)"},
    {.name = "moving_glass",
     .world = R"(Material "dielectric" "float eta" 1.5 Translate -0.4 0.9 0 ActiveTransform EndTime
                 Translate 0.8 0.2 0 Shape "sphere" "float radius" 0.6)"},
    {.name = "moving_receiver",
     .world = R"(ObjectBegin "ball" Material "diffuse" "rgb reflectance" [0.7 0.6 0.5] BALL
                 ObjectEnd
                 AttributeBegin Scale 1.5 1 1.5 Translate -0.3 0.6 0 ActiveTransform EndTime
                 Translate 0.2 0 0 Rotate 60 0 1 0 ObjectInstance "ball" AttributeEnd
                 Material "dielectric" "float eta" 1.5 Translate 0.7 1.9 0.2
                 Shape "sphere" "float radius" 0.5)"},
    {.name = "two_events",
     .world = R"(Material "conductor" "float roughness" 0
                 AttributeBegin Translate 0 0.7 0 Shape "sphere" "float radius" 0.6 AttributeEnd
                 Material "interface"
                 Shape "bilinearmesh" "point3 P" [-3 2 -3  3 2 -3  -3 2 3  3 2 3]
                 Material "thindielectric" "float eta" 1.5
                 Shape "bilinearmesh" "point3 P" [-3.4 2.2 -3  3.4 2.2 -3  -3.4 2.2 3  3.4 2.2 3])",
     .max_depth = 2,
     .photons = 8192},
    {.name = "three_events",
     .world = R"(Material "dielectric" "float eta" 1.5 Translate 0 0.9 0
                 Shape "sphere" "float radius" 0.6)",
     .max_depth = 3},
    {.name = "orthographic",
     .world = R"(Material "dielectric" "float eta" 1.5 Translate 0 0.9 0
                 Shape "sphere" "float radius" 0.6)",
     .camera = kOrthographic},
    {.name = "flipped_screen",
     .world = R"(Material "dielectric" "float eta" 1.5 Translate 0.3 0.9 0.2
                 Shape "sphere" "float radius" 0.6)",
     .camera = kFlipped},
    // The limit is above any sample value here and must then change nothing.
    {.name = "signed_filter_and_limit",
     .world = R"(Material "conductor" "float roughness" 0 Translate 0 0.7 0
                 Shape "sphere" "float radius" 0.6)",
     .film = R"("float maxcomponentvalue" 1000 PixelFilter "mitchell")",
     .photons = 8192},
};

std::string agreement_scene_text(const AgreementScene& scene, const std::string& directory) {
  const std::string film = *scene.film ? scene.film : R"(PixelFilter "box")";
  std::string text = std::string(scene.camera ? scene.camera : kCamera) +
                     R"( Film "rgb" "integer xresolution" 12 "integer yresolution" 12 )" + film +
                     " WorldBegin\n" + (scene.light ? scene.light : kSceneLamp) + kSceneRoom +
                     scene.world;
  const auto fill_in = [&text](const std::string& placeholder, const std::string& by) {
    if (const size_t at = text.find(placeholder); at != std::string::npos)
      text.replace(at, placeholder.size(), by);
  };
  fill_in("WAVES", directory + "/waves.pfm");
  fill_in("PICTURE", directory + "/picture.pfm");
  fill_in("MEASURED", directory + "/brushed.bsdf");
  fill_in("BALL", kSceneBall);
  return text;
}

}  // namespace nephroid

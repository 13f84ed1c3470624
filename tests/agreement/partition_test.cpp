// Routes partition the light: with one seed, path tracing of a route and of its complement add up
// to path tracing of everything, in every pixel and pass. The picture is the same, within noise,
// for any estimator of a route. Layers of a partition add up to the picture. Sweeping roughness
// moves a caustic between routes without a jump.
#include <gtest/gtest.h>

#include "integrator/metropolis/metropolis_options.h"
#include "integrator/path/path_options.h"
#include "integrator/photon_mapping/photon_map.h"
#include "integrator/photon_mapping/ppm.h"
#include "rendering.h"

namespace nephroid {
namespace {

using namespace testing_support;

// Glass, varnish and rough metal on a floor in front of a wall; two lamps and a dim sky. All lights
// are large, so that path tracing finds every path.
std::string world(
    const std::string& film = "\"integer xresolution\" 12 \"integer yresolution\" 12") {
  return R"(
  LookAt 0 3.2 -4  0 0.4 0  0 1 0
  Camera "perspective" "float fov" 40
  PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
  Film "rgb" )" +
         film + R"(
  WorldBegin
  AttributeBegin
    Translate 0 3 0 Rotate 90 1 0 0
    AreaLightSource "diffuse" "rgb L" [9 8 7] "string name" "key"
    Shape "disk" "float radius" 0.9
  AttributeEnd
  LightSource "infinite" "rgb L" [0.3 0.4 0.5] "string name" "sky"
  AttributeBegin
    Translate 2 2 -2
    AreaLightSource "diffuse" "rgb L" [4 5 6]
    Shape "sphere" "float radius" 0.5
  AttributeEnd
  MakeNamedMaterial "floor" "string type" "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  MakeNamedMaterial "glass" "string type" "dielectric" "float roughness" 0
  MakeNamedMaterial "brass" "string type" "conductor" "float roughness" 0.5
  MakeNamedMaterial "varnish" "string type" "coateddiffuse" "rgb reflectance" [0.2 0.5 0.3]
     "float roughness" 0.3
  NamedMaterial "floor"
  Shape "bilinearmesh" "point3 P" [-3 0 -3  3 0 -3  -3 0 3  3 0 3]
  Shape "bilinearmesh" "point3 P" [-3 0 3  3 0 3  -3 2 3  3 2 3]
  NamedMaterial "glass"
  AttributeBegin Translate -0.9 0.7 0 Shape "sphere" "float radius" 0.6 AttributeEnd
  NamedMaterial "brass"
  AttributeBegin Translate 0.9 0.7 0.3 Shape "sphere" "float radius" 0.5 AttributeEnd
  NamedMaterial "varnish"
  AttributeBegin Translate 0.1 0.4 -1 Shape "sphere" "float radius" 0.35 AttributeEnd
)";
}

// Fog, a glowing medium, hair, skin, dispersive glass, and slightly frosted glass whose roughness
// lies in the specular band.
std::string second_world() {
  return R"(
  LookAt 0 3.2 -4  0 0.4 0  0 1 0
  Camera "perspective" "float fov" 40
  PixelFilter "box" "float xradius" 0.5 "float yradius" 0.5
  Film "rgb" "integer xresolution" 12 "integer yresolution" 12
  WorldBegin
  AttributeBegin
    Translate 0 3 0 Rotate 90 1 0 0
    AreaLightSource "diffuse" "rgb L" [9 8 7] "string name" "key"
    Shape "disk" "float radius" 0.9
  AttributeEnd
  LightSource "infinite" "rgb L" [0.3 0.4 0.5] "string name" "sky"
  MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_a" [0.05 0.1 0.2]
    "rgb sigma_s" [0.9 0.6 0.4] "float g" 0.4
  MakeNamedMedium "fire" "string type" "homogeneous" "rgb sigma_a" [2 1.5 1]
    "rgb sigma_s" [0.5 0.5 0.5] "rgb Le" [1.2 0.7 0.3]
  MakeNamedMaterial "floor" "string type" "diffuse" "rgb reflectance" [0.6 0.5 0.4]
  MakeNamedMaterial "prism" "string type" "dielectric" "spectrum eta" "glass-SF11"
  MakeNamedMaterial "frosted" "string type" "dielectric" "float roughness" 0.05
    "bool remaproughness" false
  MakeNamedMaterial "skin" "string type" "subsurface" "rgb mfp" [0.2 0.12 0.07]
    "rgb reflectance" [0.8 0.6 0.5]
  MakeNamedMaterial "fur" "string type" "hair" "float eumelanin" 0.3
  NamedMaterial "floor"
  Shape "bilinearmesh" "point3 P" [-3 0 -3  3 0 -3  -3 0 3  3 0 3]
  Shape "bilinearmesh" "point3 P" [-3 0 3  3 0 3  -3 2 3  3 2 3]
  NamedMaterial "prism"
  AttributeBegin Translate -1 0.6 -0.4 Shape "sphere" "float radius" 0.45 AttributeEnd
  NamedMaterial "frosted"
  AttributeBegin Translate 1 0.6 -0.4 Shape "sphere" "float radius" 0.45 AttributeEnd
  NamedMaterial "skin"
  AttributeBegin Translate 0 0.5 -0.9 Shape "sphere" "float radius" 0.4 AttributeEnd
  NamedMaterial "fur"
  Shape "curve" "point3 P" [-1.2 0.2 0.1  -0.4 1.4 0.3  0.4 0.2 0.4  1.2 1.3 0.1]
    "float width" 0.3
  Material "interface"
  AttributeBegin MediumInterface "fog" ""
    Translate -0.7 0.9 1.2 Shape "sphere" "float radius" 0.8 AttributeEnd
  AttributeBegin MediumInterface "fire" ""
    Translate 0.9 0.9 1.2 Shape "sphere" "float radius" 0.5 AttributeEnd
)";
}

Film render_routes(const Scene& scene, const std::vector<std::string>& routes,
                   const IntegratorOptions& options, uint64_t seed, uint32_t count,
                   const std::vector<std::string>& aovs = {}) {
  return render(scene, plan_of(routes, aovs), options, seed, count);
}

// Holds in every pass of path tracing that does not skip useless paths: a first route with any
// expression, and the rest, add up to the picture.
void expect_complements(const Scene& scene, const std::vector<std::string>& expressions) {
  IntegratorOptions options;
  options.max_depth = 8;
  options.edit<PathOptions>().blind_walks = true;
  std::vector<double> found(expressions.size()), total(expressions.size());
  for (const uint32_t pass : {0u, 1u, 5u}) {
    const Film all = render(scene, plan_of({"all=.*:path"}), options, 3, 1, pass);
    for (size_t i = 0; i < expressions.size(); ++i) {
      const Film parts =
          render(scene, plan_of({"some=" + expressions[i] + ":path", "rest=.*:path"}), options, 3,
                 1, pass);
      for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 12; ++x) {
          const Rgb whole = all.value(x, y);
          const Rgb sum = parts.route_value(0, x, y) + parts.route_value(1, x, y);
          for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(sum[c], whole[c], 1e-6 * (1e-3 + std::abs(whole[c])))
                << expressions[i] << ", pass " << pass << ", pixel " << x << ' ' << y;
          found[i] += static_cast<double>(parts.route_value(0, x, y).g);
          total[i] += static_cast<double>(whole.g);
        }
    }
  }
  for (size_t i = 0; i < expressions.size(); ++i) {
    EXPECT_LT(found[i], total[i]) << expressions[i];
    EXPECT_GT(found[i], 0) << expressions[i];
  }
}

TEST(Partition, ARouteAndItsComplementAddUpInEveryPixelAndPass) {
  expect_complements(
      *scene_from_text(world()),
      {"C.*[DG]S+[DG]?L", "C.*<L.'key'>", "C[DG]L", "C.*<..'glass'>.*L", "C(S|G)+<.D'floor'>.*L",
       "C.*B", "C.*<TS>.*L", "C.{2,3}L", "C.*<RG'brass'>.*O", "C[^S]*L"});
}

TEST(Partition, SoTheyDoInMediaHairSkinAndTheBandOfRoughness) {
  expect_complements(
      *scene_from_text(second_world()),
      {"C.*V.*L", "CV+L", "C<V'fog'>.*<L.'key'>", "C.*<V'fire'>.*M", "C.*M", "CD.*<M.'fire'>",
       "C.*H.*L", "C<H'fur'>L", "C.*D.*H.*B", "C[^VH]*O", "C.*<TS'prism'>.*L", "C.*<RS>.*L",
       "C.*<TD'skin'>.*L", "C.*<RS'skin'>.*L", "C.*<TS'frosted'>.*L", "C.*<TG'frosted'>.*L",
       "C.*[DG]S+[DG]?L", "C.*[VD]<T[SG]>+[DGV]?L", "C.*(V|H).*[^M]"});
}

TEST(Partition, LayersOfAPartitionAddUpToThePicture) {
  const auto scene = scene_from_text(world());
  IntegratorOptions options;
  options.max_depth = 8;
  options.photons_per_pass = 4096;
  const Film film = render_routes(
      *scene, {"caustic=C.*[DG]S+[DG]?L:photons", "seen=C[DG]+L:lighttrace", "rest=.*:path"},
      options, 4, 3,
      {"key=C.*<L.'key'>", "sky=C.*<L.'sky'>", "others=C.*[^<L.'key'><L.'sky'>]", "everything=.*"});
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 12; ++x) {
      const Rgb beauty = film.value(x, y);
      const Rgb lights =
          film.aov_value(0, x, y) + film.aov_value(1, x, y) + film.aov_value(2, x, y);
      Rgb routes;
      for (int r = 0; r < 3; ++r) routes = routes + film.route_value(r, x, y);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(lights[c], beauty[c], 3e-7 * beauty[c]);
        EXPECT_NEAR(routes[c], beauty[c], 3e-7 * beauty[c]);
        EXPECT_EQ(film.aov_value(3, x, y)[c], beauty[c]);
      }
    }
}

// Any estimator of a route finds the picture of path tracing, by t-tests over seeds.
struct Owners {
  const char* name;
  std::vector<std::string> routes;
  uint32_t passes = 4;
};

class PartitionOwners : public ::testing::TestWithParam<Owners> {};

constexpr int kPartitionSeeds = 32, kPartitionAcross = 2;

IntegratorOptions options_of_owners() {
  IntegratorOptions options;
  options.max_depth = 8;
  options.photons_per_pass = 6144;
  options.camera_samples_per_pass = 8;
  options.radius = 0.6f;
  options.edit<PpmOptions>().hit_points = 4;
  options.edit<PhotonMapOptions>().nearest_photons = kAllPhotons;
  options.edit<MetropolisOptions>().mutations = 256;
  options.edit<MetropolisOptions>().large_step = 0.5f;
  return options;
}

/// Path tracing of everything, shared by all rows.
const SeedValues& path_traced() {
  static const SeedValues values =
      block_values(*scene_from_text(world()), plan_of({"all=.*:path"}), options_of_owners(),
                   kPartitionSeeds, 8, 1, kPartitionAcross);
  return values;
}

TEST_P(PartitionOwners, FindTheSamePicture) {
  const Plan plan = plan_of(GetParam().routes);
  IntegratorOptions options = options_of_owners();
  uint32_t passes = GetParam().passes;
  use_whole_maps(plan, options, passes);
  const SeedValues& reference = path_traced();
  const SeedValues found = unbiased_block_values(*scene_from_text(world()), plan, options,
                                                 kPartitionSeeds, passes, 500, kPartitionAcross);
  for (size_t i = 0; i < reference.size(); ++i) {
    const Estimate a = estimate_of(found[i]), b = estimate_of(reference[i]);
    const double error = std::hypot(a.error, b.error);
    std::printf("%-28s block %zu: %.5f against %.5f, %+.2f standard errors of %.2f %%\n",
                GetParam().name, i, a.mean, b.mean, (a.mean - b.mean) / error,
                100 * error / b.mean);
    EXPECT_NEAR(a.mean, b.mean, kT31 * error) << "block " << i;
    EXPECT_LT(error, max_error(0.015 * b.mean)) << "too noisy to tell";
  }
}

const std::vector<Owners> kOwners = {
    {"light_of_all_seen_directly", {"seen=C[DG].*L:lighttrace", "rest=.*:path"}},
    {"light_of_shapes", {"lamp=CO:lighttrace", "seen=C[DG].*L:lighttrace", "rest=.*:path"}},
    {"light_of_one_lamp", {"key=C[DG].*<L.'key'>:lighttrace", "rest=.*:path"}},
    {"light_of_caustics", {"seen=C[DG]S+L:lighttrace", "rest=.*:path"}},
    {"photons_of_one_material", {"brass=C.*<.G'brass'>[DG]*[DG]L:photons", "rest=.*:path"}},
    {"sppm_of_caustics", {"caustic=C.*[DG]S+[DG]?L:sppm", "rest=.*:path"}},
    {"photons_at_the_last", {"bounced=C.*[DG]@S+[DG]?L:photons", "rest=.*:path"}},
    {"photons_at_the_second", {"second=C[DG][DG]@[DG]*L:photons", "rest=.*:path"}},
    {"ppm_of_caustics", {"caustic=C.*[DG]S+[DG]?L:ppm", "rest=.*:path"}},
    {"photon_map_at_the_first", {"seen=C[DG].*L:photonmap", "rest=.*:path"}, 8},
    {"photon_map_of_gather_rays", {"second=C[DG][DG]@[DG]*L:photonmap", "rest=.*:path"}},
    {"two_photon_maps",
     {"caustic=C[SV]*[DG]S+L:photonmap", "global=C[SV]*[DG]S*[DGV].*:photonmap", "rest=.*:path"}},
    {"photons_and_light", {"seen=C[DG].*L:photons+light", "rest=.*:path"}},
    {"photons_and_light_of_all", {"bare=C[SV]*(L|.*M):path", "rest=.*:photons+light"}},
    {"bdpt_of_all", {"all=.*:bdpt", "rest=.*:path"}},
    {"bdpt_of_some", {"glass=C.*<..'glass'>.*L:bdpt", "rest=.*:path"}},
    {"vcm_of_all", {"all=.*:vcm", "rest=.*:path"}, 10},
    {"bpm_of_caustics", {"caustic=C.*[DG]S+[DG]?L:bpm", "rest=.*:path"}},
    {"path_and_photons_of_all", {"all=.*:path+photons", "rest=.*:path"}},
    {"path_and_photons_of_some", {"glass=C.*<..'glass'>.*L:path+photons", "rest=.*:path"}},
    {"chains_of_caustics", {"seen=C.*[DG]S+L:mlt", "rest=.*:path"}, 3},
    {"chains_of_all", {"all=.*:mlt", "rest=.*:path"}, 3},
    {"chains_from_the_eye", {"key=C.*<L.'key'>:pssmlt", "rest=.*:path"}, 2},
    {"point_lights_of_all", {"indirect=C[^VH]*:pointlights", "rest=.*:path"}},
    {"point_lights_of_diffuse", {"diffuse=C[SV]*DD.*L:pointlights", "rest=.*:path"}},
    {"point_lights_behind_glass", {"seen=CS+[DG][DG]+L:pointlights", "rest=.*:path"}},
    {"forecast_of_caustics", {"caustic=C.*[DG]S+L:forecast", "rest=.*:path"}},
    {"forecast_of_all", {"all=.*:forecast"}},
    {"three_owners",
     {"a=C.*[DG]S+[DG]?L:photons", "b=C[DG]L:lighttrace", "c=C[DG][DG]L:path", "d=.*:path"}},
};

INSTANTIATE_TEST_SUITE_P(Routes, PartitionOwners, ::testing::ValuesIn(kOwners),
                         [](const auto& test) { return std::string(test.param.name); });

// A metal ring throws a caustic on the floor. Its alpha sweeps the specular band. With a threshold
// in place of the band, the caustic's route would lose all its light in one step.
TEST(RoughnessBand, MovesACausticFromOneRouteToAnotherWithoutAJump) {
  constexpr uint32_t kPasses = 64;
  const auto energies = [&](float alpha) {
    std::string text = R"(
  LookAt 0 4 -0.01  0 0 0  0 0 1
  Camera "perspective" "float fov" 30
  Film "rgb" "integer xresolution" 8 "integer yresolution" 8
  WorldBegin
  AttributeBegin
    Translate 3.5 2 0
    AreaLightSource "diffuse" "rgb L" [8 8 8]
    Shape "sphere" "float radius" 1.3
  AttributeEnd
  Material "diffuse" "rgb reflectance" [0.6 0.6 0.6]
  Shape "bilinearmesh" "point3 P" [-3 0 -3  3 0 -3  -3 0 3  3 0 3]
  Material "conductor" "bool remaproughness" false "float roughness" )";
    text += std::to_string(alpha) + R"(
  AttributeBegin Rotate -90 1 0 0 Shape "cylinder" "float radius" 1 "float zmin" 0.01 "float zmax" 0.5
  AttributeEnd
)";
    const auto scene = scene_from_text(text);
    IntegratorOptions options;
    options.photons_per_pass = 8192;
    options.camera_samples_per_pass = 16;
    options.max_depth = 6;
    options.radius = 0.5f;
    const Film film = render(*scene, "doidge2012", options, 11, kPasses);
    double caustic = 0, all = 0;
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        caustic += film.route_value(0, x, y).g;
        all +=
            (static_cast<double>(film.value(x, y).r) + film.value(x, y).g + film.value(x, y).b) / 3;
      }
    return std::pair{caustic / all,
                     all / (64 * picture_mean(render(*scene, "path", options, 12, 2 * kPasses)))};
  };
  const SpecularBand band;
  const auto [share_below, energy_below] = energies(0.95f * band.low);
  const auto [share_above, energy_above] = energies(1.05f * band.high);
  EXPECT_GT(share_below, 0.05) << "there is a caustic";
  EXPECT_EQ(share_above, 0) << "above the band nothing is S";
  constexpr int kSteps = 8;
  EXPECT_NEAR(energy_below, 1, 0.03);
  EXPECT_NEAR(energy_above, 1, 0.03);
  double before = share_below;
  for (int i = 0; i <= kSteps; ++i) {
    const float t = (static_cast<float>(i) + 0.5f) / (kSteps + 1);
    const auto [share, energy] = energies(band.low + t * (band.high - band.low));
    std::printf("alpha %.4f: caustic %.4f of the light, energy %.4f of path tracing's\n",
                static_cast<double>(band.low + t * (band.high - band.low)), share, energy);
    EXPECT_LE(share, before + 0.03 * share_below) << "falls";
    EXPECT_GE(share, before - 0.3 * share_below) << "does not jump";
    EXPECT_NEAR(share, share_below * (1 - static_cast<double>(t)), 0.12 * share_below);
    EXPECT_NEAR(energy, 1, 0.03) << "no light is lost on the way";
    before = share;
  }
}

}  // namespace
}  // namespace nephroid

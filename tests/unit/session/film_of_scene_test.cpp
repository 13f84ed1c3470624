// Output names, the memory of a render, and its outlier rejection.
#include "session/film_of_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>

#include "core/errors.h"
#include "film/film_output.h"
#include "film/splats.h"
#include "integrator/photon_mapping/ppm.h"
#include "integrator/presets/estimator_table.h"
#include "route/compile.h"
#include "scene/film_description.h"
#include "unit/film/scratch_directory.h"

namespace nephroid {
namespace {

Routes routes_of(const std::vector<std::string>& texts) {
  std::vector<RouteDefinition> routes;
  for (const std::string& text : texts) routes.push_back(parse_route(text, estimator_traits()));
  return compile_routes(routes, {}).routes;
}

TEST(FilmOfScene, DefaultOutputIsHereAndExr) {
  FilmDescription film;
  film.filename = "cornell-box.exr";
  EXPECT_EQ(default_output(film, "x.pbrt"), "cornell-box.exr");
  film.filename = "pictures/tea.pot.png";
  EXPECT_EQ(default_output(film, "x.pbrt"), "tea.pot.exr");
  film.filename = "bare";
  EXPECT_EQ(default_output(film, "x.pbrt"), "bare.exr");
  film.filename = "";
  EXPECT_EQ(default_output(film, "scenes/x.pbrt"), "x.exr");
  EXPECT_EQ(default_output(film, "scenes/x.pbrt.gz"), "x.exr");
  Diagnostics diagnostics;
  EXPECT_EQ(make_film_description({}, {}, diagnostics).filename, "");
}

constexpr uint64_t kMemory = uint64_t{64} << 30;
const IntegratorOptions kDefaults;
const IntegratorOptions kNoPhotons = [] {
  IntegratorOptions options;
  options.memory_photons = 0;
  return options;
}();

TEST(FilmOfScene, MemoryIsThatOfThePartsGroupsAndSplats) {
  // Exactly the memory of a one-route film: more is refused.
  const FilmLayout one = FilmLayout::of_routes({"all"});
  const Routes path = routes_of({"all=.*:path"});
  const auto memory = static_cast<double>(kMemory);
  FilmDescription description;
  description.crop_x0 = description.crop_y0 = 0;
  description.crop_x1 = 1024;
  const auto fill = [&](size_t bytes) {
    description.crop_y1 = static_cast<int>(memory / static_cast<double>(bytes) / 1024);
  };
  const size_t film = Film::bytes_per_pixel(one, false);
  fill(film);
  EXPECT_NO_THROW(check_memory({description, one, path, kDefaults}, kMemory, false, false));
  FilmLayout two = one;
  two.routes.emplace_back("rest");
  two.groups.push_back(0);
  EXPECT_THROW(check_memory({description, two, path, kDefaults}, kMemory, false, true), UsageError);
  description.gbuffer = GBufferSpace::kWorld;
  EXPECT_THROW(check_memory({description, one, path, kDefaults}, kMemory, false, false),
               SceneError);
  description.gbuffer = GBufferSpace::kNone;

  // Bytes per pixel. A splat is a sum of 48 bytes. Merging has a colour per part, a filter weight
  // and a bias. sppm keeps radius, count, flux and footprint; a pass adds colour, count and weight.
  // ppm has these per hit point. Photon maps have no bias. Estimators render one after another.
  constexpr int kHitPoints = 5;
  IntegratorOptions options = kNoPhotons;
  options.edit<PpmOptions>().hit_points = kHitPoints;
  const struct {
    std::vector<std::string> routes;
    size_t bytes;
  } rows[] = {{{"all=.*:lighttrace"}, 48},
              {{"all=C.*DL:photons"}, 12 + 8},
              {{"all=C.*DL:photons+light"}, 48 + 12 + 8},
              {{"all=C.*DL:sppm"}, 16 + 24 + 4 + 12 + 4 + 8},
              {{"all=C.*DL:ppm"}, 5 * (16 + 24 + 4 + 12 + 4 + 8)},
              {{"all=C.*DL:photonmap"}, 12 + 4},
              {{"a=C.*DL:photons", "b=C.*GL:photons"}, 2 * 12 + 8},
              {{"a=C.*DL:sppm", "b=C.*GL:photons+light"}, 16 + 24 + 4 + 48 + 12 + 8}};
  for (const auto& row : rows) {
    SCOPED_TRACE(row.routes.back());
    const Routes routes = routes_of(row.routes);
    fill(film + row.bytes);
    const MemoryNeed need{description, one, routes, options};
    EXPECT_NO_THROW(check_memory(need, kMemory, false, false));
    fill(film + row.bytes - 1);
    EXPECT_THROW(check_memory(need, kMemory, false, false), SceneError);
  }
}

TEST(FilmOfScene, MemoryIsRefusedWithWhatItIsFor) {
  const FilmLayout one = FilmLayout::of_routes({"all"});
  const Routes photons = routes_of({"all=C.*DL:photons"}), path = routes_of({"all=.*:path"});
  FilmDescription description;
  description.crop_x0 = description.crop_y0 = 0;
  description.crop_x1 = description.crop_y1 = 16;
  constexpr uint64_t kMiB = 1 << 20;
  MemoryNeed need{description, one, photons, kDefaults};
  need.held = 100 * kMiB;
  need.textures = 50 * kMiB;
  need.writes = true;
  EXPECT_NO_THROW(check_memory(need, 1 << 30, true, false));
  try {
    check_memory(need, 160 * kMiB, true, false);
    FAIL();
  } catch (const UsageError& error) {
    const std::string what = error.what();
    for (const char* part : {"--memory: 256 pixels (16 x 16) need about ", "100 MiB what is read",
                             "MiB photons", "50 MiB textures", "the limit is 160 MiB"})
      EXPECT_NE(what.find(part), std::string::npos) << part << " in " << what;
  }
  // Without photons there is enough memory.
  EXPECT_NO_THROW(check_memory({description, one, path, kDefaults, 1, false, 100 * kMiB, 50 * kMiB},
                               160 * kMiB, true, false));
}

TEST(FilmOfScene, RejectionOfOutliersNeedsMemoryToo) {
  const Routes routes = routes_of({"a=C.*DL:photons", "b=C.*GL:photons", "c=.*:path"});
  FilmLayout layout = FilmLayout::of_routes({"a", "b", "c"});
  layout.groups = {0, 0, 1};
  const auto memory = static_cast<double>(kMemory);
  const size_t bytes = Film::bytes_per_pixel(layout, false) + 2 * 12 + 8 +
                       OutlierRejection::bytes_per_pixel(2) + OutlierRejection::bytes_per_pixel(1);
  FilmDescription description;
  description.crop_x0 = description.crop_y0 = 0;
  description.crop_x1 = 1024;
  description.crop_y1 = static_cast<int>(memory / static_cast<double>(bytes) / 1024);
  const MemoryNeed with{description, layout, routes, kNoPhotons, 1, true},
      without{description, layout, routes, kNoPhotons};
  EXPECT_NO_THROW(check_memory(with, kMemory, false, false));
  description.crop_y1 = static_cast<int>(memory / static_cast<double>(bytes - 1) / 1024);
  EXPECT_THROW(check_memory(with, kMemory, false, false), SceneError);
  EXPECT_NO_THROW(check_memory(without, kMemory, false, false));
  // A pixel's counts take 64 bytes, a held sum 48.
  EXPECT_LE(OutlierRejection::bytes_per_pixel(1), 320u);
}

TEST(FilmOfScene, RejectionKnowsHowManyPixelsALightPathExposes) {
  const auto filter_of = [](const Vec2f& radius) {
    return PixelFilter([](float, float, const std::array<float, 2>&) { return 1.0f; }, radius, {},
                       {});
  };
  const auto exposed = [&](const std::string& route, float radius, const PixelFilter& filter) {
    IntegratorOptions options;
    options.radius = radius;
    SceneSettings of_scene;
    of_scene.outlier_neighbours = 11;
    const OutlierSettings settings =
        outlier_settings(routes_of({route}), options, filter, 1, of_scene);
    EXPECT_EQ(settings.neighbours, 11);
    EXPECT_EQ(settings.exposed_pixels.size(), 1u);
    return settings.exposed_pixels.at(0);
  };
  // With a filter of 3 x 4 pixels, at the default radius, at a radius of 3, and at one below a
  // pixel.
  const PixelFilter wide = filter_of({1.5f, 2}), narrow = filter_of({0.5f, 0.5f});
  const struct {
    const char* estimator;
    float by_default, with_three, with_little;
  } rows[] = {{"path", 1, 1, 1},
              {"pointlights", 1, 1, 1},
              {"forecast", 1, 1, 1},
              {"photons", 2.25f * kPi, 9 * kPi, 1},
              {"sppm", 4 * kPi, 9 * kPi, 1},
              {"ppm", 4 * kPi, 9 * kPi, 1},
              {"photonmap", 256 * kPi, 9 * kPi, 1},
              {"bpm", 2.25f * kPi, 9 * kPi, 1},
              {"path+photons", 4 * kPi, 9 * kPi, 1},
              {"lighttrace", 12, 12, 12},
              {"bdpt", 12, 12, 12},
              {"mlt", 12, 12, 12},
              {"pssmlt", 12, 12, 12},
              {"photons+light", 12, 9 * kPi, 12},
              {"vcm", 12, 9 * kPi, 12}};
  for (const EstimatorTraits* estimator : estimator_traits()) {
    SCOPED_TRACE(estimator->name);
    const auto row = std::find_if(std::begin(rows), std::end(rows), [&](const auto& r) {
      return std::string(r.estimator) == estimator->name;
    });
    ASSERT_NE(row, std::end(rows));
    const std::string route = std::string("a=C.*DL:") + estimator->name;
    EXPECT_FLOAT_EQ(exposed(route, 0, wide), row->by_default);
    EXPECT_FLOAT_EQ(exposed(route, 3, wide), row->with_three);
    EXPECT_FLOAT_EQ(exposed(route, 0.25f, wide), row->with_little);
    EXPECT_FLOAT_EQ(exposed(route, 0.25f, narrow), 1);
  }
  const OutlierSettings both =
      outlier_settings(routes_of({"a=C.*DL:lighttrace", "b=.*:path"}), {}, wide, 1);
  EXPECT_EQ(both.exposed_pixels, (std::vector<float>{12, 1}));
}

TEST(FilmOfScene, NoRouteTakesTheNameOfALayerOfPictures) {
  FilmSettings settings;
  settings.width = settings.height = 2;
  settings.crop = {0, 0, 2, 2};
  for (const bool gbuffer : {false, true}) {
    settings.gbuffer = gbuffer;
    Film film(settings, FilmLayout::of_routes({"all"}));
    film.reject_outliers({{1.0f}, 8});
    for (const std::string& channel : film_picture(film, {}).channels) {
      const std::string layer = channel.substr(0, channel.find('.'));
      if (layer == "all") continue;
      EXPECT_THROW(parse_route(layer + "=.*:path", estimator_traits()), UsageError) << layer;
    }
  }
}

TEST(FilmOfScene, TheFilmsMemoryIsCountedInFull) {
  // 24 bytes per route, 48 per group, features (six of 8 bytes, and depth) and a counter.
  FilmLayout layout = FilmLayout::of_routes({"a", "b"});
  const size_t two = Film::bytes_per_pixel(layout, false);
  EXPECT_GE(two, 2u * 24 + 2 * 48 + 6 * 8 + 16 + 8);
  layout.routes.emplace_back("c");
  layout.groups.push_back(1);
  EXPECT_EQ(Film::bytes_per_pixel(layout, false), two + 24);
  layout.groups = {0, 0, 0};
  const size_t one_group = two + 24 - 48;
  EXPECT_EQ(Film::bytes_per_pixel(layout, false), one_group);
  EXPECT_GE(Film::bytes_per_pixel(layout, true), one_group + 13 * 16);
  EXPECT_EQ(SplatBuffer::bytes_per_pixel(3), 144u);
}

TEST(FilmOfScene, LayersByLightAreCheap) {
  FilmLayout layout = FilmLayout::of_routes({"a", "b"});
  layout.groups = {0, 0};
  const size_t without = Film::bytes_per_pixel(layout, false);
  layout.parts.clear();
  for (int light = 0; light < 12; ++light) {
    layout.aovs.push_back("light" + std::to_string(light));
    for (const int route : {0, 1}) layout.parts.push_back({route, {light}});
  }
  EXPECT_EQ(Film::bytes_per_pixel(layout, false), without + 12 * 24);
  // Groups count their estimates apart, so they need sums apart.
  layout.groups = {0, 1};
  EXPECT_EQ(Film::bytes_per_pixel(layout, false), without + 48 + 2 * 12 * 24);
}

}  // namespace
}  // namespace nephroid

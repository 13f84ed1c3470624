// Compares gathering photons with a lower bound and prints a line of Markdown for each scene.
// Traces a pass of photons on one thread, sorts them into the grid and queries places between them.
// A bare loop then visits the same photons again at known positions of the sorted array.
// tools/measure_photons builds and runs it.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/parallel.h"
#include "core/sampler.h"
#include "integrator/presets/estimator_table.h"
#include "photon/photon_grid.h"
#include "photon/photon_tracer.h"
#include "route/compile.h"
#include "session/scene_loading.h"

using namespace nephroid;

namespace {

constexpr int64_t kPaths = 1 << 17;
constexpr size_t kQueries = 1 << 17, kSampled = 1 << 10;
constexpr int kRuns = 5, kMaxEvents = 16;

double seconds_of(const auto& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The fastest of some runs.
double least_seconds(const auto& f) {
  double least = seconds_of(f);
  for (int i = 1; i < kRuns; ++i) least = std::min(least, seconds_of(f));
  return least;
}

/// The route of all photons, as in `sppm`.
OwnedRoutes all_photons(const Scene& scene) {
  const std::vector<RouteDefinition> routes = {
      parse_route("photons=.*:photons", estimator_traits())};
  RouteCompilation compiled = compile_routes(routes, {});
  OwnedRoutes owned;
  owned.symbols = std::make_shared<const SceneSymbols>(scene, compiled.routes.labels());
  owned.routes = std::make_shared<const Routes>(std::move(compiled.routes));
  return owned;
}

/// The radius that finds `wanted` photons around the median photon.
float radius_for(const PhotonGrid& grid, size_t wanted) {
  std::vector<float> radii;
  std::vector<PhotonGrid::Neighbour> found;
  const size_t step = std::max<size_t>(1, grid.size() / kSampled);
  for (size_t i = 0; i < grid.size(); i += step) {
    grid.nearest(
        grid.photons()[i].p, 1e6f, wanted, [](const Photon&) { return true; }, found);
    radii.push_back(std::sqrt(found.back().distance_squared));
  }
  std::nth_element(radii.begin(), radii.begin() + std::ssize(radii) / 2, radii.end());
  return radii[radii.size() / 2];
}

/// Query points between photons, as close to each other as those of neighbouring pixels.
std::vector<Vec3f> places(const PhotonGrid& grid, float radius) {
  std::vector<Vec3f> all;
  for (size_t i = 0; i < kQueries; ++i) {
    const uint64_t bits = hash_combine(i, 1);
    const Photon& photon = grid.photons()[i * grid.size() / kQueries];
    const float angle = static_cast<float>(bits >> 40) * 0x1p-24f * 2 * kPi;
    Vec3f s, t;
    coordinate_system(photon.ng.unpacked(), &s, &t);
    all.push_back(photon.p + (s * std::cos(angle) + t * std::sin(angle)) * (0.5f * radius));
  }
  return all;
}

struct Gather {
  double found = 0;                              ///< photons per query
  double nanoseconds = 0, bare_nanoseconds = 0;  ///< times per query
};

Gather measure_gather(const PhotonGrid& grid, size_t wanted) {
  const float radius = radius_for(grid, wanted);
  const std::vector<Vec3f> where = places(grid, radius);
  SampledSpectrum sum;
  const double seconds = least_seconds([&] {
    for (const Vec3f& p : where)
      grid.query(p, radius, [&](const Photon& photon, float) { sum += photon.flux.unpacked(); });
  });
  // Photons that are contiguous in memory.
  struct Run {
    uint32_t begin, end;
  };
  std::vector<Run> runs;
  std::vector<uint32_t> first_run;
  const Photon* photons = grid.photons().data();
  uint64_t found = 0;
  for (const Vec3f& p : where) {
    first_run.push_back(static_cast<uint32_t>(runs.size()));
    grid.query(p, radius, [&](const Photon& photon, float) {
      const auto i = static_cast<uint32_t>(&photon - photons);
      if (runs.size() > first_run.back() && runs.back().end == i)
        ++runs.back().end;
      else
        runs.push_back({i, i + 1});
      ++found;
    });
  }
  first_run.push_back(static_cast<uint32_t>(runs.size()));
  SampledSpectrum bare_sum;
  const double bare = least_seconds([&] {
    for (size_t q = 0; q < where.size(); ++q)
      for (uint32_t r = first_run[q]; r < first_run[q + 1]; ++r)
        for (uint32_t i = runs[r].begin; i < runs[r].end; ++i) {
          const Vec3f d = photons[i].p - where[q];
          if (dot(d, d) <= radius * radius) bare_sum += photons[i].flux.unpacked();
        }
  });
  // Same photons in the same order: equal bits. The check also keeps the loops from being removed.
  if (!(sum == bare_sum)) throw std::runtime_error("the bare loop found another sum of photons");
  const double queries = static_cast<double>(where.size());
  return {static_cast<double>(found) / queries, 1e9 * seconds / queries, 1e9 * bare / queries};
}

void measure(const char* file) {
  const LoadedScene loaded = load_scene(file, {});
  const Scene& scene = *loaded.scene;
  const OwnedRoutes owned = all_photons(scene);
  PhotonTraceSettings settings;
  settings.key = {1, 0};
  settings.photons_per_pass = kPaths;
  settings.lambda = SampledWavelengths::sample_visible(0.3f);
  settings.max_events = kMaxEvents;
  PhotonTrace trace;
  const double tracing =
      seconds_of([&] { trace = trace_photons(scene, owned, settings, 0, kPaths); });
  if (trace.photons.empty()) throw std::runtime_error(std::string(file) + ": no photons");
  std::optional<PhotonGrid> grid;
  double building = 1e30;
  for (int i = 0; i < kRuns; ++i) {
    std::vector<Photon> copy = trace.photons;
    grid.reset();
    building = std::min(building, seconds_of([&] { grid.emplace(std::move(copy)); }));
  }
  const auto n = static_cast<double>(trace.photons.size());
  std::printf("| %s | %.2f | %.0f | %.0f | %.1f %% | %.0f |", file, n / kPaths,
              1e9 * tracing / kPaths, 1e9 * building / n, 100 * building / (building + tracing),
              static_cast<double>(grid->bytes()) / n);
  for (const size_t wanted : {4, 32}) {
    const Gather g = measure_gather(*grid, wanted);
    std::printf(" %.1f | %.0f | %.0f | %.1f |", g.found, g.nanoseconds, g.bare_nanoseconds,
                g.nanoseconds / g.bare_nanoseconds);
  }
  std::printf("\n");
}

}  // namespace

int main(int count, char** arguments) try {
  const ThreadLimit one(1);
  std::printf(
      "| scene | photons a light path | ns to trace a path | ns to sort a photon | sorting of a "
      "pass | bytes a photon | found a query | ns | bare ns | ratio | found a query | ns | bare ns "
      "| ratio |\n|%s\n",
      " --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |");
  for (int i = 1; i < count; ++i) measure(arguments[i]);
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}

#include "bench/bench.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>

#include "bench/claims.h"
#include "bench/kept.h"
#include "bench/kept_scenes.h"
#include "bench/measure.h"
#include "bench/render.h"
#include "core/counted.h"
#include "core/errors.h"
#include "core/parallel.h"
#include "film/atomic_file.h"
#include "film/exr_file.h"
#include "input/spelling.h"
#include "session/checkpoint/version.h"

namespace nephroid {
namespace {

constexpr int kSignalStatus = 128;

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos)
      return line.substr(colon + 2);
  }
  return "unknown";
}

std::string date_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc = {};
  gmtime_r(&now, &utc);
  return fmt::format("{:04}-{:02}-{:02} {:02}:{:02} UTC", utc.tm_year + 1900, utc.tm_mon + 1,
                     utc.tm_mday, utc.tm_hour, utc.tm_min);
}

/// The effective limit: the command line's, else the scene's, else the suite's.
BenchLimit limit_of(const BenchSuite& suite, const BenchScene& scene, const BenchLimit& over_all) {
  if (over_all.is_set()) return over_all;
  return scene.limit.is_set() ? scene.limit : suite.limit;
}

std::vector<const BenchScene*> chosen_scenes(const BenchSuite& suite, const BenchOptions& options) {
  std::vector<std::string> names;
  for (const BenchScene& scene : suite.scenes) names.push_back(scene.name);
  for (const std::string& name : options.only)
    if (suite.find_scene(name) == nullptr)
      throw UsageError(fmt::format("--only: the suite has no scene '{}', expected one of: {}{}",
                                   name, fmt::join(names, ", "), did_you_mean(name, names)));
  std::vector<const BenchScene*> chosen;
  for (const BenchScene& scene : suite.scenes) {
    if (!options.only.empty() &&
        std::find(options.only.begin(), options.only.end(), scene.name) == options.only.end())
      continue;
    if (!limit_of(suite, scene, options.limit).is_set())
      throw UsageError(
          fmt::format("{}: the runs of scene '{}' have no limit, expected \"time\" or \"passes\" "
                      "in the suite, or --time or --passes",
                      suite.file, scene.name));
    chosen.push_back(&scene);
  }
  return chosen;
}

/// One invocation of a suite, with the state that its renders share.
class Bench {
 public:
  Bench(const BenchSuite& suite, const BenchOptions& options, SignalFlags& signals)
      : suite_(suite), options_(options), signals_(signals), scenes_(options.directory) {}

  bool stopped() const { return signals_.stop.load() != 0; }

  BenchSceneResult scene(const BenchScene& scene) {
    BenchSceneResult result;
    result.name = scene.name;
    Picture reference;
    try {
      const auto found = reference_of(scene, &reference);
      if (!found) return result;
      result.reference = *found;
    } catch (const std::exception& error) {
      result.failure = error.what();
      options_.say(fmt::format("{}: {}", scene.name, error.what()));
      return result;
    }
    result.width = reference.width();
    result.height = reference.height();
    // Round by round, so that other load of the machine affects all integrators alike.
    const uint32_t rounds = options_.repeat > 0 ? options_.repeat : suite_.repeat;
    for (uint32_t round = 0; round < rounds; ++round)
      if (!run_all(scene, round, reference, &result)) break;
    return result;
  }

 private:
  /// The seed of a round: consecutive seeds, skipping the reference's, with which the error would
  /// be too small.
  static uint64_t seed_of_round(const BenchScene& scene, uint64_t first, uint32_t round) {
    const bool rendered = scene.reference.file.empty();
    const uint64_t taken = scene.reference.integrator.seed;
    const uint64_t seed = first + round;
    // Compares differences, since the sum may overflow.
    return rendered && round > 0 && taken - first <= round && taken != first ? seed + 1 : seed;
  }

  /// Runs every integrator of the scene with the seed of the round. Runs that failed in the first
  /// round are not repeated. False if a signal stopped it.
  bool run_all(const BenchScene& scene, uint32_t round, const Picture& reference,
               BenchSceneResult* result) {
    for (size_t i = 0; i < scene.integrators.size(); ++i) {
      BenchIntegrator integrator = *suite_.find_integrator(scene.integrators[i]);
      if (round > 0 && !result->runs[i].failure.empty()) continue;
      integrator.seed = seed_of_round(scene, integrator.seed, round);
      const auto run = run_of(scene, integrator, reference, result->reference.key);
      if (!run) return false;
      if (round == 0)
        result->runs.push_back(*run);
      else
        result->runs[i].again.push_back(*run);
    }
    return true;
  }

  /// Hash of all files of a render's scene.
  uint64_t hash_of_scene(const BenchRender& render) {
    return scenes_.hash(render.scene->file, [&]() -> const SceneFiles& {
      return *shelf_.load(render).description.files;
    });
  }

  /// The reference and its picture: from a file, kept from earlier, or rendered now. Empty if a
  /// signal stopped it.
  std::optional<BenchReferenceResult> reference_of(const BenchScene& scene, Picture* picture) {
    const BenchReference& wanted = scene.reference;
    BenchReferenceResult result;
    if (!wanted.file.empty()) {
      *picture = read_picture(wanted.file);
      result.picture = wanted.file;
      result.key = hash_picture(*picture);
      result.own_error = own_error(*picture);
      return result;
    }
    const BenchRender render{&scene, &wanted.integrator, wanted.limit, true};
    const KeptFiles files = kept_files(options_.directory, "references", scene.name,
                                       reference_key(render, hash_of_scene(render)));
    const RouteChoice& routes = wanted.integrator.routes;
    const std::string integrator = name_of(routes, routes.integrator);
    if (auto kept = kept_reference(files, picture)) {
      kept->integrator = integrator;
      return kept;
    }
    options_.say(fmt::format("{}: rendering the reference", scene.name));
    const auto rendered = render_for_bench(render, nullptr, shelf_, signals_);
    if (!rendered) return std::nullopt;
    write_exr(files.picture, rendered->picture);
    // Read back, so that it is the same as in a later invocation.
    *picture = read_picture(files.picture);
    result.picture = files.picture;
    result.key = hash_picture(*picture);
    result.rendered = true;
    result.integrator = integrator;
    result.passes = rendered->run.end().passes;
    result.seconds = rendered->run.end().seconds;
    result.own_error = own_error(*picture);
    result.energy = rendered->run.energy;
    write_text(files.json, reference_to_json(result));
    return result;
  }

  /// The reference of an earlier invocation and its picture, if the figures belong to that picture.
  static std::optional<BenchReferenceResult> kept_reference(const KeptFiles& files,
                                                            Picture* picture) {
    const auto text = text_of_file(files.json);
    if (!text || !std::filesystem::exists(files.picture)) return std::nullopt;
    auto reference = reference_from_json(*text);
    if (!reference) return std::nullopt;
    *picture = read_picture(files.picture);
    if (reference->key != hash_picture(*picture)) return std::nullopt;
    reference->kept = true;
    reference->picture = files.picture;
    return reference;
  }

  /// A run, kept from earlier or rendered now. Empty if a signal stopped it.
  std::optional<BenchRun> run_of(const BenchScene& scene, const BenchIntegrator& integrator,
                                 const Picture& reference, const std::string& reference_hash) {
    const BenchRender render{&scene, &integrator, limit_of(suite_, scene, options_.limit),
                             !scene.reference.file.empty()};
    std::string title = scene.name + ", " + integrator.name;
    if (integrator.seed > 0) title += fmt::format(", seed {}", integrator.seed);
    BenchRun failed;
    failed.integrator = integrator.name;
    failed.seed = integrator.seed;
    try {
      const std::string key = run_key(render, hash_of_scene(render), reference_hash);
      const KeptFiles files =
          kept_files(options_.directory, "runs", scene.name + "-" + integrator.name, key);
      if (const auto kept = kept_run(files)) {
        options_.say(title + ": kept from earlier");
        return kept;
      }
      options_.say(title + ": rendering");
      auto rendered = render_for_bench(render, &reference, shelf_, signals_);
      if (!rendered) return std::nullopt;
      BenchRun& run = rendered->run;
      for (const std::string& warning : rendered->warnings)
        options_.say(title + ": warning: " + warning);
      run.key = key;
      run.picture = files.picture;
      write_exr(files.picture, rendered->picture);
      // Written last: a run with this file is finished.
      write_text(files.json, run_to_json(run));
      options_.say(fmt::format("{}: {} in {:.2f} s, RMSE {:.4g}", title,
                               counted(run.end().passes, "pass", "passes"), run.end().seconds,
                               run.end().errors.rmse));
      return run;
    } catch (const std::exception& error) {
      failed.failure = error.what();
    }
    options_.say(title + ": " + failed.failure);
    return failed;
  }

  static std::optional<BenchRun> kept_run(const KeptFiles& files) {
    const auto text = text_of_file(files.json);
    if (!text || !std::filesystem::exists(files.picture)) return std::nullopt;
    auto run = run_from_json(*text);
    if (!run || run->points.empty()) return std::nullopt;
    run->kept = true;
    run->picture = files.picture;
    return run;
  }

  const BenchSuite& suite_;
  const BenchOptions& options_;
  SignalFlags& signals_;
  SceneShelf shelf_;
  KeptScenes scenes_;
};

void write_results(const BenchResults& results) {
  const std::filesystem::path directory(results.directory);
  const auto write = [&](const char* name, const std::string& text) {
    write_text((directory / name).string(), text);
  };
  write("results.json", results_json(results));
  write("runs.csv", runs_csv(results));
  write("curves.csv", curves_csv(results));
}

}  // namespace

BenchResults run_bench(const BenchSuite& suite, const BenchOptions& options, SignalFlags& signals) {
  const std::vector<const BenchScene*> scenes = chosen_scenes(suite, options);
  std::error_code error;
  std::filesystem::create_directories(options.directory, error);
  if (error) throw IoError(options.directory + ": cannot make the directory: " + error.message());
  check_file_can_be_written((std::filesystem::path(options.directory) / "results.json").string());

  BenchResults results;
  results.suite = suite;
  results.directory = options.directory;
  results.machine = {kVersion,   instruction_set(), processor_name(),
                     date_now(), thread_count(),    options.command};
  Bench bench(suite, options, signals);
  for (const BenchScene* scene : scenes) {
    if (bench.stopped()) break;
    results.scenes.push_back(bench.scene(*scene));
  }
  results.signal = signals.stop.load();
  results.verdicts = judge_claims(results);
  write_results(results);
  return results;
}

int exit_status(const BenchResults& results, bool strict) {
  if (results.signal != 0) return kSignalStatus + results.signal;
  const bool claims_hold =
      std::all_of(results.verdicts.begin(), results.verdicts.end(),
                  [](const BenchVerdict& v) { return v.state == BenchVerdict::State::kHolds; });
  if (results.failures() > 0 || (strict && !claims_hold))
    return static_cast<int>(ExitStatus::kRender);
  return static_cast<int>(ExitStatus::kDone);
}

}  // namespace nephroid

// JSON in the order of the structures. Reading expects the names and types that this program
// writes, and fails for anything else.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/repeats.h"
#include "bench/result.h"
#include "core/errors.h"

namespace nephroid {
namespace {

using ResultJson = nlohmann::ordered_json;

/// Version of results.json; other versions are refused.
constexpr int kResultsFormat = 2;

ResultJson errors_json(const BenchErrors& e) {
  return {{"rmse", e.rmse},
          {"relmse", e.relmse},
          {"relmse_trim", e.relmse_trim},
          {"mean_error", e.mean_error},
          {"flip", e.flip}};
}

/// The figure of a JSON value. Figures that are not finite are written as null: the relative error
/// of a mean for a black reference.
double figure_of(const ResultJson& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

BenchErrors errors_of(const ResultJson& json) {
  const auto figure = [&](const char* name) { return figure_of(json.at(name)); };
  return {figure("rmse"), figure("relmse"), figure("relmse_trim"), figure("mean_error"),
          figure("flip")};
}

ResultJson shares_json(const BenchShares& shares) {
  ResultJson json = ResultJson::object();
  for (const auto& [name, share] : shares) json[name] = share;
  return json;
}

ResultJson named_json(const BenchNamedErrors& list) {
  ResultJson json = ResultJson::object();
  for (const auto& [name, errors] : list) json[name] = errors_json(errors);
  return json;
}

BenchNamedErrors named_of(const ResultJson& json) {
  BenchNamedErrors list;
  for (const auto& [name, errors] : json.items()) list.emplace_back(name, errors_of(errors));
  return list;
}

BenchShares shares_of(const ResultJson& json) {
  BenchShares shares;
  for (const auto& [name, share] : json.items()) shares.emplace_back(name, figure_of(share));
  return shares;
}

/// One render.
ResultJson run_json(const BenchRun& run) {
  ResultJson json = {{"integrator", run.integrator}, {"seed", run.seed}, {"key", run.key}};
  if (!run.failure.empty()) {
    json["failure"] = run.failure;
    return json;
  }
  json["picture"] = run.picture;
  json["routes"] = run.routes;
  json["options"] = run.options;
  json["rays"] = run.rays;
  json["emitted"] = run.emitted;
  json["photons_stored"] = run.photons_stored;
  json["bytes"] = run.bytes;
  json["photon_bytes"] = run.photon_bytes;
  json["pixel_bytes"] = run.pixel_bytes;
  json["first_pass_bytes"] = run.first_pass_bytes;
  json["process_bytes"] = run.process_bytes;
  json["energy"] = shares_json(run.energy);
  json["regions"] = named_json(run.regions);
  json["notes"] = run.notes;
  json["points"] = ResultJson::array();
  for (const BenchPoint& p : run.points)
    json["points"].push_back({{"passes", p.passes},
                              {"seconds", p.seconds},
                              {"emitted", p.emitted},
                              {"errors", errors_json(p.errors)},
                              {"layers", named_json(p.layers)}});
  return json;
}

BenchRun run_of(const ResultJson& json) {
  BenchRun run;
  run.integrator = json.at("integrator");
  run.seed = json.at("seed");
  run.key = json.at("key");
  run.failure = json.value("failure", "");
  if (!run.failure.empty()) return run;
  run.picture = json.at("picture");
  run.routes = json.at("routes");
  run.options = json.at("options");
  run.rays = json.at("rays");
  run.emitted = json.at("emitted");
  run.photons_stored = json.at("photons_stored");
  run.bytes = json.at("bytes");
  run.photon_bytes = json.at("photon_bytes");
  run.pixel_bytes = json.at("pixel_bytes");
  run.first_pass_bytes = json.at("first_pass_bytes");
  run.process_bytes = json.at("process_bytes");
  run.energy = shares_of(json.at("energy"));
  run.regions = named_of(json.at("regions"));
  run.notes = json.at("notes").get<std::vector<std::string>>();
  for (const ResultJson& point : json.at("points"))
    run.points.push_back({point.at("passes"), point.at("seconds"), point.at("emitted"),
                          errors_of(point.at("errors")), named_of(point.at("layers"))});
  return run;
}

ResultJson reference_json(const BenchReferenceResult& r) {
  ResultJson json = {{"picture", r.picture},   {"key", r.key},
                     {"rendered", r.rendered}, {"passes", r.passes},
                     {"seconds", r.seconds},   {"energy", shares_json(r.energy)}};
  if (!r.integrator.empty()) json["integrator"] = r.integrator;
  if (r.own_error) json["own_error"] = *r.own_error;
  return json;
}

BenchReferenceResult reference_of(const ResultJson& json) {
  BenchReferenceResult r;
  r.picture = json.at("picture");
  r.key = json.at("key");
  r.rendered = json.at("rendered");
  r.passes = json.at("passes");
  r.seconds = json.at("seconds");
  r.energy = shares_of(json.at("energy"));
  r.integrator = json.value("integrator", "");
  if (json.contains("own_error")) r.own_error = figure_of(json.at("own_error"));
  return r;
}

/// Parses a text and applies `read`; empty if the text does not fit.
template <class Read>
auto read_json(const std::string& text, const Read& read)
    -> std::optional<decltype(read(ResultJson()))> {
  try {
    return read(ResultJson::parse(text));
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

/// JSON as text. Paths and messages may have bytes that are not UTF-8, which are replaced.
std::string dump(const ResultJson& json) {
  return json.dump(2, ' ', false, ResultJson::error_handler_t::replace) + "\n";
}

const char* state_name(BenchVerdict::State state) {
  if (state == BenchVerdict::State::kHolds) return "holds";
  return state == BenchVerdict::State::kFails ? "fails" : "not measured";
}

BenchVerdict::State state_of(const std::string& name) {
  using State = BenchVerdict::State;
  for (const State state : {State::kHolds, State::kFails, State::kNotMeasured})
    if (name == state_name(state)) return state;
  throw UsageError("a claim has the unknown state '" + name +
                   "', expected 'holds', 'fails' or 'not measured'");
}

/// A run of results.json, with its repetitions.
BenchRun repeated_run_of(const ResultJson& json) {
  BenchRun run = run_of(json);
  if (json.contains("again"))
    for (const ResultJson& again : json.at("again")) run.again.push_back(run_of(again));
  const auto is_whole = [](const BenchRun& r) { return !r.failure.empty() || !r.points.empty(); };
  if (!is_whole(run) || !std::all_of(run.again.begin(), run.again.end(), is_whole))
    throw UsageError("a run of '" + run.integrator + "' has no points");
  return run;
}

void read_scene(const ResultJson& json, BenchResults* results) {
  BenchScene shown;
  shown.name = json.at("name");
  shown.title = json.at("title");
  shown.file = json.at("file");
  shown.exposure = json.at("exposure");
  BenchSceneResult scene;
  scene.name = shown.name;
  scene.failure = json.at("failure");
  scene.width = json.at("width");
  scene.height = json.at("height");
  scene.reference = reference_of(json.at("reference"));
  for (const ResultJson& run : json.at("runs")) {
    scene.runs.push_back(repeated_run_of(run));
    if (results->suite.find_integrator(scene.runs.back().integrator) == nullptr)
      throw UsageError("unknown integrator '" + scene.runs.back().integrator + "'");
  }
  results->suite.scenes.push_back(std::move(shown));
  results->scenes.push_back(std::move(scene));
}

void read_claim(const ResultJson& json, BenchResults* results) {
  BenchClaim claim;
  claim.text = json.at("text");
  BenchVerdict verdict;
  verdict.state = state_of(json.at("state"));
  for (const ResultJson& figure : json.at("figures")) {
    verdict.figures.push_back({figure.at("scene"), figure.at("figure"), figure.at("holds")});
    if (results->suite.find_scene(verdict.figures.back().scene) == nullptr)
      throw UsageError("unknown scene '" + verdict.figures.back().scene + "'");
  }
  results->suite.claims.push_back(std::move(claim));
  results->verdicts.push_back(std::move(verdict));
}

BenchResults results_of(const ResultJson& json) {
  if (json.at("format") != kResultsFormat)
    throw UsageError("its format is " + json.at("format").dump() + ", expected " +
                     std::to_string(kResultsFormat));
  BenchResults results;
  results.suite.name = json.at("suite");
  results.suite.title = json.at("title");
  results.suite.description = json.at("description");
  results.directory = json.at("directory");
  results.signal = json.at("signal");
  const ResultJson& m = json.at("machine");
  results.machine = {m.at("version"), m.at("instruction_set"), m.at("processor"),
                     m.at("date"),    m.at("threads"),         m.at("command")};
  for (const ResultJson& name : json.at("integrators"))
    results.suite.integrators.emplace_back().name = name;
  for (const ResultJson& scene : json.at("scenes")) read_scene(scene, &results);
  for (const ResultJson& claim : json.at("claims")) read_claim(claim, &results);
  return results;
}

/// Updates the path of a picture in the directory of results, which may have moved.
void follow(std::string* picture, const std::string& old_directory, const std::string& directory) {
  if (picture->rfind(old_directory + "/", 0) == 0)
    *picture =
        (std::filesystem::path(directory) / picture->substr(old_directory.size() + 1)).string();
}

}  // namespace

const BenchRun* BenchSceneResult::find_run(const std::string& integrator) const {
  for (const BenchRun& run : runs)
    if (run.integrator == integrator && run.failure.empty()) return &run;
  return nullptr;
}

double without_reference(double rmse, double own_error) {
  const double square = rmse * rmse - own_error * own_error;
  return std::copysign(std::sqrt(std::abs(square)), square);
}

int BenchResults::failures() const {
  int count = 0;
  for (const BenchSceneResult& scene : scenes) {
    count += !scene.failure.empty();
    for (const BenchRun& run : scene.runs) {
      count += !run.failure.empty();
      for (const BenchRun& again : run.again) count += !again.failure.empty();
    }
  }
  return count;
}

std::string run_to_json(const BenchRun& run) {
  return dump(run_json(run));
}
std::optional<BenchRun> run_from_json(const std::string& text) {
  return read_json(text, run_of);
}
std::string reference_to_json(const BenchReferenceResult& reference) {
  return dump(reference_json(reference));
}
std::optional<BenchReferenceResult> reference_from_json(const std::string& text) {
  return read_json(text, reference_of);
}

std::string results_json(const BenchResults& results) {
  const BenchMachine& m = results.machine;
  ResultJson json = {{"format", kResultsFormat},
                     {"suite", results.suite.name},
                     {"title", results.suite.title},
                     {"description", results.suite.description},
                     {"directory", results.directory},
                     {"signal", results.signal},
                     {"integrators", ResultJson::array()},
                     {"machine",
                      {{"version", m.version},
                       {"instruction_set", m.instruction_set},
                       {"processor", m.processor},
                       {"threads", m.threads},
                       {"date", m.date},
                       {"command", m.command}}},
                     {"scenes", ResultJson::array()},
                     {"claims", ResultJson::array()}};
  for (const BenchIntegrator& integrator : results.suite.integrators)
    json["integrators"].push_back(integrator.name);
  for (const BenchSceneResult& scene : results.scenes) {
    const BenchScene& in_suite = *results.suite.find_scene(scene.name);
    ResultJson runs = ResultJson::array();
    for (const BenchRun& run : scene.runs) {
      ResultJson all = run_json(run);
      if (!run.again.empty()) {
        if (run.failure.empty()) all["errors_of_all"] = errors_json(errors_at_end(run));
        all["again"] = ResultJson::array();
        for (const BenchRun& again : run.again) all["again"].push_back(run_json(again));
      }
      runs.push_back(std::move(all));
    }
    json["scenes"].push_back({{"name", scene.name},
                              {"title", in_suite.title},
                              {"file", in_suite.file},
                              {"exposure", in_suite.exposure},
                              {"failure", scene.failure},
                              {"width", scene.width},
                              {"height", scene.height},
                              {"reference", reference_json(scene.reference)},
                              {"runs", std::move(runs)}});
  }
  for (size_t i = 0; i < results.verdicts.size(); ++i) {
    ResultJson figures = ResultJson::array();
    for (const BenchFigure& figure : results.verdicts[i].figures)
      figures.push_back(
          {{"scene", figure.scene}, {"figure", figure.text}, {"holds", figure.holds}});
    json["claims"].push_back({{"text", results.suite.claims[i].text},
                              {"state", state_name(results.verdicts[i].state)},
                              {"figures", std::move(figures)}});
  }
  return dump(json);
}

BenchResults results_from_json(const std::string& text, const std::string& file) {
  BenchResults results;
  try {
    results = results_of(ResultJson::parse(text));
  } catch (const std::exception& error) {
    throw UsageError(
        fmt::format("{}: not the results of a suite: {}; expected a results.json of "
                    "this version of nephroid bench",
                    file, error.what()));
  }
  const std::string old_directory =
      std::exchange(results.directory, std::filesystem::path(file).parent_path().string());
  for (BenchSceneResult& scene : results.scenes) {
    follow(&scene.reference.picture, old_directory, results.directory);
    for (BenchRun& run : scene.runs) {
      follow(&run.picture, old_directory, results.directory);
      for (BenchRun& again : run.again) follow(&again.picture, old_directory, results.directory);
    }
  }
  return results;
}

}  // namespace nephroid

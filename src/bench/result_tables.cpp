// Results as tables of comma-separated values.
#include <fmt/format.h>

#include "bench/result.h"

namespace nephroid {

namespace {

constexpr const char* kErrorColumns = "rmse,relmse,relmse_trim,mean_error,flip";

/// A CSV field, quoted if necessary.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string error_fields(const BenchErrors& e) {
  return fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}", e.rmse, e.relmse, e.relmse_trim,
                     e.mean_error, e.flip);
}

std::string run_line(const BenchSceneResult& scene, const BenchRun& run) {
  const std::string begin = fmt::format("{},{},{},", scene.name, run.integrator, run.seed);
  if (!run.failure.empty()) return fmt::format("{},,,,,,,,,,,,,,,{}\n", begin, field(run.failure));
  const std::optional<double>& own = scene.reference.own_error;
  const std::string without =
      own ? fmt::format("{:.9g}", without_reference(run.end().errors.rmse, *own)) : "";
  return begin + fmt::format("{},{:.3f},{},{},{},{},{},{},{},{},{},\n", run.end().passes,
                             run.end().seconds, error_fields(run.end().errors), run.rays,
                             run.emitted, run.photons_stored, run.bytes, run.photon_bytes,
                             run.pixel_bytes, run.process_bytes, without);
}

}  // namespace

std::string runs_csv(const BenchResults& results) {
  std::string csv = fmt::format(
      "scene,integrator,seed,passes,seconds,{},rays,emitted,photons_stored,bytes,photon_bytes,"
      "pixel_bytes,process_bytes,rmse_without_reference,failure\n",
      kErrorColumns);
  for (const BenchSceneResult& scene : results.scenes) {
    if (!scene.failure.empty())
      csv += fmt::format("{},,,,,,,,,,,,,,,,,,{}\n", scene.name, field(scene.failure));
    for (const BenchRun& first : scene.runs) {
      csv += run_line(scene, first);
      for (const BenchRun& again : first.again) csv += run_line(scene, again);
    }
  }
  return csv;
}

std::string curves_csv(const BenchResults& results) {
  std::string csv =
      fmt::format("scene,integrator,layer,passes,seconds,emitted,{}\n", kErrorColumns);
  for (const BenchSceneResult& scene : results.scenes)
    for (const BenchRun& run : scene.runs)
      for (const BenchPoint& p : run.points) {
        const auto line = [&](const std::string& layer, const BenchErrors& errors) {
          csv += fmt::format("{},{},{},{},{:.6f},{},{}\n", scene.name, run.integrator, layer,
                             p.passes, p.seconds, p.emitted, error_fields(errors));
        };
        line("", p.errors);
        for (const auto& [name, errors] : p.layers) line(name, errors);
      }
  return csv;
}

}  // namespace nephroid

// `line`: density estimation on a line, [E3] of docs/estimators.md (Hachisuka & Jensen 2009).
#include "bench/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "core/errors.h"
#include "core/parallel.h"
#include "photon/line_experiment.h"

namespace nephroid {
namespace {

/// Slopes are fitted from this power of two on: the sums that [E3] is about start at 1 and are not
/// yet powers before.
constexpr size_t kFirstFitted = 3;

/// Over seeds, [region][power of two]: of [E1] and of [E2].
struct LineSums {
  struct Point {
    double mean = 0, square = 0;
  };
  std::vector<uint32_t> passes;
  std::vector<std::vector<Point>> shared, memoryless;
};

LineSums sums_of(const LineSettings& settings, std::span<const double> widths, int seeds) {
  std::vector<std::vector<std::vector<LineError>>> errors(static_cast<size_t>(seeds));
  parallel_chunks(seeds, 1, [&](int64_t seed, int64_t, int64_t) {
    LineSettings own = settings;
    own.seed = static_cast<uint64_t>(seed);
    errors[static_cast<size_t>(seed)] = line_errors(own, widths);
  });
  LineSums sums;
  for (const LineError& e : errors[0][0]) sums.passes.push_back(e.passes);
  const std::vector<LineSums::Point> none(sums.passes.size());
  sums.shared.assign(widths.size(), none);
  sums.memoryless.assign(widths.size(), none);
  const auto add = [&](LineSums::Point& point, double error) {
    point.mean += error / seeds;
    point.square += error * error / seeds;
  };
  for (const auto& of_seed : errors)
    for (size_t r = 0; r < widths.size(); ++r)
      for (size_t i = 0; i < sums.passes.size(); ++i) {
        add(sums.shared[r][i], of_seed[r][i].shared);
        add(sums.memoryless[r][i], of_seed[r][i].memoryless);
      }
  return sums;
}

ExperimentCurve curve_of(const std::string& name, const std::vector<uint32_t>& passes,
                         const std::vector<LineSums::Point>& points, bool bias, double predicted) {
  ExperimentCurve curve{name, {}, 0, predicted};
  std::vector<double> errors;
  for (size_t i = 0; i < passes.size(); ++i) {
    errors.push_back(bias ? std::abs(points[i].mean) : std::sqrt(points[i].square));
    curve.points.push_back({static_cast<double>(passes[i]), errors.back()});
  }
  const size_t first = std::min(kFirstFitted, passes.size() - 2);
  curve.slope = line_slope(std::span(passes).subspan(first), std::span(errors).subspan(first));
  return curve;
}

constexpr const char* kShared = "shared statistics [E1]";
constexpr const char* kMemoryless = "memoryless radius [E2]";

ExperimentPart noise_on_a_line(const ExperimentEffort& effort) {
  LineSettings settings;
  settings.density = LineDensity::kFlat;
  settings.photons_per_pass = effort.photons;
  settings.passes = effort.passes;
  const double widths[] = {0, 0.3};
  const LineSums sums = sums_of(settings, widths, effort.seeds);
  ExperimentPart part;
  part.title = "Noise";
  part.text = fmt::format(
      "Photons of an even density, {} in each pass: root mean square error over {} seeds, at a "
      "point and in a region that spans 0.3 of the line. There is no bias. Predicted is the power "
      "−α/2 of the passes, α = 2/3.",
      effort.photons, effort.seeds);
  for (size_t r = 0; r < 2; ++r) {
    const std::string where = r == 0 ? ", point" : ", region";
    const double power = -settings.alpha / 2;
    part.curves.push_back(curve_of(kShared + where, sums.passes, sums.shared[r], false, power));
    part.curves.push_back(
        curve_of(kMemoryless + where, sums.passes, sums.memoryless[r], false, power));
  }
  return part;
}

ExperimentPart bias_on_a_line(const ExperimentEffort& effort) {
  LineSettings settings;
  settings.density = LineDensity::kWave;
  settings.radius = 0.15;
  settings.photons_per_pass = effort.photons;
  settings.passes = effort.passes;
  const double crest[] = {0};
  const LineSums sums = sums_of(settings, crest, effort.seeds);
  ExperimentPart part;
  part.title = "Bias";
  part.text = fmt::format(
      "A wave of photons, seen at its crest with a large first radius: magnitude of the mean error "
      "of {} seeds. Predicted is 2α − 2 in the end; the sums start at the first pass and are a "
      "little less steep before.",
      effort.seeds);
  const double power = 2 * settings.alpha - 2;
  part.curves.push_back(curve_of(kShared, sums.passes, sums.shared[0], true, power));
  part.curves.push_back(curve_of(kMemoryless, sums.passes, sums.memoryless[0], true, power));
  return part;
}

}  // namespace

const std::vector<std::string>& experiment_names() {
  static const std::vector<std::string> names = {"line"};
  return names;
}

BenchExperiment run_experiment(const std::string& name, const ExperimentEffort& effort) {
  if (name != "line") throw UsageError("unknown experiment '" + name + "', expected line");
  BenchExperiment experiment;
  experiment.name = name;
  experiment.title = "Density estimation on a line";
  experiment.text =
      "Photons of a known density fall on a line, and regions around known points gather them from "
      "pass to pass, with statistics that a region shares over all points that it sees (Hachisuka "
      "and Jensen 2009) and with a radius that a formula gives to each pass. Both tend to the true "
      "mean of the region; how fast is compared with what theory predicts.";
  experiment.parts = {noise_on_a_line(effort), bias_on_a_line(effort)};
  return experiment;
}

}  // namespace nephroid

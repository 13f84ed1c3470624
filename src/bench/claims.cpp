#include "bench/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/fit.h"

namespace nephroid {
namespace {

double error_of(const BenchErrors& errors, BenchMetric metric) {
  switch (metric) {
    case BenchMetric::kRelmse:
      return errors.relmse;
    case BenchMetric::kRelmseTrim:
      return errors.relmse_trim;
    case BenchMetric::kFlip:
      return errors.flip;
    case BenchMetric::kMeanError:
      return std::abs(errors.mean_error);
    default:
      return errors.rmse;
  }
}

double position_of(const BenchPoint& point, BenchAxis axis) {
  if (axis == BenchAxis::kTime) return point.seconds;
  return axis == BenchAxis::kPasses ? point.passes : static_cast<double>(point.emitted);
}

std::vector<CurvePoint> curve_of(const BenchRun& run, BenchMetric metric, BenchAxis axis) {
  std::vector<CurvePoint> curve;
  for (const BenchPoint& point : run.points)
    curve.push_back({position_of(point, axis), error_of(point.errors, metric)});
  return curve;
}

std::optional<double> region_error(const BenchRun& run, const BenchClaim& claim) {
  for (const auto& [name, errors] : run.regions)
    if (name == claim.region) return error_of(errors, claim.metric);
  return std::nullopt;
}

std::optional<double> if_positive(uint64_t value) {
  if (value == 0) return std::nullopt;
  return static_cast<double>(value);
}

/// A pair of figures to compare, and where they were taken.
struct Pair {
  double subject = 0, other = 0;
  std::string where;
};

std::optional<Pair> figures_of(const BenchRun& subject, const BenchRun& other,
                               const BenchClaim& claim) {
  if (!claim.at_equal) {
    const auto a = metric_of(subject, claim), b = metric_of(other, claim);
    if (!a || !b) return std::nullopt;
    return Pair{*a, *b, ""};
  }
  const BenchAxis axis = *claim.at_equal;
  const double x = std::min(position_of(subject.end(), axis), position_of(other.end(), axis));
  if (!(x > 0)) return std::nullopt;
  const auto a = log_interpolate(curve_of(subject, claim.metric, axis), x);
  const auto b = log_interpolate(curve_of(other, claim.metric, axis), x);
  if (!a || !b) return std::nullopt;
  const char* unit = axis == BenchAxis::kTime     ? "s"
                     : axis == BenchAxis::kPasses ? "passes"
                                                  : "light paths";
  return Pair{*a, *b, fmt::format(" at {:.4g} {}", x, unit)};
}

BenchFigure compare(const BenchClaim& claim, const std::string& other, const Pair& pair) {
  const char* metric = metric_name(claim.metric);
  BenchFigure figure;
  const double ratio = pair.subject / pair.other;
  if (claim.form == BenchClaim::Form::kSmaller) {
    figure.holds = pair.subject <= claim.factor * pair.other;
    figure.text = fmt::format(
        "{} of {} {:.4g}, of {} {:.4g}{}: ratio {:.3g}, at most {:.3g} claimed", metric,
        claim.subject, pair.subject, other, pair.other, pair.where, ratio, claim.factor);
  } else {
    figure.holds =
        pair.subject <= claim.factor * pair.other && pair.other <= claim.factor * pair.subject;
    figure.text =
        fmt::format("{} of {} {:.4g}, of {} {:.4g}{}: ratio {:.3g}, {:.3g} to {:.3g} claimed",
                    metric, claim.subject, pair.subject, other, pair.other, pair.where, ratio,
                    1 / claim.factor, claim.factor);
  }
  return figure;
}

BenchFigure place(const BenchClaim& claim, double value) {
  BenchFigure figure;
  figure.holds = value >= claim.low && value <= claim.high;
  const std::string over =
      claim.metric == BenchMetric::kSlope ? fmt::format(" over {}", axis_name(claim.over)) : "";
  figure.text =
      fmt::format("{}{} of {} {:.4g}, {:.4g} to {:.4g} claimed", metric_name(claim.metric), over,
                  claim.subject, value, claim.low, claim.high);
  return figure;
}

/// Every figure of the claim in a scene; false if one could not be measured.
bool add_figures(const BenchClaim& claim, const BenchSceneResult& scene, BenchVerdict* verdict) {
  const BenchRun* subject = scene.find_run(claim.subject);
  if (subject == nullptr) return false;
  std::vector<BenchFigure> figures;
  if (claim.form == BenchClaim::Form::kBetween) {
    const auto value = metric_of(*subject, claim);
    if (!value) return false;
    figures.push_back(place(claim, *value));
  }
  for (const std::string& name : claim.others) {
    const BenchRun* other = scene.find_run(name);
    const auto pair = other == nullptr ? std::nullopt : figures_of(*subject, *other, claim);
    if (!pair) return false;
    figures.push_back(compare(claim, name, *pair));
  }
  for (BenchFigure& figure : figures) {
    figure.scene = scene.name;
    verdict->figures.push_back(std::move(figure));
  }
  return true;
}

template <class List>
bool contains(const List& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

/// Whether a claim is about a scene of the suite.
bool is_about(const BenchClaim& claim, const BenchScene& scene) {
  if (!claim.scenes.empty()) return contains(claim.scenes, scene.name);
  const bool has_region =
      claim.region.empty() ||
      std::any_of(scene.regions.begin(), scene.regions.end(),
                  [&](const BenchRegion& region) { return region.name == claim.region; });
  return has_region && contains(scene.integrators, claim.subject) &&
         std::all_of(claim.others.begin(), claim.others.end(),
                     [&](const std::string& name) { return contains(scene.integrators, name); });
}

}  // namespace

std::optional<double> metric_of(const BenchRun& run, const BenchClaim& claim) {
  switch (claim.metric) {
    case BenchMetric::kMemory:
      return if_positive(run.bytes);
    case BenchMetric::kPhotonMemory:
      return if_positive(run.photon_bytes);
    case BenchMetric::kMemoryGrowth:
      if (run.first_pass_bytes == 0) return std::nullopt;
      return static_cast<double>(run.bytes) / static_cast<double>(run.first_pass_bytes);
    case BenchMetric::kPhotons:
      return if_positive(run.photons_stored);
    case BenchMetric::kEmitted:
      return if_positive(run.emitted);
    case BenchMetric::kRays:
      return if_positive(run.rays);
    case BenchMetric::kPasses:
      return run.end().passes;
    case BenchMetric::kSeconds:
      return run.end().seconds;
    case BenchMetric::kSlope:
      return log_slope(curve_of(run, BenchMetric::kRmse, claim.over));
    default:
      break;
  }
  if (!claim.region.empty()) return region_error(run, claim);
  return error_of(run.end().errors, claim.metric);
}

std::vector<BenchVerdict> judge_claims(const BenchResults& results) {
  std::vector<BenchVerdict> verdicts;
  for (const BenchClaim& claim : results.suite.claims) {
    BenchVerdict verdict;
    bool complete = true;
    for (const BenchSceneResult& scene : results.scenes)
      if (is_about(claim, *results.suite.find_scene(scene.name)))
        complete = add_figures(claim, scene, &verdict) && complete;
    const bool holds = std::all_of(verdict.figures.begin(), verdict.figures.end(),
                                   [](const BenchFigure& figure) { return figure.holds; });
    if (!holds)
      verdict.state = BenchVerdict::State::kFails;
    else if (complete && !verdict.figures.empty())
      verdict.state = BenchVerdict::State::kHolds;
    verdicts.push_back(std::move(verdict));
  }
  return verdicts;
}

}  // namespace nephroid

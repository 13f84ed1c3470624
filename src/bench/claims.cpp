#include "bench/claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/figure_text.h"
#include "bench/fit.h"
#include "bench/repeats.h"
#include "session/report/short_number.h"

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

const BenchErrors* find(const BenchNamedErrors& list, const std::string& wanted) {
  for (const auto& [name, errors] : list)
    if (name == wanted) return &errors;
  return nullptr;
}

/// The curve of the claim's metric in its layer; of RMSE for a slope.
std::vector<CurvePoint> curve_of(const BenchRun& run, const BenchClaim& claim, BenchAxis axis) {
  std::vector<CurvePoint> curve;
  for (const BenchPoint& point : run.points) {
    const BenchErrors* errors =
        claim.layer.empty() ? &point.errors : find(point.layers, claim.layer);
    if (errors != nullptr)
      curve.push_back({position_of(point, axis), error_of(*errors, claim.metric)});
  }
  return curve;
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

/// The number of renders behind errors at the end, as text. Empty for one each, and for other
/// metrics.
std::string over_renders(const BenchClaim& claim, std::initializer_list<const BenchRun*> runs) {
  if (!is_error(claim.metric)) return {};
  std::string counts;
  bool several = false;
  for (const BenchRun* run : runs) {
    const size_t count = renders_of(*run).size();
    several |= count > 1;
    counts += fmt::format("{}{}", counts.empty() ? "" : " and ", count);
  }
  return several ? fmt::format(" over {} renders", counts) : "";
}

std::optional<Pair> figures_of(const BenchRun& subject, const BenchRun& other,
                               const BenchClaim& claim) {
  if (!claim.at_equal) {
    const auto a = metric_of(subject, claim), b = metric_of(other, claim);
    if (!a || !b) return std::nullopt;
    return Pair{*a, *b, over_renders(claim, {&subject, &other})};
  }
  const BenchAxis axis = *claim.at_equal;
  const double x = std::min(position_of(subject.end(), axis), position_of(other.end(), axis));
  if (!(x > 0)) return std::nullopt;
  const auto a = log_interpolate(curve_of(subject, claim, axis), x);
  const auto b = log_interpolate(curve_of(other, claim, axis), x);
  if (!a || !b) return std::nullopt;
  const char* unit = axis == BenchAxis::kTime     ? "s"
                     : axis == BenchAxis::kPasses ? "passes"
                                                  : "light paths";
  return Pair{*a, *b, fmt::format(" at {} {}", short_number(x), unit)};
}

/// A figure with its unit.
std::string in_words(BenchMetric metric, double value) {
  switch (metric) {
    case BenchMetric::kMemory:
    case BenchMetric::kPhotonMemory:
    case BenchMetric::kPixelMemory:
      return short_bytes(value);
    case BenchMetric::kPhotons:
    case BenchMetric::kEmitted:
    case BenchMetric::kRays:
      return short_number(value);
    default:
      return number_text(value);
  }
}

/// "RMSE of the layer 'caustic'".
std::string measured(const BenchClaim& claim) {
  std::string text = metric_title(claim.metric);
  if (claim.metric == BenchMetric::kSlope) text += fmt::format(" over {}", axis_name(claim.over));
  if (!claim.layer.empty()) text += " in the layer '" + claim.layer + "'";
  if (!claim.region.empty()) text += " in the region '" + claim.region + "'";
  return text + ": ";
}

/// RMSEs of the whole picture without the reference's own error, as text; empty for other metrics.
std::string without(const BenchClaim& claim, const std::optional<double>& own_error,
                    std::initializer_list<double> values) {
  if (claim.metric != BenchMetric::kRmse || !claim.region.empty() || !claim.layer.empty() ||
      !own_error)
    return {};
  std::string text;
  for (const double value : values)
    text += (text.empty() ? "" : " and ") + number_text(without_reference(value, *own_error));
  return "; without the reference's own error " + text;
}

BenchFigure compare(const BenchClaim& claim, const std::string& other, const Pair& pair,
                    const std::optional<double>& own_error) {
  BenchFigure figure;
  const bool at_most = pair.subject <= claim.factor * pair.other;
  const bool smaller = claim.form == BenchClaim::Form::kSmaller;
  figure.holds = at_most && (smaller || pair.other <= claim.factor * pair.subject);
  const std::string limits = smaller
                                 ? fmt::format("at most {:.3g}", claim.factor)
                                 : fmt::format("{:.3g} to {:.3g}", 1 / claim.factor, claim.factor);
  figure.text =
      measured(claim) +
      fmt::format("{} {}, {} {}{}, ratio {:.3g} ({} claimed)", claim.subject,
                  in_words(claim.metric, pair.subject), other, in_words(claim.metric, pair.other),
                  pair.where, pair.subject / pair.other, limits) +
      without(claim, own_error, {pair.subject, pair.other});
  return figure;
}

BenchFigure place(const BenchClaim& claim, double value, const std::string& where,
                  const std::optional<double>& own_error) {
  BenchFigure figure;
  figure.holds = value >= claim.low && value <= claim.high;
  figure.text =
      measured(claim) +
      fmt::format("{} {}{} ({} to {} claimed)", claim.subject, in_words(claim.metric, value), where,
                  in_words(claim.metric, claim.low), in_words(claim.metric, claim.high)) +
      without(claim, own_error, {value});
  return figure;
}

/// Adds the figures of the claim in a scene; false if one could not be measured.
bool add_figures(const BenchClaim& claim, const BenchSceneResult& scene, BenchVerdict* verdict) {
  const BenchRun* subject = scene.find_run(claim.subject);
  if (subject == nullptr) return false;
  std::vector<BenchFigure> figures;
  if (claim.form == BenchClaim::Form::kBetween) {
    const auto value = metric_of(*subject, claim);
    if (!value) return false;
    figures.push_back(
        place(claim, *value, over_renders(claim, {subject}), scene.reference.own_error));
  }
  for (const std::string& name : claim.others) {
    const BenchRun* other = scene.find_run(name);
    const auto pair = other == nullptr ? std::nullopt : figures_of(*subject, *other, claim);
    if (!pair) return false;
    figures.push_back(compare(claim, name, *pair, scene.reference.own_error));
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

/// True if a claim is about a scene of the suite.
bool is_about(const BenchClaim& claim, const BenchScene& scene) {
  if (!claim.scenes.empty()) return contains(claim.scenes, scene.name);
  const auto has = [](const auto& list, const std::string& name) {
    return name.empty() || std::any_of(list.begin(), list.end(),
                                       [&](const auto& named) { return named.name == name; });
  };
  return has(scene.regions, claim.region) && has(scene.layers, claim.layer) &&
         contains(scene.integrators, claim.subject) &&
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
    case BenchMetric::kPixelMemory:
      return if_positive(run.pixel_bytes);
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
      return log_slope(curve_of(run, claim, claim.over));
    default:
      break;
  }
  if (claim.region.empty() && claim.layer.empty())
    return error_of(errors_at_end(run), claim.metric);
  const BenchNamedErrors parts =
      claim.region.empty() ? layer_errors_at_end(run) : region_errors(run);
  const BenchErrors* errors = find(parts, claim.region.empty() ? claim.layer : claim.region);
  if (errors == nullptr) return std::nullopt;
  return error_of(*errors, claim.metric);
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

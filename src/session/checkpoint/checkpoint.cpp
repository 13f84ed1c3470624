#include "session/checkpoint/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/errors.h"

namespace nephroid {

bool passes_are_independent(const EstimatorSet& set) {
  return std::ranges::all_of(set.estimators, [](const auto& estimator) {
    return estimator->descriptor().capabilities.independent_passes;
  });
}

RenderState state_of(const Scene& scene, EstimatorSet& set, Film& film) {
  RenderState state = film.state();
  for (const auto& estimator : set.estimators) estimator->add_state(scene, film, state);
  return state;
}

PassRanges passes_of(const StateFile& file, const std::string& purpose) {
  const std::string refusal = file.path() + ": cannot " + purpose + ": ";
  if (!file.has_state())
    throw IoError(refusal +
                  "it has no state, expected a picture that was rendered without --no-state");
  const auto passes = PassRanges::parse(value_of(file.metadata(), kPassesKey));
  if (!passes || (passes->empty() && !open_pass_of(file)))
    throw IoError(refusal + "it does not say which passes it has");
  return *passes;
}

std::optional<uint32_t> open_pass_of(const StateFile& file) {
  const std::string text = value_of(file.metadata(), kOpenPassKey);
  if (text.empty()) return std::nullopt;
  uint32_t pass = 0;
  const char* const end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, pass);
  if (error != std::errc() || after != end)
    throw IoError(fmt::format("{}: '{}' of {} is no pass", file.path(), text, kOpenPassKey));
  return pass;
}

double seconds_of(const StateFile& file, const std::string& key) {
  const std::string text = value_of(file.metadata(), key);
  if (text.empty()) return 0;
  double seconds = 0;
  const char* const end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, seconds);
  if (error != std::errc() || after != end || !(seconds >= 0) || !std::isfinite(seconds))
    throw IoError(fmt::format("{}: '{}' of {} is no time", file.path(), text, key));
  return seconds;
}

void require_same_render(const StateFile& file, const RenderIdentity& other,
                         const std::string& name, const std::string& purpose) {
  const auto found = RenderIdentity::from_metadata(file.metadata()).differences(other, name);
  if (found.empty()) return;
  throw UsageError(fmt::format("{}: cannot {}: it is the picture of another render:\n  {}",
                               file.path(), purpose, fmt::join(found, "\n  ")));
}

std::optional<std::string> warning_of_instruction_sets(const StateFile& file,
                                                       const RenderIdentity& other,
                                                       const std::string& name) {
  const std::string there = value_of(file.metadata(), kInstructionSetKey);
  const std::string& here = other.instruction_sets;
  if (there == here) return std::nullopt;
  const auto shown = [](const std::string& sets) { return sets.empty() ? "nothing" : sets; };
  return fmt::format("{}: rendered with {}, {} {}: the last bits may differ from those of one run",
                     file.path(), shown(there), name, shown(here));
}

void add_progress(const Checkpoint& progress, Metadata* metadata) {
  metadata->emplace_back(kPassesKey, progress.passes.text());
  if (progress.open_pass)
    metadata->emplace_back(kOpenPassKey, fmt::format("{}", *progress.open_pass));
  metadata->emplace_back(kSecondsKey, fmt::format("{:.3f}", progress.seconds));
  metadata->emplace_back(kHistoryKey, progress.history);
}

void add_estimates(const Film& film, Metadata* metadata) {
  if (const OutlierRejection* rejection = film.rejection())
    metadata->emplace_back(kOutlierEstimatesKey, fmt::format("{}", rejection->held_estimates()));
  const FilmLayout& layout = film.layout();
  for (size_t r = 0; r < layout.routes.size(); ++r)
    metadata->emplace_back(kEstimatesKey + layout.routes[r],
                           fmt::format("{}", film.estimates(layout.groups[r])));
}

PassRanges passes_to_go_on_from(const std::string& path, const RenderIdentity& here) {
  try {
    const StateFile file(path);
    const RenderIdentity there = RenderIdentity::from_metadata(file.metadata());
    if (file.has_state() && there.differences(here, "here").empty())
      return passes_of(file, "go on from it");
  } catch (const IoError&) {
  }
  return {};
}

Checkpoint go_on_from(const std::string& path, const RenderIdentity& here, const Scene& scene,
                      EstimatorSet& set, Film& film) try {
  const std::string purpose = "go on from it";
  StateFile file(path);
  const PassRanges passes = passes_of(file, purpose);
  require_same_render(file, here, "here", purpose);
  file.load(state_of(scene, set, film));
  const Metadata& metadata = file.metadata();
  Checkpoint checkpoint{passes,
                        open_pass_of(file),
                        seconds_of(file, kSecondsKey),
                        value_of(metadata, kHistoryKey),
                        value_of(metadata, kChoicesKey),
                        value_of(metadata, kInstructionSetKey),
                        {}};
  if (auto warning = warning_of_instruction_sets(file, here, "here"))
    checkpoint.warnings.push_back(std::move(*warning));
  return checkpoint;
} catch (const IoError& error) {
  throw IoError(std::string(error.what()) + "; without --resume the render starts anew");
}

}  // namespace nephroid

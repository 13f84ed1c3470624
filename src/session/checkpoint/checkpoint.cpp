#include "session/checkpoint/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "core/errors.h"
#include "film/atomic_file.h"
#include "film/film_output.h"

namespace nephroid {

bool passes_add_up(const EstimatorSet& set, const Film& film) {
  return film.rejection() == nullptr &&
         std::ranges::all_of(set.estimators, [](const auto& estimator) {
           return estimator->descriptor().capabilities.independent_passes;
         });
}

namespace {

/// Adds what estimator `i` has learned. A photon map is left out: it is large and quickly made
/// again.
void add_learned(size_t i, EstimatorSet& set, const Film& film, RenderState& state) {
  const Estimator& estimator = *set.estimators[i];
  if (!estimator.descriptor().capabilities.learned_is_light)
    set.learned[i].add_state(estimator, film.format(),
                             fmt::format("{}learned.{}", RenderState::kOptionalPrefix, i), state);
}

/// True if the file has all that was learned: only these streams are optional.
bool has_learned(const StateFile& file, const std::vector<RenderState::Stream>& streams) {
  return std::ranges::all_of(streams, [&](const RenderState::Stream& stream) {
    return !stream.is_optional() || file.has_words(stream.name);
  });
}

/// Warnings about learned values that could not be read, from the reasons.
std::vector<std::string> warnings_of_learned(const std::vector<std::string>& reasons) {
  std::vector<std::string> warnings;
  for (const std::string& reason : reasons) warnings.push_back(reason + "; it is learned again");
  return warnings;
}

}  // namespace

RenderState state_of(const Scene& scene, EstimatorSet& set, Film& film) {
  RenderState state = film.state();
  set.learned.resize(set.estimators.size());
  for (size_t i = 0; i < set.estimators.size(); ++i) {
    set.estimators[i]->add_state(scene, film, state);
    add_learned(i, set, film, state);
  }
  return state;
}

StateFile open_state(const std::string& path, const std::string& purpose) {
  const std::string state = state_path_beside(path);
  if (!std::filesystem::exists(state))
    throw IoError(
        fmt::format("{}: cannot {}: there is no {}; a render writes it unless --no-state "
                    "is given",
                    path, purpose, state));
  return StateFile(state);
}

PassRanges passes_of(const StateFile& file, const std::string& purpose) {
  const auto passes = PassRanges::parse(value_of(file.metadata(), kPassesKey));
  if (!passes || (passes->empty() && !open_pass_of(file)))
    throw IoError(fmt::format("{}: cannot {}: the passes that it holds are not recorded",
                              file.path(), purpose));
  return *passes;
}

std::optional<uint32_t> open_pass_of(const StateFile& file) {
  const std::string text = value_of(file.metadata(), kOpenPassKey);
  if (text.empty()) return std::nullopt;
  uint32_t pass = 0;
  const char* const end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, pass);
  if (error != std::errc() || after != end)
    throw IoError(fmt::format("{}: '{}' of {} is not a pass, expected a whole number", file.path(),
                              text, kOpenPassKey));
  return pass;
}

double seconds_of(const StateFile& file, const std::string& key) {
  const std::string text = value_of(file.metadata(), key);
  if (text.empty()) return 0;
  double seconds = 0;
  const char* const end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, seconds);
  if (error != std::errc() || after != end || !(seconds >= 0) || !std::isfinite(seconds))
    throw IoError(
        fmt::format("{}: '{}' of {} is not a time, expected seconds", file.path(), text, key));
  return seconds;
}

void require_same_render(const StateFile& file, const RenderIdentity& other,
                         const std::string& name, const std::string& purpose) {
  const auto found = RenderIdentity::from_metadata(file.metadata()).differences(other, name);
  if (found.empty()) return;
  throw UsageError(fmt::format("{}: cannot {}: it belongs to a different render:\n  {}",
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

std::string kept_name(const std::string& name) {
  const std::filesystem::path path(name);
  return std::filesystem::path(path)
      .replace_extension(".previous" + path.extension().string())
      .string();
}

std::optional<std::string> kept_picture(const std::string& path) {
  std::error_code ignored;
  const std::string kept = kept_name(path);
  return std::filesystem::exists(kept, ignored) ? std::optional(kept) : std::nullopt;
}

void check_picture_can_be_written(const std::string& output) {
  for (const std::string& path : {output, png_path_beside(output), state_path_beside(output)})
    check_file_can_be_written(path);
}

std::vector<KeptFile> files_to_keep(const std::string& output) {
  if (output.empty()) return {};
  const std::string png = png_path_beside(output);
  std::vector<KeptFile> files;
  std::error_code ignored;
  for (const std::string& path : {output, state_path_beside(output), png})
    if (std::filesystem::exists(path, ignored)) files.push_back({path, kept_name(path)});
  const bool is_png_alone = files.size() == 1 && files[0].path == png;
  if (is_png_alone && std::filesystem::exists(files[0].kept, ignored)) files.clear();
  return files;
}

void keep_files(const std::string& output) {
  const std::vector<KeptFile> files = files_to_keep(output);
  std::error_code error;
  // Files kept earlier belong to an older render: do not mix them with these.
  if (!files.empty())
    for (const std::string& path : {output, state_path_beside(output), png_path_beside(output)})
      std::filesystem::remove(kept_name(path), error);
  for (const KeptFile& file : files) {
    std::filesystem::rename(file.path, file.kept, error);
    if (error)
      throw IoError(
          fmt::format("{}: cannot be kept as {}: {}", file.path, file.kept, error.message()));
  }
}

std::optional<std::string> warning_of_replacing(const std::string& output,
                                                const RenderIdentity& here) {
  const std::vector<KeptFile> files = files_to_keep(output);
  if (files.empty()) return std::nullopt;
  std::error_code ignored;
  const bool replaces_older = std::ranges::any_of(
      files, [&](const KeptFile& file) { return std::filesystem::exists(file.kept, ignored); });
  std::string kept = files[0].kept;
  for (size_t i = 1; i < files.size(); ++i) kept += (i == 1 ? ", with " : " and ") + files[i].kept;
  const char* const older = replaces_older ? ", in place of what was kept before" : "";
  const std::string state = state_path_beside(output);
  if (std::ranges::none_of(files, [&](const KeptFile& file) { return file.path == state; }))
    return fmt::format("{} is there already; it is kept as {}{}", files[0].path, kept, older);
  std::string what = "a state that cannot be read";
  try {
    const StateFile file = open_state(output, "read it");
    const PassRanges passes = passes_of(file, "read it");
    const bool is_same =
        RenderIdentity::from_metadata(file.metadata()).differences(here, "here").empty();
    what = fmt::format(
        "{} of {} render{}", passes.empty() ? "a part of a pass" : "passes " + passes.text(),
        is_same ? "this very" : "another", is_same ? ", with which --resume would go on" : "");
  } catch (const IoError&) {
  }
  return fmt::format("{} has {}; it is kept as {}{}", output, what, kept, older);
}

Checkpoint go_on_from(const std::string& path, const RenderIdentity& here, const Scene& scene,
                      EstimatorSet& set, Film& film) try {
  const std::string purpose = "go on from it";
  StateFile file = open_state(path, purpose);
  const PassRanges passes = passes_of(file, purpose);
  require_same_render(file, here, "here", purpose);
  const RenderState state = state_of(scene, set, film);
  const std::vector<std::string> passed_over = file.load(state);
  const Metadata& metadata = file.metadata();
  Checkpoint checkpoint{passes,
                        open_pass_of(file),
                        seconds_of(file, kSecondsKey),
                        value_of(metadata, kHistoryKey),
                        value_of(metadata, kChoicesKey),
                        value_of(metadata, kInstructionSetKey),
                        warnings_of_learned(passed_over),
                        passed_over.empty() && has_learned(file, state.streams)};
  if (auto warning = warning_of_instruction_sets(file, here, "here"))
    checkpoint.warnings.push_back(std::move(*warning));
  return checkpoint;
} catch (const IoError& error) {
  throw IoError(std::string(error.what()) + "; without --resume the render starts anew");
}

std::vector<std::string> learn_from(const std::string& path, const RenderIdentity& here,
                                    EstimatorSet& set, const Film& film) {
  RenderState state;
  set.learned.resize(set.estimators.size());
  for (size_t i = 0; i < set.learned.size(); ++i) add_learned(i, set, film, state);
  const std::string purpose = "take what it has learned", alone = "; this render learns by itself";
  std::vector<std::string> warnings;
  try {
    StateFile file = open_state(path, purpose);
    require_same_render(file, here, "here", purpose);
    // With another instruction set the last bits of what is learned may differ.
    if (const std::string there = value_of(file.metadata(), kInstructionSetKey);
        there != here.instruction_sets)
      warnings.push_back(fmt::format("{}: learned with {}, here {}, expected the same{}",
                                     file.path(), there.empty() ? "nothing" : there,
                                     here.instruction_sets, alone));
    else if (!has_learned(file, state.streams))
      warnings.push_back(file.path() +
                         ": what was learned is not kept there, as in a sum of merge" + alone);
    else
      warnings = warnings_of_learned(file.load_streams(state));
  } catch (const IoError& error) {
    warnings.push_back(error.what() + alone);
  }
  return warnings;
}

}  // namespace nephroid

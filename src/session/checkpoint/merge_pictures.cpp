#include "session/checkpoint/merge_pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/counted.h"
#include "core/errors.h"
#include "film/film_output.h"
#include "session/checkpoint/checkpoint.h"
#include "session/checkpoint/film_metadata.h"
#include "session/checkpoint/version.h"
#include "session/report/invalid_samples.h"

namespace nephroid {
namespace {

constexpr const char* kPurpose = "merge it";

/// A picture to be merged. It is not kept open: there may be more pictures than open files allowed.
struct Input {
  std::string path;
  PassRanges passes;
};

void warn_of_gaps(Merged& merged) {
  constexpr size_t kMaxNamed = 20;
  size_t gaps = 0;
  for (uint32_t pass = 0; const PassRange& range : merged.passes.ranges()) {
    if (range.first > pass && ++gaps <= kMaxNamed)
      merged.warnings.push_back(
          fmt::format("passes {}..{} are in none of the pictures", pass, range.first - 1));
    pass = range.last + 1;
  }
  if (gaps > kMaxNamed)
    merged.warnings.push_back(
        fmt::format("also in none of the pictures: {}",
                    counted(gaps - kMaxNamed, "more range of passes", "more ranges of passes")));
}

}  // namespace

Merged merge_pictures(const std::vector<std::string>& inputs, const std::string& output,
                      LayerPrecision precision) {
  std::vector<Input> files;
  for (const std::string& path : inputs)
    files.push_back({path, passes_of(open_state(path, kPurpose), kPurpose)});
  // Sorted, so that the order of the arguments does not matter.
  std::ranges::sort(
      files, {}, [](const Input& i) { return i.passes.empty() ? 0 : i.passes.ranges()[0].first; });
  const StateFile first = open_state(files[0].path, kPurpose);
  RenderIdentity identity = RenderIdentity::from_metadata(first.metadata());
  if (identity.version != kVersion)
    throw UsageError(fmt::format(
        "{}: cannot {}: version {} rendered it, expected {}, the version of this program",
        first.path(), kPurpose, identity.version.empty() ? "?" : identity.version, kVersion));
  Merged merged;
  std::string history, sets;
  for (const Input& input : files) {
    const StateFile file = open_state(input.path, kPurpose);
    const PassRanges& passes = input.passes;
    require_same_render(file, identity, "in " + first.path(), kPurpose);
    const auto refuse = [&name = file.path()](const std::string& why) {
      throw UsageError(name + ": cannot " + kPurpose + ": " + why);
    };
    if (const auto open = open_pass_of(file))
      refuse(fmt::format(
          "pass {} is incomplete, expected whole passes: complete it with --resume and a longer "
          "--time, or the same --passes",
          *open));
    if (value_of(file.metadata(), kOutliersKey) == "reject")
      refuse(
          "its passes depend on each other, since it was rendered with --outliers reject; "
          "--resume continues the render instead");
    if (!passes_add_up(file))
      refuse("passes of this integrator cannot be added up; --resume continues the render instead");
    if (merged.passes.overlap(passes))
      for (const Input& other : files)
        if (const auto both = other.passes.overlap(passes); both && &other != &input)
          refuse(fmt::format("{} has passes {}..{}, too, expected each pass in one picture only",
                             other.path, both->first, both->last));
    merged.passes.add(passes);
    merged.seconds += seconds_of(file, kSecondsKey);
    history += value_of(file.metadata(), kHistoryKey);
    if (const auto warning = warning_of_instruction_sets(file, identity, "in " + first.path()))
      merged.warnings.push_back(*warning);
    sets = joined_instruction_sets(sets, value_of(file.metadata(), kInstructionSetKey));
  }
  warn_of_gaps(merged);
  Film sum = film_of(first);
  for (const Input& input : files) {
    StateFile file = open_state(input.path, kPurpose);
    // A running render may have written a newer state meanwhile.
    if (passes_of(file, kPurpose) != input.passes || open_pass_of(file))
      throw IoError(input.path + ": cannot merge it: it changed while it was read");
    Film film = film_of(first);
    file.load(film.state());
    sum.add(film);
  }
  identity.instruction_sets = sets;
  Metadata metadata = identity.to_metadata();
  metadata.emplace_back(kLayoutKey, value_of(first.metadata(), kLayoutKey));
  Checkpoint progress;
  progress.passes = merged.passes;
  progress.seconds = merged.seconds;
  progress.history = history;
  add_progress(progress, &metadata);
  std::string faults;
  for (const std::string& fault : invalid_samples(sum)) faults += "warning: " + fault + "\n";
  if (!faults.empty()) metadata.emplace_back(kChoicesKey, faults);
  add_estimates(sum, &metadata);
  if (auto warning = warning_of_replacing(output, identity))
    merged.warnings.push_back(std::move(*warning));
  keep_files(output);
  write_state(state_path_beside(output), {first.resolution(), first.window(), metadata},
              sum.state());
  write_film(output, sum, picture_metadata_of(metadata), 1, precision);
  return merged;
}

}  // namespace nephroid

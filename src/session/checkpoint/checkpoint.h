// The checkpoint of a render: the state file beside its picture, and how another run resumes from
// it. It must not know when it is written.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "film/state_file.h"
#include "integrator/presets/estimator_set.h"
#include "session/checkpoint/pass_ranges.h"
#include "session/checkpoint/render_identity.h"

namespace nephroid {

/// What has been rendered before.
struct Checkpoint {
  PassRanges passes;                  ///< whole ones
  std::optional<uint32_t> open_pass;  ///< begun and not whole
  double seconds = 0;                 ///< of rendering, all runs together
  std::string history;                ///< a line for each run
  std::string choices;                ///< the report of the last run
  std::string instruction_sets;
  std::vector<std::string> warnings;
};

/// True if the passes of all estimators are independent, so that they can be added up.
bool passes_are_independent(const EstimatorSet& set);

/// All that a render keeps, as it lies in memory: of the film and of the estimators.
RenderState state_of(const Scene& scene, EstimatorSet& set, Film& film);

/// The state of a picture, whose name or the state's own is `path`. Throws IoError, "cannot
/// `purpose`", if it is not there.
StateFile open_state(const std::string& path, const std::string& purpose);

/// Throws IoError if picture, PNG or state cannot be written. Removes what processes of this
/// machine have left of them when they were killed.
void check_picture_can_be_written(const std::string& output);

/// A file that a new render is about to replace, and the name under which it is kept.
struct KeptFile {
  std::string path, kept;
};
/// Picture, state and PNG, those that are there: "a/b.exr" is kept as "a/b.previous.exr". A PNG
/// alone, as a render leaves it that ends before its first picture, is kept if there is no earlier
/// one to lose.
std::vector<KeptFile> files_to_keep(const std::string& output);
/// Gives them the names under which they are kept. Throws IoError.
void keep_files(const std::string& output);

/// The whole passes that a state has. Throws IoError, "cannot `purpose`", if it does not say so.
PassRanges passes_of(const StateFile& file, const std::string& purpose);
/// The pass of which it has a part. Throws IoError for what is no pass.
std::optional<uint32_t> open_pass_of(const StateFile& file);

/// A time in the metadata, 0 if it is not there. Throws IoError for what is no time.
double seconds_of(const StateFile& file, const std::string& key);

/// Throws UsageError, "cannot `purpose`", with all differences, unless the file is of the
/// render `other`, which the message calls `name`, "here" for example.
void require_same_render(const StateFile& file, const RenderIdentity& other,
                         const std::string& name, const std::string& purpose);

/// A warning if the file was rendered with other instruction sets than `other`, called `name`.
std::optional<std::string> warning_of_instruction_sets(const StateFile& file,
                                                       const RenderIdentity& other,
                                                       const std::string& name);

/// Metadata of the progress: passes, times and history.
void add_progress(const Checkpoint& progress, Metadata* metadata);
/// Metadata of the film's estimates, of each route and of rejected outliers.
void add_estimates(const Film& film, Metadata* metadata);

/// What a new render `here` is about to replace at its output, and where it is kept, as a sentence;
/// empty if nothing is there.
std::optional<std::string> warning_of_replacing(const std::string& output,
                                                const RenderIdentity& here);

/// Reads the state of a picture into film and estimators. Throws UsageError if it is of another
/// render, with all that differs, and IoError if it has none or it cannot be read.
Checkpoint go_on_from(const std::string& path, const RenderIdentity& here, const Scene& scene,
                      EstimatorSet& set, Film& film);

}  // namespace nephroid

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

/// The progress of earlier runs.
struct Checkpoint {
  PassRanges passes;                  ///< whole passes
  std::optional<uint32_t> open_pass;  ///< unfinished pass
  double seconds = 0;                 ///< rendering time of all runs
  std::string history;                ///< a line for each run
  std::string choices;                ///< the report of the last run
  std::string instruction_sets;
  std::vector<std::string> warnings;
  bool has_learned = false;  ///< what was learned could be read as well
};

/// True if whole passes, rendered anywhere, can be added up: the passes of all estimators are
/// independent, and no outliers are rejected.
bool passes_add_up(const EstimatorSet& set, const Film& film);

/// The complete state of a render in memory: film and estimators.
RenderState state_of(const Scene& scene, EstimatorSet& set, Film& film);

/// Opens the state of a picture; `path` is the picture's name or the state's own. Throws IoError,
/// "cannot `purpose`", if it is missing.
StateFile open_state(const std::string& path, const std::string& purpose);

/// Throws IoError if picture, PNG or state cannot be written. Removes their temporary files that
/// killed processes of this machine have left.
void check_picture_can_be_written(const std::string& output);

/// The name under which a file that is about to be replaced is kept: "a/b.exr" becomes
/// "a/b.previous.exr".
std::string kept_name(const std::string& name);
/// The kept_name() of a picture, if there is one.
std::optional<std::string> kept_picture(const std::string& path);
/// A file that a new render is about to replace, and the name under which it is kept.
struct KeptFile {
  std::string path, kept;
};
/// Picture, state and PNG, if they exist, with kept_name() of each. A PNG alone comes from a render
/// that ended before its first picture. It is kept unless it would replace an earlier kept one.
std::vector<KeptFile> files_to_keep(const std::string& output);
/// Renames files_to_keep(). Throws IoError.
void keep_files(const std::string& output);

/// The whole passes of a state. Throws IoError, "cannot `purpose`", if its metadata lack them.
PassRanges passes_of(const StateFile& file, const std::string& purpose);
/// The unfinished pass of a state. Throws IoError if the metadata are invalid.
std::optional<uint32_t> open_pass_of(const StateFile& file);

/// A time in the metadata, 0 if it is missing. Throws IoError if it is invalid.
double seconds_of(const StateFile& file, const std::string& key);

/// Throws UsageError, "cannot `purpose`", with all differences, unless the file belongs to the
/// render `other`. The message calls `other` `name`, for example "here".
void require_same_render(const StateFile& file, const RenderIdentity& other,
                         const std::string& name, const std::string& purpose);

/// A warning if the file was rendered with instruction sets different from those of `other`, which
/// it calls `name`.
std::optional<std::string> warning_of_instruction_sets(const StateFile& file,
                                                       const RenderIdentity& other,
                                                       const std::string& name);

/// Adds metadata of the progress: passes, times and history.
void add_progress(const Checkpoint& progress, Metadata* metadata);
/// Adds metadata of the film's estimates: their numbers by route, and that of rejected outliers.
void add_estimates(const Film& film, Metadata* metadata);

/// A warning about the files that the render `here` is about to replace, and the names under which
/// they are kept. Empty if there are none.
std::optional<std::string> warning_of_replacing(const std::string& output,
                                                const RenderIdentity& here);

/// Loads the state of a picture into film and estimators. Throws UsageError with all differences if
/// it belongs to another render, IoError if it is missing or cannot be read.
Checkpoint go_on_from(const std::string& path, const RenderIdentity& here, const Scene& scene,
                      EstimatorSet& set, Film& film);

/// Gives the estimators what was learned for another picture of the same render, from its state.
/// Returns warnings: if the state is missing, cannot be read or was rendered with other instruction
/// sets, they learn by themselves. Throws UsageError with all differences if it belongs to another
/// render.
std::vector<std::string> learn_from(const std::string& path, const RenderIdentity& here,
                                    EstimatorSet& set, const Film& film);

}  // namespace nephroid

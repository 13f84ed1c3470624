// The picture of a render as its checkpoint: the progress that a run leaves in the EXR, and how
// another run resumes from it. It must not know when pictures are written.
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

/// The whole passes that a picture with state has. Throws IoError, "cannot `purpose`", without
/// state.
PassRanges passes_of(const StateFile& file, const std::string& purpose);
/// The pass of which it has a part. Throws IoError for what is no pass.
std::optional<uint32_t> open_pass_of(const StateFile& file);

/// A time in the metadata, 0 if it is not there. Throws IoError for what is no time.
double seconds_of(const StateFile& file, const std::string& key);

/// Throws UsageError, "cannot `purpose`", with all differences, unless the file is a picture of the
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

/// The passes of a picture that the render `here` could resume from; empty if there are none.
PassRanges passes_to_go_on_from(const std::string& path, const RenderIdentity& here);

/// Reads the state of a file into film and estimators. Throws UsageError if it is the picture of
/// another render, with all that differs, and IoError if it has no state or cannot be read.
Checkpoint go_on_from(const std::string& path, const RenderIdentity& here, const Scene& scene,
                      EstimatorSet& set, Film& film);

}  // namespace nephroid

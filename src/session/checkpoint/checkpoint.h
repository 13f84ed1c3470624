// The picture of a render as its checkpoint: what a run of the program leaves in the EXR, and how
// another run goes on from it. Who calls it: the session, and the commands render and merge. It
// must not know when pictures are written.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "film/state_file.h"
#include "integrator/estimator.h"
#include "session/checkpoint/pass_ranges.h"

namespace nephroid {

/// What has been rendered before.
struct Checkpoint {
  PassRanges passes;
  double seconds = 0;  ///< of rendering, all runs together
  double last_pass_seconds = 0;
  std::string history;  ///< a line for each run
  std::string choices;  ///< the report of the last run
  std::string instruction_sets;
  std::vector<std::string> warnings;
};

/// All that a render keeps, as it lies in memory: of the film and of the estimators.
RenderState state_of(const Scene& scene, Preset& preset, Film& film);

/// The passes that a picture with state has. Throws IoError, "cannot `purpose`", without state.
PassRanges passes_of(const StateFile& file, const std::string& purpose);

/// A time in the metadata, 0 if it is not there. Throws IoError for what is no time.
double seconds_of(const StateFile& file, const std::string& key);

/// Throws UsageError, "cannot `purpose`", with all that differs, each as "radius 1, here 2", unless
/// metadata tell of the same render as those of the file: version, scene, film, routes, options,
/// outliers and seed. `other` is what these are called, "here" for example.
void require_same_render(const StateFile& file, const Metadata& metadata, const std::string& other,
                         const std::string& purpose);

/// With which instruction sets a picture's passes were rendered: those of version.h, one or more.
inline constexpr const char* kInstructionSetKey = "nephroid:instruction_set";
std::string instruction_sets_of(const Metadata& metadata);
/// Each of both once.
std::string joined_instruction_sets(const std::string& a, const std::string& b);
/// What to say if the file's are others than those of `metadata`, which are called `other`.
std::optional<std::string> warning_of_instruction_sets(const StateFile& file,
                                                       const Metadata& metadata,
                                                       const std::string& other);

/// The passes of a picture that a render with these metadata could go on from; empty if the file is
/// none.
PassRanges passes_to_go_on_from(const std::string& path, const Metadata& here);

/// Reads the state of a file into film and estimators. Throws UsageError if it is the picture of
/// another render, with all that differs, and IoError if it has no state or cannot be read.
Checkpoint go_on_from(const std::string& path, const Metadata& here, const Scene& scene,
                      Preset& preset, Film& film);

}  // namespace nephroid

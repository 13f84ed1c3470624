// The picture of a render as its checkpoint: what a run of the program leaves in the EXR, and how
// another run goes on from it. Who calls it: the session, and the commands render and merge. It
// must not know when pictures are written.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "film/exr_file.h"
#include "integrator/estimator.h"
#include "session/pass_ranges.h"

namespace nephroid {

/// What has been rendered before.
struct Checkpoint {
  PassRanges passes;
  double seconds = 0;   ///< of rendering, all runs together
  std::string history;  ///< a line for each run
};

/// All that a render keeps, as it lies in memory: of the film and of the estimators.
RenderState state_of(const Scene& scene, Preset& preset, Film& film);

/// Metadata that a picture must share with a render that goes on from it: version, scene, routes,
/// options, seed, film.
const std::vector<std::string>& identity_keys();

/// What differs between two renders, each as "options: radius 1, here 2"; empty if nothing that
/// counts does.
std::vector<std::string> differences(const StateFile& file, const Metadata& here);

/// Reads the state of a file into film and estimators. Throws UsageError if it is the picture of
/// another render, with all that differs, and IoError if it has no state or cannot be read.
Checkpoint go_on_from(const std::string& path, const Metadata& here, const Scene& scene,
                      Preset& preset, Film& film);

}  // namespace nephroid

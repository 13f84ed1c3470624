// Paths that estimators of the same kind can never sample, for EstimatorTraits.
#pragma once

#include "route/path_summary.h"

namespace nephroid {

/// Of walks from the eye with next-event estimation.
const char* out_of_reach_of_eye_walks(const PathSummary& path);
/// Of eye and light subpaths that are connected wherever both have a vertex that is no S.
const char* out_of_reach_of_connections(const PathSummary& path);
/// Of eye subpaths with next-event estimation whose D and G vertices gather photons.
const char* out_of_reach_of_merging(const PathSummary& path);
/// Of connections and merging together.
const char* out_of_reach_of_both(const PathSummary& path);

}  // namespace nephroid

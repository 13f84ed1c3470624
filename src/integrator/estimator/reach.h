// Paths that estimators of the same kind can never sample, for EstimatorTraits.
#pragma once

#include "route/path_summary.h"

namespace nephroid {

/// Each returns the reason why a path cannot be sampled, or null: by eye walks with next-event
/// estimation;
const char* out_of_reach_of_eye_walks(const PathSummary& path);
/// by eye and light subpaths that are connected wherever two vertices in a row are no S;
const char* out_of_reach_of_connections(const PathSummary& path);
/// by eye subpaths with next-event estimation that gather photons at D and G;
const char* out_of_reach_of_merging(const PathSummary& path);
/// by connections and merging together.
const char* out_of_reach_of_both(const PathSummary& path);

}  // namespace nephroid

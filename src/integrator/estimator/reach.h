// Paths that a kind of estimator can never sample, for EstimatorTraits.
#pragma once

#include "route/path_summary.h"

namespace nephroid {

/// Each function says why a path cannot be sampled, or returns null. This one: by eye walks with
/// next-event estimation.
const char* out_of_reach_of_eye_walks(const PathSummary& path);
/// By eye and light subpaths that are connected wherever two vertices in a row are no S.
const char* out_of_reach_of_connections(const PathSummary& path);
/// By eye subpaths with next-event estimation that gather photons at D and G.
const char* out_of_reach_of_merging(const PathSummary& path);
/// By the same, if photons are also gathered along a walk's first flights through media ([V8]).
const char* out_of_reach_of_merging_in_media(const PathSummary& path);
/// By connections and merging together.
const char* out_of_reach_of_both(const PathSummary& path);

}  // namespace nephroid

// The traits of an estimator that routes need: its name, where it merges and connects, and which
// paths it can never sample. It must not know the estimators: the compiler gets traits as
// arguments.
#pragma once

#include <span>

#include "route/path_summary.h"

namespace nephroid {

/// For an estimator that can sample every path of a route that it may own.
constexpr const char* samples_every_path(const PathSummary&) {
  return nullptr;
}

struct EstimatorTraits {
  const char* name = "";  ///< name in routes: "path", "photons+light"
  const char* help = "";  ///< one sentence
  bool merges = false;    ///< each of its paths has exactly one vertex with a merge
  /// True if it connects light walks to the camera, by Routes::connects.
  bool connects = false;
  /// True if its paths start at lights: it cannot reach light from media or via hair.
  bool starts_at_lights = false;
  bool one_route_each = false;  ///< each of its routes is a group of its own
  /// The reason why it can never sample such a path, as a phrase after "which it cannot find: ".
  /// Null if it can sample it, or if no estimator can.
  const char* (*why_never_sampled)(const PathSummary& path) = samples_every_path;
};

/// The estimators that routes may name.
using TraitsTable = std::span<const EstimatorTraits* const>;

}  // namespace nephroid

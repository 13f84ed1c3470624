// What routes need to know of an estimator: its name, where it merges and connects, and which paths
// it can never sample. The estimators themselves stand further right; compilers of routes get their
// traits as arguments.
#pragma once

#include <span>

#include "route/path_summary.h"

namespace nephroid {

/// For an estimator that can sample every path of a route that it may own.
constexpr const char* samples_every_path(const PathSummary&) {
  return nullptr;
}

struct EstimatorTraits {
  const char* name = "";  ///< as routes write it: "path", "photons+light"
  const char* help = "";  ///< one sentence
  bool merges = false;    ///< each of its paths has exactly one vertex with a merge
  /// Its light walks follow Routes::connects: it needs a camera that they can be connected to.
  bool connects = false;
  /// Light that a medium emits or that touches hair is out of its reach.
  bool starts_at_lights = false;
  bool one_route_each = false;  ///< each of its routes is a group of its own
  /// Why it can never sample such a path, in words that follow "which it cannot find: "; null if it
  /// can, or if no estimator can.
  const char* (*why_never_sampled)(const PathSummary& path) = samples_every_path;
};

/// The estimators that routes may name.
using TraitsTable = std::span<const EstimatorTraits* const>;

}  // namespace nephroid

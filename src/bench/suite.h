// The contents of a suite file: integrators, scenes, references and claims (format: docs/bench.md).
// It must not know how anything is rendered or drawn.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "session/route_plan.h"
#include "session/settings/integrator_settings.h"

namespace nephroid {

/// The limit of a run: a time or a number of passes. It is not set if both are 0.
struct BenchLimit {
  double seconds = 0;
  uint32_t passes = 0;
  bool is_set() const { return seconds > 0 || passes > 0; }
};

struct BenchIntegrator {
  std::string name;  ///< name in the suite, the report and file names
  RouteChoice routes;
  SettingList options;
  uint64_t seed = 0;
  bool reject_outliers = false;
};

/// The reference of a scene: a file, or a render by the suite.
struct BenchReference {
  std::string file;  ///< empty: the suite renders it
  BenchIntegrator integrator;
  BenchLimit limit;
};

/// A light path expression whose share of the picture's light, or whose error, is measured.
struct BenchEnergy {
  std::string name, expression;
};

/// A part of the picture with its own error, in fractions of the picture's sides.
struct BenchRegion {
  std::string name;
  float x0 = 0, x1 = 1, y0 = 0, y1 = 1;
};

struct BenchScene {
  std::string name, title, file;
  int width = 0, height = 0;  ///< 0: the scene's
  float exposure = 1;         ///< exposure of pictures in the report and for FLIP
  BenchReference reference;
  std::vector<std::string> integrators;  ///< by default all of the suite
  SettingList options;                   ///< options of runs and reference, before their own
  BenchLimit limit;                      ///< overrides the suite's limit
  std::vector<BenchEnergy> energy;
  std::vector<BenchEnergy> layers;  ///< layers with their own errors
  std::vector<BenchRegion> regions;
};

enum class BenchMetric {
  kRmse,
  kRelmse,
  kRelmseTrim,
  kFlip,
  kMeanError,     ///< magnitude of the relative error of the mean
  kMemory,        ///< peak bytes of photons and per-pixel data
  kPhotonMemory,  ///< peak bytes of photons and their search structure
  kPixelMemory,   ///< peak bytes of per-pixel data
  kMemoryGrowth,  ///< memory at the end over memory after the first pass
  kPhotons,       ///< photons stored in all
  kEmitted,       ///< light paths in all
  kRays,
  kPasses,
  kSeconds,
  kSlope,  ///< slope of log RMSE, over the second half of the run
};

/// Whether the metric is an error against a reference.
constexpr bool is_error(BenchMetric metric) {
  return metric == BenchMetric::kRmse || metric == BenchMetric::kRelmse ||
         metric == BenchMetric::kRelmseTrim || metric == BenchMetric::kFlip ||
         metric == BenchMetric::kMeanError;
}

/// The x axis of curves and comparisons.
enum class BenchAxis { kPasses, kTime, kEmitted };

/// A claim that is judged by figures, in one of three forms.
struct BenchClaim {
  enum class Form {
    kSmaller,  ///< subject <= factor * each of `others`
    kSame,     ///< subject within a factor of each of `others`, either way
    kBetween,  ///< low <= subject <= high
  };
  std::string text;
  BenchMetric metric = BenchMetric::kRmse;
  Form form = Form::kSmaller;
  std::string subject;
  std::vector<std::string> others;
  double factor = 1, low = 0, high = 0;
  std::vector<std::string> scenes;      ///< empty: all scenes in which it can be measured
  std::string region;                   ///< empty: the whole picture
  std::string layer;                    ///< empty: all light
  BenchAxis over = BenchAxis::kPasses;  ///< x axis of a slope
  /// Compares runs at an equal value on this axis; empty: at their ends.
  std::optional<BenchAxis> at_equal;
};

struct BenchSuite {
  std::string file;  ///< name on the command line
  std::string name, title, description;
  BenchLimit limit;
  uint32_t repeat = 1;  ///< renders of each run, with consecutive seeds
  std::vector<BenchIntegrator> integrators;
  std::vector<BenchScene> scenes;
  std::vector<BenchClaim> claims;

  /// Null if there is none of that name.
  const BenchIntegrator* find_integrator(const std::string& wanted) const;
  const BenchScene* find_scene(const std::string& wanted) const;
};

/// Names for reports.
const char* metric_title(BenchMetric metric);
const char* axis_name(BenchAxis axis);

/// Parses a suite; `file` is its name, and file names in it are relative to its directory. Throws
/// UsageError "file:line:column: what is wrong, what was expected".
BenchSuite parse_suite(const std::string& text, const std::string& file);
/// Reads and parses a suite file. Also throws IoError.
BenchSuite read_suite(const std::string& file);

}  // namespace nephroid

// What a suite file says: integrators, scenes, references, and claims about how they compare
// (docs/bench.md has the format). It must not know how anything is rendered or drawn.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "session/route_plan.h"
#include "session/settings/integrator_settings.h"

namespace nephroid {

/// How long a run goes on: for a time, or for a number of passes. None is set if both are 0.
struct BenchLimit {
  double seconds = 0;
  uint32_t passes = 0;
  bool is_set() const { return seconds > 0 || passes > 0; }
};

struct BenchIntegrator {
  std::string name;  ///< in the suite, the report and the names of files
  RouteChoice routes;
  SettingList options;
  uint64_t seed = 0;
  bool reject_outliers = false;
};

/// A picture to measure against: a file, or a render of its own.
struct BenchReference {
  std::string file;  ///< empty: it is rendered
  BenchIntegrator integrator;
  BenchLimit limit;
};

/// A light path expression whose share of the picture's light, or whose error, is measured.
struct BenchEnergy {
  std::string name, expression;
};

/// A part of the picture with an error of its own, in fractions of its sides.
struct BenchRegion {
  std::string name;
  float x0 = 0, x1 = 1, y0 = 0, y1 = 1;
};

struct BenchScene {
  std::string name, title, file;
  int width = 0, height = 0;  ///< 0: the scene's
  float exposure = 1;         ///< of the pictures in the report and of FLIP
  BenchReference reference;
  std::vector<std::string> integrators;  ///< all of the suite unless it names some
  SettingList options;                   ///< of all runs and of the reference, before their own
  BenchLimit limit;                      ///< over the suite's
  std::vector<BenchEnergy> energy;
  std::vector<BenchEnergy> layers;  ///< with errors of their own
  std::vector<BenchRegion> regions;
};

enum class BenchMetric {
  kRmse,
  kRelmse,
  kRelmseTrim,
  kFlip,
  kMeanError,     ///< magnitude of the relative error of the mean
  kMemory,        ///< bytes of photons and of what is kept for each pixel, at most at once
  kPhotonMemory,  ///< of photons and what finds them alone
  kPixelMemory,   ///< of what is kept for each pixel alone
  kMemoryGrowth,  ///< all memory at the end over that after the first pass
  kPhotons,       ///< stored, in all
  kEmitted,       ///< light paths, in all
  kRays,
  kPasses,
  kSeconds,
  kSlope,  ///< of log RMSE, over the second half of the run
};

/// What curves are drawn and compared over.
enum class BenchAxis { kPasses, kTime, kEmitted };

/// A sentence that figures bear out or not, in one of three forms.
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
  std::vector<std::string> scenes;      ///< all of the suite's in which it can be measured if empty
  std::string region;                   ///< empty: the whole picture
  std::string layer;                    ///< empty: all light
  BenchAxis over = BenchAxis::kPasses;  ///< of a slope
  /// Compares where both have the same number of these; empty: at the ends of the runs.
  std::optional<BenchAxis> at_equal;
};

struct BenchSuite {
  std::string file;  ///< as the command line named it
  std::string name, title, description;
  BenchLimit limit;
  uint32_t repeat = 1;  ///< renders of each run, with seeds that follow each other
  std::vector<BenchIntegrator> integrators;
  std::vector<BenchScene> scenes;
  std::vector<BenchClaim> claims;
  std::vector<std::string> experiments;  ///< names that experiment.h has

  /// Null if there is none of that name.
  const BenchIntegrator* find_integrator(const std::string& wanted) const;
  const BenchScene* find_scene(const std::string& wanted) const;
};

/// As readers say it.
const char* metric_title(BenchMetric metric);
const char* axis_name(BenchAxis axis);

/// Understands a suite; `file` is its name, and what it names is relative to its directory. Throws
/// UsageError "file:line:column: what is wrong, what was expected".
BenchSuite parse_suite(const std::string& text, const std::string& file);
/// Reads and understands a suite. Throws IoError too.
BenchSuite read_suite(const std::string& file);

}  // namespace nephroid

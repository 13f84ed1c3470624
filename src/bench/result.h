// The results of a suite: runs with their curves, references, verdicts on claims. Runs are kept as
// JSON, so that a later invocation need not repeat them; results.json has the contents of the page.
// It must not know how anything is rendered or drawn.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/suite.h"

namespace nephroid {

/// Errors of a picture, or of a part of it, against the reference.
struct BenchErrors {
  double rmse = 0, relmse = 0, relmse_trim = 0;
  double mean_error = 0;  ///< relative error of the mean, with its sign
  double flip = 0;
};

/// Errors of parts of the picture or of its light, by name.
using BenchNamedErrors = std::vector<std::pair<std::string, BenchErrors>>;

/// An RMSE without the reference's own error: the root of the difference of squares, below 0 if the
/// reference's own error is larger.
double without_reference(double rmse, double own_error);

/// A run at the end of a pass.
struct BenchPoint {
  uint32_t passes = 0;
  double seconds = 0;    ///< rendering time, without the time of measuring
  uint64_t emitted = 0;  ///< light paths of all kinds
  BenchErrors errors;
  BenchNamedErrors layers;
};

/// A share of the light, by name.
using BenchShares = std::vector<std::pair<std::string, double>>;

/// An integrator on a scene.
struct BenchRun {
  std::string integrator;
  uint64_t seed = 0;
  std::string key;                 ///< hash of everything that determines it, 16 digits
  std::string failure;             ///< error message; the rest is then empty
  bool kept = false;               ///< true if from an earlier invocation
  std::string picture;             ///< EXR in the directory of results
  std::string routes, options;     ///< as in the picture's metadata
  std::vector<BenchPoint> points;  ///< in the order of passes; the last one is the end
  uint64_t rays = 0, emitted = 0, photons_stored = 0;
  uint64_t bytes = 0, photon_bytes = 0, pixel_bytes = 0;  ///< peaks
  uint64_t first_pass_bytes = 0;
  uint64_t process_bytes = 0;  ///< peak of the whole program during the run; 0: unknown
  BenchNamedErrors regions;
  BenchShares energy;
  std::vector<std::string> notes;
  std::vector<BenchRun> again;  ///< repetitions with the next seeds; means in repeats.h

  const BenchPoint& end() const { return points.back(); }
};

struct BenchReferenceResult {
  std::string picture;     ///< file
  std::string key;         ///< hash of the picture itself, 16 digits
  bool rendered = false;   ///< true if rendered by the suite, now or earlier
  std::string integrator;  ///< integrator or routes that rendered it; empty for a file
  bool kept = false;
  uint32_t passes = 0;
  double seconds = 0;
  std::optional<double> own_error;  ///< RMS of its standard error, if known
  BenchShares energy;
};

struct BenchSceneResult {
  std::string name;
  std::string failure;  ///< error of the scene or its reference; there are then no runs
  int width = 0, height = 0;
  BenchReferenceResult reference;
  std::vector<BenchRun> runs;  ///< in the order of the suite, without runs that were not begun

  /// The run of an integrator if it did not fail, else null.
  const BenchRun* find_run(const std::string& integrator) const;
};

/// One comparison of a claim: in one scene, with another integrator or an interval.
struct BenchFigure {
  std::string scene, text;  ///< the text has the numbers
  bool holds = false;
};
struct BenchVerdict {
  enum class State { kHolds, kFails, kNotMeasured };
  State state = State::kNotMeasured;
  std::vector<BenchFigure> figures;
};

/// The machine and the program, so that the suite can be repeated.
struct BenchMachine {
  std::string version, instruction_set, processor, date;
  int threads = 0;
  std::string command;
};

struct BenchResults {
  BenchSuite suite;
  BenchMachine machine;
  std::string directory;
  std::vector<BenchSceneResult> scenes;
  std::vector<BenchVerdict> verdicts;  ///< [claim]
  int signal = 0;                      ///< signal that stopped it, 0 if none
  int failures() const;
};

/// Convert a finished run to JSON and back. Empty for any other JSON.
std::string run_to_json(const BenchRun& run);
std::optional<BenchRun> run_from_json(const std::string& text);
std::string reference_to_json(const BenchReferenceResult& reference);
std::optional<BenchReferenceResult> reference_from_json(const std::string& text);

/// All results as JSON, as CSV with a line per run (runs_csv), and as CSV with a line per measured
/// point of the first renders (curves_csv).
std::string results_json(const BenchResults& results);
/// Reads a text of results_json, which came from `file`: pictures are looked for in its directory.
/// The suite has only the fields that the page shows. Throws UsageError for any other text.
BenchResults results_from_json(const std::string& text, const std::string& file);
std::string runs_csv(const BenchResults& results);
std::string curves_csv(const BenchResults& results);

}  // namespace nephroid

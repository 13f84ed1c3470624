// The results of a suite: runs with their curves, references, and how the claims fared. Runs are
// kept as JSON, so that a second invocation need not repeat them, and results.json has all that the
// page shows. It must not know how anything is rendered or drawn.
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
  double mean_error = 0;  ///< relative, with its sign
  double flip = 0;
};

/// Errors of parts of the picture or of its light, by name.
using BenchNamedErrors = std::vector<std::pair<std::string, BenchErrors>>;

/// An RMSE without what the reference itself adds to it: the root of the difference of squares,
/// below 0 if the reference's own error is the larger one.
double without_reference(double rmse, double own_error);

/// A run at the end of a pass.
struct BenchPoint {
  uint32_t passes = 0;
  double seconds = 0;    ///< of rendering, without the time that measuring took
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
  std::string key;                 ///< hash of all that determines it, 16 digits
  std::string failure;             ///< empty if it went well; the rest is then empty
  bool kept = false;               ///< from an earlier invocation
  std::string picture;             ///< EXR, in the directory of results
  std::string routes, options;     ///< as in the picture's metadata
  std::vector<BenchPoint> points;  ///< passes increase, the last is the end
  uint64_t rays = 0, emitted = 0, photons_stored = 0;
  uint64_t bytes = 0, photon_bytes = 0, pixel_bytes = 0;  ///< the most at once
  uint64_t first_pass_bytes = 0;
  uint64_t process_bytes = 0;  ///< peak of the whole program during the run, 0: not known
  BenchNamedErrors regions;
  BenchShares energy;
  std::vector<std::string> notes;
  std::vector<BenchRun> again;  ///< the same with the seeds that follow; repeats.h has the means

  const BenchPoint& end() const { return points.back(); }
};

struct BenchReferenceResult {
  std::string picture;     ///< file
  std::string key;         ///< hash of the picture itself, 16 digits
  bool rendered = false;   ///< by the suite, now or earlier
  std::string integrator;  ///< integrator or routes that rendered it, empty for a file
  bool kept = false;
  uint32_t passes = 0;
  double seconds = 0;
  std::optional<double> own_error;  ///< RMS of its standard error, if it knows that
  BenchShares energy;
};

struct BenchSceneResult {
  std::string name;
  std::string failure;  ///< of the scene or its reference; there are then no runs
  int width = 0, height = 0;
  BenchReferenceResult reference;
  std::vector<BenchRun> runs;  ///< in the order of the suite; one that was not begun is missing

  /// A run that went well, null if there is none.
  const BenchRun* find_run(const std::string& integrator) const;
};

/// A claim in one scene, against one other integrator (or an interval).
struct BenchFigure {
  std::string scene, text;  ///< the text has the numbers
  bool holds = false;
};
struct BenchVerdict {
  enum class State { kHolds, kFails, kNotMeasured };
  State state = State::kNotMeasured;
  std::vector<BenchFigure> figures;
};

/// The machine and the program, for whoever wants to repeat it.
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
  int signal = 0;                      ///< that stopped it, if one did
  int failures() const;
};

/// A finished run as JSON, and back; what is not such JSON gives no run.
std::string run_to_json(const BenchRun& run);
std::optional<BenchRun> run_from_json(const std::string& text);
std::string reference_to_json(const BenchReferenceResult& reference);
std::optional<BenchReferenceResult> reference_from_json(const std::string& text);

/// Everything as one JSON text, as CSV with a line for each run, and as CSV with a line for each
/// measured point of the first renders.
std::string results_json(const BenchResults& results);
/// Reads the text of results_json; the suite in it has only the fields that the page shows.
/// Pictures are looked for in the directory of `file`, which the text is from. Throws UsageError
/// for any other text.
BenchResults results_from_json(const std::string& text, const std::string& file);
std::string runs_csv(const BenchResults& results);
std::string curves_csv(const BenchResults& results);

}  // namespace nephroid

// Runs a suite: references, runs and results. Existing results are not rendered again, and a
// failure does not stop the rest. It must not know how a picture is made or how the page looks.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/result.h"
#include "session/signals.h"

namespace nephroid {

struct BenchOptions {
  std::string directory;          ///< directory of results; created if missing
  BenchLimit limit;               ///< overrides the suite's limits
  uint32_t repeat = 0;            ///< renders of each run; 0: the suite's
  std::vector<std::string> only;  ///< names of scenes; empty: all
  std::string command;            ///< the command line, for the page
  /// Called with each line of progress.
  std::function<void(const std::string&)> say = [](const std::string&) {};
};

/// Runs the suite and writes into the directory:
/// - references/ and runs/, with a picture and a JSON file for each
/// - results.json, runs.csv and curves.csv, from all results there
/// Throws UsageError for an unknown scene in `only` and for a run without a limit, IoError if the
/// directory cannot be written. Other failures are reported in the results.
BenchResults run_bench(const BenchSuite& suite, const BenchOptions& options, SignalFlags& signals);

/// The exit status: 128 + N after signal N. Else 1 if something failed or, if `strict`, a claim
/// does not hold. Else 0.
int exit_status(const BenchResults& results, bool strict);

}  // namespace nephroid

// A suite from its first reference to its results: what is there already is not rendered again, and
// what fails does not stop the rest. It must not know how a picture is made or how the page looks.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/result.h"
#include "session/signals.h"

namespace nephroid {

struct BenchOptions {
  std::string directory;          ///< of results; made if it is not there
  BenchLimit limit;               ///< over all of the suite's
  uint32_t repeat = 0;            ///< renders of each run, 0: as the suite says
  std::vector<std::string> only;  ///< scenes by name, all if empty
  std::string command;            ///< the command line, for the page
  /// Called with a line for whoever waits.
  std::function<void(const std::string&)> say = [](const std::string&) {};
};

/// Runs the suite and writes into the directory: references/ and runs/ with a picture and a JSON
/// file each, and, from everything that is there in the end, results.json, runs.csv and curves.csv.
/// Throws UsageError for a scene of `only` that the suite has not and for a run without a limit,
/// IoError if the directory cannot be written. Scenes, references and runs that fail are in the
/// results.
BenchResults run_bench(const BenchSuite& suite, const BenchOptions& options, SignalFlags& signals);

/// The exit status: 128 + N after a signal, else 1 if something failed or, if `strict`, if a claim
/// does not hold, else 0.
int exit_status(const BenchResults& results, bool strict);

}  // namespace nephroid

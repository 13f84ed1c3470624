// Runs the real program on the files of a folder and reports how it ended, as a user would see it.
// It must not know what the program does with scenes.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace nephroid::testing_support {

struct ProgramRun {
  int status = -1;           ///< exit status; -1 if the program did not exit by itself
  int signal = 0;            ///< signal that ended it, 0 if none did
  bool hung = false;         ///< still running after a minute, and killed
  std::string errors;        ///< all of standard error
  double seconds = 0;        ///< running time
  double cpu_seconds = 0;    ///< sum over its threads
  uint64_t peak_memory = 0;  ///< bytes, sampled a hundred times a second
};

/// Runs the program with these arguments in `folder`. Standard input is a file, relative to the
/// folder, or empty. Throws std::runtime_error if it cannot be started.
ProgramRun run_program(const std::string& folder, const std::vector<std::string>& arguments,
                       const std::string& input = "/dev/null");

/// Names of everything in a folder, hidden files too.
std::set<std::string> names_in(const std::string& folder);

}  // namespace nephroid::testing_support

// Runs the real program on the files of a folder and tells how it ended: what a user would see.
// Who calls it: the tests of this folder. It must not know what the program does with scenes.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace nephroid::testing_support {

struct ProgramRun {
  int status = -1;           ///< exit status; -1 if the program did not exit by itself
  int signal = 0;            ///< that ended it, 0 if none did
  bool hung = false;         ///< it was still running after a minute and was ended
  std::string errors;        ///< all of standard error
  double seconds = 0;        ///< that it ran
  uint64_t peak_memory = 0;  ///< bytes, as seen a hundred times a second
};

/// Runs the program with these arguments in `folder`; its standard input is a file, as seen from
/// there, or empty. Throws std::runtime_error if it cannot be started.
ProgramRun run_program(const std::string& folder, const std::vector<std::string>& arguments,
                       const std::string& input = "/dev/null");

/// Names of everything in a folder, hidden files too.
std::set<std::string> names_in(const std::string& folder);

}  // namespace nephroid::testing_support

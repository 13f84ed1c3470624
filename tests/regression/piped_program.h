// The real program with its standard output on a pipe, as a parent process runs it. It must not
// know what the program writes.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <string>
#include <vector>

namespace nephroid::testing_support {

class PipedProgram {
 public:
  /// Starts the program in `folder`. Throws std::runtime_error if it cannot be started.
  PipedProgram(const std::string& folder, const std::vector<std::string>& arguments);
  PipedProgram(const PipedProgram&) = delete;
  PipedProgram& operator=(const PipedProgram&) = delete;
  /// Kills the program if it still runs.
  ~PipedProgram();

  /// The next `count` bytes of its standard output, fewer at the end.
  std::string read(size_t count);
  /// Closes the reader's end of the pipe.
  void close_output();
  void send(int signal) const;
  /// Waits for the end. Returns the exit status, or minus the signal that ended it.
  int wait();

 private:
  pid_t process_ = 0;
  int output_ = -1;
  bool has_ended_ = false;
};

}  // namespace nephroid::testing_support

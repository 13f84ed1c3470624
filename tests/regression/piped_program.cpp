#include "regression/piped_program.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

extern char** environ;

namespace nephroid::testing_support {

PipedProgram::PipedProgram(const std::string& folder, const std::vector<std::string>& arguments) {
  std::vector<char*> argv = {const_cast<char*>("nephroid")};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  const int failure =
      posix_spawn(&process_, NEPHROID_PROGRAM, &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  output_ = ends[0];
  if (failure != 0) throw std::runtime_error("cannot start " NEPHROID_PROGRAM);
}

PipedProgram::~PipedProgram() {
  close_output();
  if (has_ended_) return;
  send(SIGKILL);
  wait();
}

std::string PipedProgram::read(size_t count) {
  std::string bytes(count, '\0');
  size_t got = 0;
  while (got < count) {
    const ssize_t more = ::read(output_, bytes.data() + got, count - got);
    if (more <= 0) break;
    got += static_cast<size_t>(more);
  }
  bytes.resize(got);
  return bytes;
}

void PipedProgram::close_output() {
  if (output_ >= 0) ::close(output_);
  output_ = -1;
}

void PipedProgram::send(int signal) const {
  kill(process_, signal);
}

int PipedProgram::wait() {
  int state = 0;
  waitpid(process_, &state, 0);
  has_ended_ = true;
  return WIFEXITED(state) ? WEXITSTATUS(state) : -WTERMSIG(state);
}

}  // namespace nephroid::testing_support

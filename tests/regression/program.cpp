// posix_spawn, one pipe and one deadline.
#include "regression/program.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <stdexcept>

extern char** environ;

namespace nephroid::testing_support {
namespace {

constexpr std::chrono::seconds kPatience(60);

/// Starts the program with standard error going to `errors`; returns its process id.
pid_t start(const std::string& folder, const std::vector<std::string>& arguments,
            const std::string& input, int errors) {
  std::vector<char*> argv = {const_cast<char*>("nephroid")};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, input.c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
  pid_t child = 0;
  const int failure =
      posix_spawn(&child, NEPHROID_PROGRAM, &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw std::runtime_error("cannot start " NEPHROID_PROGRAM);
  return child;
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Peak memory of a process. wait4 would report that of the process that started it.
uint64_t peak_memory_of(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stoull(line.substr(6)) * 1024;
  return 0;
}

/// Reads to the end while sampling the memory. False if the end does not come in time.
bool read_all(int descriptor, pid_t process, std::string* text, uint64_t* peak_memory) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  constexpr int kMilliseconds = 10;
  for (;;) {
    *peak_memory = std::max(*peak_memory, peak_memory_of(process));
    if (std::chrono::steady_clock::now() > deadline) return false;
    pollfd ready{descriptor, POLLIN, 0};
    if (poll(&ready, 1, kMilliseconds) == 0) continue;
    char block[4096];
    const ssize_t got = read(descriptor, block, sizeof(block));
    if (got == 0) return true;
    if (got > 0) text->append(block, static_cast<size_t>(got));
  }
}

}  // namespace

ProgramRun run_program(const std::string& folder, const std::vector<std::string>& arguments,
                       const std::string& input) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  ProgramRun run;
  const auto begin = std::chrono::steady_clock::now();
  const pid_t child = start(folder, arguments, input, ends[1]);
  close(ends[1]);
  run.hung = !read_all(ends[0], child, &run.errors, &run.peak_memory);
  close(ends[0]);
  if (run.hung) kill(child, SIGKILL);
  int state = 0;
  rusage usage{};
  wait4(child, &state, 0, &usage);
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  run.cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  if (WIFEXITED(state)) run.status = WEXITSTATUS(state);
  if (WIFSIGNALED(state)) run.signal = WTERMSIG(state);
  return run;
}

std::set<std::string> names_in(const std::string& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

}  // namespace nephroid::testing_support

// Handlers use only what is safe in them: sigaction, lock-free atomics and write(2).
#include "session/signals.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <string_view>

namespace nephroid {
namespace {

static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

SignalFlags requests;
std::atomic<bool> answers{false};

void set_action(int signal, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(signal, &action, nullptr);
}

auto action_of(int signal) {
  struct sigaction action = {};
  sigaction(signal, nullptr, &action);
  return action.sa_handler;
}

/// Writes the answer to an interrupt; errors are ignored.
void answer() {
  constexpr std::string_view kText =
      "\nnephroid: stopping and writing the picture; one more interrupt stops at once\n";
  const int error = errno;
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kText.data(), kText.size());
  errno = error;
}

void ask_to_stop(int signal) {
  requests.stop.store(signal);
  if (signal == SIGINT && answers.load()) answer();
  if (action_of(SIGINT) != SIG_IGN) set_action(SIGINT, SIG_DFL);
}

/// Signals that are ignored stay so, as under nohup or in a background shell.
void set_stop_actions(void (*handler)(int)) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (action_of(signal) != SIG_IGN) set_action(signal, handler);
}

void ask_to_write(int) {
  requests.write.store(true);
}

}  // namespace

SignalListener::SignalListener() {
  requests.stop.store(0);
  requests.write.store(false);
  set_action(SIGUSR1, ask_to_write);
  set_action(SIGPIPE, SIG_IGN);
  set_action(SIGXFSZ, SIG_IGN);
}

void SignalListener::note_stops(bool answer_interrupts) {
  answers.store(answer_interrupts);
  set_stop_actions(ask_to_stop);
}

SignalListener::~SignalListener() {
  set_stop_actions(SIG_DFL);
  // A scheduler that requests pictures may not know that the process is ending.
  set_action(SIGUSR1, SIG_IGN);
  // SIGPIPE and SIGXFSZ stay ignored: the cause of a failed render is still to be printed.
}

SignalFlags& SignalListener::flags() const {
  return requests;
}

}  // namespace nephroid

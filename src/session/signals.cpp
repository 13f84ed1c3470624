// sigaction and two lock-free atomics, which is all that a handler may touch.
#include "session/signals.h"

#include <csignal>

namespace nephroid {
namespace {

static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

SignalFlags requests;

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

void ask_to_stop(int signal) {
  requests.stop.store(signal);
  set_action(SIGINT, SIG_DFL);
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

void SignalListener::note_stops() {
  set_action(SIGINT, ask_to_stop);
  set_action(SIGTERM, ask_to_stop);
  if (action_of(SIGHUP) != SIG_IGN) set_action(SIGHUP, ask_to_stop);
}

SignalListener::~SignalListener() {
  set_action(SIGINT, SIG_DFL);
  set_action(SIGTERM, SIG_DFL);
  if (action_of(SIGHUP) != SIG_IGN) set_action(SIGHUP, SIG_DFL);
  set_action(SIGUSR1, SIG_DFL);
  set_action(SIGPIPE, SIG_DFL);
  set_action(SIGXFSZ, SIG_DFL);
}

SignalFlags& SignalListener::flags() const {
  return requests;
}

}  // namespace nephroid

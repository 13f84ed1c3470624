// Signals to a running render: stop, or write the picture now. A signal handler can only reach
// static storage, so this is the one mutable global of the program. It never affects a pixel.
#pragma once

#include <atomic>

namespace nephroid {

struct SignalFlags {
  std::atomic<int> stop{0};        ///< signal that requested a stop, 0 if none
  std::atomic<bool> write{false};  ///< true if a picture is requested now
};

/// Handles signals during its lifetime:
/// - SIGUSR1 sets `write` in flags(). After its lifetime it is ignored.
/// - SIGINT, SIGTERM and SIGHUP set `stop` from note_stops() on, unless they are ignored (nohup).
///   Before that there is nothing to write, and they end the program.
/// - After a request to stop, SIGINT ends the program. A second SIGTERM does not: supervisors send
///   it to a process and to its group.
/// - SIGPIPE and SIGXFSZ are ignored from its beginning on, so that writing fails with an error.
class SignalListener {
 public:
  SignalListener();
  ~SignalListener();
  SignalListener(const SignalListener&) = delete;
  SignalListener& operator=(const SignalListener&) = delete;

  /// Starts to handle requests to stop. With `answer_interrupts` the first SIGINT is answered on
  /// standard error, since writing a picture may take long.
  void note_stops(bool answer_interrupts = false);
  SignalFlags& flags() const;
};

}  // namespace nephroid

// What the outside asks of a running render: stop, or write the picture now.
// A signal handler can only reach static storage, so this is the one mutable global of the program;
// it holds requests and never reaches a pixel.
#pragma once

#include <atomic>

namespace nephroid {

struct SignalFlags {
  std::atomic<int> stop{0};        ///< the signal that asked to stop, 0 if none did
  std::atomic<bool> write{false};  ///< a picture is wanted now
};

/// While it lives, SIGUSR1 sets `write` in flags(), and from note_stops() on SIGINT, SIGTERM and
/// SIGHUP (unless they are ignored, as by nohup) set `stop`. Before, while there is nothing to
/// write yet, these end the program, and so does a SIGINT after the first request to stop; a second
/// SIGTERM, which supervisors send to a process and to its group, does not. A log that nobody reads
/// any more and files that grow too large are errors of writing and no signals, from then on; and
/// SIGUSR1, which comes from whoever does not see that the program is at its end, is ignored after
/// it.
class SignalListener {
 public:
  SignalListener();
  ~SignalListener();
  SignalListener(const SignalListener&) = delete;
  SignalListener& operator=(const SignalListener&) = delete;

  /// If wished, the first SIGINT is answered on standard error: to write a picture may take long.
  void note_stops(bool answer_interrupts = false);
  SignalFlags& flags() const;
};

}  // namespace nephroid

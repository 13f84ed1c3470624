// Watches a pass while it is rendered: decides when attend() is due. It must not know what attend()
// does.
#pragma once

#include <atomic>
#include <functional>

#include "core/pass_control.h"
#include "session/signals.h"

namespace nephroid {

class PassWatch final : public PassControl {
 public:
  /// `now` may be called by any thread, `attend` by the one that renders.
  PassWatch(const SignalFlags& signals, std::function<double()> now, std::function<void()> attend)
      : signals_(signals), now_(std::move(now)), attend_(std::move(attend)) {}
  /// Sets the time from which on attend() is called.
  void wake_at(double seconds) { wake_.store(seconds, std::memory_order_relaxed); }
  /// Sets whether a request to write calls attend(); at first it does not.
  void answer_writes(bool answers) { answers_writes_.store(answers, std::memory_order_relaxed); }

  bool is_wanted() const noexcept override {
    return signals_.stop.load(std::memory_order_relaxed) != 0 ||
           (answers_writes_.load(std::memory_order_relaxed) &&
            signals_.write.load(std::memory_order_relaxed)) ||
           now_() >= wake_.load(std::memory_order_relaxed);
  }
  void attend() override { attend_(); }

 private:
  const SignalFlags& signals_;
  const std::function<double()> now_;
  const std::function<void()> attend_;
  std::atomic<double> wake_{0};
  std::atomic<bool> answers_writes_{false};
};

}  // namespace nephroid

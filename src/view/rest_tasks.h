// Questions about a render, which wait until no pixel is rendered. Thread-safe.
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>

#include "session/render.h"

namespace nephroid {

/// A render while no pixel is rendered.
struct RenderAtRest {
  Render& render;
  const LoadedScene& loaded;
  uint64_t generation = 0;  ///< counts edits
  bool is_preview = false;
  bool is_edited = false;  ///< camera or settings are not those that the view began with
};

class RestTasks {
 public:
  using Run = std::function<void(const RenderAtRest&)>;

  /// A task that has been added.
  class Ticket;
  std::shared_ptr<Ticket> add(Run run);
  bool empty() const;
  /// Runs the tasks that wait now, not those that are added meanwhile: who asks without a pause
  /// must not keep the render from its work. Their exceptions go to those who wait for them.
  void serve(const RenderAtRest& rest);
  /// Throws UsageError with this text at those who wait.
  void refuse(const std::string& why);

 private:
  std::deque<std::shared_ptr<Ticket>> take_all();

  mutable std::mutex mutex_;
  std::deque<std::shared_ptr<Ticket>> tasks_;
};

class RestTasks::Ticket {
 public:
  explicit Ticket(Run run) : run_(std::move(run)), future_(done_.get_future()) {}
  /// Returns after the task, with its exception. Throws UsageError if it has not begun after so
  /// many seconds; it is not run then.
  void wait(double seconds);

 private:
  friend class RestTasks;
  enum class State { kWaiting, kBegun, kGivenUp };
  /// False if nobody waits any more.
  bool begin();

  Run run_;
  std::promise<void> done_;
  std::future<void> future_;
  std::atomic<State> state_{State::kWaiting};
};

}  // namespace nephroid

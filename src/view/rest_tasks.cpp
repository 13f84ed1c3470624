#include "view/rest_tasks.h"

#include <chrono>
#include <utility>

#include "core/errors.h"

namespace nephroid {

bool RestTasks::Ticket::begin() {
  State waiting = State::kWaiting;
  return state_.compare_exchange_strong(waiting, State::kBegun);
}

void RestTasks::Ticket::wait(double seconds) {
  const auto longest = std::chrono::duration<double>(seconds);
  if (future_.wait_for(longest) != std::future_status::ready) {
    State waiting = State::kWaiting;
    if (state_.compare_exchange_strong(waiting, State::kGivenUp))
      throw UsageError("the renderer is busy, try again");
  }
  future_.get();
}

std::shared_ptr<RestTasks::Ticket> RestTasks::add(Run run) {
  auto ticket = std::make_shared<Ticket>(std::move(run));
  const std::lock_guard lock(mutex_);
  tasks_.push_back(ticket);
  return ticket;
}

bool RestTasks::empty() const {
  const std::lock_guard lock(mutex_);
  return tasks_.empty();
}

std::deque<std::shared_ptr<RestTasks::Ticket>> RestTasks::take_all() {
  const std::lock_guard lock(mutex_);
  return std::exchange(tasks_, {});
}

void RestTasks::serve(const RenderAtRest& rest) {
  for (const std::shared_ptr<Ticket>& ticket : take_all()) {
    if (!ticket->begin()) continue;
    try {
      ticket->run_(rest);
      ticket->done_.set_value();
    } catch (...) {
      ticket->done_.set_exception(std::current_exception());
    }
  }
}

void RestTasks::refuse(const std::string& why) {
  for (const std::shared_ptr<Ticket>& ticket : take_all())
    if (ticket->begin()) ticket->done_.set_exception(std::make_exception_ptr(UsageError(why)));
}

}  // namespace nephroid

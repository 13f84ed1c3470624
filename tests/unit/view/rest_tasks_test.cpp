// Questions that wait until a render is at rest.
#include "view/rest_tasks.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <thread>

#include "core/errors.h"
#include "unit/view/live_scene.h"

namespace nephroid {
namespace {

/// A render that is never run: tasks need one to look at.
class Tasks : public testing_support::LiveTest {
 protected:
  LoadedScene loaded_ = load_scene(request(1));
  Render render_{request(1), loaded_};
  RenderAtRest rest_{render_, loaded_, 7};
  RestTasks tasks_;
};

TEST_F(Tasks, RunInTheirOrderWithTheRender) {
  std::vector<int> order;
  const auto first = tasks_.add([&](const RenderAtRest& rest) {
    EXPECT_EQ(rest.generation, 7u);
    EXPECT_EQ(&rest.render, &render_);
    order.push_back(1);
  });
  const auto second = tasks_.add([&](const RenderAtRest&) { order.push_back(2); });
  EXPECT_FALSE(tasks_.empty());
  tasks_.serve(rest_);
  EXPECT_TRUE(tasks_.empty());
  first->wait(0);
  second->wait(0);
  EXPECT_EQ(order, (std::vector<int>{1, 2}));
}

TEST_F(Tasks, ErrorsGoToWhoWaitsAndOthersRun) {
  const auto wrong = tasks_.add([](const RenderAtRest&) { throw IoError("no disk"); });
  bool has_run = false;
  const auto right = tasks_.add([&](const RenderAtRest&) { has_run = true; });
  tasks_.serve(rest_);
  EXPECT_THROW(wrong->wait(0), IoError);
  right->wait(0);
  EXPECT_TRUE(has_run);
}

TEST_F(Tasks, RefusedOnesSayWhy) {
  bool has_run = false;
  const auto ticket = tasks_.add([&](const RenderAtRest&) { has_run = true; });
  tasks_.refuse("the scene is wrong");
  try {
    ticket->wait(0);
    FAIL() << "not refused";
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(), "the scene is wrong");
  }
  tasks_.serve(rest_);
  EXPECT_FALSE(has_run);
}

TEST_F(Tasks, WhoeverHasWaitedTooLongIsNotServedLater) {
  bool has_run = false;
  const auto ticket = tasks_.add([&](const RenderAtRest&) { has_run = true; });
  EXPECT_THROW(ticket->wait(0), UsageError);
  tasks_.serve(rest_);
  EXPECT_FALSE(has_run);
}

TEST_F(Tasks, ATaskThatHasBegunIsWaitedFor) {
  std::promise<void> begun, may_end;
  bool has_ended = false;
  const auto ticket = tasks_.add([&](const RenderAtRest&) {
    begun.set_value();
    may_end.get_future().wait();
    has_ended = true;
  });
  std::thread renderer([&] { tasks_.serve(rest_); });
  begun.get_future().wait();
  std::thread releases([&] { may_end.set_value(); });
  ticket->wait(0);
  EXPECT_TRUE(has_ended);
  releases.join();
  renderer.join();
}

TEST_F(Tasks, ThoseAddedMeanwhileWaitForTheNextRest) {
  int runs = 0;
  std::shared_ptr<RestTasks::Ticket> next;
  std::function<void(const RenderAtRest&)> again = [&](const RenderAtRest&) {
    if (++runs < 100) next = tasks_.add(again);
  };
  next = tasks_.add(again);
  tasks_.serve(rest_);
  EXPECT_EQ(runs, 1) << "who asks again at once would keep the render from its work";
  EXPECT_FALSE(tasks_.empty());
}

using LiveTasks = testing_support::LiveTest;

TEST_F(LiveTasks, TheEndWaitsForATaskThatHasBegun) {
  auto live = std::make_unique<LiveRender>(request());
  ASSERT_TRUE(testing_support::has_picture(*live));
  std::promise<void> begun;
  std::atomic<bool> has_ended = false;
  std::thread first([&, view = live.get()] {
    view->at_rest([&](const RenderAtRest&) {
      begun.set_value();
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      has_ended = true;
    });
  });
  begun.get_future().wait();
  live.reset();
  EXPECT_TRUE(has_ended);
  first.join();
}

TEST_F(LiveTasks, AreRefusedWithTheReasonOfAFailure) {
  write("WorldBegin\nShape \"spere\"\n");
  LiveRender live(request());
  ASSERT_TRUE(testing_support::has_status(live, LiveStatus::kFailed));
  EXPECT_THROW(live.at_rest([](const RenderAtRest&) {}), UsageError);
  EXPECT_THROW(live.colors({}), UsageError);
  EXPECT_FALSE(live.frame({"picture"}, 0, 0).has_value());
}

}  // namespace
}  // namespace nephroid

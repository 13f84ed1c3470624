// Real signals to this process, and to a child that the second one must kill.
#include "session/signals.h"

#include <gtest/gtest.h>

#include <csignal>

namespace nephroid {
namespace {

/// The parent of the tests may ignore some signals (nohup, a shell's background job).
class Signals : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
  }
};
using SignalsDeathTest = Signals;

TEST_F(Signals, StopAndWriteAreNoted) {
  SignalListener listener;
  listener.note_stops();
  EXPECT_EQ(listener.flags().stop.load(), 0);
  std::raise(SIGUSR1);
  EXPECT_TRUE(listener.flags().write.load());
  EXPECT_EQ(listener.flags().stop.load(), 0);
  std::raise(SIGTERM);
  EXPECT_EQ(listener.flags().stop.load(), SIGTERM);
}

TEST_F(Signals, ANewListenerStartsAfresh) {
  {
    SignalListener listener;
    listener.note_stops();
    std::raise(SIGINT);
    EXPECT_EQ(listener.flags().stop.load(), SIGINT);
  }
  const SignalListener listener;
  EXPECT_EQ(listener.flags().stop.load(), 0);
}

TEST_F(SignalsDeathTest, TheFirstInterruptIsAnswered) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto twice = [](int signal, bool answer) {
    SignalListener listener;
    listener.note_stops(answer);
    std::raise(signal);
    std::raise(SIGINT);
  };
  EXPECT_EXIT(twice(SIGINT, true), ::testing::KilledBySignal(SIGINT),
              "stopping and writing the picture");
  EXPECT_EXIT(twice(SIGINT, false), ::testing::KilledBySignal(SIGINT), "^$");
  EXPECT_EXIT(twice(SIGTERM, true), ::testing::KilledBySignal(SIGINT), "^$");
}

TEST_F(SignalsDeathTest, TheSecondInterruptKills) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto twice = [](int first, int second) {
    SignalListener listener;
    listener.note_stops();
    std::raise(first);
    std::raise(second);
  };
  EXPECT_EXIT(twice(SIGINT, SIGINT), ::testing::KilledBySignal(SIGINT), "");
  EXPECT_EXIT(twice(SIGTERM, SIGINT), ::testing::KilledBySignal(SIGINT), "");
}

TEST_F(Signals, ASecondTerminationChangesNothing) {
  SignalListener listener;
  listener.note_stops();
  std::raise(SIGTERM);
  std::raise(SIGTERM);
  EXPECT_EQ(listener.flags().stop.load(), SIGTERM);
}

TEST_F(Signals, ATerminalThatClosesStopsUnlessItIsIgnored) {
  {
    SignalListener listener;
    listener.note_stops();
    std::raise(SIGHUP);
    EXPECT_EQ(listener.flags().stop.load(), SIGHUP);
  }
  std::signal(SIGHUP, SIG_IGN);
  {
    SignalListener listener;
    listener.note_stops();
    std::raise(SIGHUP);
    EXPECT_EQ(listener.flags().stop.load(), 0);
  }
  std::raise(SIGHUP);  // still ignored
  std::signal(SIGHUP, SIG_DFL);
}

TEST_F(Signals, WhatIsIgnoredStaysIgnored) {
  std::signal(SIGINT, SIG_IGN);
  {
    SignalListener listener;
    listener.note_stops();
    std::raise(SIGINT);
    EXPECT_EQ(listener.flags().stop.load(), 0);
    std::raise(SIGTERM);
    std::raise(SIGINT);
    EXPECT_EQ(listener.flags().stop.load(), SIGTERM);
  }
  std::raise(SIGINT);
}

// Also after the end, when the reason is still to be printed.
TEST_F(Signals, WritingToNobodyIsNoSignal) {
  {
    const SignalListener listener;
    std::raise(SIGPIPE);
    std::raise(SIGXFSZ);
  }
  std::raise(SIGPIPE);
  std::raise(SIGXFSZ);
}

TEST_F(Signals, PicturesMayBeAskedForAtTheVeryEnd) {
  { const SignalListener listener; }
  std::raise(SIGUSR1);
}

TEST_F(SignalsDeathTest, BeforeThereIsSomethingToWriteTheFirstOneKills) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto early = [](int signal) {
    const SignalListener listener;
    std::raise(SIGUSR1);  // recorded until there is a picture to write
    if (listener.flags().write.load()) std::raise(signal);
  };
  EXPECT_EXIT(early(SIGINT), ::testing::KilledBySignal(SIGINT), "");
  EXPECT_EXIT(early(SIGTERM), ::testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace nephroid

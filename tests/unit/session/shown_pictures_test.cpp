// Pictures for a viewer: when the session shows them.
#include <csignal>

#include "unit/session/scripted_session.h"

namespace nephroid {
namespace {

class ShownPictures : public testing_support::ScriptedSession {
 protected:
  struct Shown {
    double seconds;
    uint32_t passes;
    bool is_last;
  };
  RenderResult run_and_note(const RenderOptions& options) {
    RenderSession session(scene_, set_, *film_, options);
    session.use_clock([this] { return script_.now; });
    session.on_picture([this](const ShownPicture& picture) {
      shown_.push_back({picture.seconds, picture.passes, picture.is_last});
      script_.now += cost_;
    });
    return session.run(signals_);
  }

  std::vector<Shown> shown_;
  double cost_ = 0;  ///< seconds that a viewer takes for a picture
};

TEST_F(ShownPictures, BeginAtOnceAndGetRarer) {
  script_.pass_seconds = 0.1;
  RenderOptions options;
  options.time_limit = 60;
  run_and_note(options);
  ASSERT_GT(shown_.size(), 20u);
  EXPECT_NEAR(shown_[0].seconds, 0.1, 1e-9);
  EXPECT_EQ(shown_[0].passes, 1u);
  const double first = shown_[1].seconds - shown_[0].seconds;
  const size_t n = shown_.size();
  const double late = shown_[n - 2].seconds - shown_[n - 3].seconds;
  EXPECT_NEAR(first, 0.2, 0.11);
  EXPECT_NEAR(late, 3, 0.3);
  for (size_t i = 0; i + 1 < n; ++i) EXPECT_FALSE(shown_[i].is_last);
  EXPECT_TRUE(shown_[n - 1].is_last);
}

TEST_F(ShownPictures, SlowViewerGetsFewer) {
  script_.pass_seconds = 0.1;
  cost_ = 1;
  RenderOptions options;
  options.time_limit = 60;
  run_and_note(options);
  EXPECT_LT(shown_.size(), 10u);
}

TEST_F(ShownPictures, NoneAfterASignal) {
  script_.during_pass = [this](const PassKey& key) {
    if (key.pass == 2) signals_.stop = SIGTERM;
  };
  const RenderResult result = run_and_note({});
  EXPECT_EQ(result.reason, StopReason::kSignal);
  ASSERT_FALSE(shown_.empty());
  EXPECT_FALSE(shown_.back().is_last);
  EXPECT_LT(shown_.back().passes, 3u);
}

}  // namespace
}  // namespace nephroid

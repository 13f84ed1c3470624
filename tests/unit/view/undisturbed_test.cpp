// A render that is looked at, asked and paused within its passes has the bits of one that is not.
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "core/errors.h"
#include "same_bits.h"
#include "unit/view/live_scene.h"

namespace nephroid {
namespace {

/// A glass ball over a floor: the default integrator stores photons and learns from them.
constexpr const char* kGlass = R"(
LookAt 0 1 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 96 "integer yresolution" 64
WorldBegin
LightSource "point" "point3 from" [ 0 3 -1 ] "rgb I" [ 9 9 9 ]
Material "dielectric"
Shape "sphere" "float radius" 0.5
Material "diffuse"
Shape "bilinearmesh" "point3 P" [ -2 -0.6 -2  2 -0.6 -2  -2 -0.6 2  2 -0.6 2 ]
)";

class Undisturbed : public testing_support::LiveTest,
                    public ::testing::WithParamInterface<const char*> {
 protected:
  RenderRequest wanted() const {
    RenderRequest wanted = request(4);
    wanted.routes.integrator = GetParam();
    return wanted;
  }
};

/// Asks a view all the time, until it is stopped. Counts the answers.
class Disturbance {
 public:
  explicit Disturbance(LiveRender& live) : live_(live), thread_([this] { work(); }) {}
  ~Disturbance() { stop(); }

  int stop() {
    is_ending_ = true;
    if (thread_.joinable()) thread_.join();
    return answers_;
  }

 private:
  void work() {
    for (int i = 0; !is_ending_; ++i) {
      try {
        ask(i);
        ++answers_;
      } catch (const UsageError&) {  // there is no picture yet
      }
    }
    set_paused(false);
  }
  void ask(int i) {
    if (i % 50 == 0)
      live_.with_picture([&](const RenderAtRest& rest) { rest.render.inspect(i % 96, i % 64); });
    if (i % 10 == 1) set_paused(true);
    live_.probe(i % 96, i % 64);
    live_.frame({"picture", "albedo", "N", "stderr"}, 0, 0);
    if (i % 10 == 1) set_paused(false);
  }
  void set_paused(bool is_paused) {
    RenderChange change;
    change.action = is_paused ? RenderAction::kPause : RenderAction::kResume;
    live_.change(change);
  }

  LiveRender& live_;
  std::atomic<bool> is_ending_{false};
  int answers_ = 0;
  std::thread thread_;
};

TEST_P(Undisturbed, PicturesHaveTheSameBits) {
  write(kGlass);
  const LoadedScene loaded = load_scene(wanted());
  Render plain(wanted(), loaded);
  SignalFlags signals;
  plain.run(signals);

  LiveRender live(wanted());
  Disturbance disturbance(live);
  const bool is_done = testing_support::has_status(live, LiveStatus::kDone);
  EXPECT_GT(disturbance.stop(), 4);
  ASSERT_TRUE(is_done);
  live.at_rest([&](const RenderAtRest& rest) {
    testing_support::expect_same_bits(plain.film(), rest.render.film(), GetParam());
  });
}

INSTANTIATE_TEST_SUITE_P(Integrators, Undisturbed, ::testing::Values("mixed", "path", "sppm"),
                         [](const auto& named) { return std::string(named.param); });

}  // namespace
}  // namespace nephroid

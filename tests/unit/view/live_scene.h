// A small scene on the disk, and waiting for the states of its live render.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <string>

#include "view/live_render.h"
#include "view/temporary_directory.h"

namespace nephroid::testing_support {

inline constexpr int kLiveWidth = 32, kLiveHeight = 24;
inline constexpr const char* kLiveScene = R"(
LookAt 0 0 -4  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 32 "integer yresolution" 24
WorldBegin
LightSource "point" "string name" "key" "point3 from" [ 0 3 -3 ] "rgb I" [ 9 9 9 ]
LightSource "point" "string name" "fill" "point3 from" [ 3 0 -3 ] "rgb I" [ 1 2 3 ]
Shape "sphere"
)";

/// Waits for at most ten seconds until the state is as wanted; it looks when there is news.
template <class Wanted>
bool comes(const LiveRender& live, const Wanted& wanted) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::seconds kLongest(120);  // for a sanitizer on a busy machine
  const auto end = Clock::now() + kLongest;
  for (uint64_t seen = 0; Clock::now() < end; seen = live.wait_for_news(seen, 1))
    if (wanted(live.state())) return true;
  return false;
}
inline bool has_status(const LiveRender& live, LiveStatus status) {
  return comes(live, [status](const LiveState& state) { return state.status == status; });
}
inline bool has_picture(const LiveRender& live) {
  return comes(live, [](const LiveState& state) {
    return state.version > 0 && state.progress.passes_done > 0;
  });
}

class LiveTest : public ::testing::Test {
 protected:
  LiveTest() { write(kLiveScene); }

  void write(const std::string& text) const { write("scene.pbrt", text); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name)) << text;
  }
  std::string file(const std::string& name) const { return directory_.file(name); }

  RenderRequest request() const {
    RenderRequest request;
    request.scene = path_;
    request.routes.integrator = "path";
    return request;
  }
  /// A render that is done after `passes` passes.
  RenderRequest request(uint32_t passes) const {
    RenderRequest short_one = request();
    short_one.options.last_pass = passes - 1;
    return short_one;
  }

  TemporaryDirectory directory_;
  std::string path_ = directory_.file("scene.pbrt");
};

}  // namespace nephroid::testing_support

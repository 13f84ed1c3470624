// Requests of the page as JSON.
#include "view/view_requests.h"

#include <gtest/gtest.h>

#include <functional>

#include "core/errors.h"

namespace nephroid {
namespace {

std::string message_of(const std::function<void()>& body) {
  try {
    body();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ViewRequests, ACameraChangesInWhatItSays) {
  const CameraChange change =
      parse_camera_change(R"({"eye":[1,2,3],"fov":40.5,"shutter":[0,0.5],"moving":true})");
  EXPECT_TRUE(change.is_moving);
  CameraPose pose;
  pose.target = {7, 8, 9};
  pose.lens_radius = 0.25;
  const CameraPose changed = change.applied_to(pose);
  EXPECT_EQ(changed.eye, Vec3d(1, 2, 3));
  EXPECT_EQ(changed.target, Vec3d(7, 8, 9));
  EXPECT_EQ(changed.fov, 40.5);
  EXPECT_EQ(changed.lens_radius, 0.25);
  EXPECT_EQ(changed.shutter_open, 0.0);
  EXPECT_EQ(changed.shutter_close, 0.5);
}

TEST(ViewRequests, RestingIsTheDefault) {
  EXPECT_FALSE(parse_camera_change("{}").is_moving);
}

TEST(ViewRequests, SettingsBeginAnewAndPausesDoNot) {
  EXPECT_FALSE(parse_render_change(R"({"action":"pause"})").begins_anew());
  EXPECT_FALSE(parse_render_change(R"({"action":"resume"})").begins_anew());
  EXPECT_TRUE(parse_render_change(R"({"action":"restart"})").begins_anew());
  const RenderChange change = parse_render_change(
      R"({"integrator":"bdpt","layers":"lights","seed":7,"time":null,"noise":0.02,)"
      R"("resolution":[640,480],"crop":[0.25,0.75,0,1]})");
  EXPECT_TRUE(change.begins_anew());
  EXPECT_EQ(change.integrator, "bdpt");
  EXPECT_EQ(change.layers, LayerChoice::kLights);
  EXPECT_EQ(change.seed, 7u);
  EXPECT_EQ(change.time, 0.0);
  EXPECT_EQ(change.noise, 0.02);
  EXPECT_EQ(change.resolution, std::pair(640, 480));
  EXPECT_EQ((*change.crop)[1], 0.75);
}

TEST(ViewRequests, WrongRequestsSayWhatWasExpected) {
  const std::pair<const char*, const char*> camera[] = {
      {"", "the request is no JSON object"},
      {"[1]", "the request is no JSON object"},
      {R"({"eye":[1,2]})", "eye: expected 3 numbers"},
      {R"({"eye":[1,2,"x"]})", "eye: expected a number"},
      {R"({"eye":[1,2,1e39]})", "eye: 1e+39 is not valid, expected -1e+30 to 1e+30"},
      {R"({"fov":180})", "fov: 180 is not valid, expected 0.001 to 179.9"},
      {R"({"moving":1})", "moving: expected true or false"},
      {R"({"eyes":1})", "the request has a member 'eyes' that is not known"},
  };
  for (const auto& [body, message] : camera)
    EXPECT_EQ(message_of([body = body] { parse_camera_change(body); }), message);
  const std::pair<const char*, const char*> render[] = {
      {R"({"action":"stop"})", "action: 'stop' is not valid, expected pause, resume or restart"},
      {R"({"layers":"none"})", "layers: 'none' is not valid, expected routes, lights or both"},
      {R"({"seed":-1})", "seed: expected a whole number from 0"},
      {R"({"seed":1.5})", "seed: expected a whole number from 0"},
      {R"({"integrator":1})", "integrator: expected a text"},
      {R"({"resolution":[0,10]})", "resolution: 0 is not valid, expected 1 to 32768"},
      {R"({"crop":[0.5,0.5,0,1]})", "crop: expected x0 < x1 and y0 < y1"},
  };
  for (const auto& [body, message] : render)
    EXPECT_EQ(message_of([body = body] { parse_render_change(body); }), message);
  EXPECT_EQ(message_of([] { parse_pixel_request(R"({"x":1})"); }), "expected the pixel as x and y");
  EXPECT_EQ(message_of([] { parse_pixel_request(R"({"x":1.5,"y":1})"); }),
            "x: 1.5 is not valid, expected a whole number");
}

TEST(ViewRequests, DeepNestingIsNoDanger) {
  const std::string deep(100000, '[');
  EXPECT_EQ(message_of([&] { parse_camera_change(deep); }), "the request is no JSON object");
}

}  // namespace
}  // namespace nephroid

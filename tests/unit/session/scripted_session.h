// A session with scripted estimators and a scripted clock.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "session/render_session.h"
#include "unit/film/one_part.h"

namespace nephroid::testing_support {

/// Script of a fake pass, shared between test and estimator.
struct Script {
  double now = 0;
  double pass_seconds = 1;
  int looks = 0;                                    ///< calls of PassControl per pass
  std::vector<PassKey> passes;                      ///< passes begun
  std::function<void(const PassKey&)> during_pass;  ///< called once per pass
  std::function<void(const PassKey&, int look)> during_look;
  EstimatorDescriptor descriptor{.traits = {.name = "fake"}};
};

class FakeEstimator : public Estimator {
 public:
  FakeEstimator(Script& script, int group) : script_(script), group_(group) {}
  const EstimatorDescriptor& descriptor() const override { return script_.descriptor; }
  void render_pass(const PassKey& key, const Learned*, const Scene&, Film& film,
                   PassControl& control) override {
    script_.passes.push_back(key);
    for (int look = 0; look < script_.looks; ++look) {
      script_.now += script_.pass_seconds / script_.looks;
      if (script_.during_look) script_.during_look(key, look);
      if (control.is_wanted()) control.attend();
    }
    if (script_.looks == 0) script_.now += script_.pass_seconds;
    if (script_.during_pass) script_.during_pass(key);
    // 0, 2, 0, 2 ...: mean 1 and standard deviation 1 in every pixel.
    const float value = key.pass % 2 == 0 ? 0.0f : 2.0f;
    for (int y = film.bounds().y0; y < film.bounds().y1; ++y)
      for (int x = film.bounds().x0; x < film.bounds().x1; ++x)
        add_one(film, group_, x, y, {value, value, value});
    film.add_estimates(group_, 1);
    statistics_.rays += 100;
    statistics_.light_rays += 20;
    statistics_.photon_paths += 50;
    statistics_.photon_paths_useful += 5;
    statistics_.photons_stored += 10;
    statistics_.radius_max_pixels = 8.0f / static_cast<float>(key.pass + 1);
    statistics_.radius_min_pixels = statistics_.radius_max_pixels;
  }
  EstimatorStatistics statistics() const override { return statistics_; }

 private:
  Script& script_;
  int group_;
  EstimatorStatistics statistics_;
};

/// A film of 5 x 3 pixels, one route, six samples per pixel.
class ScriptedSession : public ::testing::Test {
 protected:
  ScriptedSession() {
    set_.layout = FilmLayout::of_routes({"diffuse"});
    set_.estimators.push_back(std::make_unique<FakeEstimator>(script_, 0));
    FilmSettings settings;
    settings.width = 5;
    settings.height = 3;
    film_ = std::make_unique<Film>(settings, set_.layout);
    scene_.samples_per_pixel = 6;
  }
  RenderResult run(const RenderOptions& options) {
    RenderSession session(scene_, set_, *film_, options);
    session.use_clock([this] { return script_.now; });
    session.on_progress([this](const RenderProgress& progress) {
      (progress.within_pass ? progress_within_ : progress_).push_back(progress);
    });
    session.on_warning([this](const std::string& warning) { warnings_.push_back(warning); });
    return session.run(signals_);
  }

  Script script_;
  EstimatorSet set_;
  Scene scene_;
  std::unique_ptr<Film> film_;
  SignalFlags signals_;
  std::vector<RenderProgress> progress_, progress_within_;  ///< after passes, and within them
  std::vector<std::string> warnings_;
};

}  // namespace nephroid::testing_support

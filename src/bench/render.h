// One render of a suite: a run with its curve, or a reference. The time of measuring is not
// counted. It must not know what is kept in files.
#pragma once

#include "bench/result.h"
#include "film/image_io.h"
#include "session/render.h"
#include "session/signals.h"

namespace nephroid {

/// A render of a suite: scene, integrator and limit.
struct BenchRender {
  const BenchScene* scene = nullptr;
  const BenchIntegrator* integrator = nullptr;
  BenchLimit limit;
  bool with_energy = false;  ///< true: measure the scene's shares of light
};

/// Loads the scenes of a suite. The last one is kept, because consecutive renders mostly use the
/// same scene.
class SceneShelf {
 public:
  /// The scene of a render, built with its settings. Throws SceneError and IoError.
  const LoadedScene& load(const BenchRender& render);

 private:
  std::string name_;
  SceneOverrides overrides_;
  LoadedScene loaded_;
};

/// The settings of a render: those of the scene in the suite, then the integrator's own.
SettingList settings_of(const BenchRender& render);
/// The routes of a render, with the AOVs for its shares. Throws UsageError and IoError.
RoutePlan plan_of(const BenchRender& render);

/// A finished render.
struct BenchRendered {
  BenchRun run;                       ///< without key and picture
  Picture picture;                    ///< all layers, with metadata
  std::vector<std::string> warnings;  ///< warnings about its routes, also among the run's notes
};

/// Renders and measures against the reference during the render. With a null reference the run's
/// points have no errors. Empty if a signal stopped it. Throws Error.
std::optional<BenchRendered> render_for_bench(const BenchRender& render, const Picture* reference,
                                              SceneShelf& shelf, SignalFlags& signals);

}  // namespace nephroid

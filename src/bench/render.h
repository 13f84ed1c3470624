// One render of a suite: a run with its curve, or a reference. The time that measuring takes is not
// counted. It must not know what is kept in files.
#pragma once

#include "bench/result.h"
#include "film/image_io.h"
#include "session/render.h"
#include "session/signals.h"

namespace nephroid {

/// What to render and for how long.
struct BenchRender {
  const BenchScene* scene = nullptr;
  const BenchIntegrator* integrator = nullptr;
  BenchLimit limit;
  bool with_energy = false;  ///< measures the scene's shares of light
};

/// The scenes of a suite as they are loaded: the last one stays, because most renders after each
/// other are of the same scene.
class SceneShelf {
 public:
  /// The scene of a render, built with its settings. Throws SceneError and IoError.
  const LoadedScene& load(const BenchRender& render);

 private:
  std::string name_;
  SceneOverrides overrides_;
  LoadedScene loaded_;
};

/// The settings of a render: the scene's of the suite, then the integrator's own.
SettingList settings_of(const BenchRender& render);
/// Its routes, with the AOVs that its shares need. Throws UsageError and IoError.
RoutePlan plan_of(const BenchRender& render);

/// A finished render; nothing if a signal stopped it.
struct BenchRendered {
  BenchRun run;                       ///< without key and picture
  Picture picture;                    ///< all layers, with metadata
  std::vector<std::string> warnings;  ///< about its routes, which the run has among its notes
};

/// Renders and measures against the reference as it goes. A null reference measures nothing, and
/// the run's points have no errors. Throws Error.
std::optional<BenchRendered> render_for_bench(const BenchRender& render, const Picture* reference,
                                              SceneShelf& shelf, SignalFlags& signals);

}  // namespace nephroid

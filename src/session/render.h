// A render from its scene to its picture: prepare, run, write. Start reading here; each step is one
// call in render.cpp. It must not know command lines, terminals or how estimators work.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "session/inspect.h"
#include "session/render_session.h"
#include "session/route_plan.h"
#include "session/scene_loading.h"
#include "session/settings/integrator_choice.h"

namespace nephroid {

/// A render as the user requests it: scene, routes, settings, stop rules.
struct RenderRequest {
  std::string scene;         ///< file name
  SceneOverrides overrides;  ///< resolution and crop window; the rest comes from `settings`
  RouteChoice routes;
  RenderSettings settings;  ///< over the scene's Integrator line
  bool reject_outliers = false;
  uint64_t memory = 0;           ///< limit in bytes, 0: the memory of the machine
  std::optional<uint64_t> seed;  ///< empty: the scene's
  bool resume = false;           ///< continues the saved render, if it is there
  std::string resume_from;       ///< picture of the saved render; empty: the output
  std::string learned_from;      ///< picture with what is to be learned; empty: none
  bool strict = false;           ///< names that the format does not have are errors
  /// Stop rules and output. Render sets seed, begin_with, identity and notes.
  RenderOptions options;
};

/// Callbacks for warnings; either may be empty.
struct RenderWarnings {
  std::function<void(const std::string&)> input;   ///< about scene, routes and settings
  std::function<void(const std::string&)> output;  ///< about the picture: resumed, replaced, failed
};

/// The request's changes to the scene file.
SceneOverrides scene_overrides(const RenderRequest& request);
/// The scene of a request. Throws SceneError and IoError. `files` as for read_scene().
LoadedScene load_scene(const RenderRequest& request, std::shared_ptr<SceneFiles> files = nullptr);
/// The same with a picture whose longer side has at most `longest_side` pixels.
LoadedScene load_small_scene(const RenderRequest& request, int longest_side);

/// Integrator and settings of a request in a scene. Throws SceneError and UsageError.
IntegratorChoice choose_integrator(const RenderRequest& request, const Scene& scene);

/// A prepared render with its film.
class Render {
 public:
  /// Prepares: routes, estimators, memory check, film, state of an earlier run. Keeps a reference
  /// to the scene. Throws UsageError and SceneError for a request that cannot be rendered, IoError
  /// for a picture that cannot be resumed or written. Warns if RenderRequest::learned_from cannot
  /// be used.
  Render(const RenderRequest& request, const LoadedScene& loaded, RenderWarnings warnings = {});
  Render(const Render&) = delete;
  Render& operator=(const Render&) = delete;

  /// Called after every pass, and several times a second within it.
  void on_progress(std::function<void(const RenderProgress&)> callback);
  /// Called with pictures on their way, see RenderSession.
  void on_picture(std::function<void(const ShownPicture&)> callback);
  /// Called soon after a request to write, see RenderSession.
  void on_request(std::function<void()> callback);
  /// Seconds from any origin; the machine's steady clock unless set.
  void use_clock(std::function<double()> seconds);

  /// Renders until a rule or a signal stops it and writes the picture. Throws IoError.
  RenderResult run(SignalFlags& signals);

  /// Writes what is rendered so far, see RenderSession. Throws IoError.
  void save(const std::string& path, bool with_state) { session_->save(path, with_state); }
  void save_last(const std::string& path, bool with_state) {
    session_->save_last(path, with_state);
  }
  /// True if it goes on from a saved render.
  bool has_resumed() const { return has_resumed_; }
  /// Explains a pixel. Called after run() or from a callback. Throws UsageError.
  PixelInspection inspect(int x, int y);
  /// The report so far, see RenderSession.
  std::string report() { return session_->report(); }

  const IntegratorChoice& integrator() const { return choice_; }
  const RoutePlan& plan() const { return plan_; }
  const EstimatorSet& estimators() const { return set_; }
  const Film& film() const { return *film_; }
  const RenderIdentity& identity() const { return identity_; }
  /// Notes for the report: choices for the scene, routes that stay black, parameters of the scene
  /// that are not used.
  std::vector<std::string> notes() const;

 private:
  const Scene& scene_;
  std::vector<std::string> notes_of_scene_;
  RenderWarnings warnings_;
  uint64_t seed_ = 0;
  bool has_resumed_ = false;
  IntegratorChoice choice_;
  RoutePlan plan_;
  EstimatorSet set_;
  std::optional<Film> film_;
  RenderIdentity identity_;
  std::optional<RenderSession> session_;
};

}  // namespace nephroid

// A render that follows its user: it runs on a thread of its own, begins anew after each edit, and
// lets others read the film while no pixel is rendered. It must not know the server.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "input/file_stamp.h"
#include "session/render.h"
#include "view/frame_store.h"
#include "view/rest_tasks.h"
#include "view/view_requests.h"
#include "view/view_source.h"

namespace nephroid {

class LiveRender final : public ViewSource {
 public:
  /// Loads the scene of the request and renders it, until the end of its lifetime. Its output is
  /// not written, but resumed from if the request says so.
  explicit LiveRender(RenderRequest request);
  /// Stops within a fraction of a second.
  ~LiveRender() override;
  LiveRender(const LiveRender&) = delete;
  LiveRender& operator=(const LiveRender&) = delete;

  LiveState state() const override;
  uint64_t wait_for_news(uint64_t seen, double seconds) const override;
  /// Layers that nobody has asked for lately are made now.
  std::optional<std::string> frame(const std::vector<std::string>& layers, uint64_t generation,
                                   uint64_t since) override;
  std::optional<PictureFrame> picture() override { return frames_.picture(); }
  ProbedPixel probe(int x, int y) override;
  Picture colors(const LayerGains& gains) override;
  void write(const std::string& exr_path) override;
  LiveRender* live() override { return this; }

  /// Edits: the render begins anew, and pictures get the generation that is returned. Throw
  /// UsageError for a change that cannot be made.
  uint64_t move_camera(const CameraChange& change);
  uint64_t change(const RenderChange& change);
  /// Renders the full picture if the camera is said to be moving and no move has come for so long:
  /// a page may have been closed meanwhile. Returns whether it does.
  bool settle_camera(double seconds);
  /// Reads the scene's files again.
  void reload();

  /// True if camera or settings are not those that the view began with.
  bool is_edited() const;
  /// The files of the scene as they were when it was read, those that it looked for included, also
  /// if it could not be read. Empty while it is read, and for a scene from a pipe, which cannot be
  /// read again.
  FileStamps files() const;

  /// Calls `task` on the render's thread as soon as no pixel is rendered, and returns after it.
  /// Passes on its exceptions. Throws UsageError if nothing can be rendered, or if it takes longer
  /// than a few seconds until the task begins.
  void at_rest(std::function<void(const RenderAtRest&)> task);
  /// The same for a task that needs the full picture. Throws UsageError if there is none.
  void with_picture(std::function<void(const RenderAtRest&)> task);
  /// The pixel of a render, which may be a preview, at a pixel of the full picture.
  Vec2i pixel_of_render(const RenderAtRest& rest, int x, int y) const;

 private:
  /// What the user has changed, read by the render's thread when it begins anew.
  struct Edits {
    RenderRequest request;
    std::optional<CameraPose> camera;  ///< empty: the scene's own
    bool is_moving = false;
    double moved_at = 0;     ///< steady_seconds() at the last move
    bool is_edited = false;  ///< since the view began
    bool reloads = true;
    uint64_t generation = 1;
  };

  /// The render's thread.
  void work();
  /// A camera of the user that the scene's type of camera cannot be is taken out of `edits`.
  void load(Edits& edits);
  LoadedScene read_scene_of(const RenderRequest& request);
  void render(const Edits& edits);
  /// Connects a render with state, frames and tasks.
  /// The pictures of a moving camera have at most `longest_edge` pixels in their longer side.
  void connect(Render& render, const Edits& edits, double longest_edge);
  /// Serves tasks until the render may go on.
  void rest_while_paused(const RenderAtRest& rest);
  /// Serves tasks until an edit or the end.
  void rest_until_edited(const RenderAtRest& rest);
  void refuse_tasks_until_edited(const std::string& why);
  Edits take_edits();
  bool must_stop() const;  ///< true after an edit or at the end
  /// Counts an edit; the lock is held.
  uint64_t note_edit();
  void publish(const std::function<void(LiveState&)>& change);
  /// Nothing is published after an edit, whose status is set already.
  void publish_status(LiveStatus status, const std::string& message = {});
  void renew_report(Render& render);

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  LiveState state_;
  uint64_t news_ = 1;
  Edits edits_;
  uint64_t taken_generation_ = 0;  ///< generation of the edits that the thread has taken
  bool is_ending_ = false, is_paused_ = false;
  SceneDescription camera_scene_;  ///< camera and film of the scene alone, to try edits
  bool is_loaded_ = false;
  FileStamps files_;
  SignalFlags signals_;  ///< of the present run
  RestTasks tasks_;
  FrameStore frames_;

  // Owned by the render's thread.
  std::optional<LoadedScene> loaded_;
  std::optional<CameraDescription> own_camera_;  ///< of the scene's file
  double preview_edge_ = 0;  ///< pixels of the longer side while the camera moves
  double paused_seconds_ = 0;
  bool has_rendered_ = false;  ///< false until the first render of the view
  std::thread thread_;
};

}  // namespace nephroid

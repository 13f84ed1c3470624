// The film of a render: how it rejects outliers, whether it fits the memory, the name of its file.
#pragma once

#include <string>

#include "film/film.h"
#include "route/routes.h"
#include "scene/scene.h"
#include "session/settings/integrator_settings.h"

namespace nephroid {

/// How a film of these routes rejects outliers.
OutlierSettings outlier_settings(const Routes& routes, const IntegratorOptions& options,
                                 const PixelFilter& filter, int64_t pixels,
                                 const SceneSettings& settings = {});

/// What a render is about to take memory for.
struct MemoryNeed {
  const FilmDescription& film;
  const FilmLayout& layout;
  const Routes& routes;
  const IntegratorOptions& options;
  int samples_per_pixel = 1;  ///< as the scene has them
  bool rejects_outliers = false;
  uint64_t held = 0;      ///< bytes that the process holds already, the scene among them
  uint64_t textures = 0;  ///< bytes that may still be taken for them
  bool writes = false;    ///< a picture at the end
};

/// Refuses a render that does not fit `limit` bytes, before anything is allocated for it, with what
/// it needs them for: throws UsageError if the limit or the film's size came from the command line,
/// else SceneError at the Film directive. What the estimators of the routes keep for each pixel is
/// counted, too.
void check_memory(const MemoryNeed& need, uint64_t limit, bool limit_is_an_option,
                  bool size_is_an_option);

/// The output when the user names none: the stem of the scene's film file name (or of the scene's
/// own, if the film has none), ".exr", in the current directory.
std::string default_output(const FilmDescription& film, const std::string& scene_file);

}  // namespace nephroid

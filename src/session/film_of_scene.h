// The film of a render: its outlier rejection, the check of its memory, the name of its file.
#pragma once

#include <string>

#include "film/film.h"
#include "route/routes.h"
#include "scene/scene.h"
#include "session/settings/integrator_settings.h"

namespace nephroid {

/// The outlier settings of a film with these routes; `pixels` are those of the uncropped picture.
OutlierSettings outlier_settings(const Routes& routes, const IntegratorOptions& options,
                                 const PixelFilter& filter, int64_t pixels,
                                 const SceneSettings& settings = {});

/// The memory that a render is about to allocate.
struct MemoryNeed {
  const FilmDescription& film;
  const FilmLayout& layout;
  const Routes& routes;
  const IntegratorOptions& options;
  int samples_per_pixel = 1;  ///< the scene's pixel samples
  bool rejects_outliers = false;
  uint64_t held = 0;      ///< bytes that the process already holds, including the scene
  uint64_t textures = 0;  ///< bytes that textures may still take
  bool writes = false;    ///< true if a picture is written at the end
};

/// Checks, before anything is allocated, that the render fits in `limit` bytes, estimators
/// included. If not, throws an error that lists the memory needs: UsageError if the limit or the
/// film's size came from the command line, else SceneError at the Film directive.
void check_memory(const MemoryNeed& need, uint64_t limit, bool limit_is_an_option,
                  bool size_is_an_option);

/// The default output: the stem of the film's file name in the scene, or else of the scene's own
/// name, plus ".exr", in the current directory.
std::string default_output(const FilmDescription& film, const std::string& scene_file);

}  // namespace nephroid

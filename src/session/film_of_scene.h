// From the scene's words about its film to the film itself, and to the name of the output.
// Who calls it: apps and tests that render whole scenes.
#pragma once

#include <string>

#include "film/film.h"
#include "integrator/estimator.h"
#include "route/routes.h"
#include "scene/scene.h"

namespace nephroid {

FilmSettings film_settings(const FilmDescription& description);

/// How a film of these routes rejects outliers.
OutlierSettings outlier_settings(const Routes& routes, const IntegratorOptions& options,
                                 const PixelFilter& filter);

/// Refuses a film that this machine's memory cannot hold, before anything is allocated for it:
/// throws UsageError if its size came from the command line, else SceneError at the Film directive.
/// What the estimators of the routes keep for each pixel is counted, too; `hit_points` are those of
/// `ppm` in a pixel.
void check_film_fits(const FilmDescription& description, const FilmLayout& layout,
                     const Routes& routes, bool size_is_an_option, bool rejects_outliers = false,
                     int hit_points = 0);

/// The output when the user names none: the stem of the scene's film file name (or of the scene's
/// own, if the film has none), ".exr", in the current directory.
std::string default_output(const FilmDescription& film, const std::string& scene_file);

}  // namespace nephroid

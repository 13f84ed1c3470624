// Converts the scene's film description to the film's settings.
#pragma once

#include "film/film.h"
#include "scene/scene.h"

namespace nephroid {

FilmSettings film_settings(const FilmDescription& description);

}  // namespace nephroid

// From the scene's description of its film to the film's settings.
#pragma once

#include "film/film.h"
#include "scene/scene.h"

namespace nephroid {

FilmSettings film_settings(const FilmDescription& description);

}  // namespace nephroid

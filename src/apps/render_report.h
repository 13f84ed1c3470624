// The short report at the end of a render.
#pragma once

#include <string>
#include <vector>

#include "film/film.h"
#include "session/render_session.h"

namespace nephroid {

/// Time, passes, rays, photons, radii, shares of routes, and warnings about light that was not
/// rendered. Without an output it names no files.
std::string render_report(const RenderResult& result, const Film& film, const std::string& output);

}  // namespace nephroid

// The renders of a view, as requests: the full picture, and the coarse one while the camera moves.
// It must not know threads.
#pragma once

#include "session/render.h"

namespace nephroid {

/// The user's request without its output, which is only resumed from; endless unless a rule was
/// given.
RenderRequest full_request(const RenderRequest& request);

/// Path-traced, with at most `edge` pixels in the longer side. `full` is the film of the full
/// picture; the crop stays.
RenderRequest preview_request(const RenderRequest& request, const FilmDescription& full,
                              double edge);

}  // namespace nephroid

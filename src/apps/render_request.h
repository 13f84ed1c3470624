// The render request of the commands `render` and `view`, from their arguments.
#pragma once

#include "options/options.h"
#include "session/render.h"

namespace nephroid {

RenderRequest request_of(const RenderCommand& command);

}  // namespace nephroid

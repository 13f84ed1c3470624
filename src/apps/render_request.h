// What the commands `render` and `view` ask for, from their arguments.
#pragma once

#include "options/options.h"
#include "session/render.h"

namespace nephroid {

RenderRequest request_of(const RenderCommand& command);

}  // namespace nephroid

// An inspected pixel as JSON (docs/view-protocol.md).
#pragma once

#include "session/inspect.h"
#include "view/json_text.h"

namespace nephroid {

Json inspection_json(const PixelInspection& inspection);

}  // namespace nephroid

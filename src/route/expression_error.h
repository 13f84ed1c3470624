// Error messages about routes, with column and caret below the user's text. It must not know the
// grammar.
#pragma once

#include <string>
#include <string_view>

#include "core/errors.h"
#include "route/route_set.h"

namespace nephroid {

/// "--route: column 12: message", the text, and a caret below the error. `offset` counts bytes from
/// the beginning of source.text; columns count characters from 1.
UsageError expression_error(const ExpressionSource& source, size_t offset,
                            const std::string& message);

/// "'x'" for the (UTF-8) character at `offset`, or `at_end` after the last one.
std::string found_text(std::string_view text, size_t offset, const char* at_end);

}  // namespace nephroid

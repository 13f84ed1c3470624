// Where a text of the user is wrong: column and caret below the text.
// Who calls it: everything that reads routes. It must not know the grammar.
#pragma once

#include <string>
#include <string_view>

#include "core/errors.h"
#include "route/route_set.h"

namespace nephroid {

/// "--route: column 12: message", the text, and a caret below the place. `offset` counts bytes from
/// the beginning of source.text; columns count characters from 1.
UsageError expression_error(const ExpressionSource& source, size_t offset,
                            const std::string& message);

/// "'x'" for the character at `offset`, whole if it is of several bytes, or `at_end` behind the
/// last.
std::string found_text(std::string_view text, size_t offset, const char* at_end);

}  // namespace nephroid

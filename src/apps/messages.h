// Errors and warnings on standard error. What they quote comes from files that may hold anything,
// so control characters and bytes that are not UTF-8 are shown as \xNN: a terminal obeys none of
// them. It must not know what the messages are about.
#pragma once

#include <string>
#include <vector>

namespace nephroid {

/// To standard error as it is. A log that cannot be written, on a full disk or closed, ends
/// nothing.
void say(const std::string& text);
void print_error(const std::string& message);
void print_warning(const std::string& message);
void print_warnings(const std::vector<std::string>& messages);

/// The text with everything that is not printable UTF-8, except line ends, as \xNN.
std::string printable(const std::string& text);

}  // namespace nephroid

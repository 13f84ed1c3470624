// Writes errors, warnings and notes to standard error. Messages may quote any file, so control
// characters and invalid UTF-8 are escaped as \xNN: a terminal must not obey them. It must not know
// the contents of messages.
#pragma once

#include <string>
#include <vector>

namespace nephroid {

/// Writes the text to standard error. Write errors, as on a full disk or a closed log, are ignored.
void say(const std::string& text);
void print_error(const std::string& message);
void print_warning(const std::string& message);
void print_warnings(const std::vector<std::string>& messages);
void print_notes(const std::vector<std::string>& messages);

/// Escapes all bytes that are not printable UTF-8 as \xNN, except line ends.
std::string printable(const std::string& text);

}  // namespace nephroid

// Puts what the page saves into the directory of --save-to. It must not know what it is.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace nephroid {

/// Writes the bytes to a new file in the directory and returns its path. If the name is taken, by a
/// file, a directory or a link, or by another call at the same time, it gets a number: "a-2.exr".
/// Throws IoError; no file is left then.
std::string save_new_file(const std::string& directory, const std::string& name,
                          std::span<const std::byte> bytes);

}  // namespace nephroid

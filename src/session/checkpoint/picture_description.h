// Describes a picture of the program and its progress, for `nephroid info`. It must not know
// scenes.
#pragma once

#include <string>

namespace nephroid {

/// True if a file begins like an OpenEXR file or a state file, or its name ends in .exr.
bool is_picture(const std::string& path);

/// Describes the file, its pixels, its passes, and whether it can be resumed or merged. Then lists
/// its metadata, one per line; longer texts are indented below their names. Throws IoError.
std::string description_of_picture(const std::string& path);

}  // namespace nephroid

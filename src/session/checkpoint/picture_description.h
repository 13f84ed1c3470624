// What a picture that the program wrote is of, and how far it has come, in sentences. It must not
// know scenes.
#pragma once

#include <string>

namespace nephroid {

/// True for files that begin as OpenEXR files or states of a render do.
bool is_picture(const std::string& path);

/// A line for the file, its pixels and its passes, and whether a render can go on from it; then all
/// that its metadata say, a line each, longer texts indented below their names. Throws IoError.
std::string description_of_picture(const std::string& path);

}  // namespace nephroid

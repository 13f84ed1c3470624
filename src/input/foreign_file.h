// Recognizes files of other programs given as a scene, by their first bytes and their name. It must
// not know the syntax of pbrt-v4 scenes.
#pragma once

#include <string>
#include <string_view>

namespace nephroid {

/// `this is a glTF scene, expected a pbrt-v4 scene ...` for a foreign file; empty if it may be a
/// pbrt-v4 scene.
std::string foreign_file_error(std::string_view bytes, const std::string& path);

}  // namespace nephroid

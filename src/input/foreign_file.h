// Files of other programs that are given as a scene: known by their first bytes, with the name as a
// hint. It must not know how a pbrt-v4 scene reads.
#pragma once

#include <string>
#include <string_view>

namespace nephroid {

/// `this is a glTF scene, expected a pbrt-v4 scene ...` for a file that is something else; empty if
/// nothing speaks against a pbrt-v4 scene.
std::string foreign_file_error(std::string_view bytes, const std::string& path);

}  // namespace nephroid

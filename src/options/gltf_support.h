// Writes docs/gltf-support.md from the importer's tables. It must not know any name of the format.
#pragma once

#include <string>

namespace nephroid {

/// The page.
std::string gltf_support_markdown();

}  // namespace nephroid

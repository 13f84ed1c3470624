// Checks the header of an OpenEXR file before the library reads it: the library allocates the
// memory that a header claims before it notices that the file is shorter. It must not know the
// contents of the picture.
#pragma once

#include <string>

namespace nephroid {

/// Maximum number of the library's threads in this program.
inline constexpr int kMaxImageThreads = 8;

/// The fault of the file's headers; empty if these checks find none:
/// - each attribute lies within the file
/// - no window claims more pixels than can be in the file
/// - nor do the tiles or blocks that the library holds for `threads` (0: the caller's own)
/// - no part is deep
/// Empty for other files, and for files that cannot be opened.
std::string fault_of_exr_header(const std::string& path, int threads = kMaxImageThreads);

}  // namespace nephroid

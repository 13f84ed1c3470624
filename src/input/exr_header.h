// A look at the header of an OpenEXR file before the library reads it: the library takes the memory
// that a header claims before it finds that the file is shorter.
// Who calls it: the readers of images and of checkpoints. It must not know what is in the picture.
#pragma once

#include <string>

namespace nephroid {

/// The most threads that the library may have in this program.
inline constexpr int kMaxImageThreads = 8;

/// What is wrong with the file's headers; empty if nothing is, as far as this looks: each attribute
/// lies within the file, no window has more in it than could be in the file, nor have the tiles or
/// blocks of rows that the library holds for so many threads (0: the caller's own), and no part is
/// deep. Empty for other files, and for those that cannot be opened.
std::string fault_of_exr_header(const std::string& path, int threads = kMaxImageThreads);

}  // namespace nephroid

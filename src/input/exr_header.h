// A look at the header of an OpenEXR file before the library reads it: the library takes the memory
// that a header claims before it finds that the file is shorter.
// Who calls it: the readers of images and of checkpoints. It must not know what is in the picture.
#pragma once

#include <string>

namespace nephroid {

/// What is wrong with the file's headers; empty if nothing is, as far as this looks: each attribute
/// lies within the file, and no window, tile or block of rows has more in it than could be in the
/// file. Empty for other files, and for those that cannot be opened.
std::string fault_of_exr_header(const std::string& path);

}  // namespace nephroid

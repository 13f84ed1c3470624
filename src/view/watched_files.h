// Tells when files have changed since they were read. It must not know what is in them.
#pragma once

#include "input/file_stamp.h"

namespace nephroid {

/// True if one of the files has changed since it had this stamp, or has appeared. One that is
/// missing now does not count: an editor may just be replacing it.
bool have_changed(const FileStamps& as_read);

}  // namespace nephroid

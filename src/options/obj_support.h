// Writes docs/obj-support.md, the support of OBJ and MTL files, from the tables of the importer. It
// must not know any keyword.
#pragma once

#include <string>

namespace nephroid {

/// The page.
std::string obj_support_markdown();

}  // namespace nephroid

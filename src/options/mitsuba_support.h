// Writes docs/mitsuba-support.md, the support of Mitsuba's plug-ins, from the tables of the
// importer. It must not know any plug-in.
#pragma once

#include <string>

namespace nephroid {

/// The page.
std::string mitsuba_support_markdown();

}  // namespace nephroid

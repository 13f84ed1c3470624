// Reads the XML of a Mitsuba scene into plug-ins: defaults, includes, references and aliases. It
// must not know the meaning of plug-ins.
#pragma once

#include <string>

#include "input/import_options.h"
#include "input/mitsuba/object.h"

namespace nephroid::mitsuba {

/// Throws IoError if the scene cannot be read and SceneError if its contents are wrong.
Document read_document(const std::string& path, SceneFiles& files, const ImportOptions& options,
                       Diagnostics& diagnostics);

}  // namespace nephroid::mitsuba

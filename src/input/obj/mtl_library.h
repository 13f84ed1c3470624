// All materials of the MTL files that an OBJ file names. It must not know scenes.
#pragma once

#include <map>
#include <string>

#include "input/obj/mtl_file.h"
#include "input/obj/obj_file.h"

namespace nephroid {

/// Where the files of an OBJ file may lie.
struct ObjFolder {
  std::string name;            ///< folder of the OBJ file, relative to the scene's
  bool allow_outside = false;  ///< see contained_file.h
};

/// The materials by name; of two with one name the first counts. Names of images are relative to
/// the scene. Warns of MTL files that cannot be read.
std::map<std::string, MtlMaterial> read_mtl_libraries(SceneFiles& files, const ObjFile& file,
                                                      const ObjFolder& folder,
                                                      Diagnostics& diagnostics);

}  // namespace nephroid

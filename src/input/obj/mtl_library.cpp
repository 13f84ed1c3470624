#include "input/obj/mtl_library.h"

#include <filesystem>
#include <utility>

#include "input/contained_file.h"

namespace nephroid {
namespace {

std::string joined(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / name).string();
}

/// Makes the names of images relative to the scene; in MTL files they are relative to these.
void name_images(const SceneFiles& files, const std::string& library, bool allow_outside,
                 MtlMaterial& material) {
  const std::string folder = std::filesystem::path(library).parent_path().string();
  for (auto& entry : material.maps) {
    MtlMap& map = entry.second;
    map.file = contained_file(files, joined(folder, map.file), allow_outside, map.where);
  }
}

}  // namespace

std::map<std::string, MtlMaterial> read_mtl_libraries(SceneFiles& files, const ObjFile& file,
                                                      const ObjFolder& folder,
                                                      Diagnostics& diagnostics) {
  std::map<std::string, MtlMaterial> all;
  for (const ObjLibrary& library : file.libraries) {
    const std::string name = contained_file(files, joined(folder.name, library.name),
                                            folder.allow_outside, library.where);
    try {
      for (auto& entry : read_mtl(files, files.path_of(name), diagnostics)) {
        name_images(files, name, folder.allow_outside, entry.second);
        all.try_emplace(entry.first, std::move(entry.second));
      }
    } catch (const IoError& error) {
      diagnostics.warn(library.where, std::string(error.what()) + "; its materials are missing");
    }
  }
  return all;
}

}  // namespace nephroid

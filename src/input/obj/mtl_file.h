// The materials of Wavefront MTL files, as they are written. It must not know the renderer's
// materials. Formats: Wavefront Technologies, "Material library file", 1995; the keywords of
// physically based materials are Exocortex's.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"
#include "input/scene_files.h"

namespace nephroid {

/// An image with its options.
struct MtlMap {
  std::string file;  ///< name as in the file, with "/" between folders
  double u_scale = 1, v_scale = 1, u_offset = 0, v_offset = 0;
  double bump = 1;  ///< -bm
  bool clamps = false;
  SourceLocation where;
};

/// The keywords of one newmtl. Names are canonical: map_bump is bump, Tr is 1 - d.
struct MtlMaterial {
  using Color = std::array<double, 3>;

  std::string name;
  SourceLocation where;
  std::map<std::string, Color> colors;
  std::map<std::string, double> numbers;
  std::map<std::string, MtlMap> maps;

  std::optional<Color> color(const std::string& keyword) const;
  std::optional<double> number(const std::string& keyword) const;
  const MtlMap* map(const std::string& keyword) const;
};

/// Reads an MTL file. If a name occurs twice, the last one counts. Throws SceneError for numbers
/// that are none; other lines that make no sense are ignored with a warning. Throws IoError if the
/// file cannot be read.
std::map<std::string, MtlMaterial> read_mtl(SceneFiles& files, const std::string& path,
                                            Diagnostics& diagnostics);

}  // namespace nephroid

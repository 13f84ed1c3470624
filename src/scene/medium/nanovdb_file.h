// The container of .nvdb files: segments of named grids, plain or packed with zlib. Takes one grid
// out as bytes and trusts no number of the file.
// Who calls it: nanovdb_grid.cpp. It must not know what is inside a grid. The layout is that of
// NanoVDB 32 (Museth 2021, "NanoVDB: A GPU-Friendly and Portable VDB Data Structure").
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"

namespace nephroid {

/// NanoVDB's nodes stand at multiples of this.
struct alignas(32) NanoVdbBlock {
  std::byte bytes[32];
};
using NanoVdbBytes = std::vector<NanoVdbBlock>;

/// The first grid named `name` of a file with the bytes `file`; empty if there is none. Throws
/// SceneError at `where` that names `path` if the file is none of NanoVDB 32, broken, or packed
/// with something else than zlib.
std::optional<NanoVdbBytes> read_nanovdb_grid(const std::string& file, const std::string& name,
                                              const std::string& path, const SourceLocation& where);

}  // namespace nephroid

// The container of .nvdb files: segments of named grids, plain or packed with zlib. Extracts one
// grid as bytes and validates all numbers of the file. It must not know what is inside a grid.
// Layout: NanoVDB 32 (Museth 2021, NanoVDB: A GPU-Friendly and Portable VDB Data Structure).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/errors.h"

namespace nephroid {

/// NanoVDB's nodes lie at multiples of this alignment.
struct alignas(32) NanoVdbBlock {
  std::byte bytes[32];
};
using NanoVdbBytes = std::vector<NanoVdbBlock>;

/// The first grid named `name` in a file with the bytes `file`. Empty if there is none. Throws
/// SceneError at `where`, naming `path`, if the file is not NanoVDB 32, broken, or packed with
/// something other than zlib.
std::optional<NanoVdbBytes> read_nanovdb_grid(const std::string& file, const std::string& name,
                                              const std::string& path, const SourceLocation& where);

}  // namespace nephroid

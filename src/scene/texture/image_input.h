// An opened image file: its header in the terms of this program. It shows OpenImageIO, so only
// image_file.cpp and paged_image.cpp include it.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/color.h"
#include "core/errors.h"
#include "input/scene_files.h"
#include "scene/texture/color_encoding.h"

namespace nephroid {

/// Type of values in the file and in memory; all other types are read as float.
enum class StoredType { kByte, kShort, kHalf, kFloat };

struct ImageInputFile {
  OIIO::ImageInput::Creator create = nullptr;  ///< creates another reader of the file's format
  FileSource source{std::string()};
  std::unique_ptr<OIIO::Filesystem::IOMemReader> memory_reader;  ///< null for files on disk
  std::unique_ptr<OIIO::ImageInput> input;                       ///< reads from memory_reader
  OIIO::ImageSpec spec;
  std::vector<int> channels;  ///< indices of grey or rgb, and alpha, in the file
  StoredType type = StoredType::kFloat;
  ColorEncoding encoding;  ///< encoding of integer values
  const RgbColorSpace* space = nullptr;

  /// Bytes of the wanted channels in memory, where shorts become half.
  uint64_t memory() const;
  /// True if a part can be read without reading everything before it.
  bool has_parts() const;
};

/// Opens a file. `encoding` and the errors are those of read_image.
ImageInputFile open_image(const FileSource& source, std::optional<ColorEncoding> encoding,
                          const SourceLocation& wanted_by);

/// The value type to ask OpenImageIO for.
OIIO::TypeDesc type_to_read(StoredType type);

}  // namespace nephroid

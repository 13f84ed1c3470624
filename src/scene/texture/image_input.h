// An image file that has been opened: what its header says, in the terms of this program.
// Who calls it: image_file.cpp, which reads whole files, and paged_image.cpp, which reads parts.
// No other file includes this one, because it shows OpenImageIO.
#pragma once

#include <OpenImageIO/imageio.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/color.h"
#include "core/errors.h"
#include "scene/texture/color_encoding.h"

namespace nephroid {

/// How values lie in the file, and so in memory: what is none of the first three is read as float.
enum class StoredType { kByte, kShort, kHalf, kFloat };

struct ImageInputFile {
  OIIO::ImageInput::Creator create = nullptr;  ///< makes another reader of the file's format
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
  std::vector<int> channels;  ///< indices of grey, of rgb or of rgba among those of the file
  StoredType type = StoredType::kFloat;
  ColorEncoding encoding;  ///< of integer values
  const RgbColorSpace* space = nullptr;

  /// Bytes of the wanted channels in memory, where shorts become half.
  uint64_t memory() const;
  /// True if a part can be read without all that comes before it.
  bool has_parts() const;
};

/// Opens a file; `encoding` and the errors are those of read_image.
ImageInputFile open_image(const std::string& path, std::optional<ColorEncoding> encoding,
                          const SourceLocation& wanted_by);

/// The value type to ask OpenImageIO for.
OIIO::TypeDesc type_to_read(StoredType type);

}  // namespace nephroid

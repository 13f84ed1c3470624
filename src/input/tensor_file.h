// Reads tensor files (".bsdf"), named arrays of numbers in which measured reflectances are
// published. Claims of a file are checked before memory is allocated. It must not know what the
// arrays mean. Format: the data base of J. Dupuy, W. Jakob, "An Adaptive Parameterization for
// Efficient Material Acquisition and Rendering", 2018.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/errors.h"
#include "input/scene_files.h"

namespace nephroid {

/// The number types of the format, with the codes that files use.
enum class TensorType : uint8_t {
  kUint8 = 1,
  kInt8,
  kUint16,
  kInt16,
  kUint32,
  kInt32,
  kUint64,
  kInt64,
  kFloat16,
  kFloat32,
  kFloat64
};

/// One array: type, extent along each dimension (the last one runs fastest) and bytes.
struct TensorField {
  TensorType type = TensorType::kUint8;
  std::vector<uint64_t> shape;
  std::string_view bytes;  ///< view into the file, of the size that type and shape need

  /// "float32 [2 x 3]", for messages.
  std::string to_string() const;
};

class TensorFile {
 public:
  /// Reads a file (".gz" is unpacked). If it cannot be read, throws SceneError at `wanted_by`, or
  /// IoError if no scene names the file. Throws SceneError if it is damaged or not a tensor file.
  static TensorFile read(SceneFiles& files, const std::string& path,
                         const SourceLocation& wanted_by);
  /// The same from bytes in memory; `name` is the name in messages.
  TensorFile(std::string bytes, std::string name, SourceLocation wanted_by);
  TensorFile(const TensorFile&) = delete;
  TensorFile& operator=(const TensorFile&) = delete;

  /// The field with that name, or nullptr.
  const TensorField* find(const std::string& name) const;
  /// The field with that name; throws SceneError if it is absent, or of another type or number of
  /// dimensions.
  const TensorField& require(const std::string& name, TensorType type, size_t dimensions) const;
  /// The numbers of a field that `require` found to be of type kFloat32.
  static std::vector<float> floats(const TensorField& field);

  /// Throws SceneError with the file's name and the message.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::string bytes_, name_;
  SourceLocation wanted_by_;
  std::map<std::string, TensorField> fields_;
};

}  // namespace nephroid

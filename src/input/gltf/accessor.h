// Accessors: typed arrays in buffer views, as numbers. All component types, normalised integers,
// sparse values and strides. It must not know what the numbers mean.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "input/gltf/document.h"

namespace nephroid::gltf {

/// `count` elements of `width` numbers each; matrices are column by column.
struct NumberArray {
  size_t count = 0;
  size_t width = 1;
  std::vector<float> values;

  const float* operator[](size_t element) const { return &values[element * width]; }
};

/// Reads accessor `index`. Normalised integers become 0 to 1 or -1 to 1. Throws SceneError if it
/// reaches beyond its buffer view, claims too much, or has a number that is not finite.
NumberArray read_accessor(Document& document, size_t index, const JsonValue& wanted_by);
/// The same if the member of `owner` exists. Throws if the elements have another width.
std::optional<NumberArray> find_accessor(Document& document, const JsonValue& owner,
                                         const std::string& member, size_t width);

/// Reads an accessor of unsigned integers exactly.
std::vector<uint32_t> read_integers(Document& document, size_t index, const JsonValue& wanted_by);

/// True if all elements are in the file; else they are 0, or sparse.
bool has_data(Document& document, size_t index, const JsonValue& wanted_by);

/// A component type of glTF, which has OpenGL's numbers.
struct ComponentType {
  size_t code;
  size_t size;    ///< bytes
  float largest;  ///< value that normalises to 1; 0 if it is no integer
  bool is_signed;
};
/// The type with that code; nullptr if there is none.
const ComponentType* find_component_type(size_t code);

}  // namespace nephroid::gltf

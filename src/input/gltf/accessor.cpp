#include "input/gltf/accessor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

#include "core/counted.h"

namespace nephroid::gltf {
namespace {

constexpr size_t kFloat = 5126, kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125;
constexpr ComponentType kComponentTypes[] = {
    {5120, 1, 127, true},        {kUnsignedByte, 1, 255, false},
    {5122, 2, 32767, true},      {kUnsignedShort, 2, 65535, false},
    {kUnsignedInt, 4, 0, false}, {kFloat, 4, 0, true},
};

struct ElementType {
  const char* name;
  size_t rows, columns;
};
constexpr ElementType kElementTypes[] = {{"SCALAR", 1, 1}, {"VEC2", 2, 1}, {"VEC3", 3, 1},
                                         {"VEC4", 4, 1},   {"MAT2", 2, 2}, {"MAT3", 3, 3},
                                         {"MAT4", 4, 4}};

/// Elements of an accessor that has no data: they are 0, and no file of that size backs the claim.
constexpr size_t kMaxZeros = size_t{1} << 24;

/// The layout of an accessor's elements.
struct Layout {
  const ComponentType* component;
  const ElementType* element;
  size_t count;
  bool normalised;

  size_t width() const { return element->rows * element->columns; }
  /// Bytes of a column; those of matrices start at multiples of 4.
  size_t column_size() const {
    const size_t bytes = element->rows * component->size;
    return element->columns > 1 ? (bytes + 3) / 4 * 4 : bytes;
  }
  size_t element_size() const { return element->columns * column_size(); }
};

const ComponentType& component_type(const JsonValue& owner) {
  const size_t code = owner.get_index("componentType");
  const ComponentType* type = find_component_type(code);
  if (!type)
    owner.get("componentType")
        .fail("unknown component type " + std::to_string(code) +
              ", expected 5120 to 5123, 5125 or 5126");
  return *type;
}

Layout read_layout(const JsonValue& accessor) {
  const std::string name = accessor.get("type").text();
  const auto* const element =
      std::find_if(std::begin(kElementTypes), std::end(kElementTypes),
                   [&](const ElementType& row) { return name == row.name; });
  if (element == std::end(kElementTypes))
    accessor.get("type").fail("unknown type \"" + name +
                              "\", expected SCALAR, VEC2 to VEC4 or MAT2 to MAT4");
  return {&component_type(accessor), element, accessor.get_index("count"),
          accessor.get_flag("normalized", false)};
}

/// Elements in a buffer view, checked to lie within it.
struct Elements {
  const std::byte* first = nullptr;
  size_t stride = 0;
};

Elements find_elements(Document& document, const JsonValue& owner, size_t count,
                       size_t element_size) {
  const size_t view = owner.get_index("bufferView");
  const Bytes bytes = document.buffer_view(view, owner);
  const size_t offset = owner.get_index("byteOffset", 0);
  size_t stride = document.buffer_view_stride(view, owner);
  if (stride == 0) stride = element_size;
  if (stride < element_size)
    owner.fail("elements of " + counted(element_size, "byte") +
               " overlap, expected a stride of at least that, found " + std::to_string(stride));
  const bool fits =
      count == 0 || (offset <= bytes.size() && element_size <= bytes.size() - offset &&
                     count - 1 <= (bytes.size() - offset - element_size) / stride);
  if (!fits)
    owner.fail(counted(count, "element") + in_number(count, " reaches", " reach") +
               " beyond the buffer view, which has " + std::to_string(bytes.size()) + " bytes");
  return {bytes.data() + (count == 0 ? 0 : offset), stride};
}

template <class T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

double number_at(const std::byte* from, const ComponentType& type) {
  switch (type.code) {
    case 5120:
      return load<int8_t>(from);
    case kUnsignedByte:
      return load<uint8_t>(from);
    case 5122:
      return load<int16_t>(from);
    case kUnsignedShort:
      return load<uint16_t>(from);
    case kUnsignedInt:
      return load<uint32_t>(from);
    default:
      return load<float>(from);
  }
}

float value_at(const std::byte* from, const Layout& layout) {
  const double number = number_at(from, *layout.component);
  if (!layout.normalised || layout.component->largest == 0) return static_cast<float>(number);
  return static_cast<float>(std::max(number / layout.component->largest, -1.0));
}

void read_element(const std::byte* from, const Layout& layout, float* to) {
  for (size_t column = 0; column < layout.element->columns; ++column)
    for (size_t row = 0; row < layout.element->rows; ++row)
      *to++ = value_at(from + column * layout.column_size() + row * layout.component->size, layout);
}

/// Packed floats, the usual case, are copied at once.
void read_elements(const Elements& elements, const Layout& layout, float* to) {
  if (layout.count == 0) return;
  if (layout.component->code == kFloat && elements.stride == layout.width() * sizeof(float)) {
    std::memcpy(to, elements.first, layout.count * elements.stride);
    return;
  }
  for (size_t i = 0; i < layout.count; ++i)
    read_element(elements.first + i * elements.stride, layout, to + i * layout.width());
}

uint32_t integer_at(const std::byte* from, const ComponentType& type) {
  return type.code == kUnsignedByte    ? load<uint8_t>(from)
         : type.code == kUnsignedShort ? load<uint16_t>(from)
                                       : load<uint32_t>(from);
}

const ComponentType& unsigned_type(const JsonValue& owner) {
  const ComponentType& type = component_type(owner);
  if (type.is_signed)
    owner.get("componentType").fail("this type is signed, expected an unsigned integer");
  return type;
}

/// Calls replace(i, from) with each element that a sparse accessor stores.
template <class Replace>
void read_sparse(Document& document, const JsonValue& accessor, const Layout& layout,
                 Replace replace) {
  const std::optional<JsonValue> sparse = accessor.find_object("sparse");
  if (!sparse) return;
  const size_t count = sparse->get_index("count");
  const JsonValue indices = sparse->get("indices"), values = sparse->get("values");
  const ComponentType& type = unsigned_type(indices);
  const Elements places = find_elements(document, indices, count, type.size);
  const Elements elements = find_elements(document, values, count, layout.element_size());
  for (size_t i = 0; i < count; ++i) {
    const uint32_t place = integer_at(places.first + i * places.stride, type);
    if (place >= layout.count)
      indices.fail("index " + std::to_string(place) + " is out of range, the accessor has " +
                   counted(layout.count, "element"));
    replace(place, elements.first + i * elements.stride);
  }
}

void check_zeros(Document& document, const JsonValue& accessor, const Layout& layout) {
  if (layout.count > kMaxZeros)
    accessor.get("count").fail("an accessor without data has " + std::to_string(layout.count) +
                               " elements, expected at most " + std::to_string(kMaxZeros));
  document.claim_memory(layout.count * layout.width() * sizeof(double), accessor);
}

}  // namespace

const ComponentType* find_component_type(size_t code) {
  for (const ComponentType& type : kComponentTypes)
    if (type.code == code) return &type;
  return nullptr;
}

NumberArray read_accessor(Document& document, size_t index, const JsonValue& wanted_by) {
  const JsonValue accessor = document.item("accessors", index, wanted_by);
  const Layout layout = read_layout(accessor);
  NumberArray array{layout.count, layout.width(), {}};
  std::optional<Elements> elements;
  if (accessor.find("bufferView"))
    elements = find_elements(document, accessor, layout.count, layout.element_size());
  else
    check_zeros(document, accessor, layout);
  array.values.resize(layout.count * layout.width());
  if (elements) read_elements(*elements, layout, array.values.data());
  read_sparse(document, accessor, layout, [&](size_t place, const std::byte* from) {
    read_element(from, layout, &array.values[place * layout.width()]);
  });
  for (size_t i = 0; i < array.values.size(); ++i)
    if (!std::isfinite(array.values[i]))
      accessor.fail("element " + std::to_string(i / array.width) +
                    " is not finite, expected finite numbers");
  return array;
}

std::optional<NumberArray> find_accessor(Document& document, const JsonValue& owner,
                                         const std::string& member, size_t width) {
  const std::optional<JsonValue> reference = owner.find(member);
  if (!reference) return std::nullopt;
  NumberArray array = read_accessor(document, reference->index(), *reference);
  if (array.width != width)
    reference->fail("the accessor has " + counted(array.width, "number") +
                    " per element, expected " + std::to_string(width));
  return array;
}

std::vector<uint32_t> read_integers(Document& document, size_t index, const JsonValue& wanted_by) {
  const JsonValue accessor = document.item("accessors", index, wanted_by);
  const Layout layout = read_layout(accessor);
  const ComponentType& type = unsigned_type(accessor);
  std::optional<Elements> elements;
  if (accessor.find("bufferView"))
    elements = find_elements(document, accessor, layout.count, layout.element_size());
  else
    check_zeros(document, accessor, layout);
  const size_t width = layout.width();
  std::vector<uint32_t> values(layout.count * width);
  const auto read = [&](size_t place, const std::byte* from) {
    for (size_t k = 0; k < width; ++k)
      values[place * width + k] = integer_at(from + k * type.size, type);
  };
  for (size_t i = 0; elements && i < layout.count; ++i)
    read(i, elements->first + i * elements->stride);
  read_sparse(document, accessor, layout, read);
  return values;
}

bool has_data(Document& document, size_t index, const JsonValue& wanted_by) {
  return document.item("accessors", index, wanted_by).find("bufferView").has_value();
}

}  // namespace nephroid::gltf

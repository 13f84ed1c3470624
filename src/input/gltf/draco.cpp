// The only file with Draco; see draco.h.
#include "input/gltf/draco.h"

// Draco's headers do not meet this project's warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <draco/compression/decode.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cmath>

namespace nephroid::gltf {
namespace {

class DracoSource final : public AttributeSource {
 public:
  DracoSource(Document& document, const JsonValue& primitive, const JsonValue& extension,
              std::unique_ptr<draco::Mesh> mesh)
      : document_(document),
        extension_(extension),
        packed_(extension.get("attributes")),
        attributes_(primitive.get("attributes")),
        mesh_(std::move(mesh)) {}

  std::optional<NumberArray> find(const std::string& name) override {
    if (packed_.find(name)) return unpack(name);
    const std::optional<JsonValue> reference = attributes_.find(name);
    if (!reference) return std::nullopt;
    return read_accessor(document_, reference->index(), *reference);
  }

  std::optional<std::vector<uint32_t>> indices() override {
    std::vector<uint32_t> list;
    list.reserve(3 * size_t{mesh_->num_faces()});
    for (draco::FaceIndex f(0); f < mesh_->num_faces(); ++f)
      for (const draco::PointIndex& point : mesh_->face(f)) list.push_back(point.value());
    return list;
  }

 private:
  /// The integer that means 1, or 0 if the numbers count as they are. The accessor says so: most
  /// encoders do not set Draco's own flag.
  float value_of_one(const std::string& name, const draco::PointAttribute& attribute) const {
    const std::optional<JsonValue> reference = attributes_.find(name);
    if (!reference || attribute.normalized() || !draco::IsDataTypeIntegral(attribute.data_type()))
      return 0;
    const JsonValue accessor = document_.item("accessors", reference->index(), *reference);
    if (!accessor.get_flag("normalized", false)) return 0;
    const ComponentType* type = find_component_type(accessor.get_index("componentType"));
    return type ? type->largest : 0;
  }

  NumberArray unpack(const std::string& name) const {
    const JsonValue id = packed_.get(name);
    const draco::PointAttribute* attribute =
        mesh_->GetAttributeByUniqueId(static_cast<uint32_t>(id.index()));
    if (!attribute) id.fail("the Draco data have no attribute with this number");
    NumberArray array{mesh_->num_points(), static_cast<size_t>(attribute->num_components()), {}};
    array.values.resize(array.count * array.width);
    for (draco::PointIndex point(0); point < mesh_->num_points(); ++point) {
      float* const to = &array.values[point.value() * array.width];
      if (!attribute->ConvertValue(attribute->mapped_index(point), attribute->num_components(), to))
        extension_.fail("the Draco data are damaged: " + name + " cannot be read");
    }
    if (const float one = value_of_one(name, *attribute); one > 0)
      for (float& value : array.values) value = std::max(value / one, -1.0f);
    for (const float value : array.values)
      if (!std::isfinite(value)) extension_.fail(name + " has a value that is not finite");
    return array;
  }

  Document& document_;
  JsonValue extension_, packed_, attributes_;
  std::unique_ptr<draco::Mesh> mesh_;
};

}  // namespace

std::unique_ptr<AttributeSource> open_draco(Document& document, const JsonValue& primitive,
                                            const JsonValue& extension) {
  const Bytes bytes = document.buffer_view(extension.get_index("bufferView"), extension);
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
  if (!mesh.ok())
    extension.fail(std::string("the Draco data are damaged: ") + mesh.status().error_msg());
  return std::make_unique<DracoSource>(document, primitive, extension, std::move(mesh).value());
}

}  // namespace nephroid::gltf

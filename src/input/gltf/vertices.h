// The vertices and triangles of a mesh primitive as plain arrays, read from accessors or Draco data
// and changed by morph targets and skins. It must not know materials.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/math.h"
#include "input/gltf/accessor.h"

namespace nephroid::gltf {

struct Vertices {
  std::vector<Vec3f> positions;
  std::vector<Vec3f> normals;                ///< or empty
  std::vector<Vec3f> tangents;               ///< or empty
  std::vector<float> tangent_signs;          ///< one per tangent: of the bitangent
  std::array<std::vector<Vec2f>, 2> uvs;     ///< with v upwards; or empty
  std::vector<std::array<float, 4>> colors;  ///< linear; or empty
  std::vector<uint32_t> triangles;           ///< three indices each, checked
};

/// What of a primitive is wanted.
struct WantedAttributes {
  std::vector<size_t> uv_sets;  ///< at most two
  bool colors = false;
  bool tangents = false;
};

/// Named arrays of a primitive, whatever their compression.
class AttributeSource {
 public:
  virtual ~AttributeSource() = default;
  /// The attribute, such as "POSITION"; empty if the primitive has none.
  virtual std::optional<NumberArray> find(const std::string& name) = 0;
  /// The indices as stored; empty if the primitive has none.
  virtual std::optional<std::vector<uint32_t>> indices() = 0;
};

/// The source of a primitive: its accessors, or its KHR_draco_mesh_compression.
std::unique_ptr<AttributeSource> open_attributes(Document& document, const JsonValue& primitive);

/// True if the primitive has triangles: other modes have no area.
bool has_area(const JsonValue& primitive);

/// Reads a primitive. Throws SceneError for indices out of range and arrays of different lengths.
Vertices read_vertices(AttributeSource& source, const JsonValue& primitive,
                       const WantedAttributes& wanted, Diagnostics& diagnostics);

/// Makes tangents along u of the first texture coordinates, averaged over the faces of a vertex by
/// angle, as MikkTSpace does (Mikkelsen 2008). Unlike it, this splits no vertices where mirrored
/// halves meet. Does nothing without texture coordinates or normals.
void add_tangents(Vertices& vertices);
/// Gives each triangle vertices of its own, with its normal and tangents along u.
void make_faceted(Vertices& vertices);
/// Turns tangents about the normals by an angle, counter-clockwise.
void rotate_tangents(Vertices& vertices, double angle);

}  // namespace nephroid::gltf

// Reads the vertices and faces of a PLY file into a MeshData; all else in the file is skipped.
// Claims of the header are compared with the file's size before memory is allocated for them.
// Format: G. Turk, "The PLY Polygon File Format", 1994.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <new>
#include <optional>
#include <stdexcept>

#include "core/counted.h"
#include "input/file_bytes.h"
#include "input/mesh_data.h"
#include "input/ply_header.h"
#include "input/ply_source.h"
#include "input/polygon_triangles.h"

namespace nephroid {
namespace {

/// Reads the elements of one file; its errors are std::runtime_errors that do not name the file.
template <class Source>
class PlyReader {
 public:
  PlyReader(const PlyHeader& header, std::string_view body, PlyColors colors)
      : header_(header), source_(body), colors_(colors) {}

  MeshData read() {
    vertex_count_ = require("vertex").count;
    require("face");
    if (vertex_count_ > std::numeric_limits<uint32_t>::max())
      throw std::runtime_error("it has more vertices than 32-bit indices can tell apart");
    for (const PlyElement& element : header_.elements) {
      check_size(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else {
        for_each(element, [&] {
          for (const PlyProperty& property : element.properties) skip(property);
        });
      }
    }
    check_values();
    for (const Polygon& polygon : polygons_) add_polygon(polygon);
    mesh_.face_indices = std::move(triangle_tags_);
    mesh_.face_indices.insert(mesh_.face_indices.end(), quad_tags_.begin(), quad_tags_.end());
    return std::move(mesh_);
  }

 private:
  const PlyElement& require(const char* name) const {
    for (const PlyElement& element : header_.elements) {
      if (element.name == name) return element;
    }
    throw std::runtime_error(std::string("it has no element \"") + name + "\"");
  }

  static std::string nth(const PlyElement& element, uint64_t index) {
    return element.name + " " + std::to_string(index) + " (counted from 0)";
  }

  /// Refuses a file that cannot hold the elements even if all their lists are empty.
  void check_size(const PlyElement& element) const {
    const uint64_t needed = element.count * element.least_bytes(Source::kAscii);
    // The last word of a text needs no blank after it.
    const uint64_t present = source_.remaining() + (Source::kAscii ? 1 : 0);
    if (needed <= present) return;
    const uint64_t missing = needed - present;
    throw std::runtime_error(
        "the file is too short: " + counted(element.count, "element") + " \"" + element.name +
        in_number(element.count, "\" needs", "\" need") + " at least " + counted(needed, "byte") +
        ", " + std::to_string(missing) + in_number(missing, " is", " are") + " missing");
  }

  /// Calls `read_one` for each element and adds the element to error messages.
  template <class ReadOne>
  void for_each(const PlyElement& element, const ReadOne& read_one) {
    if (element.properties.empty()) return;
    uint64_t i = 0;
    try {
      for (; i < element.count; ++i) read_one();
    } catch (const PlyTruncated& truncated) {
      const uint64_t after = element.count - i - 1;
      const uint64_t bytes = truncated.missing_bytes + after * element.least_bytes(Source::kAscii);
      throw std::runtime_error("the file is too short: it ends inside " + nth(element, i) + " of " +
                               std::to_string(element.count) + ", at least " +
                               counted(bytes, "byte") + in_number(bytes, " is", " are") +
                               " missing");
    } catch (const PlyBadValue& bad) {
      throw std::runtime_error(nth(element, i) + ": " + bad.message);
    }
  }

  void skip(const PlyProperty& property) {
    const int64_t count = property.is_list ? source_.integer(property.count_type) : 1;
    if (count < 0) throw PlyBadValue{"property \"" + property.name + "\" has a negative length"};
    source_.skip(property.type, count);
  }

  /// A face with other than three or four corners. Its vertices may come later in the file.
  struct Polygon {
    std::vector<uint32_t> corners;
    std::optional<int> tag;
  };
  /// A coordinate that is not finite, of a vertex that a face may use.
  struct BadValue {
    size_t vertex;
    const PlyProperty* property;
  };

  void read_vertices(const PlyElement& element);
  void read_faces(const PlyElement& element);
  /// Reads the corners of a face: three or four go to the mesh, others to `polygon`.
  void read_indices(const PlyProperty& property, Polygon* polygon);
  void check_values();
  void add_polygon(const Polygon& polygon);

  const PlyHeader& header_;
  Source source_;
  PlyColors colors_;
  uint64_t vertex_count_ = 0;
  MeshData mesh_;
  std::vector<int> triangle_tags_, quad_tags_;  // face_indices of either kind
  std::vector<Polygon> polygons_;
  std::vector<BadValue> bad_values_;
};

/// Index of a vertex property in a row of floats.
enum Slot { kX, kY, kZ, kNx, kNy, kNz, kU, kV, kRed, kGreen, kBlue, kSlots };

/// The slot of each property, or -1. Incomplete coordinates have none.
struct VertexLayout {
  std::vector<int> slots;
  bool has_normals = false;
  bool has_uvs = false;
  bool has_colors = false;

  VertexLayout(const PlyElement& element, PlyColors colors) : slots(element.properties.size(), -1) {
    const bool has_positions = assign(element, {"x", "y", "z"}, kX);
    if (!has_positions)
      throw std::runtime_error("the element \"vertex\" lacks x, y or z as a single number");
    has_normals = assign(element, {"nx", "ny", "nz"}, kNx);
    has_uvs = assign(element, {"u", "v"}, kU) || assign(element, {"s", "t"}, kU) ||
              assign(element, {"texture_u", "texture_v"}, kU) ||
              assign(element, {"texture_s", "texture_t"}, kU);
    has_colors = colors == PlyColors::kRead &&
                 (assign(element, {"r", "g", "b"}, kRed) ||
                  assign(element, {"red", "green", "blue"}, kRed) ||
                  assign(element, {"diffuse_red", "diffuse_green", "diffuse_blue"}, kRed));
  }

 private:
  bool assign(const PlyElement& element, std::initializer_list<const char*> names, int first) {
    for (const char* name : names) {
      const int found = element.find(name);
      if (found < 0 || element.properties[found].is_list) return false;
    }
    for (const char* name : names) slots[element.find(name)] = first++;
    return true;
  }
};

template <class Source>
void PlyReader<Source>::read_vertices(const PlyElement& element) {
  const VertexLayout layout(element, colors_);
  const size_t count = element.count;
  mesh_.positions.reserve(count);
  if (layout.has_normals) mesh_.normals.reserve(count);
  if (layout.has_uvs) mesh_.uvs.reserve(count);
  if (layout.has_colors) mesh_.colors.reserve(count);

  const size_t property_count = element.properties.size();
  for_each(element, [&] {
    std::array<float, kSlots> row{};
    for (size_t i = 0; i < property_count; ++i) {
      const PlyProperty& property = element.properties[i];
      if (layout.slots[i] < 0) {
        skip(property);
        continue;
      }
      float value = static_cast<float>(source_.number(property.type));
      if (layout.slots[i] >= kRed && is_integer(property.type)) value /= 255.0f;
      const bool is_normal = layout.slots[i] >= kNx && layout.slots[i] <= kNz;
      if (!std::isfinite(value) && !is_normal)
        bad_values_.push_back({mesh_.positions.size(), &property});
      row[layout.slots[i]] = value;
    }
    mesh_.positions.emplace_back(row[kX], row[kY], row[kZ]);
    if (layout.has_normals) mesh_.normals.emplace_back(row[kNx], row[kNy], row[kNz]);
    if (layout.has_uvs) mesh_.uvs.emplace_back(row[kU], row[kV]);
    if (layout.has_colors) mesh_.colors.push_back({row[kRed], row[kGreen], row[kBlue], 1.0f});
  });
}

template <class Source>
void PlyReader<Source>::read_indices(const PlyProperty& property, Polygon* polygon) {
  const int64_t corners = source_.integer(property.count_type);
  if (corners < 0 || corners > static_cast<int64_t>(kMaxPolygonCorners))
    throw PlyBadValue{"it has " + std::to_string(corners) + " vertices, expected at most " +
                      std::to_string(kMaxPolygonCorners)};
  std::vector<uint32_t>& indices = corners == 3   ? mesh_.triangles
                                   : corners == 4 ? mesh_.quads
                                                  : polygon->corners;
  for (int64_t i = 0; i < corners; ++i) {
    const int64_t index = source_.integer(property.type);
    if (index < 0 || static_cast<uint64_t>(index) >= vertex_count_)
      throw PlyBadValue{"vertex index " + std::to_string(index) +
                        " is out of range, the file has " +
                        counted(vertex_count_, "vertex", "vertices")};
    indices.push_back(static_cast<uint32_t>(index));
  }
}

/// Refuses positions, texture coordinates and colours that are not finite, or sets them to 0 if no
/// face uses their vertex.
template <class Source>
void PlyReader<Source>::check_values() {
  if (bad_values_.empty()) return;
  std::vector<bool> used(mesh_.positions.size());
  for (const uint32_t v : mesh_.triangles) used[v] = true;
  for (const uint32_t v : mesh_.quads) used[v] = true;
  for (const Polygon& polygon : polygons_)
    for (const uint32_t v : polygon.corners) used[v] = true;
  for (const BadValue& bad : bad_values_) {
    if (used[bad.vertex])
      throw std::runtime_error("vertex " + std::to_string(bad.vertex) + " (counted from 0): \"" +
                               bad.property->name + "\" is not a finite float");
    mesh_.positions[bad.vertex] = Vec3f(0, 0, 0);
    if (!mesh_.uvs.empty()) mesh_.uvs[bad.vertex] = Vec2f(0, 0);
    if (!mesh_.colors.empty()) mesh_.colors[bad.vertex] = {0, 0, 0, 1};
  }
}

/// Cuts a face into triangles. A face with fewer than three distinct vertices becomes a triangle
/// without area; the check of the mesh removes and counts it.
template <class Source>
void PlyReader<Source>::add_polygon(const Polygon& polygon) {
  std::vector<uint32_t> ring = polygon.corners;
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  std::vector<uint32_t> distinct = ring;
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  const size_t before = mesh_.triangles.size();
  if (distinct.size() >= 3) {
    std::vector<Vec3f> corners;
    for (const uint32_t v : ring) corners.push_back(mesh_.positions[v]);
    for (const uint32_t corner : triangulate_polygon(corners))
      mesh_.triangles.push_back(ring[corner]);
  } else if (!mesh_.positions.empty()) {
    mesh_.triangles.insert(mesh_.triangles.end(), 3, ring.empty() ? 0 : ring[0]);
  }
  if (polygon.tag)
    triangle_tags_.insert(triangle_tags_.end(), (mesh_.triangles.size() - before) / 3,
                          *polygon.tag);
}

template <class Source>
void PlyReader<Source>::read_faces(const PlyElement& element) {
  int corners = element.find("vertex_indices");
  if (corners < 0) corners = element.find("vertex_index");
  if (element.count == 0) return;
  if (corners < 0 || !element.properties[corners].is_list)
    throw std::runtime_error("the element \"face\" has no list \"vertex_indices\"");
  const size_t corners_at = corners;
  if (!is_integer(element.properties[corners_at].type))
    throw std::runtime_error("the list \"vertex_indices\" is not of an integer type");

  const int tag = element.find("face_indices");
  const bool has_tags =
      tag >= 0 && !element.properties[tag].is_list && is_integer(element.properties[tag].type);
  const size_t tag_at = has_tags ? static_cast<size_t>(tag) : element.properties.size();

  mesh_.triangles.reserve(3 * element.count);
  for_each(element, [&] {
    const size_t triangles_before = mesh_.triangles.size(), quads_before = mesh_.quads.size();
    Polygon polygon;
    int64_t tag_value = 0;
    for (size_t i = 0; i < element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (i == corners_at) {
        read_indices(property, &polygon);
      } else if (i == tag_at) {
        tag_value = source_.integer(property.type);
      } else {
        skip(property);
      }
    }
    if (tag_value < std::numeric_limits<int>::min() || tag_value > std::numeric_limits<int>::max())
      throw PlyBadValue{"face index " + std::to_string(tag_value) + " does not fit 32 bits"};
    const int tag_of_face = static_cast<int>(tag_value);
    if (mesh_.quads.size() > quads_before) {
      if (has_tags) quad_tags_.push_back(tag_of_face);
    } else if (mesh_.triangles.size() > triangles_before) {
      if (has_tags) triangle_tags_.push_back(tag_of_face);
    } else {
      if (has_tags) polygon.tag = tag_of_face;
      polygons_.push_back(std::move(polygon));
    }
  });
}

MeshData read_mesh(std::string_view bytes, PlyColors colors) {
  const PlyHeader header = read_ply_header(bytes);
  const std::string_view body = bytes.substr(header.size);
  constexpr bool kIsLittleEndian = std::endian::native == std::endian::little;
  switch (header.format) {
    case PlyHeader::Format::kLittleEndian:
      return PlyReader<PlyBinarySource<!kIsLittleEndian>>(header, body, colors).read();
    case PlyHeader::Format::kBigEndian:
      return PlyReader<PlyBinarySource<kIsLittleEndian>>(header, body, colors).read();
    default:
      return PlyReader<PlyTextSource>(header, body, colors).read();
  }
}

}  // namespace

MeshData read_ply(SceneFiles& files, const std::string& path, const SourceLocation& wanted_by,
                  PlyColors colors) {
  std::string bytes;
  try {
    bytes = files.read(path);
  } catch (const IoError& error) {
    file_is_unreadable(wanted_by, error.what());
  }
  try {
    return read_mesh(bytes, colors);
  } catch (const std::bad_alloc&) {
    throw SceneError(wanted_by, "cannot use \"" + path + "\": it does not fit into memory");
  } catch (const std::runtime_error& error) {
    throw SceneError(wanted_by, "cannot use \"" + path + "\": " + error.what());
  }
}

}  // namespace nephroid

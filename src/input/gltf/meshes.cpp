#include "input/gltf/meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::gltf {
namespace {

template <class Vectors>
std::vector<double> flattened(const Vectors& vectors, size_t width) {
  std::vector<double> numbers;
  numbers.reserve(vectors.size() * width);
  for (const auto& v : vectors)
    for (size_t k = 0; k < width; ++k) numbers.push_back(v[static_cast<int>(k)]);
  return numbers;
}

/// Drops the vertices that no triangle uses: files share one set of vertices among primitives.
void drop_unused(Vertices& vertices) {
  constexpr uint32_t kUnused = 0xffffffffu;
  std::vector<uint32_t> number(vertices.positions.size(), kUnused);
  uint32_t count = 0;
  for (const uint32_t v : vertices.triangles) number[v] = 0;
  for (uint32_t& n : number)
    if (n != kUnused) n = count++;
  if (count == number.size()) return;
  const auto compact = [&](auto& values) {
    if (values.empty()) return;
    for (size_t i = 0; i < number.size(); ++i)
      if (number[i] != kUnused) values[number[i]] = values[i];
    values.resize(count);
    values.shrink_to_fit();
  };
  compact(vertices.positions);
  compact(vertices.normals);
  compact(vertices.tangents);
  compact(vertices.uvs[0]);
  compact(vertices.uvs[1]);
  compact(vertices.colors);
  for (uint32_t& v : vertices.triangles) v = number[v];
}

void add_vertices(ParameterList& list, const Vertices& vertices) {
  list.add_numbers("point3", "P", flattened(vertices.positions, 3));
  list.add_numbers("integer", "indices", {vertices.triangles.begin(), vertices.triangles.end()});
  if (!vertices.normals.empty()) list.add_numbers("normal", "N", flattened(vertices.normals, 3));
  if (!vertices.tangents.empty()) list.add_numbers("vector3", "S", flattened(vertices.tangents, 3));
  if (!vertices.uvs[0].empty()) list.add_numbers("point2", "uv", flattened(vertices.uvs[0], 2));
  if (!vertices.uvs[1].empty()) list.add_numbers("point2", "uv2", flattened(vertices.uvs[1], 2));
  if (!vertices.colors.empty())
    list.add_numbers("float", "vertexcolors", flattened(vertices.colors, 4));
}

/// The mean of the vertex colours over the area.
ParameterList::Color mean_color(const Vertices& vertices) {
  Vec3d sum(0.0);
  double total = 0;
  for (size_t t = 0; t + 2 < vertices.triangles.size(); t += 3) {
    const uint32_t* corner = &vertices.triangles[t];
    const auto p = [&](int k) { return to_double(vertices.positions[corner[k]]); };
    const double area = (p(1) - p(0)).cross(p(2) - p(0)).length();
    for (int k = 0; k < 3; ++k) {
      const std::array<float, 4>& c = vertices.colors[corner[k]];
      sum += Vec3d(c[0], c[1], c[2]) * area;
    }
    total += 3 * area;
  }
  if (total > 0) sum /= total;
  return {sum.x, sum.y, sum.z};
}

/// Multiplies the colour of an area light, or the factor of its image.
void tint(DirectiveDescription& area_light, const ParameterList::Color& color) {
  for (Parameter& parameter : area_light.parameters.list)
    if (parameter.name == "L" || parameter.name == "factor")
      for (size_t i = 0; i < 3; ++i) parameter.numbers[i] *= color[i];
}

bool is_placeable(const Mat44d& m) {
  const double determinant = m.determinant();
  return std::isfinite(determinant) && determinant != 0;
}

/// Counts the memory of instances for which the file has no data.
void check_instances(Document& document, const JsonValue& attributes, size_t count) {
  constexpr size_t kBytesOfInstance = 512;  // with its name and its place in the file
  for (const char* name : {"TRANSLATION", "ROTATION", "SCALE"}) {
    const std::optional<JsonValue> attribute = attributes.find(name);
    if (attribute && has_data(document, attribute->index(), *attribute)) return;
  }
  document.claim_memory(count * kBytesOfInstance, attributes);
}

/// The transforms of EXT_mesh_gpu_instancing, below the node's own.
std::vector<Mat44d> instance_matrices(Document& document, const JsonValue& extension) {
  const JsonValue attributes = extension.get("attributes");
  const auto translations = find_accessor(document, attributes, "TRANSLATION", 3);
  const auto rotations = find_accessor(document, attributes, "ROTATION", 4);
  const auto scales = find_accessor(document, attributes, "SCALE", 3);
  size_t count = 0;
  for (const auto* array : {&translations, &rotations, &scales})
    if (*array) count = std::max(count, (*array)->count);
  check_instances(document, attributes, count);
  std::vector<Mat44d> matrices;
  for (size_t i = 0; i < count; ++i) {
    NodePose pose;
    const auto take = [&](const std::optional<NumberArray>& from, auto& to) {
      if (!from) return;
      if (from->count != count)
        attributes.fail(
            "TRANSLATION, ROTATION and SCALE have different numbers of elements, expected one per "
            "instance");
      std::copy_n((*from)[i], to.size(), to.begin());
    };
    take(translations, pose.translation);
    take(rotations, pose.rotation);
    take(scales, pose.scale);
    matrices.push_back(matrix_of(pose));
  }
  return matrices;
}

}  // namespace

std::vector<TransformDescription> Meshes::transforms_of(size_t node, const JsonValue& description) {
  std::vector<TransformDescription> transforms{nodes_.world(node)};
  if (const auto extension = description.extension("EXT_mesh_gpu_instancing")) {
    transforms.clear();
    for (const Mat44d& m : instance_matrices(document_, *extension))
      transforms.push_back({m * nodes_.world(node).start, m * nodes_.world(node).end});
  }
  const auto is_flat = [](const TransformDescription& t) {
    return !is_placeable(t.start) || !is_placeable(t.end);
  };
  const auto flat = std::remove_if(transforms.begin(), transforms.end(), is_flat);
  if (flat != transforms.end())
    document_.diagnostics().warn(description.where(),
                                 "the node is scaled to nothing, its mesh is left out");
  transforms.erase(flat, transforms.end());
  return transforms;
}

Meshes::Use Meshes::use_of(size_t node, const JsonValue& description) {
  const JsonValue& mesh = document_.item_of("meshes", description, "mesh");
  Use use{node, {}, morph_weights(description, node, mesh, animation_), {}, {}};
  if (description.find("skin")) {
    use.skin = document_.item_of("skins", description, "skin");
    use.transforms.emplace_back();  // joints lead to the world
    return use;
  }
  use.transforms = transforms_of(node, description);
  use.key = std::to_string(description.get_index("mesh"));
  for (const double weight : use.weights) use.key += fmt::format(" {}", weight);
  return use;
}

void Meshes::add_all() {
  std::vector<Use> uses;
  std::map<std::string, size_t> counts;
  for (const size_t node : nodes_.shown()) {
    const JsonValue& description = document_.list("nodes")[node];
    if (!description.find("mesh")) continue;
    uses.push_back(use_of(node, description));
    if (!uses.back().key.empty()) counts[uses.back().key] += uses.back().transforms.size();
  }
  for (const Use& use : uses) add(use, counts[use.key] > 1 && !use.key.empty());
}

/// Shapes that emit must stand in the world: objects do not emit.
void Meshes::add(const Use& use, bool is_repeated) {
  const JsonValue& node = document_.list("nodes")[use.node];
  const JsonValue& mesh = document_.item_of("meshes", node, "mesh");
  const std::string name = "mesh " + use.key;
  const bool is_known = is_repeated && scene_.objects.contains(name);
  std::vector<ShapeDescription> shapes;
  if (!is_known) shapes = make_shapes(use, mesh);
  const bool emits = std::any_of(shapes.begin(), shapes.end(), [](const ShapeDescription& s) {
    return s.area_light.has_value();
  });
  if (is_known || (is_repeated && !emits)) {
    if (!is_known) scene_.objects[name] = {name, std::move(shapes), mesh.where()};
    for (const TransformDescription& transform : use.transforms)
      scene_.instances.push_back({name, transform, node.where()});
    return;
  }
  for (const TransformDescription& transform : use.transforms)
    for (ShapeDescription shape : shapes) {
      shape.transform = transform;
      scene_.shapes.push_back(std::move(shape));
    }
}

std::vector<ShapeDescription> Meshes::make_shapes(const Use& use, const JsonValue& mesh) {
  std::vector<ShapeDescription> shapes;
  for (const JsonValue& primitive : mesh.get("primitives").elements()) {
    if (!has_area(primitive)) {
      document_.diagnostics().warn(primitive.where(),
                                   "points and lines have no area, this primitive is left out");
      continue;
    }
    if (std::optional<ShapeDescription> shape = make_shape(use, primitive))
      shapes.push_back(*std::move(shape));
  }
  return shapes;
}

std::optional<ShapeDescription> Meshes::make_shape(const Use& use, const JsonValue& primitive) {
  const bool has_colors = primitive.get("attributes").find("COLOR_0").has_value();
  const SurfaceDescription& surface = materials_.surface_of(primitive, has_colors);
  const std::unique_ptr<AttributeSource> source = open_attributes(document_, primitive);
  Vertices vertices = read_vertices(
      *source, primitive,
      {surface.uv_sets.sets(), surface.uses_vertex_colors || surface.emits_vertex_colors,
       surface.needs_tangents},
      document_.diagnostics());
  if (vertices.triangles.empty()) return std::nullopt;
  if (surface.needs_tangents && vertices.tangents.empty()) add_tangents(vertices);
  if (!use.weights.empty()) morph(document_, primitive, use.weights, vertices);
  if (use.skin) skin(document_, *use.skin, *source, primitive, nodes_, vertices);
  if (surface.tangent_rotation != 0) {
    if (vertices.normals.empty()) make_faceted(vertices);
    rotate_tangents(vertices, surface.tangent_rotation);
  }
  drop_unused(vertices);
  std::optional<DirectiveDescription> area_light = surface.area_light;
  if (area_light && surface.emits_vertex_colors && !vertices.colors.empty())
    tint(*area_light, mean_color(vertices));
  if (!surface.uses_vertex_colors) vertices.colors.clear();

  ParameterList list(primitive.where());
  add_vertices(list, vertices);
  list.add_all(surface.shape_parameters);
  ShapeDescription shape;
  static_cast<DirectiveDescription&>(shape) = std::move(list).directive("trianglemesh");
  shape.material = surface.material;
  shape.area_light = std::move(area_light);
  shape.inside_medium = surface.interior;
  return shape;
}

}  // namespace nephroid::gltf

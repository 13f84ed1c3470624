// Shapes that are meshes, built in or of files.
#include <algorithm>
#include <cmath>
#include <set>

#include "input/file_bytes.h"
#include "input/mitsuba/mesh_shapes.h"
#include "input/mitsuba/parameter_values.h"
#include "input/mitsuba/serialized_mesh.h"
#include "input/mitsuba/shape_geometry.h"
#include "input/mitsuba/spectrum_text.h"
#include "input/ply_header.h"

namespace nephroid::mitsuba {
namespace {

ShapeDescription placed(PluginProperties& p) {
  ShapeDescription shape = directive<ShapeDescription>("", p.where());
  shape.transform = p.transform();
  return shape;
}

Geometry built_in(PluginProperties& p, const MeshData& mesh) {
  ShapeDescription shape = placed(p);
  set_mesh(shape, mesh);
  return {{std::move(shape)}, is_open(mesh)};
}

/// Mitsuba makes the normals of faces, and those of vertices that have none, in the world: a mirror
/// turns them over.
void make_normals_in_world(ShapeDescription& shape) {
  shape.reverse_orientation = shape.transform.start.determinant() < 0;
}

/// The location of a property, else of the plug-in.
SourceLocation place_of(PluginProperties& p, const char* name) {
  const Property* property = p.find(name);
  return property ? property->where : p.where();
}

std::string path_of_file(PluginProperties& p) {
  const std::string file = p.file();
  return p.context().scene.files->path_of(file);
}

/// True if a texture below the object reads the colours of vertices.
bool reads_colors(const Object& object, std::set<const Object*>& visited) {
  if (!visited.insert(&object).second) return false;
  if (object.type == "vertexcolors" || object.type == "mesh_attribute") return true;
  return std::any_of(object.children.begin(), object.children.end(),
                     [&](const Child& child) { return reads_colors(*child.object, visited); });
}

/// Mitsuba 0.6 has sRGB-coded colours, unless "srgb" is false.
void decode_colors(PluginProperties& p, MeshData& mesh) {
  if (!p.boolean("srgb", p.context().is_before_version_2())) return;
  for (auto& c : mesh.colors) {
    const Vec3d linear = decoded(Vec3d(c[0], c[1], c[2]));
    for (int i = 0; i < 3; ++i) c[static_cast<size_t>(i)] = static_cast<float>(linear[i]);
  }
}

/// True if the file can be left to the loader of scenes.
bool is_usable_as_it_is(PluginProperties& p, const std::string& path) {
  const PlyHeader header = read_ply_header(p.context().scene.files->read(path));
  const auto vertices = std::find_if(header.elements.begin(), header.elements.end(),
                                     [](const PlyElement& e) { return e.name == "vertex"; });
  if (vertices == header.elements.end()) return false;
  const auto has = [&](const char* name) { return vertices->find(name) >= 0; };
  const bool has_uvs = has("u") || has("s") || has("texture_u");
  return !has_uvs && has("nx") != p.boolean("face_normals", false);
}

}  // namespace

Geometry rectangle_geometry(PluginProperties& p) {
  return built_in(p, rectangle_mesh());
}

Geometry cube_geometry(PluginProperties& p) {
  return built_in(p, cube_mesh());
}

Geometry mesh_geometry(PluginProperties& p, MeshData mesh, bool has_face_normals) {
  const bool faceted = p.boolean("face_normals", has_face_normals);
  if (p.has("max_smooth_angle"))
    warn_approximated(p, "\"max_smooth_angle\" is ignored, all edges are as smooth as the normals");
  if (faceted) mesh.normals.clear();
  const bool has_own_normals = !mesh.normals.empty();
  if (!faceted && !has_own_normals) mesh.normals = smooth_normals(mesh);
  ShapeDescription shape = placed(p);
  if (!has_own_normals) make_normals_in_world(shape);
  set_mesh(shape, mesh);
  return {{std::move(shape)}, is_open(mesh)};
}

Geometry ply_geometry(PluginProperties& p) {
  const std::string path = path_of_file(p);
  const SourceLocation named_by = place_of(p, "filename");
  std::set<const Object*> visited;
  const bool has_colors = reads_colors(p.object(), visited);
  bool as_it_is = false;
  try {
    as_it_is = !has_colors && is_usable_as_it_is(p, path);
  } catch (const IoError& error) {
    file_is_unreadable(named_by, error.what());
  } catch (const std::runtime_error&) {  // a bad header, which read_ply reports
  }
  const bool flips = p.boolean("flip_tex_coords", false);
  p.find("srgb");  // of vertex colours
  if (as_it_is) {
    ShapeDescription shape = placed(p);
    if (p.boolean("face_normals", false)) make_normals_in_world(shape);
    shape.type = "plymesh";
    add_text(shape.parameters, "filename", p.file());
    return {{std::move(shape)}, false};
  }
  MeshData mesh = read_ply(*p.context().scene.files, path, named_by,
                           has_colors ? PlyColors::kRead : PlyColors::kSkipped);
  decode_colors(p, mesh);
  if (!flips) turn_v_over(mesh);
  return mesh_geometry(p, std::move(mesh), false);
}

Geometry serialized_geometry(PluginProperties& p) {
  const std::string path = path_of_file(p);
  const int index = p.integer("shape_index", 0);
  const SourceLocation named_by = place_of(p, "filename");
  std::string bytes;
  try {
    bytes = p.context().scene.files->read(path);
  } catch (const IoError& error) {
    file_is_unreadable(named_by, error.what());
  }
  SerializedMesh found = read_serialized(bytes, index, named_by);
  turn_v_over(found.mesh);
  return mesh_geometry(p, std::move(found.mesh), found.has_face_normals);
}

}  // namespace nephroid::mitsuba

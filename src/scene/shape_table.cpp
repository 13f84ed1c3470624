#include "scene/shape_table.h"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "core/counted.h"
#include "scene/curve_directives.h"
#include "scene/shape/displacement.h"
#include "scene/shape/emitter_rectangles.h"
#include "scene/shape/mesh_preparation.h"

namespace nephroid {

namespace {

struct Context {
  std::span<const ShapeDescription> alike;
  const ShapeDescription& description;  ///< the first directive
  const ParameterSet& p;
  SceneFiles& files;
  Diagnostics& diagnostics;
  Transform transform;
  bool flip;  ///< for meshes: ReverseOrientation xor a transform that swaps handedness
  const DisplacementInputs& displacement;

  std::string what() const { return "shape \"" + description.type + "\""; }
};

std::vector<uint32_t> to_indices(const Context& c, const std::vector<int>& values) {
  std::vector<uint32_t> indices(values.size());
  for (size_t i = 0; i < values.size(); ++i) {
    if (values[i] < 0)
      throw SceneError(c.p.where, c.what() + ": index " + std::to_string(values[i]) +
                                      " is negative, expected 0 or more");
    indices[i] = values[i];
  }
  return indices;
}

// Final step of meshes: transformed to world space, checked, with padding after the positions for
// the ray tracer's 16-byte loads.
std::vector<ShapePtr> finish_mesh(const Context& c, MeshData data) {
  zero_bad_normals(data, c.p.where, c.what(), c.diagnostics);
  if (c.description.reverse_orientation) reverse_normals(data);
  transform_mesh(data, c.transform);
  validate_mesh(data, c.p.where, c.what(), c.diagnostics);
  // A light's "power" counts per primitive, so those primitives must stay as they are.
  // Patches have no further attributes.
  const bool is_plain = data.second_uvs.empty() && data.colors.empty();
  if (is_plain && c.description.area_light && !c.description.area_light->parameters.find("power"))
    data = join_rectangles(std::move(data));
  std::vector<ShapePtr> shapes;
  MeshData patches;
  if (!data.quads.empty()) {
    patches = quads_of(data);
    data = triangles_of(data);
  }
  if (!data.triangles.empty()) {
    data.positions.reserve(data.positions.size() + 2);
    shapes.push_back(std::make_shared<TriangleMesh>(std::move(data), c.flip));
  }
  if (!patches.quads.empty()) shapes.push_back(make_bilinear_mesh(std::move(patches), c.flip));
  return shapes;
}

MeshData positions_of(const Context& c) {
  MeshData data;
  data.positions = c.p.get_point3s("P");
  if (data.positions.empty())
    throw SceneError(c.p.where, c.what() + " has no vertices, expected \"point3 P\"");
  return data;
}

MeshData vertices_of(const Context& c) {
  MeshData data = positions_of(c);
  data.normals = c.p.get_normals("N");
  data.uvs = c.p.get_point2s("uv");
  return data;
}

std::vector<std::array<float, 4>> vertex_colors(const Context& c) {
  const std::vector<float> numbers = c.p.get_floats("vertexcolors");
  if (numbers.size() % 4 != 0)
    throw SceneError(c.p.where, c.what() + ": \"vertexcolors\" has " +
                                    counted(numbers.size(), "value") +
                                    ", expected a multiple of 4");
  std::vector<std::array<float, 4>> colors(numbers.size() / 4);
  for (size_t i = 0; i < numbers.size(); ++i) colors[i / 4][i % 4] = numbers[i];
  return colors;
}

std::vector<ShapePtr> triangle_mesh(const Context& c) {
  MeshData data = vertices_of(c);
  data.tangents = c.p.get_vector3s("S");
  data.second_uvs = c.p.get_point2s("uv2");
  data.colors = vertex_colors(c);
  data.face_indices = c.p.get_ints("faceIndices");
  data.triangles = to_indices(c, c.p.get_ints("indices"));
  if (data.triangles.empty()) {
    if (data.positions.size() != 3)
      throw SceneError(c.p.where,
                       c.what() + " has no \"integer indices\", expected three per triangle");
    data.triangles = {0, 1, 2};
  }
  if (data.triangles.size() % 3 != 0)
    throw SceneError(c.p.where, c.what() + ": \"indices\" has " +
                                    counted(data.triangles.size(), "value") +
                                    ", expected a multiple of 3");
  return finish_mesh(c, std::move(data));
}

// As in pbrt-v4 the texture is evaluated at object-space points before displacement.
MeshData displaced(const Context& c, MeshData data, const FloatTexture& height) {
  Displacement displacement;
  // Earlier versions of pbrt-v4 used another name for this length.
  const char* name = c.p.find("displacement.edgelength") ? "displacement.edgelength" : "edgelength";
  displacement.edge_length = c.p.get_float(name, 1.0f) * c.displacement.edge_scale;
  if (!(displacement.edge_length > 0))
    throw SceneError(c.p.where, fmt::format("{}: the edge length of \"displacement\" is {:g}, "
                                            "expected a positive number",
                                            c.what(), displacement.edge_length));
  if (data.uvs.empty())
    throw SceneError(c.p.where, c.what() +
                                    ": \"displacement\" needs texture coordinates, and the file "
                                    "has none");
  displacement.object_to_world = Transform(c.description.transform.start);
  displacement.height = [&](const Vec3f& p, const Vec2f& uv) {
    TextureContext context;
    context.p = p;
    context.uv = uv;
    return height.eval(context);
  };
  std::optional<MeshData> result = displace_mesh(std::move(data), displacement);
  if (!result)
    throw SceneError(c.p.where,
                     fmt::format("{}: \"displacement\" with edges of length {:g} makes more than "
                                 "{} triangles, expected a larger \"edgelength\"",
                                 c.what(), displacement.edge_length, kMaxDisplacedTriangles));
  return std::move(*result);
}

std::vector<ShapePtr> ply_mesh(const Context& c) {
  const std::string name = c.p.get_string("filename", "");
  if (name.empty())
    throw SceneError(c.p.where, c.what() + " has no \"string filename\", expected a PLY file");
  MeshData data = read_ply(c.files, c.files.path_of(name), c.p.where);
  zero_bad_normals(data, c.p.where, c.what(), c.diagnostics);
  if (const FloatTexturePtr height = c.displacement.textures.float_texture(c.p, "displacement"))
    data = displaced(c, std::move(data), *height);
  return finish_mesh(c, std::move(data));
}

std::vector<ShapePtr> bilinear_mesh(const Context& c) {
  MeshData data = vertices_of(c);
  data.face_indices = c.p.get_ints("faceIndices");
  std::vector<uint32_t> corners = to_indices(c, c.p.get_ints("indices"));
  if (corners.empty()) {
    if (data.positions.size() != 4)
      throw SceneError(c.p.where,
                       c.what() + " has no \"integer indices\", expected four per patch");
    corners = {0, 1, 2, 3};
  }
  if (corners.size() % 4 != 0)
    throw SceneError(c.p.where, c.what() + ": \"indices\" has " + counted(corners.size(), "value") +
                                    ", expected a multiple of 4");
  // Corners are named p00 p10 p01 p11; meshes keep quads in ring order.
  for (size_t i = 0; i < corners.size(); i += 4) std::swap(corners[i + 2], corners[i + 3]);
  data.quads = std::move(corners);
  return finish_mesh(c, std::move(data));
}

std::vector<ShapePtr> loop_subdivision(const Context& c) {
  MeshData cage = positions_of(c);
  cage.triangles = to_indices(c, c.p.get_ints("indices"));
  if (cage.triangles.empty() || cage.triangles.size() % 3 != 0)
    throw SceneError(c.p.where, c.what() + ": \"indices\" expects a multiple of 3 values");
  const int levels = c.p.get_int("levels", 3);
  if (levels < 0 || levels > 10)
    throw SceneError(c.p.where, c.what() + ": \"levels\" must lie in 0..10");
  validate_mesh(cage, c.p.where, c.what(), c.diagnostics);
  try {
    return finish_mesh(c, loop_subdivide(cage.positions, cage.triangles, levels));
  } catch (const std::invalid_argument& e) {
    throw SceneError(c.p.where, c.what() + ": " + e.what());
  }
}

float positive(const Context& c, const char* name, float fallback) {
  const float v = c.p.get_float(name, fallback);
  if (!(v > 0))
    throw SceneError(
        c.p.find(name)->where,
        fmt::format("{}: \"{}\" is {:g}, expected a positive number", c.what(), name, v));
  return v;
}

// Final step of spheres, disks and cylinders: pieces without area are dropped.
std::vector<ShapePtr> finish_quadric(const Context& c, ShapePtr shape) {
  const Bounds3f bounds = shape->bounds(0);
  if (!is_in_reach(bounds.min) || !is_in_reach(bounds.max))
    throw SceneError(c.p.where, c.what() +
                                    " is too large or too far away, expected coordinates "
                                    "up to 1e17");
  if (shape->sample_area(0, Vec2f(0.5f, 0.5f))) return {std::move(shape)};
  c.diagnostics.warn(c.p.where, c.what() + " has no area and will be invisible");
  return {};
}

std::vector<ShapePtr> sphere(const Context& c) {
  const float r = positive(c, "radius", 1.0f);
  return finish_quadric(
      c, make_sphere(c.transform, c.description.reverse_orientation, r, c.p.get_float("zmin", -r),
                     c.p.get_float("zmax", r), c.p.get_float("phimax", 360.0f)));
}

std::vector<ShapePtr> disk(const Context& c) {
  const float r = positive(c, "radius", 1.0f);
  return finish_quadric(
      c, make_disk(c.transform, c.description.reverse_orientation, c.p.get_float("height", 0.0f), r,
                   c.p.get_float("innerradius", 0.0f), c.p.get_float("phimax", 360.0f)));
}

std::vector<ShapePtr> cylinder(const Context& c) {
  return finish_quadric(
      c, make_cylinder(c.transform, c.description.reverse_orientation, positive(c, "radius", 1.0f),
                       c.p.get_float("zmin", -1.0f), c.p.get_float("zmax", 1.0f),
                       c.p.get_float("phimax", 360.0f)));
}

std::vector<ShapePtr> curves(const Context& c) {
  ShapePtr shape = make_curves(c.alike, c.transform, c.diagnostics);
  if (!shape) return {};
  return {std::move(shape)};
}

constexpr FormatParameter kEvery[] = {
    {"float or texture", "alpha", "1", "", "share of the light that meets the surface"}};
constexpr FormatParameter kVertices[] = {{"point3[]", "P", "none: an error", "scene units"}};
constexpr FormatParameter kAttributes[] = {
    {"normal[]", "N", "none", "", "one for each vertex"},
    {"point2[]", "uv", "none", "", "one for each vertex"},
    {"integer[]", "faceIndices", "none"},
};
constexpr FormatParameter kTriangles[] = {
    {"integer[]", "indices", "0 1 2, of three vertices"},
    {"vector3[]", "S", "none", "", "tangents, one for each vertex"},
    {"point2[]", "uv2", "none", "",
     "second texture coordinates, which textures name by \"uvset\"; not in pbrt-v4"},
    {"float[]", "vertexcolors", "none", "",
     "linear r, g, b and alpha for each vertex, which textures use; not in pbrt-v4"},
};
constexpr FormatParameter kPly[] = {
    {"string", "filename", "none: an error", "", "PLY, may be compressed"},
    {"float or texture", "displacement", "none", "scene units", "needs uv"},
    {"float", "edgelength", "1", "scene units", "of displaced triangles, at most"},
    {"float", "displacement.edgelength", "edgelength", "scene units", "an older name"},
};
constexpr FormatParameter kPatches[] = {
    {"integer[]", "indices", "0 1 2 3, of four vertices", "", "p00 p10 p01 p11"},
    {"string", "emissionfilename", "none", "",
     "it tells where to sample the light and does not change the picture", Support::kWarned},
};
constexpr FormatParameter kLoop[] = {
    {"integer[]", "indices", "none: an error"},
    {"integer", "levels", "3", "", "0 to 10"},
    {"string", "scheme", "loop", "", "there is one scheme", Support::kNotNeeded},
};
constexpr FormatParameter kRadius[] = {{"float", "radius", "1", "scene units", "above 0"}};
constexpr FormatParameter kPhiMax[] = {{"float", "phimax", "360", "degrees"}};
constexpr FormatParameter kSphere[] = {
    {"float", "zmin", "-radius", "scene units"},
    {"float", "zmax", "radius", "scene units"},
};
constexpr FormatParameter kDisk[] = {
    {"float", "height", "0", "scene units"},
    {"float", "innerradius", "0", "scene units"},
};
constexpr FormatParameter kCylinder[] = {
    {"float", "zmin", "-1", "scene units"},
    {"float", "zmax", "1", "scene units"},
};
constexpr FormatParameter kCurve[] = {
    {"string", "type", "flat", "", "flat, cylinder or ribbon"},
    {"string", "basis", "bezier", "", "bezier or bspline"},
    {"integer", "degree", "3", "", "2 or 3"},
    {"float", "width", "1", "scene units"},
    {"float", "width0", "width", "scene units"},
    {"float", "width1", "width", "scene units"},
    {"normal[]", "N", "none", "",
     "one at each end of the segments of a ribbon; of other types ignored with a warning"},
    {"integer", "splitdepth", "3", "", "curves are divided as it is needed", Support::kNotNeeded},
};

struct ShapeRow : FormatType {
  std::vector<ShapePtr> (*make)(const Context&);
};
constexpr ShapeRow kShapeTable[] = {
    {{"trianglemesh", {kVertices, kTriangles, kAttributes, kEvery}}, triangle_mesh},
    {{"plymesh", {kPly, kEvery}}, ply_mesh},
    {{"bilinearmesh", {kVertices, kPatches, kAttributes, kEvery}}, bilinear_mesh},
    {{"loopsubdiv", {kVertices, kLoop, kEvery}}, loop_subdivision},
    {{"sphere", {kRadius, kSphere, kPhiMax, kEvery}}, sphere},
    {{"disk", {kRadius, kDisk, kPhiMax, kEvery}}, disk},
    {{"cylinder", {kRadius, kCylinder, kPhiMax, kEvery}}, cylinder},
    {{"curve",
      {kVertices, kCurve, kEvery},
      "cannot be an area light (error); rays do not meet a curve nearer to their origin than its "
      "width"},
     curves},
};

}  // namespace

std::vector<FormatType> shape_types() {
  return format_types(kShapeTable);
}

void report_unused_parameters(const ShapeDescription& description, Diagnostics& diagnostics) {
  if (const ShapeRow* row = find_row(kShapeTable, description.type))
    description.parameters.report_unused("shape \"" + description.type + "\"", *row, diagnostics);
}

bool is_moving(const ShapeDescription& description) {
  return description.transform.is_animated() && !description.area_light;
}

size_t shapes_alike(std::span<const ShapeDescription> descriptions) {
  return curves_alike(descriptions);
}

std::vector<ShapePtr> make_shapes(std::span<const ShapeDescription> alike, SceneFiles& files,
                                  Diagnostics& diagnostics,
                                  const DisplacementInputs& displacement) {
  const ShapeDescription& description = alike[0];
  if (description.transform.is_animated() && !is_moving(description))
    diagnostics.warn(description.where,
                     "a shape that emits light cannot move, the start of its motion is used");
  const Transform transform =
      is_moving(description) ? Transform() : Transform(description.transform.start);
  const Context context{alike,
                        description,
                        description.parameters,
                        files,
                        diagnostics,
                        transform,
                        description.reverse_orientation != transform.swaps_handedness(),
                        displacement};
  return row_of(kShapeTable, "shape", description.type, description.where).make(context);
}

}  // namespace nephroid

#include "input/mitsuba/mesh_shapes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>

#include "input/mitsuba/parameter_values.h"

namespace nephroid::mitsuba {
namespace {

/// Triangles of the mesh, with quads cut along their first diagonal.
std::vector<uint32_t> triangles_of(const MeshData& mesh) {
  std::vector<uint32_t> all = mesh.triangles;
  for (size_t i = 0; i + 3 < mesh.quads.size(); i += 4) {
    const uint32_t* q = &mesh.quads[i];
    all.insert(all.end(), {q[0], q[1], q[2], q[0], q[2], q[3]});
  }
  return all;
}

template <class Vec>
std::vector<double> flat(const std::vector<Vec>& vectors) {
  std::vector<double> numbers;
  numbers.reserve(vectors.size() * Vec::dimensions());
  for (const Vec& v : vectors)
    for (unsigned int i = 0; i < Vec::dimensions(); ++i) numbers.push_back(v[static_cast<int>(i)]);
  return numbers;
}

/// Angle between two vectors; accurate for small ones, too.
double angle(const Vec3d& a, const Vec3d& b) {
  return std::atan2(a.cross(b).length(), a.dot(b));
}

/// A number per position: vertices at one place have the same.
std::vector<uint32_t> places_of(const MeshData& mesh) {
  struct Hash {
    size_t operator()(const std::array<uint32_t, 3>& p) const {
      uint64_t h = 0;
      for (const uint32_t bits : p) h = (h ^ bits) * 0x9e3779b97f4a7c15u;
      return static_cast<size_t>(h ^ (h >> 32));
    }
  };
  std::unordered_map<std::array<uint32_t, 3>, uint32_t, Hash> numbers;
  std::vector<uint32_t> places;
  for (const Vec3f& p : mesh.positions) {
    // Adding 0 makes one zero of two.
    const std::array<uint32_t, 3> bits = {std::bit_cast<uint32_t>(p.x + 0.0f),
                                          std::bit_cast<uint32_t>(p.y + 0.0f),
                                          std::bit_cast<uint32_t>(p.z + 0.0f)};
    places.push_back(
        numbers.try_emplace(bits, static_cast<uint32_t>(numbers.size())).first->second);
  }
  return places;
}

}  // namespace

std::vector<Vec3f> smooth_normals(const MeshData& mesh) {
  std::vector<Vec3d> sums(mesh.positions.size(), Vec3d(0.0));
  const std::vector<uint32_t> triangles = triangles_of(mesh);
  for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
    Vec3d p[3];
    for (int k = 0; k < 3; ++k) p[k] = to_double(mesh.positions[triangles[i + k]]);
    const Vec3d n = (p[1] - p[0]).cross(p[2] - p[0]);
    if (!(n.length() > 0)) continue;
    for (int k = 0; k < 3; ++k)
      sums[triangles[i + k]] +=
          n.normalized() * angle(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
  }
  std::vector<Vec3f> normals;
  normals.reserve(sums.size());
  for (const Vec3d& sum : sums) normals.push_back(to_float(sum.normalized()));
  return normals;
}

void turn_v_over(MeshData& mesh) {
  for (Vec2f& uv : mesh.uvs) uv.y = 1 - uv.y;
}

bool is_open(const MeshData& mesh) {
  const std::vector<uint32_t> places = places_of(mesh), triangles = triangles_of(mesh);
  std::vector<std::pair<uint32_t, uint32_t>> edges;
  for (size_t i = 0; i + 2 < triangles.size(); i += 3)
    for (size_t k = 0; k < 3; ++k)
      edges.push_back(std::minmax({places[triangles[i + k]], places[triangles[i + (k + 1) % 3]]}));
  std::sort(edges.begin(), edges.end());
  for (size_t i = 0; i < edges.size(); i += 2) {
    const bool has_pair = i + 1 < edges.size() && edges[i] == edges[i + 1];
    const bool has_third = i + 2 < edges.size() && edges[i] == edges[i + 2];
    if (!has_pair || has_third) return true;
  }
  return false;
}

void set_mesh(ShapeDescription& shape, const MeshData& mesh) {
  shape.type = "trianglemesh";
  ParameterSet& set = shape.parameters;
  add_numbers(set, "point3", "P", flat(mesh.positions));
  const std::vector<uint32_t> triangles = triangles_of(mesh);
  add_numbers(set, "integer", "indices", std::vector<double>(triangles.begin(), triangles.end()));
  if (!mesh.normals.empty()) add_numbers(set, "normal", "N", flat(mesh.normals));
  if (!mesh.uvs.empty()) add_numbers(set, "point2", "uv", flat(mesh.uvs));
  if (mesh.colors.empty()) return;
  std::vector<double> colors;
  for (const auto& color : mesh.colors) colors.insert(colors.end(), color.begin(), color.end());
  add_numbers(set, "float", "vertexcolors", std::move(colors));
}

MeshData rectangle_mesh() {
  MeshData mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  mesh.quads = {0, 1, 2, 3};
  return mesh;
}

MeshData cube_mesh() {
  // Each face by its outward normal n and Mitsuba's direction of u; that of v is u x n, and pbrt-v4
  // counts v the other way.
  constexpr float kFaces[6][2][3] = {{{0, 0, 1}, {0, 1, 0}},  {{0, 0, -1}, {0, -1, 0}},
                                     {{1, 0, 0}, {0, 1, 0}},  {{-1, 0, 0}, {0, 1, 0}},
                                     {{0, 1, 0}, {-1, 0, 0}}, {{0, -1, 0}, {0, 0, 1}}};
  constexpr float kCorners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  MeshData mesh;
  for (const auto& face : kFaces) {
    const Vec3f n(face[0][0], face[0][1], face[0][2]), u(face[1][0], face[1][1], face[1][2]);
    const Vec3f v = cross(n, u);
    for (const auto& corner : kCorners) {
      mesh.quads.push_back(static_cast<uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(n + u * corner[0] + v * corner[1]);
      mesh.uvs.emplace_back(0.5f + 0.5f * corner[0], 0.5f + 0.5f * corner[1]);
    }
  }
  return mesh;
}

}  // namespace nephroid::mitsuba

// Checks of meshes, transforms, and the handling of quads. It must not know what the mesh is for.
#include "scene/shape/mesh_preparation.h"

#include <fmt/format.h>

#include "core/counted.h"
#include "scene/shape/shape.h"

namespace nephroid {
namespace {

std::string text(const Vec3f& v) {
  return fmt::format("({:g}, {:g}, {:g})", v.x, v.y, v.z);
}

template <class V>
bool all_finite(const V& v) {
  for (unsigned i = 0; i < V::dimensions(); ++i)
    if (!std::isfinite(v[static_cast<int>(i)])) return false;
  return true;
}

/// The checks of one mesh, with its location and name for messages.
class MeshChecker {
 public:
  MeshChecker(const MeshData& mesh, const SourceLocation& where, const std::string& what)
      : mesh_(mesh), where_(where), what_(what) {}

  void check() const {
    check_positions();
    check_count(mesh_.normals.size(), "normal");
    check_count(mesh_.uvs.size(), "texture coordinate");
    check_count(mesh_.tangents.size(), "tangent");
    check_count(mesh_.second_uvs.size(), "second texture coordinate");
    check_count(mesh_.colors.size(), "vertex colour");
    check_finite(mesh_.normals, "normal");
    check_finite(mesh_.tangents, "tangent");
    check_finite(mesh_.uvs, "texture coordinate");
    check_indices(mesh_.triangles, 3, "triangle");
    check_indices(mesh_.quads, 4, "quad");
    const size_t faces = mesh_.triangles.size() / 3 + mesh_.quads.size() / 4;
    if (!mesh_.face_indices.empty() && mesh_.face_indices.size() != faces)
      fail("has " + counted(mesh_.face_indices.size(), "face index", "face indices") +
           ", expected " + std::to_string(faces) + ", one per face");
    if (faces > kMaxFaces)
      fail("has " + std::to_string(faces) + " faces, expected at most " +
           std::to_string(kMaxFaces) + " in one shape");
  }

 private:
  /// The ray tracer's limit: it numbers the primitives of a shape in 32 bits.
  static constexpr size_t kMaxFaces = 0xfffffffeu;

  [[noreturn]] void fail(const std::string& message) const {
    throw SceneError(where_, what_ + " " + message);
  }
  void check_positions() const {
    for (size_t i = 0; i < mesh_.positions.size(); ++i)
      if (!is_in_reach(mesh_.positions[i]))
        fail("has a position that is not finite or too far away: vertex " + std::to_string(i) +
             " is " + text(mesh_.positions[i]) + ", expected coordinates up to 1e17");
  }
  void check_count(size_t count, const char* of) const {
    if (count != 0 && count != mesh_.positions.size())
      fail("has " + counted(count, of) + ", expected " + std::to_string(mesh_.positions.size()) +
           ", one per vertex");
  }
  template <class V>
  void check_finite(const std::vector<V>& values, const char* of) const {
    for (size_t i = 0; i < values.size(); ++i)
      if (!all_finite(values[i]))
        fail(std::string("has a ") + of + " that is not finite, of vertex " + std::to_string(i));
  }
  void check_indices(const std::vector<uint32_t>& indices, size_t corners, const char* of) const {
    if (indices.size() % corners != 0)
      fail("has " + counted(indices.size(), "index", "indices") + " of " + of +
           "s, expected a multiple of " + std::to_string(corners));
    for (size_t i = 0; i < indices.size(); ++i)
      if (indices[i] >= mesh_.positions.size())
        fail("has the vertex index " + std::to_string(static_cast<int32_t>(indices[i])) + " in " +
             of + " " + std::to_string(i / corners) + ", expected 0 to " +
             std::to_string(static_cast<int64_t>(mesh_.positions.size()) - 1));
  }

  const MeshData& mesh_;
  const SourceLocation& where_;
  const std::string& what_;
};

bool has_area(const Vec3f& p0, const Vec3f& p1, const Vec3f& p2) {
  const Vec3d a(p0.x, p0.y, p0.z), b(p1.x, p1.y, p1.z), c(p2.x, p2.y, p2.z);
  const Vec3d n = (b - a).cross(c - a);
  return n.dot(n) > 0.0;
}

/// Keeps the faces for which keep(face) holds. Returns the number of removed faces.
template <class Keep>
size_t filter_faces(std::vector<uint32_t>& indices, size_t corners, std::vector<int>& face_indices,
                    size_t first_face, Keep keep) {
  const size_t count = indices.size() / corners;
  size_t kept = 0;
  for (size_t face = 0; face < count; ++face) {
    if (!keep(&indices[face * corners])) continue;
    if (kept != face) {
      for (size_t k = 0; k < corners; ++k)
        indices[kept * corners + k] = indices[face * corners + k];
      if (!face_indices.empty()) face_indices[first_face + kept] = face_indices[first_face + face];
    }
    ++kept;
  }
  indices.resize(kept * corners);
  if (!face_indices.empty())
    face_indices.erase(face_indices.begin() + first_face + kept,
                       face_indices.begin() + first_face + count);
  return count - kept;
}

void warn_or_note(bool is_note, const SourceLocation& where, const std::string& message,
                  Diagnostics& diagnostics) {
  if (is_note)
    diagnostics.note(where, message);
  else
    diagnostics.warn(where, message);
}

}  // namespace

void validate_mesh(MeshData& mesh, const SourceLocation& where, const std::string& what,
                   Diagnostics& diagnostics) {
  MeshChecker(mesh, where, what).check();
  const auto& p = mesh.positions;
  const size_t faces = mesh.triangles.size() / 3 + mesh.quads.size() / 4;
  size_t lost = filter_faces(mesh.triangles, 3, mesh.face_indices, 0, [&](const uint32_t* v) {
    return has_area(p[v[0]], p[v[1]], p[v[2]]);
  });
  lost += filter_faces(
      mesh.quads, 4, mesh.face_indices, mesh.triangles.size() / 3, [&](const uint32_t* v) {
        return has_area(p[v[0]], p[v[1]], p[v[2]]) || has_area(p[v[0]], p[v[1]], p[v[3]]) ||
               has_area(p[v[0]], p[v[2]], p[v[3]]) || has_area(p[v[1]], p[v[2]], p[v[3]]);
      });
  if (lost == 0) return;
  constexpr size_t kFewFaces = 10;  ///< one of so many faces
  if (lost == faces)
    diagnostics.warn(where, what + " has no area and will be invisible: it has only " +
                                counted(faces, "degenerate face"));
  else  // the poles of a lathed mesh have some; many are a fault of the exporter
    warn_or_note(lost <= faces / kFewFaces, where,
                 what + ": " + std::to_string(lost) + " of " + std::to_string(faces) + " faces " +
                     in_number(lost, "has no area and was", "have no area and were") + " removed",
                 diagnostics);
}

void zero_bad_normals(MeshData& mesh, const SourceLocation& where, const std::string& what,
                      Diagnostics& diagnostics) {
  std::vector<bool> bad(mesh.normals.size());
  bool any = false;
  for (size_t i = 0; i < bad.size(); ++i) {
    if (all_finite(mesh.normals[i])) continue;
    mesh.normals[i] = Vec3f(0, 0, 0);
    any = bad[i] = true;
  }
  if (!any) return;
  size_t used = 0;
  for (const auto* indices : {&mesh.triangles, &mesh.quads})
    for (const uint32_t v : *indices)
      if (v < bad.size() && bad[v]) {
        bad[v] = false;
        ++used;
      }
  if (used > 0)
    diagnostics.warn(where, what + ": " + std::to_string(used) + " of " +
                                std::to_string(mesh.normals.size()) + " normals " +
                                in_number(used, "is", "are") +
                                " not finite, the normals of the faces are used there");
}

void reverse_normals(MeshData& mesh) {
  for (Vec3f& n : mesh.normals) n = -n;
}

MeshData split_quads(MeshData mesh) {
  const size_t triangles = mesh.triangles.size() / 3, quads = mesh.quads.size() / 4;
  mesh.triangles.reserve(3 * triangles + 6 * quads);
  for (size_t i = 0; i < quads; ++i) {
    const uint32_t* v = &mesh.quads[4 * i];
    for (const uint32_t index : {v[0], v[1], v[2], v[0], v[2], v[3]})
      mesh.triangles.push_back(index);
  }
  mesh.quads.clear();
  if (!mesh.face_indices.empty()) {
    std::vector<int> split(mesh.face_indices.begin(), mesh.face_indices.begin() + triangles);
    for (size_t i = triangles; i < triangles + quads; ++i)
      split.insert(split.end(), 2, mesh.face_indices[i]);
    mesh.face_indices = std::move(split);
  }
  return mesh;
}

MeshData triangles_of(const MeshData& mesh) {
  MeshData out = mesh;
  out.quads.clear();
  if (!out.face_indices.empty()) out.face_indices.resize(out.triangles.size() / 3);
  return out;
}

MeshData quads_of(const MeshData& mesh) {
  MeshData out = mesh;
  out.triangles.clear();
  for (size_t i = 0; i + 4 <= out.quads.size(); i += 4)
    std::swap(out.quads[i + 2], out.quads[i + 3]);
  if (!out.face_indices.empty())
    out.face_indices.erase(out.face_indices.begin(),
                           out.face_indices.begin() + mesh.triangles.size() / 3);
  return out;
}

void transform_mesh(MeshData& data, const Transform& object_to_world) {
  for (Vec3f& p : data.positions) p = object_to_world.point(p);
  for (Vec3f& t : data.tangents) t = object_to_world.vector(t);
  if (data.normals.empty()) return;
  // Scaled by one common factor, not normalised: interpolation uses relative lengths, and a
  // similarity transform keeps lengths.
  const Mat44d& m = object_to_world.m;
  const Vec3d a(m[0][0], m[0][1], m[0][2]), b(m[1][0], m[1][1], m[1][2]);
  const double determinant = std::abs(a.cross(b).dot(Vec3d(m[2][0], m[2][1], m[2][2])));
  const double factor = std::cbrt(determinant);
  Mat44d scaled_inverse = object_to_world.inverse;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) scaled_inverse[i][j] *= factor;
  const Transform for_normals(object_to_world.m, scaled_inverse);
  for (Vec3f& n : data.normals) n = for_normals.normal(n);
}

}  // namespace nephroid

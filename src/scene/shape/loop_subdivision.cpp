// Loop subdivision: each level splits a triangle into four; at the end all vertices move to the
// limit surface and get its normals. Pure geometry, in double until the end. Papers: Loop 1987;
// Hoppe et al. 1994 (boundary rules and tangents, as in pbrt's loopsubdiv).
#include <stdexcept>
#include <string>

#include "core/counted.h"
#include "scene/shape/shape.h"

namespace nephroid {
namespace {

/// Half-edge h = 3 * face + k runs from corner k to corner k + 1 of its face.
constexpr uint32_t kNone = 0xffffffffu;
uint32_t next_in_face(uint32_t h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}
uint32_t previous_in_face(uint32_t h) {
  return h % 3 == 0 ? h + 2 : h - 1;
}

struct SubdivisionMesh {
  std::vector<Vec3d> positions;
  std::vector<uint32_t> corners;   ///< start vertex of each half-edge
  std::vector<uint32_t> twins;     ///< opposite of each half-edge, or kNone at a boundary
  std::vector<uint32_t> outgoing;  ///< one half-edge that starts at each vertex; at a boundary the
                                   ///< one without a twin
  uint32_t start(uint32_t h) const { return corners[h]; }
  uint32_t end(uint32_t h) const { return corners[next_in_face(h)]; }
  bool on_boundary(uint32_t vertex) const { return twins[outgoing[vertex]] == kNone; }
};

[[noreturn]] void fail(const std::string& message) {
  throw std::invalid_argument("loop subdivision: " + message);
}

std::string edge_name(uint32_t a, uint32_t b) {
  return "the edge from vertex " + std::to_string(a) + " to vertex " + std::to_string(b);
}

/// Finds twins and outgoing half-edges from the corners. Throws unless the faces are an oriented
/// manifold.
void connect(SubdivisionMesh& mesh) {
  struct Directed {
    uint32_t low, high, half_edge;
  };
  const uint32_t count = static_cast<uint32_t>(mesh.corners.size());
  std::vector<Directed> edges(count);
  for (uint32_t h = 0; h < count; ++h) {
    const uint32_t a = mesh.start(h), b = mesh.end(h);
    if (a == b)
      fail("face " + std::to_string(h / 3) + " has vertex " + std::to_string(a) +
           " twice, expected three different ones");
    edges[h] = {std::min(a, b), std::max(a, b), h};
  }
  std::sort(edges.begin(), edges.end(), [](const Directed& x, const Directed& y) {
    return x.low != y.low     ? x.low < y.low
           : x.high != y.high ? x.high < y.high
                              : x.half_edge < y.half_edge;
  });
  mesh.twins.assign(count, kNone);
  for (size_t i = 0; i < count;) {
    size_t j = i + 1;
    while (j < count && edges[j].low == edges[i].low && edges[j].high == edges[i].high) ++j;
    const uint32_t h = edges[i].half_edge;
    if (j - i > 2)
      fail(edge_name(edges[i].low, edges[i].high) + " belongs to " + std::to_string(j - i) +
           " faces, expected at most 2");
    if (j - i == 2) {
      const uint32_t other = edges[i + 1].half_edge;
      if (mesh.start(h) == mesh.start(other))
        fail(edge_name(mesh.start(h), mesh.end(h)) +
             " is used twice in the same direction, expected faces of the same orientation");
      mesh.twins[h] = other;
      mesh.twins[other] = h;
    }
    i = j;
  }
  mesh.outgoing.assign(mesh.positions.size(), kNone);
  for (uint32_t h = 0; h < count; ++h) {
    uint32_t& out = mesh.outgoing[mesh.start(h)];
    if (out == kNone || mesh.twins[h] == kNone) out = h;
  }
}

/// The neighbours of a vertex, counter-clockwise seen from the front of the faces; at a boundary
/// from one end of it to the other.
void one_ring(const SubdivisionMesh& mesh, uint32_t vertex, std::vector<uint32_t>& ring) {
  ring.clear();
  const uint32_t first = mesh.outgoing[vertex];
  uint32_t h = first;
  do {
    ring.push_back(mesh.end(h));
    const uint32_t back = previous_in_face(h);
    h = mesh.twins[back];
    if (h == kNone) {
      ring.push_back(mesh.start(back));
      return;
    }
  } while (h != first);
}

/// Throws if two fans of faces touch in a vertex, which then has no one-ring. Only the input can
/// have such vertices.
void check_fans(const SubdivisionMesh& mesh) {
  std::vector<uint32_t> faces(mesh.positions.size(), 0), ring;
  for (const uint32_t vertex : mesh.corners) ++faces[vertex];
  for (uint32_t vertex = 0; vertex < faces.size(); ++vertex) {
    one_ring(mesh, vertex, ring);
    const size_t in_fan = mesh.on_boundary(vertex) ? ring.size() - 1 : ring.size();
    if (in_fan != faces[vertex])
      fail("vertex " + std::to_string(vertex) +
           " joins parts of the surface that share no edge, expected a manifold mesh");
  }
}

double neighbour_weight(size_t valence) {
  return valence == 3 ? 3.0 / 16.0 : 3.0 / (8.0 * static_cast<double>(valence));
}

double limit_weight(size_t valence) {
  return 1.0 / (static_cast<double>(valence) + 3.0 / (8.0 * neighbour_weight(valence)));
}

/// The vertex moved towards its neighbours: all of them, or at a boundary the two along it.
Vec3d smoothed(const SubdivisionMesh& mesh, uint32_t vertex, const std::vector<uint32_t>& ring,
               double inside_weight, double boundary_weight) {
  const Vec3d& p = mesh.positions[vertex];
  if (mesh.on_boundary(vertex))
    return p * (1.0 - 2.0 * boundary_weight) +
           (mesh.positions[ring.front()] + mesh.positions[ring.back()]) * boundary_weight;
  Vec3d sum(0, 0, 0);
  for (const uint32_t neighbour : ring) sum += mesh.positions[neighbour];
  return p * (1.0 - static_cast<double>(ring.size()) * inside_weight) + sum * inside_weight;
}

Vec3d edge_point(const SubdivisionMesh& mesh, uint32_t h) {
  const Vec3d ends = mesh.positions[mesh.start(h)] + mesh.positions[mesh.end(h)];
  const uint32_t twin = mesh.twins[h];
  if (twin == kNone) return ends * 0.5;
  const Vec3d sides = mesh.positions[mesh.start(previous_in_face(h))] +
                      mesh.positions[mesh.start(previous_in_face(twin))];
  return ends * 0.375 + sides * 0.125;
}

SubdivisionMesh subdivide_once(const SubdivisionMesh& mesh) {
  SubdivisionMesh finer;
  std::vector<uint32_t> ring;
  for (uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
    one_ring(mesh, vertex, ring);
    finer.positions.push_back(smoothed(mesh, vertex, ring, neighbour_weight(ring.size()), 0.125));
  }
  std::vector<uint32_t> on_edge(mesh.corners.size(), kNone);
  for (uint32_t h = 0; h < mesh.corners.size(); ++h) {
    const uint32_t twin = mesh.twins[h];
    if (twin != kNone && on_edge[twin] != kNone) {
      on_edge[h] = on_edge[twin];
      continue;
    }
    on_edge[h] = static_cast<uint32_t>(finer.positions.size());
    finer.positions.push_back(edge_point(mesh, h));
  }
  // A child keeps its parent's corner at the same place in the list, because triangles without
  // texture coordinates get default ones by corner.
  finer.corners.reserve(4 * mesh.corners.size());
  for (uint32_t h = 0; h < mesh.corners.size(); h += 3) {
    const uint32_t v0 = mesh.corners[h], v1 = mesh.corners[h + 1], v2 = mesh.corners[h + 2];
    const uint32_t e0 = on_edge[h], e1 = on_edge[h + 1], e2 = on_edge[h + 2];
    for (const uint32_t corner : {v0, e0, e2, e0, v1, e1, e2, e1, v2, e0, e1, e2})
      finer.corners.push_back(corner);
  }
  connect(finer);
  return finer;
}

/// A normal of the limit surface, not normalised. For counter-clockwise faces it points away from
/// the viewer, as in pbrt.
Vec3d limit_normal(const SubdivisionMesh& mesh, uint32_t vertex,
                   const std::vector<uint32_t>& ring) {
  const size_t n = ring.size();
  const auto at = [&](size_t i) { return mesh.positions[ring[i]] - mesh.positions[vertex]; };
  Vec3d s(0, 0, 0), t(0, 0, 0);
  if (!mesh.on_boundary(vertex)) {
    for (size_t j = 0; j < n; ++j) {
      const double angle = 2.0 * kPiDouble * static_cast<double>(j) / static_cast<double>(n);
      s += at(j) * std::cos(angle);
      t += at(j) * std::sin(angle);
    }
    return t.cross(s);
  }
  s = at(n - 1) - at(0);
  if (n == 2) {
    t = at(0) + at(1);
  } else if (n == 3) {
    t = at(1);
  } else if (n == 4) {
    t = at(1) * 2.0 + at(2) * 2.0 - at(0) - at(3);
  } else {
    const double theta = kPiDouble / static_cast<double>(n - 1);
    t = (at(0) + at(n - 1)) * -std::sin(theta);
    for (size_t k = 1; k + 1 < n; ++k)
      t += at(k) * ((2.0 - 2.0 * std::cos(theta)) * std::sin(static_cast<double>(k) * theta));
  }
  return s.cross(t);
}

/// The mesh without unused vertices.
SubdivisionMesh checked_input(const std::vector<Vec3f>& positions,
                              const std::vector<uint32_t>& triangles, int levels) {
  if (triangles.size() % 3 != 0)
    fail(counted(triangles.size(), "index", "indices") + ", expected a multiple of 3");
  // All half-edge numbers must be below kNone.
  uint64_t half_edges = triangles.size();
  if (levels < 0) fail("level " + std::to_string(levels) + ", expected 0 or more");
  for (int i = 0; i < levels && half_edges > 0; ++i) {
    half_edges *= 4;
    if (half_edges >= kNone)
      fail("subdivision of " + counted(triangles.size() / 3, "face") + " to level " +
           std::to_string(levels) + " makes too many triangles, expected a lower level");
  }
  SubdivisionMesh mesh;
  std::vector<uint32_t> place(positions.size(), kNone);
  for (const uint32_t index : triangles) {
    if (index >= positions.size())
      fail("vertex index " + std::to_string(index) + " is out of range, the mesh has " +
           counted(positions.size(), "vertex", "vertices"));
    const Vec3f& p = positions[index];
    if (!is_finite(p)) fail("the position of vertex " + std::to_string(index) + " is not finite");
    if (place[index] == kNone) {
      place[index] = static_cast<uint32_t>(mesh.positions.size());
      mesh.positions.emplace_back(p.x, p.y, p.z);
    }
    mesh.corners.push_back(place[index]);
  }
  return mesh;
}

}  // namespace

MeshData loop_subdivide(const std::vector<Vec3f>& positions, const std::vector<uint32_t>& triangles,
                        int levels) {
  SubdivisionMesh mesh = checked_input(positions, triangles, levels);
  connect(mesh);
  check_fans(mesh);
  for (int i = 0; i < levels; ++i) mesh = subdivide_once(mesh);

  std::vector<uint32_t> ring;
  std::vector<Vec3d> limit;
  limit.reserve(mesh.positions.size());
  for (uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
    one_ring(mesh, vertex, ring);
    limit.push_back(smoothed(mesh, vertex, ring, limit_weight(ring.size()), 0.2));
  }
  mesh.positions = std::move(limit);

  std::vector<Vec3d> normals;
  normals.reserve(mesh.positions.size());
  double longest = 0.0;
  for (uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
    one_ring(mesh, vertex, ring);
    normals.push_back(limit_normal(mesh, vertex, ring));
    longest = std::max(longest, normals.back().length());
  }
  MeshData out;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3d& p = mesh.positions[i];
    // One factor for all, because relative lengths weigh them in interpolation.
    const Vec3d n = longest > 0.0 ? normals[i] / longest : Vec3d(0, 0, 0);
    out.positions.emplace_back(static_cast<float>(p.x), static_cast<float>(p.y),
                               static_cast<float>(p.z));
    out.normals.emplace_back(static_cast<float>(n.x), static_cast<float>(n.y),
                             static_cast<float>(n.z));
  }
  out.triangles = std::move(mesh.corners);
  return out;
}

}  // namespace nephroid

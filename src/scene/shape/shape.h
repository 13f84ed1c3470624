// Shapes as geometry that rays hit and lights are made of. One family per file. Embree traces
// triangle meshes itself and calls the intersect() of the others. It must not know materials,
// lights or Embree.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/math.h"
#include "input/mesh_data.h"
#include "scene/interaction.h"

namespace nephroid {

/// Largest allowed absolute coordinate. Squared distances fit a float with room to spare, and the
/// ray tracer accepts such rays.
inline constexpr float kLargestCoordinate = 1e17f;
/// False for NaNs, too.
inline bool is_in_reach(const Vec3f& p) {
  return std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate &&
         std::abs(p.z) <= kLargestCoordinate;
}

/// A point sampled on a shape, world space.
struct ShapeSample {
  Vec3f p{0, 0, 0};
  Vec3f p_error{0, 0, 0};
  Vec3f ng{0, 0, 0};  ///< outside normal, as in SurfaceInteraction
  Vec2f uv{0, 0};     ///< texture coordinates
  float pdf = 0;      ///< pdf_a (1/area) from sample_area, pdf_w (1/sr) from sample_towards
};

/// A hit of a ray on a primitive.
struct ShapeHit {
  float t = 0;
  Vec2f uv{0, 0};  ///< parametric position for fill() (barycentric for triangles)
};

class PlaneRectangle;

class Shape {
 public:
  virtual ~Shape() = default;

  virtual uint32_t primitive_count() const = 0;
  virtual Bounds3f bounds(uint32_t primitive) const = 0;

  /// First hit with t in (t_min, t_max), computed in double; empty if none. Triangle meshes are
  /// traced by Embree; their version is the reference of the tests.
  virtual std::optional<ShapeHit> intersect(uint32_t primitive, const Ray& ray,
                                            float t_min) const = 0;

  /// Fills the geometric part of the interaction (p, p_error, ng, uv, derivatives, shading frame,
  /// face_index). The ray's direction need not be normalised. wo, time, distance, material, light
  /// and ids are set by the caller.
  virtual void fill(uint32_t primitive, const Vec2f& hit_uv, const Ray& ray, float t,
                    SurfaceInteraction& out) const = 0;

  /// The mesh, if every primitive is a plane rectangle of `quads` (patch order). The ray tracer can
  /// then trace them itself, with the (u, v) of intersect(). nullptr otherwise.
  virtual const MeshData* flat_quads() const { return nullptr; }

  /// True for a closed surface whose outside points into the enclosed volume. Can take as long as
  /// sorting the edges.
  virtual bool is_inside_out() const { return false; }

  /// False where photons cannot be merged, whatever the material: curves are narrow and turn their
  /// surface towards each ray.
  virtual bool merges_photons() const { return true; }

  virtual float area(uint32_t primitive) const = 0;
  /// Samples uniformly by area; pdf is pdf_a. Empty for a degenerate primitive.
  virtual std::optional<ShapeSample> sample_area(uint32_t primitive, const Vec2f& u) const = 0;
  /// Samples the part seen from `from`: by solid angle where a good method is known, else by area
  /// with conversion. pdf is pdf_w at `from`. Empty if nothing is visible.
  virtual std::optional<ShapeSample> sample_towards(uint32_t primitive, const Vec3f& from,
                                                    const Vec2f& u) const = 0;
  /// Density pdf_w of sample_towards for the direction from `from` to the hit point `p` with
  /// outside normal `ng` on this primitive.
  virtual float pdf_towards(uint32_t primitive, const Vec3f& from, const Vec3f& p,
                            const Vec3f& ng) const = 0;
  /// Cone of normals: axis, and cosine of the half angle (-1 if unknown or closed).
  virtual void normal_bounds(uint32_t primitive, Vec3f* axis, float* cos_half_angle) const = 0;
  /// The primitive as a rectangle, if its samples equal those of the shape except for texture
  /// coordinates.
  virtual std::optional<PlaneRectangle> rectangle(uint32_t primitive) const;
};
using ShapePtr = std::shared_ptr<const Shape>;

/// An indexed triangle mesh in world space. `flip` (ReverseOrientation xor a transform that swaps
/// handedness, hence winding) reverses the outside given by the winding. If the mesh has normals,
/// they decide instead; the caller has already applied ReverseOrientation to them (reverse_normals
/// in mesh_preparation.h). Throws std::invalid_argument if an index is out of range.
class TriangleMesh : public Shape {
 public:
  TriangleMesh(MeshData data, bool flip);
  uint32_t primitive_count() const override;
  Bounds3f bounds(uint32_t primitive) const override;
  std::optional<ShapeHit> intersect(uint32_t, const Ray&, float t_min) const override;
  void fill(uint32_t, const Vec2f& barycentric, const Ray&, float t,
            SurfaceInteraction&) const override;
  float area(uint32_t) const override;
  std::optional<ShapeSample> sample_area(uint32_t, const Vec2f&) const override;
  std::optional<ShapeSample> sample_towards(uint32_t, const Vec3f& from,
                                            const Vec2f&) const override;
  float pdf_towards(uint32_t, const Vec3f& from, const Vec3f& p, const Vec3f& ng) const override;
  void normal_bounds(uint32_t, Vec3f* axis, float* cos_half_angle) const override;
  bool is_inside_out() const override;
  const MeshData& data() const { return data_; }

 private:
  MeshData data_;
  bool flip_;
};

/// Quadrics keep their transform, any affine map, and are intersected in object space in double.
/// sample_area is uniform in object space; its pdf_a holds at the world-space point. The outside is
/// where dpdu x dpdv points in object space (away from the axis or centre, up for disks), reversed
/// by reverse_orientation. Mirroring the shape mirrors its outside.
ShapePtr make_sphere(const Transform& object_to_world, bool reverse_orientation, float radius,
                     float z_min, float z_max, float phi_max_degrees);
ShapePtr make_disk(const Transform& object_to_world, bool reverse_orientation, float height,
                   float radius, float inner_radius, float phi_max_degrees);
ShapePtr make_cylinder(const Transform& object_to_world, bool reverse_orientation, float radius,
                       float z_min, float z_max, float phi_max_degrees);
/// Patches of four corners in pbrt's order p00 p10 p01 p11 (data.quads), in world space; `flip` and
/// normals as for TriangleMesh.
ShapePtr make_bilinear_mesh(MeshData data, bool flip);
/// Loop subdivision to `levels`, with limit positions and normals. As in pbrt-v4, normals of
/// counter-clockwise faces point backwards and are not of unit length. Throws std::invalid_argument
/// if an index is out of range, the faces are not an oriented manifold (with or without boundary),
/// or there would be too many. The message has no location; the caller adds it.
MeshData loop_subdivide(const std::vector<Vec3f>& positions, const std::vector<uint32_t>& triangles,
                        int levels);
/// Transforms positions, normals and tangents. Normals keep their relative lengths, which weigh
/// them in interpolation.
void transform_mesh(MeshData& data, const Transform& object_to_world);

}  // namespace nephroid

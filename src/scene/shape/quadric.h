// Base class of spheres, disks and cylinders: one primitive with a transform, intersected and
// differentiated in object space in double, reported in world space with error bounds. Derived
// classes define the surface; it must not know which there are.
#pragma once

#include "scene/shape/shape.h"

namespace nephroid {

class Quadric : public Shape {
 public:
  uint32_t primitive_count() const final { return 1; }
  Bounds3f bounds(uint32_t) const final { return bounds_; }
  /// Leaves the hit's uv at 0: fill() intersects again, and most hits are never filled.
  std::optional<ShapeHit> intersect(uint32_t, const Ray& ray, float t_min) const final;
  /// `hit_uv` is used only with a ray without direction: it is then the point.
  void fill(uint32_t, const Vec2f& hit_uv, const Ray& ray, float t,
            SurfaceInteraction& out) const final;
  float area(uint32_t) const final;
  std::optional<ShapeSample> sample_area(uint32_t, const Vec2f& u) const final;
  std::optional<ShapeSample> sample_towards(uint32_t, const Vec3f& from,
                                            const Vec2f& u) const override;
  float pdf_towards(uint32_t, const Vec3f& from, const Vec3f& p, const Vec3f& ng) const override;

 protected:
  struct Roots {
    int count = 0;
    double t[2] = {0, 0};  ///< ascending
  };
  struct Derivatives {
    Vec3d dpdu, dpdv, dndu, dndv;
  };
  using Vec2d = Imath::V2d;

  /// The outside is where dpdu x dpdv points in object space, reversed by reverse_orientation. A
  /// transform that swaps handedness does not change it: it is mapped like a normal.
  Quadric(const Transform& object_to_world, bool reverse_orientation);
  /// Called by the constructors of derived classes. Sets the bounds to those of the cylinder around
  /// the object's z axis, intersected with those of a ball of radius `ball` if that is positive.
  void set_bounds(double radius, double z_min, double z_max, double ball);

  // The surface in object space.
  /// Intersections of the ray with the whole surface, before clipping by z and phi.
  virtual Roots roots(const Vec3d& o, const Vec3d& d) const = 0;
  /// Projects an approximate point onto the whole surface.
  virtual Vec3d project(const Vec3d& p) const = 0;
  /// True if a point of the whole surface is within the z and phi limits.
  virtual bool contains(const Vec3d& p) const = 0;
  virtual Vec3d point_at(const Vec2d& uv) const = 0;
  virtual Vec2d uv_of(const Vec3d& p) const = 0;
  /// Unit normal along dpdu x dpdv.
  virtual Vec3d normal_of(const Vec3d& p) const = 0;
  virtual Derivatives derivatives_at(const Vec3d& p) const = 0;
  virtual double local_area() const = 0;
  /// Uniform by area in object space.
  virtual Vec3d local_sample(const Vec2f& u) const = 0;

  Vec3d to_object(const Vec3f& world_point) const;
  Vec3d vector_to_object(const Vec3d& world_vector) const;
  /// Object-space unit outside normal from the world-space one.
  Vec3d normal_to_object(const Vec3f& world_normal) const;
  Vec3f world_normal(const Vec3d& object_normal) const;
  ShapeSample sample_of(const Vec3d& object_point, float pdf) const;
  /// World-space pdf_a of a uniform sample of the object-space surface, from the normal alone: the
  /// transform scales an area by |det M| |M^-T n|.
  float pdf_a(const Vec3f& ng) const;
  bool is_similarity() const { return similarity_; }
  double inverse_determinant() const {
    return 1.0 / determinant_;
  }  ///< absolute value, of the 3x3
     ///< part
  bool flip() const { return flip_; }

 private:
  Vec3f world_point(const Vec3d& p, Vec3f* error) const;

  Mat44d to_world_, to_object_;
  bool flip_;
  bool similarity_;
  double determinant_;
  double error_scale_[3][3];  ///< |M^-1| |M|, for error bounds
  Vec3d error_offset_;
  Bounds3f bounds_;
};

/// The angle of (x,y) in [0, 2 pi).
double positive_angle(double y, double x);

}  // namespace nephroid

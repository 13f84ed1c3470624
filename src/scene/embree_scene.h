// Ray tracing: a bounding hierarchy over shapes and instances of other hierarchies. The .cpp is the
// only file that includes Embree (Wald et al. 2014). It must not know materials or lights.
#pragma once

#include <memory>
#include <optional>

#include "core/motion.h"
#include "scene/shape/shape.h"

namespace nephroid {

/// A hit, in the numbering of the hierarchy: geometries are numbered from 0 in the order in which
/// they were added.
struct EmbreeHit {
  float t = 0;
  Vec2f uv;
  uint32_t geometry = 0;  ///< number in the top level, or in the instanced hierarchy
  uint32_t primitive = 0;
  uint32_t instance = kNoInstance;  ///< geometry number of the instance in the top level
  /// Geometry number of the moving instance within the instanced hierarchy, if the hit lies in it.
  uint32_t inner = kNoInstance;
  static constexpr uint32_t kNoInstance = 0xffffffffu;
};

/// A ray hits only geometry whose mask shares a bit with its own.
inline constexpr unsigned kMaskOpaque = 1;
inline constexpr unsigned kMaskPassing = 2;  ///< can let light straight through
inline constexpr unsigned kMaskAll = 3;

/// The ray in the space of an instance at the ray's time; t is unchanged. The hierarchy uses the
/// same function for moving instances.
inline Ray object_space_ray(const Transform& object_to_world, const Ray& ray) {
  const Transform world_to_object = object_to_world.inverted();
  Ray local = ray;
  local.o = world_to_object.point(ray.o);
  local.d = world_to_object.vector(ray.d);
  return local;
}

class EmbreeDevice;

class EmbreeScene {
 public:
  explicit EmbreeScene(std::shared_ptr<EmbreeDevice> device);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  static std::shared_ptr<EmbreeDevice> make_device();

  /// All return the number of the new geometry. The shape is kept alive.
  uint32_t add_shape(ShapePtr shape, unsigned mask);
  /// `child` has been committed and outlives this scene.
  uint32_t add_instance(const EmbreeScene& child, const Transform& object_to_world, unsigned mask);
  /// Like add_instance, for instances that move with the ray's time. A child can hold moving
  /// instances of hierarchies that hold none.
  uint32_t add_moving_instance(const EmbreeScene& child, const MotionTransform& object_to_world,
                               unsigned mask);
  /// Builds the hierarchy. Throws Error if memory runs out.
  void commit();

  std::optional<EmbreeHit> intersect(const Ray& ray, unsigned mask) const;
  bool occluded(const Ray& ray, unsigned mask) const;
  /// World bounds over all times; empty if there is no geometry.
  Bounds3f bounds() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace nephroid

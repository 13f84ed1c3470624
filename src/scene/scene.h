// The immutable, traceable scene, as integrators see it. Built once by build_scene from a
// SceneDescription; read by any number of threads. Between renders, renew_camera (scene_view.h) can
// exchange its camera, and a render teaches its light sampler.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/color.h"
#include "input/import_options.h"
#include "scene/embree_scene.h"
#include "scene/interaction.h"
#include "scene/light/light_sampler.h"
#include "scene/material/material.h"
#include "scene/medium/medium.h"
#include "scene/scene_options.h"

namespace nephroid {

class Camera;
class PixelFilter;

/// Coordinate system of a film's geometric layers; kNone: the film has no such layers.
enum class GBufferSpace { kNone, kCamera, kWorld };

/// The film as described by the scene's Film directive and the command line.
struct FilmDescription {
  int width = 1280, height = 720;
  int crop_x0 = 0, crop_y0 = 0, crop_x1 = 1280, crop_y1 = 720;  ///< pixels, half open
  float imaging_ratio = 1;                                      ///< exposure time * ISO / 100
  float max_component = kInfinity;                              ///< maximum rgb of a sample
  const RgbColorSpace* color_space = nullptr;
  std::optional<ColorMatrix> white_balance;
  GBufferSpace gbuffer = GBufferSpace::kNone;
  std::string filename;
  float diagonal_mm = 35;  ///< diagonal of a realistic camera's film
  SourceLocation where;    ///< location of the Film directive, if there is one
};

/// Settings of the command line that override the scene.
struct SceneOverrides {
  int width = 0, height = 0;  ///< 0: as in the file
  bool has_crop = false;
  float crop[4] = {0, 1, 0, 1};  ///< x0 x1 y0 y1 in [0,1]
  SpecularBand specular_band;
  uint64_t texture_memory = kDefaultTextureMemory;  ///< bytes for the pixels of image textures
  ImportOptions import;                             ///< choices about scenes that are not pbrt-v4
};

/// The media on both sides of a surface or around a light; null is empty space.
struct MediumInterface {
  const Medium* inside = nullptr;
  const Medium* outside = nullptr;
  bool is_transition() const { return inside != outside; }
};

/// A shape and its attributes. Emitting shapes have one light per primitive, numbered in sequence.
struct ShapeRecord {
  ShapePtr shape;
  int material = 0;
  int first_light = -1;
  FloatTexturePtr alpha;       ///< null if the shape is opaque
  bool merges_photons = true;  ///< whether the shape allows it; its material can also refuse
  MediumInterface media;       ///< media of leaving rays, if they differ
};

/// The medium that a surface names for its side to which `w` (world) points; `current` if it names
/// none.
inline const Medium* medium_beyond(const SurfaceInteraction& surface, const Vec3f& w,
                                   const Medium* current) {
  const MediumInterface& media = surface.record->media;
  if (!media.is_transition()) return current;
  return dot(w, surface.ng) > 0.0f ? media.outside : media.inside;
}

/// The medium on the side of a surface to which `w` (world) points, for light that arrived along
/// surface.wo in `current`. On the side from which it came that is `current`, whatever the surface
/// says: where the two differ, walks from the eye and from the light would see different scenes.
inline const Medium* medium_towards(const SurfaceInteraction& surface, const Vec3f& w,
                                    const Medium* current) {
  const bool stays = dot(w, surface.ng) * dot(surface.wo, surface.ng) > 0.0f;
  return stays ? current : medium_beyond(surface, w, current);
}

struct ShapeGroup;

struct InstanceRecord {
  const ShapeGroup* group = nullptr;
  MotionTransform object_to_world;  ///< "world" is the space of the group that holds the instance
};

/// Shapes that are placed as a whole: the top level, the shapes of an object definition, or those
/// of an animated directive, in the space before its transform.
struct ShapeGroup {
  std::vector<ShapeRecord> records;  ///< index = geometry number in the hierarchy
  /// Their geometry numbers follow those of the records. Below the top level: moving shapes only.
  std::vector<InstanceRecord> instances;
  std::unique_ptr<EmbreeScene> accelerator;
};

/// Maximum number of straight-through events before a ray counts as trapped.
inline constexpr int kMaxStraightEvents = 1000;

class Scene {
 public:
  Scene();
  ~Scene();

  /// Closest surface along the ray, after alpha tests. Interfaces are reported; the walk passes
  /// through them. False if the ray leaves the scene.
  bool intersect(const Ray& ray, SurfaceInteraction& hit) const;

  /// Transmittance of surfaces along a shadow ray up to its t_max: 0 if it is blocked, else the
  /// product of the weights of the surfaces that it crosses.
  SampledSpectrum transmittance(const Ray& shadow_ray, const SampledWavelengths& lambda) const;

  /// True if an opaque surface blocks a shadow ray.
  bool blocked(const Ray& shadow_ray) const;
  /// The first surface on a ray that can let light straight through, ignoring opaque surfaces.
  bool intersect_passing(const Ray& ray, SurfaceInteraction& hit) const;
  /// Light that continues straight at a surface found by intersect_passing: across it, or beside it
  /// where alpha makes it absent. The weight is the sum of both.
  struct Passage {
    SampledSpectrum across, beside;
    float across_share = 0;  ///< suggested probability of `across`; 0 or 1 if only one is possible
  };
  Passage passage(const SurfaceInteraction& hit, const SampledWavelengths& lambda) const;

  /// The light of an emitting surface, else nullptr.
  const Light* area_light(const SurfaceInteraction& hit) const {
    return hit.area_light < 0 ? nullptr : lights[hit.area_light].get();
  }

  SceneOptions options;
  SpecularBand specular_band;
  FilmDescription film;
  std::unique_ptr<Camera> camera;
  std::unique_ptr<PixelFilter> filter;
  std::vector<MaterialPtr> materials;
  std::vector<LightPtr> lights;
  std::vector<MediumInterface> light_media;  ///< around each light; for area lights, their shape's
  // Labels in light path expressions: the file's names. Unnamed things get type and number
  // ("dielectric2", "infinite1", "diffuse3"), counted per type from 1 in file order.
  std::vector<std::string> material_labels;  ///< [material index]
  std::vector<std::string> medium_labels;    ///< [medium index]
  std::vector<std::string> light_labels;  ///< [light]; the lights of one AreaLightSource share it
  std::vector<SourceLocation> material_places;  ///< [material index]
  std::vector<SourceLocation> light_places;     ///< [light]
  std::vector<MediumPtr> media;
  const Medium* camera_medium = nullptr;
  std::unique_ptr<LightSampler> light_sampler;
  SceneSphere sphere;
  int samples_per_pixel = 16;  ///< number in the scene's Sampler line
  uint64_t scene_seed = 0;
  std::string integrator;  ///< type in the scene's Integrator line, empty if absent
  ParameterSet integrator_parameters;

  ShapeGroup top;
  std::vector<std::unique_ptr<ShapeGroup>> groups;         ///< groups of object definitions
  std::vector<std::unique_ptr<ShapeGroup>> moving_shapes;  ///< groups of animated Shape directives
  bool has_passing_shapes = false;  ///< whether any shape lets light straight through
  /// True if any shape's material can scatter in class S: without one there are no caustics.
  bool has_specular_material = false;
  uint64_t primitive_count = 0;  ///< counted without instancing
  uint64_t shape_count = 0;
  uint64_t instance_count = 0;  ///< number of instances of object definitions

 private:
  bool intersect_masked(const Ray& ray, unsigned mask, SurfaceInteraction& hit) const;
};

/// Throws SceneError or IoError. Warnings go to `diagnostics`.
std::unique_ptr<Scene> build_scene(const SceneDescription& description,
                                   const SceneOverrides& overrides, Diagnostics& diagnostics);

}  // namespace nephroid

// The immutable, traceable world: what integrators see of a scene.
// Built once by build_scene from a SceneDescription; read by any number of threads.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/color.h"
#include "scene/embree_scene.h"
#include "scene/interaction.h"
#include "scene/light/light_sampler.h"
#include "scene/material/material.h"
#include "scene/medium/medium.h"
#include "scene/scene_options.h"

namespace nephroid {

class Camera;
class PixelFilter;

/// Coordinate system of the geometric layers of a film; kNone: it has none.
enum class GBufferSpace { kNone, kCamera, kWorld };

/// The film as the scene's Film directive and the command line describe it.
struct FilmDescription {
  int width = 1280, height = 720;
  int crop_x0 = 0, crop_y0 = 0, crop_x1 = 1280, crop_y1 = 720;  ///< pixels, half open
  float imaging_ratio = 1;                                      ///< exposure time * ISO / 100
  float max_component = kInfinity;                              ///< of a sample's rgb
  const RgbColorSpace* color_space = nullptr;
  std::optional<ColorMatrix> white_balance;
  GBufferSpace gbuffer = GBufferSpace::kNone;
  std::string filename;
  float diagonal_mm = 35;  ///< of the film that a realistic camera exposes
  SourceLocation where;    ///< of the Film directive, if there is one
};

/// What the command line may change of a scene.
struct SceneOverrides {
  int width = 0, height = 0;  ///< 0: as in the file
  bool has_crop = false;
  float crop[4] = {0, 1, 0, 1};  ///< x0 x1 y0 y1 in [0,1]
  SpecularBand specular_band;
  uint64_t texture_memory = kDefaultTextureMemory;  ///< bytes for the pixels of image textures
};

/// The media on both sides of a surface or around a light; null is empty space.
struct MediumInterface {
  const Medium* inside = nullptr;
  const Medium* outside = nullptr;
  bool is_transition() const { return inside != outside; }
};

/// A shape with what belongs to it. Emitting shapes have one light per primitive, in a row.
struct ShapeRecord {
  ShapePtr shape;
  int material = 0;
  int first_light = -1;
  FloatTexturePtr alpha;       ///< null where the shape is solid
  bool merges_photons = true;  ///< of the shape; its material may refuse as well
  MediumInterface media;       ///< rays that leave the surface change to these if they differ
};

struct ShapeGroup;

struct InstanceRecord {
  const ShapeGroup* group = nullptr;
  MotionTransform object_to_world;  ///< "world" is the space of the group that it stands in
};

/// Shapes that are placed as a whole: the top level, the shapes of an object definition, or those
/// of a directive under an animated transform, in the space before that transform.
struct ShapeGroup {
  std::vector<ShapeRecord> records;  ///< index = geometry number in the hierarchy
  /// Geometry numbers follow those of the records. Outside of the top level, moving shapes only.
  std::vector<InstanceRecord> instances;
  std::unique_ptr<EmbreeScene> accelerator;
};

/// Crossings of surfaces that let light straight through after which a ray is given up as trapped.
inline constexpr int kMaxStraightEvents = 1000;

class Scene {
 public:
  Scene();
  ~Scene();

  /// Closest surface along the ray that is there (alpha-tested; interfaces are reported, the walk
  /// goes through them). False if the ray leaves the scene.
  bool intersect(const Ray& ray, SurfaceInteraction& hit) const;

  /// Share of light that gets through a shadow ray up to its t_max: 0 if something stands in
  /// between, else the product of the weights of what lets light straight through.
  SampledSpectrum transmittance(const Ray& shadow_ray, const SampledWavelengths& lambda) const;

  /// True if something opaque stands in the way of a shadow ray.
  bool blocked(const Ray& shadow_ray) const;
  /// The first surface on a ray that may let light straight through, whatever opaque things there
  /// are.
  bool intersect_passing(const Ray& ray, SurfaceInteraction& hit) const;
  /// How light goes straight on at a surface that intersect_passing has found: across it, or beside
  /// it where alpha says that it is not there. The sum of both is the weight.
  struct Passage {
    SampledSpectrum across, beside;
    float across_share = 0;  ///< a good probability for choosing `across`, 0 or 1 if only one is
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
  std::vector<MediumInterface> light_media;  ///< around each light; of an area light, its shape's
  // What light path expressions call things: names of the file; what has none there is called after
  // its type and number ("dielectric2", "infinite1", "diffuse3": counted by type, from 1, in file
  // order).
  std::vector<std::string> material_labels;  ///< [material index]
  std::vector<std::string> medium_labels;    ///< [medium index]
  std::vector<std::string> light_labels;  ///< [light]; the lights of one AreaLightSource share it
  std::vector<SourceLocation> material_places;  ///< [material index]
  std::vector<SourceLocation> light_places;     ///< [light]
  std::vector<MediumPtr> media;
  const Medium* camera_medium = nullptr;
  std::unique_ptr<LightSampler> light_sampler;
  SceneSphere sphere;
  int samples_per_pixel = 16;  ///< of the scene's Sampler line
  uint64_t scene_seed = 0;
  std::string integrator;  ///< type of the scene's Integrator line, empty if absent
  ParameterSet integrator_parameters;

  ShapeGroup top;
  std::vector<std::unique_ptr<ShapeGroup>> groups;         ///< of object definitions
  std::vector<std::unique_ptr<ShapeGroup>> moving_shapes;  ///< of animated Shape directives
  bool has_passing_shapes = false;  ///< any shape that lets light straight through
  /// True if any shape's material may scatter in class S: without one there are no caustics.
  bool has_specular_material = false;
  uint64_t primitive_count = 0;  ///< without instancing
  uint64_t shape_count = 0;
  uint64_t instance_count = 0;  ///< of object definitions

 private:
  bool intersect_masked(const Ray& ray, unsigned mask, SurfaceInteraction& hit) const;
};

/// Throws SceneError or IoError; warnings go to `diagnostics`.
std::unique_ptr<Scene> build_scene(const SceneDescription& description,
                                   const SceneOverrides& overrides, Diagnostics& diagnostics);

}  // namespace nephroid

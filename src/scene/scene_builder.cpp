// Builds a Scene from a SceneDescription: textures, materials, lights, shapes, instances; camera
// and film in scene_view.cpp.
#include <exception>
#include <map>
#include <optional>
#include <utility>

#include "core/parallel.h"
#include "scene/camera/camera.h"
#include "scene/inside_out.h"
#include "scene/pixel_filter.h"
#include "scene/sampler_description.h"
#include "scene/scene.h"
#include "scene/scene_labels.h"
#include "scene/scene_view.h"
#include "scene/shape_table.h"

namespace nephroid {

namespace {

class SceneBuilder {
 public:
  SceneBuilder(const SceneDescription& description, const SceneOverrides& overrides,
               Diagnostics& diagnostics)
      : d_(description),
        diagnostics_(diagnostics),
        textures_(description, diagnostics, overrides.texture_memory),
        light_labels_(description),
        scene_(std::make_unique<Scene>()),
        device_(EmbreeScene::make_device()) {
    scene_->options = read_scene_options(d_, diagnostics);
    scene_->specular_band = overrides.specular_band;
    check_accelerator(d_, diagnostics);
    scene_->materials = make_materials(
        d_, textures_, {overrides.specular_band, scene_->options.force_diffuse}, diagnostics);
    scene_->material_labels = material_labels(d_);
    for (const MaterialDescription& m : d_.materials) scene_->material_places.push_back(m.where);
    for (size_t i = 0; i < d_.materials.size(); ++i)
      if (!d_.materials[i].name.empty())
        material_index_[d_.materials[i].name] = static_cast<int>(i);
    set_film_and_camera(*scene_, d_, overrides, diagnostics);
    scene_->filter = make_pixel_filter(d_.pixel_filter, diagnostics);
    find_instance_pivot();
    const SamplerDescription sampler = read_sampler(d_.sampler, scene_->options.seed, diagnostics);
    scene_->samples_per_pixel = sampler.samples_per_pixel;
    scene_->scene_seed = sampler.seed;
    if (d_.integrator) {
      scene_->integrator = d_.integrator->type;
      scene_->integrator_parameters = d_.integrator->parameters;
    }
    scene_->media = make_media(d_, diagnostics);
    scene_->medium_labels = medium_labels(d_);
    media_.emplace(d_, *scene_);
    scene_->camera_medium = medium_of_camera(d_, *media_);
    scene_->lights = make_lights(d_, diagnostics);
    for (size_t i = 0; i < d_.lights.size(); ++i) {
      scene_->light_media.push_back(medium_around(d_.lights[i], *media_));
      scene_->light_labels.push_back(light_labels_.light(i));
      scene_->light_places.push_back(d_.lights[i].where);
    }
  }

  std::unique_ptr<Scene> build() {
    build_group(d_.shapes, scene_->top);
    std::map<std::string, const ShapeGroup*> by_name;
    for (const auto& [name, object] : d_.objects) {
      auto group = std::make_unique<ShapeGroup>();
      build_group(object.shapes, *group);
      group->accelerator->commit();
      by_name[name] = group.get();
      scene_->groups.push_back(std::move(group));
    }
    for (const InstanceDescription& instance : d_.instances) add_instance(instance, by_name);
    scene_->top.accelerator->commit();
    finish();
    return std::move(scene_);
  }

 private:
  int material_of(const ShapeDescription& shape) const {
    if (shape.material.index >= 0) return shape.material.index;
    const auto it = material_index_.find(shape.material.name);
    if (it != material_index_.end()) return it->second;
    throw SceneError(shape.material.where, "material \"" + shape.material.name +
                                               "\" is not defined, expected the name of a "
                                               "MakeNamedMaterial");
  }

  // Reading and building meshes takes most of the time and runs in parallel over all shapes.
  // Everything with an order (geometry numbers, lights) follows in file order.
  void build_group(const std::vector<ShapeDescription>& shapes, ShapeGroup& group) {
    group.accelerator = std::make_unique<EmbreeScene>(device_);
    std::vector<std::span<const ShapeDescription>> runs;
    for (std::span<const ShapeDescription> rest(shapes); !rest.empty();
         rest = rest.subspan(runs.back().size()))
      runs.push_back(rest.first(shapes_alike(rest)));
    std::vector<std::vector<ShapePtr>> made(runs.size());
    std::vector<std::exception_ptr> failed(runs.size());
    const DisplacementInputs displacement{textures_, scene_->options.displacement_edge_scale};
    parallel_chunks(runs.size(), 1, [&](int64_t i, int64_t, int64_t) {
      try {
        made[i] = make_shapes(runs[i], *d_.files, diagnostics_, displacement);
      } catch (const std::bad_alloc&) {
        const ShapeDescription& shape = runs[i][0];
        failed[i] = std::make_exception_ptr(SceneError(
            shape.where, "there is not enough memory while shape \"" + shape.type + "\" is read"));
      } catch (...) {
        failed[i] = std::current_exception();
      }
    });
    // Each directive with a moving shape makes its own group, placed after all static shapes.
    std::vector<std::pair<const ShapeDescription*, const ShapeGroup*>> moving;
    for (size_t i = 0; i < runs.size(); ++i) {
      if (failed[i]) std::rethrow_exception(failed[i]);
      const ShapeDescription& first = runs[i][0];
      ShapeGroup* home = &group;
      if (is_moving(first) && !made[i].empty()) {
        home = scene_->moving_shapes.emplace_back(std::make_unique<ShapeGroup>()).get();
        home->accelerator = std::make_unique<EmbreeScene>(device_);
        moving.emplace_back(&first, home);
      }
      for (const ShapePtr& shape : made[i]) add_shape(first, shape, *home);
      for (const ShapeDescription& description : runs[i])
        report_unused_parameters(description, diagnostics_);
      if (home != &group) home->accelerator->commit();
    }
    for (const auto& [shape, home] : moving)
      place(shape->where, *home, {shape->transform.start, shape->transform.end}, group);
  }

  void add_shape(const ShapeDescription& description, const ShapePtr& shape, ShapeGroup& group) {
    ShapeRecord record;
    record.shape = shape;
    record.material = material_of(description);
    const Material& material = *scene_->materials[record.material];
    record.alpha = textures_.float_texture(description.parameters, "alpha");
    if (record.alpha && record.alpha->constant() && *record.alpha->constant() >= 1.0f)
      record.alpha = nullptr;
    record.media = {media_->named(description.inside_medium, description.where),
                    media_->named(description.outside_medium, description.where)};
    if (description.area_light) add_area_light(description, shape, material, record);
    const bool passing = material.transmits_straight() || record.alpha;
    scene_->has_passing_shapes |= passing;
    if (contains(material.possible_classes(), EventClass::kSpecular))
      scene_->has_specular_material = true;
    record.merges_photons = shape->merges_photons();
    inside_out_.add(description, record, material, group);
    group.accelerator->add_shape(shape, passing ? kMaskPassing : kMaskOpaque);
    scene_->primitive_count += shape->primitive_count();
    ++scene_->shape_count;
    group.records.push_back(std::move(record));
  }

  void add_area_light(const ShapeDescription& description, const ShapePtr& shape,
                      const Material& material, ShapeRecord& record) {
    if (material.is_interface()) {
      diagnostics_.warn(description.area_light->where,
                        "an area light on an \"interface\" material does not emit");
      return;
    }
    std::vector<LightPtr> lights =
        make_area_lights(*description.area_light, shape, *d_.files, textures_, record.alpha,
                         material.transmits_straight(), diagnostics_);
    if (lights.empty()) return;
    record.first_light = static_cast<int>(scene_->lights.size());
    for (LightPtr& light : lights) {
      scene_->lights.push_back(std::move(light));
      scene_->light_media.push_back(record.media);
      scene_->light_labels.push_back(light_labels_.area_light(*description.area_light));
      scene_->light_places.push_back(description.area_light->where);
    }
  }

  void add_instance(const InstanceDescription& instance,
                    const std::map<std::string, const ShapeGroup*>& by_name) {
    const auto it = by_name.find(instance.object);
    if (it == by_name.end())
      throw SceneError(
          instance.where,
          "object \"" + instance.object + "\" is not defined, expected the name of an ObjectBegin");
    if (it->second->records.empty() && it->second->instances.empty()) {
      diagnostics_.warn(instance.where, "object \"" + instance.object + "\" has no shapes");
      return;
    }
    place(instance.where, *it->second,
          {instance.transform.start, instance.transform.end, instance_pivot_}, scene_->top);
    ++scene_->instance_count;
  }

  // Places a finished group in another one that is still being built.
  static void place(const SourceLocation& where, const ShapeGroup& group,
                    const MotionTransform& motion, ShapeGroup& into) {
    const EmbreeScene& child = *group.accelerator;
    check_placement(where, child.bounds(), motion);
    if (motion.moves())
      into.accelerator->add_moving_instance(child, motion, kMaskAll);
    else
      into.accelerator->add_instance(child, motion.at(0.0f), kMaskAll);
    into.instances.push_back({&group, motion});
  }

  // The ray tracer inverts the matrix of an instance in single precision.
  static void check_placement(const SourceLocation& where, const Bounds3f& object,
                              const MotionTransform& motion) {
    for (const float time : {0.0f, 1.0f}) {
      const double volume = std::abs(motion.at(time).m.determinant());
      if (!(volume > 1e-36 && volume < 1e36))
        throw SceneError(where,
                         "the transform of this instance is too extreme, expected scales from "
                         "1e-12 to 1e12");
    }
    const Bounds3f reached = motion.bounds(object, 0.0f, 1.0f);
    if (!is_in_reach(reached.min) || !is_in_reach(reached.max))
      throw SceneError(where,
                       "this instance is too large or too far away, expected coordinates "
                       "up to 1e17");
  }

  // In smaller and larger scenes path densities and the ray tracer's products leave the range of
  // single precision. Images are then wrong: too dark by path tracing, too bright by photon
  // merging.
  void check_size(const SourceLocation& file) const {
    constexpr float kMinRadius = 1e-8f, kMaxRadius = 1e13f;
    if (scene_->shape_count > 0 && scene_->sphere.radius < kMinRadius)
      throw SceneError(
          file,
          "the scene's radius is below 1e-8 units, expected at least 1e-8: use a smaller unit of "
          "length, or a Scale before the camera and one after WorldBegin");
    if (scene_->sphere.radius > kMaxRadius)
      throw SceneError(
          file,
          "the scene's radius is above 1e13 units, expected at most 1e13: use a larger unit of "
          "length, or a Scale before the camera and one after WorldBegin");
  }

  // The origin of pbrt-v4's rendering space: the camera in the middle of its motion.
  void find_instance_pivot() {
    if (!scene_->options.turn_about_camera || !d_.camera) return;
    const TransformDescription& camera = d_.camera->world_to_camera;
    const Mat44d start = camera.start.inverse(), end = camera.end.inverse();
    for (int j = 0; j < 3; ++j) instance_pivot_[j] = 0.5 * (start[3][j] + end[3][j]);
  }

  void finish() {
    const Bounds3f bounds = scene_->top.accelerator->bounds();
    if (!bounds.isEmpty()) {
      scene_->sphere.center = (bounds.min + bounds.max) * 0.5f;
      scene_->sphere.radius = length(bounds.max - scene_->sphere.center);
    }
    if (!(scene_->sphere.radius > 0)) scene_->sphere.radius = 1;
    const SourceLocation file{std::make_shared<const std::string>(d_.file), 0, 0};
    check_size(file);
    const bool fog = std::ranges::any_of(
        scene_->media, [](const MediumPtr& medium) { return !medium->is_purely_absorbing(); });
    for (const LightPtr& light : scene_->lights) {
      light->set_scene_sphere(scene_->sphere);
      if (fog) light->leave_out_nothing();
    }
    surround_infinite_lights(*scene_, d_, *media_);
    scene_->light_sampler = std::make_unique<LightSampler>(scene_->lights);
    inside_out_.report(scene_->top, scene_->camera->camera_to_world(0.0f).point(Vec3f(0, 0, 0)),
                       diagnostics_);
    if (scene_->shape_count == 0) diagnostics_.warn(file, "the scene has no shapes");
    if (scene_->lights.empty())
      diagnostics_.warn(file, "the scene has no light, the picture will be black");
    if (!d_.camera)
      diagnostics_.warn(file,
                        "the scene has no Camera, so a perspective camera at the origin is used");
  }

  const SceneDescription& d_;
  Diagnostics& diagnostics_;
  TextureLibrary textures_;
  LightLabels light_labels_;
  InsideOutCheck inside_out_;
  std::unique_ptr<Scene> scene_;
  std::shared_ptr<EmbreeDevice> device_;
  std::map<std::string, int> material_index_;
  std::optional<MediaByName> media_;
  Vec3d instance_pivot_{0, 0, 0};  ///< pivot of moving instances
};

}  // namespace

std::unique_ptr<Scene> build_scene(const SceneDescription& description,
                                   const SceneOverrides& overrides, Diagnostics& diagnostics) {
  return SceneBuilder(description, overrides, diagnostics).build();
}

}  // namespace nephroid

#include "scene/scene_view.h"

#include <optional>
#include <utility>

#include "scene/camera/camera.h"
#include "scene/film_description.h"
#include "scene/surrounding_medium.h"

namespace nephroid {

MediaByName::MediaByName(const SceneDescription& description, const Scene& scene) {
  for (size_t i = 0; i < description.media.size(); ++i)
    media_[description.media[i].name] = scene.media[i].get();
}

const Medium* MediaByName::named(const std::string& name, const SourceLocation& where) const {
  if (name.empty()) return nullptr;
  const auto found = media_.find(name);
  if (found != media_.end()) return found->second;
  throw SceneError(
      where, "medium \"" + name + "\" is not defined, expected the name of a MakeNamedMedium");
}

void set_film_and_camera(Scene& scene, const SceneDescription& description,
                         const SceneOverrides& overrides, Diagnostics& diagnostics) {
  FilmDescription film = make_film_description(description, overrides, diagnostics);
  scene.camera = make_camera(description, {film.width, film.height, film.diagonal_mm}, diagnostics);
  scene.film = std::move(film);
}

const Medium* medium_of_camera(const SceneDescription& description, const MediaByName& media) {
  if (!description.camera) return nullptr;
  return media.named(description.camera->medium, description.camera->where);
}

MediumInterface medium_around(const LightDescription& light, const MediaByName& media) {
  const Medium* around = media.named(light.medium, light.where);
  return {around, around};
}

void surround_infinite_lights(Scene& scene, const SceneDescription& description,
                              const MediaByName& media) {
  if (scene.media.empty()) return;
  const std::optional<const Medium*> medium = surrounding_medium(scene);
  for (size_t i = 0; i < description.lights.size(); ++i)
    scene.light_media[i] = medium && scene.lights[i]->is_infinite()
                               ? MediumInterface{*medium, *medium}
                               : medium_around(description.lights[i], media);
}

void renew_camera(Scene& scene, const SceneDescription& description,
                  const SceneOverrides& overrides, Diagnostics& diagnostics) {
  const MediaByName media(description, scene);
  const Medium* camera_medium = medium_of_camera(description, media);
  set_film_and_camera(scene, description, overrides, diagnostics);
  scene.camera_medium = camera_medium;
  surround_infinite_lights(scene, description, media);
}

}  // namespace nephroid

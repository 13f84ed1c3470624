// The view of a scene: film, camera and what depends on them. build_scene makes it with the rest,
// renew_camera anew in a built scene. It must not know shapes.
#pragma once

#include <map>
#include <string>

#include "scene/scene.h"

namespace nephroid {

/// The media of a scene, by the names of its description.
class MediaByName {
 public:
  MediaByName(const SceneDescription& description, const Scene& scene);
  /// Null, which is empty space, for the empty name. Throws SceneError at `where` for a name that
  /// is not defined.
  const Medium* named(const std::string& name, const SourceLocation& where) const;

 private:
  std::map<std::string, const Medium*> media_;
};

/// Makes film and camera. Throws SceneError or UsageError, and the scene keeps what it had.
void set_film_and_camera(Scene& scene, const SceneDescription& description,
                         const SceneOverrides& overrides, Diagnostics& diagnostics);

/// The medium that the file sets for its camera. Throws SceneError.
const Medium* medium_of_camera(const SceneDescription& description, const MediaByName& media);
/// The medium that the file sets for a light. Throws SceneError.
MediumInterface medium_around(const LightDescription& light, const MediaByName& media);
/// Photons of infinite lights start in the medium in which camera paths leave the scene, whatever
/// medium the file has set for them. If that differs by direction, the file's counts.
void surround_infinite_lights(Scene& scene, const SceneDescription& description,
                              const MediaByName& media);

/// Makes film, camera and camera medium of a built scene anew, from its own description with
/// another camera or film, in milliseconds. Not while a thread reads the scene; what was made for
/// it (films, estimators, learned values) is of the old camera. Moving instances go on turning
/// about the camera with which the scene was built, and there is no new look for inside-out glass.
/// Throws SceneError or UsageError, and the scene stays as it was.
void renew_camera(Scene& scene, const SceneDescription& description,
                  const SceneOverrides& overrides, Diagnostics& diagnostics);

}  // namespace nephroid

// The first surface of a camera path, for the geometric layers of a gbuffer film. It must not know
// channels or files.
#pragma once

#include "film/film.h"
#include "scene/scene.h"
#include "transport/camera_path.h"

namespace nephroid {

/// The first surface of a path, world space; normals as the shape has them.
struct FirstSurface {
  Vec3f p, ng, ns, wo;
  Vec2f uv;
};

/// The same in the coordinate system that the scene's film asks for, normals towards the viewer.
/// Depth differences are those of the plane of the surface between the path's film point and ones a
/// sample's distance away, as pbrt-v4 takes it: 1/sqrt(samples) pixels, at least 1/8.
SurfaceSample surface_sample(const Scene& scene, const CameraPath& path, const FirstSurface& first);

}  // namespace nephroid

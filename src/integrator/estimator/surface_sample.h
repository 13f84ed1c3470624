// The first surface of a camera path, for the geometric layers of a gbuffer film. It must not know
// channels or files.
#pragma once

#include "film/film.h"
#include "scene/scene.h"
#include "transport/camera_path.h"

namespace nephroid {

/// The first surface of a path in world space, with the shape's own normals.
struct FirstSurface {
  Vec3f p, ng, ns, wo;
  Vec2f uv;
};

/// The surface in the coordinate system of the scene's film, normals towards the viewer. Depth
/// differences are taken on the tangent plane, between the path's film point and film points a
/// sample's distance away: 1/sqrt(samples) pixels, at least 1/8, as in pbrt-v4.
SurfaceSample surface_sample(const Scene& scene, const CameraPath& path, const FirstSurface& first);

}  // namespace nephroid

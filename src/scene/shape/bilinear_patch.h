// One bilinear patch p(u,v) over four corners as pure geometry, in double. It must not know meshes,
// normals or texture coordinates. Intersection: Reshetov, Cool Patches: A Geometric Approach to
// Ray/Bilinear Patch Intersections, Ray Tracing Gems, 2019.
#pragma once

#include "core/math.h"

namespace nephroid {

struct BilinearPatch {
  Vec3d p00, p10, p01, p11;  ///< the first digit is u

  struct Hit {
    double t, u, v;
  };
  struct Hits {
    int count = 0;
    Hit hit[2];
  };

  Vec3d point(double u, double v) const {
    return (p00 * (1.0 - v) + p01 * v) * (1.0 - u) + (p10 * (1.0 - v) + p11 * v) * u;
  }
  Vec3d dpdu(double v) const { return (p10 - p00) * (1.0 - v) + (p11 - p01) * v; }
  Vec3d dpdv(double u) const { return (p01 - p00) * (1.0 - u) + (p11 - p10) * u; }
  Vec3d d2pduv() const { return (p00 - p01) + (p11 - p10); }
  /// dpdu x dpdv; its length is the area element. Affine in u and v.
  Vec3d cross(double u, double v) const { return dpdu(v).cross(dpdv(u)); }

  /// Intersections of the line o + t d with the patch, for t of either sign, unordered.
  Hits hits(const Vec3d& o, const Vec3d& d) const;
  double area() const;
  /// True if the corners form a plane rectangle, up to the rounding of float corners (pbrt-v4's
  /// tolerances).
  bool is_rectangle() const;
};

}  // namespace nephroid

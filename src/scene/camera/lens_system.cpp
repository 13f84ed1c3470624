// Tracing through the surfaces, in double precision; see lens_system.h.
#include "scene/camera/lens_system.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/camera/aperture_shape.h"

namespace nephroid {
namespace {

Vec3d unit(const Vec3d& v) {
  return v / v.length();
}

/// Intersection of a ray with the part of a sphere around (0, 0, centre) that is the surface: the
/// first crossing if `first`, else the second. Empty if the ray misses or the point lies behind.
std::optional<Vec3d> meet_sphere(const LensRay& ray, double centre, double radius, bool first) {
  const Vec3d o(ray.o.x, ray.o.y, ray.o.z - centre);
  const double a = ray.d.dot(ray.d), b = o.dot(ray.d), c = o.dot(o) - radius * radius;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  // The sum without cancellation gives one root, the product of both roots the other.
  const double q = b < 0 ? -b + root : -b - root;
  double t0 = q / a, t1 = q == 0 ? 0 : c / q;
  if (t0 > t1) std::swap(t0, t1);
  const double t = first ? t0 : t1;
  if (!(t >= 0)) return std::nullopt;
  return ray.o + ray.d * t;
}

/// Refracts `d` (unit) at a surface with normal `n` (unit, against d). Empty for total reflection.
std::optional<Vec3d> refract(const Vec3d& d, const Vec3d& n, double eta_from, double eta_to) {
  const double eta = eta_from / eta_to, cosine = -d.dot(n);
  const double k = 1 - eta * eta * (1 - cosine * cosine);
  if (k <= 0) return std::nullopt;
  return d * eta + n * (eta * cosine - std::sqrt(k));
}

/// Traces through one surface whose vertex lies at z. False if the ray is blocked. Tables write 0
/// for the air around a stop.
bool pass(const LensSurface& surface, double z, double eta_from, double eta_to, double reach,
          LensRay* ray) {
  const bool is_stop = surface.radius == 0;
  if (is_stop) {
    const double t = (z - ray->o.z) / ray->d.z;
    if (!(t >= 0)) return false;
    ray->o += ray->d * t;
  } else {
    // The vertex is the far side of a sphere that bulges along the ray.
    const std::optional<Vec3d> hit = meet_sphere(*ray, z - surface.radius, surface.radius,
                                                 (ray->d.z > 0) != (surface.radius > 0));
    if (!hit) return false;
    ray->o = *hit;
  }
  const double limit = surface.aperture_radius * (is_stop ? reach : 1);
  if (ray->o.x * ray->o.x + ray->o.y * ray->o.y > limit * limit) return false;
  if (is_stop) return true;
  Vec3d n = unit(Vec3d(ray->o.x, ray->o.y, ray->o.z - (z - surface.radius)));
  if (n.dot(ray->d) > 0) n = -n;
  const auto medium = [](double eta) { return eta == 0 ? 1.0 : eta; };
  const std::optional<Vec3d> d = refract(unit(ray->d), n, medium(eta_from), medium(eta_to));
  if (!d) return false;
  ray->d = *d;
  return true;
}

}  // namespace

LensSystem::LensSystem(std::vector<LensSurface> surfaces,
                       std::shared_ptr<const ApertureShape> shape)
    : surfaces_(std::move(surfaces)), shape_(std::move(shape)) {}

double LensSystem::front_z() const {
  double z = 0;
  for (const LensSurface& surface : surfaces_) z += surface.thickness;
  return z;
}

std::optional<LensSystem::Passed> LensSystem::trace_from_film(const LensRay& ray) const {
  Passed passed{ray, 1};
  double z = 0;
  for (size_t i = surfaces_.size(); i-- > 0;) {
    const LensSurface& surface = surfaces_[i];
    z += surface.thickness;
    const double eta_scene = i > 0 ? surfaces_[i - 1].eta : 1;
    const bool shaped = shape_ && surface.radius == 0;
    if (!pass(surface, z, surface.eta, eta_scene, shaped ? shape_->reach() : 1, &passed.ray))
      return std::nullopt;
    if (!shaped) continue;
    passed.share *= shape_->at(passed.ray.o.x / surface.aperture_radius,
                               passed.ray.o.y / surface.aperture_radius);
    if (!(passed.share > 0)) return std::nullopt;
  }
  return passed;
}

bool LensSystem::reaches_scene(const LensRay& start) const {
  LensRay ray = start;
  const double reach = shape_ ? shape_->reach() : 1;
  double z = 0;
  for (size_t i = surfaces_.size(); i-- > 0;) {
    z += surfaces_[i].thickness;
    if (!pass(surfaces_[i], z, surfaces_[i].eta, i > 0 ? surfaces_[i - 1].eta : 1, reach, &ray))
      return false;
  }
  return true;
}

std::optional<LensRay> LensSystem::trace_from_scene(const LensRay& start) const {
  LensRay ray = start;
  double z = front_z();
  for (size_t i = 0; i < surfaces_.size(); ++i) {
    if (!pass(surfaces_[i], z, i > 0 ? surfaces_[i - 1].eta : 1, surfaces_[i].eta, 1, &ray))
      return std::nullopt;
    z -= surfaces_[i].thickness;
  }
  return ray;
}

bool LensSystem::focus(double distance, double x) {
  // Principal planes and focal points of both sides, from a ray parallel to the axis: the point of
  // the leaving ray at its original height, and its intersection with the axis. Here z grows
  // towards the film, as in the thick-lens formula of the book.
  const LensRay from_scene{{x, 0, front_z() + 1}, {0, 0, -1}};
  const LensRay from_film{{x, 0, rear_z() - 1}, {0, 0, 1}};
  const std::optional<LensRay> to_film = trace_from_scene(from_scene);
  LensSystem round(surfaces_, nullptr);
  const std::optional<Passed> to_scene = round.trace_from_film(from_film);
  if (!to_film || !to_scene) return false;
  const auto z_at_height = [](const LensRay& ray, double height) {
    return -(ray.o.z + ray.d.z * (height - ray.o.x) / ray.d.x);
  };
  const double p_film = z_at_height(*to_film, x), f_film = z_at_height(*to_film, 0);
  const double p_scene = z_at_height(to_scene->ray, x);
  const double f = f_film - p_film, z = -distance;
  const double c = (p_scene - z - p_film) * (p_scene - z - 4 * f - p_film);
  if (!(c > 0)) return false;
  const double moved = (p_scene - z + p_film - std::sqrt(c)) / 2;
  if (!std::isfinite(moved) || !(surfaces_.back().thickness + moved > 0)) return false;
  surfaces_.back().thickness += moved;
  return true;
}

PupilBounds LensSystem::bound_exit_pupil(double x0, double x1) const {
  constexpr int kFilmPoints = 5, kGrid = 96, kFinestGrid = 384, kRefinements = 2;
  const double r = 1.5 * rear_radius();
  PupilBounds outer{-r, -r, r, r};
  // The box of all grid points of `outer` through which light passes, widened by two grid cells:
  // one for the space between points, one for sharper corners of the pupil.
  const auto box_of_passing = [&](int grid) {
    PupilBounds box{kInfinity, kInfinity, -kInfinity, -kInfinity};
    const double dx = (outer.x1 - outer.x0) / (grid - 1), dy = (outer.y1 - outer.y0) / (grid - 1);
    for (int k = 0; k < kFilmPoints; ++k) {
      const Vec3d film(x0 + (x1 - x0) * k / (kFilmPoints - 1), 0, 0);
      for (int j = 0; j < grid; ++j)
        for (int i = 0; i < grid; ++i) {
          const Vec3d rear(outer.x0 + dx * i, outer.y0 + dy * j, rear_z());
          if (rear.x >= box.x0 && rear.x <= box.x1 && rear.y >= box.y0 && rear.y <= box.y1)
            continue;
          if (!reaches_scene({film, rear - film})) continue;
          box.x0 = std::min(box.x0, rear.x);
          box.x1 = std::max(box.x1, rear.x);
          box.y0 = std::min(box.y0, rear.y);
          box.y1 = std::max(box.y1, rear.y);
        }
    }
    return PupilBounds{box.x0 - 2 * dx, box.y0 - 2 * dy, box.x1 + 2 * dx, box.y1 + 2 * dy};
  };
  PupilBounds box = box_of_passing(kGrid);
  // A pupil smaller than the cells is searched with finer ones first.
  for (int grid = 4 * kGrid; box.empty() && grid <= kFinestGrid; grid *= 4)
    box = box_of_passing(grid);
  if (box.empty()) return {};
  for (int k = 0; k < kRefinements; ++k) {
    outer = box;
    const PupilBounds finer = box_of_passing(kGrid);
    if (finer.empty()) break;
    box = finer;
  }
  return box;
}

}  // namespace nephroid

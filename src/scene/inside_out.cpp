#include "scene/inside_out.h"

#include <algorithm>
#include <string>

#include "core/counted.h"

namespace nephroid {
namespace {

Bounds3f bounds_of(const Shape& shape) {
  Bounds3f bounds;
  for (uint32_t i = 0; i < shape.primitive_count(); ++i) bounds.extendBy(shape.bounds(i));
  return bounds;
}

std::string message_of(const ShapeDescription& description) {
  const std::string cause = description.reverse_orientation
                                ? "because of ReverseOrientation"
                                : "by its normals or the order of its vertices";
  return "this \"" + description.type + "\" of dielectric is inside out " + cause +
         ": it is rendered as a bubble of air in glass, expected normals that point outwards";
}

bool is_inside(const Bounds3f& a, const Bounds3f& b) {
  return b.intersects(a.min) && b.intersects(a.max);
}

}  // namespace

void InsideOutCheck::add(const ShapeDescription& description, const ShapeRecord& record,
                         const Material& material, const ShapeGroup& group) {
  const std::optional<float> index = material.refractive_index();
  if (!index) return;
  const bool inside_out = *index > 1 && !record.alpha && record.media.outside == nullptr &&
                          record.shape->is_inside_out();
  bodies_.push_back({description.where, inside_out ? message_of(description) : std::string(),
                     bounds_of(*record.shape), &group});
}

bool InsideOutCheck::may_be_wanted(const Body& body, const ShapeGroup& top,
                                   const Vec3f& eye) const {
  if (body.group == &top && body.bounds.intersects(eye)) return true;
  // A bubble lies in other glass, which can be an open surface of water.
  return std::any_of(bodies_.begin(), bodies_.end(), [&](const Body& other) {
    if (&other == &body) return false;
    if (other.group != body.group) return true;
    const Vec3f size = other.bounds.size();
    const bool is_flat = std::min({size.x, size.y, size.z}) <= 0.0f;
    return is_flat ||
           (other.bounds.intersects(body.bounds) && !is_inside(other.bounds, body.bounds));
  });
}

void InsideOutCheck::report(const ShapeGroup& top, const Vec3f& eye,
                            Diagnostics& diagnostics) const {
  // Pairwise comparison, too slow for more; such large scenes are taken to be intended.
  constexpr size_t kMaxBodies = 4096;
  if (bodies_.size() > kMaxBodies) return;
  const Body* first = nullptr;
  size_t count = 0;
  for (const Body& body : bodies_)
    if (!body.message.empty() && !may_be_wanted(body, top, eye)) {
      if (count++ == 0) first = &body;
    }
  if (first == nullptr) return;
  diagnostics.warn(first->where,
                   count == 1
                       ? first->message
                       : first->message + "; also inside out: " + counted(count - 1, "more shape"));
}

}  // namespace nephroid

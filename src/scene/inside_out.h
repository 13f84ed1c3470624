// Warns of inside-out glass, which renders as a bubble of air in glass; silent where that can be
// intended. It must not know rays.
#pragma once

#include <vector>

#include "input/scene_description.h"
#include "scene/scene.h"

namespace nephroid {

class InsideOutCheck {
 public:
  /// Adds a shape of the scene. Shapes of one group share a space.
  void add(const ShapeDescription& description, const ShapeRecord& record, const Material& material,
           const ShapeGroup& group);
  /// `eye`: position of the camera.
  void report(const ShapeGroup& top, const Vec3f& eye, Diagnostics& diagnostics) const;

 private:
  /// A refractive shape.
  struct Body {
    SourceLocation where;
    std::string message;  ///< empty if it is not inside out
    Bounds3f bounds;
    const ShapeGroup* group = nullptr;
  };
  bool may_be_wanted(const Body& body, const ShapeGroup& top, const Vec3f& eye) const;

  std::vector<Body> bodies_;
};

}  // namespace nephroid

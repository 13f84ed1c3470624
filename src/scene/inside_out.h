// Warns of glass whose outside is its inside: it renders as a bubble of air in glass. Where that
// may be wanted, nothing is said. It must not know rays.
#pragma once

#include <vector>

#include "input/scene_description.h"
#include "scene/scene.h"

namespace nephroid {

class InsideOutCheck {
 public:
  /// A shape of the scene; shapes of one group share a space.
  void add(const ShapeDescription& description, const ShapeRecord& record, const Material& material,
           const ShapeGroup& group);
  /// `eye`: where the camera stands.
  void report(const ShapeGroup& top, const Vec3f& eye, Diagnostics& diagnostics) const;

 private:
  /// A shape that refracts.
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

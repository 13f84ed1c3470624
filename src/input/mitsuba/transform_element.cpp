#include "input/mitsuba/transform_element.h"

#include <array>
#include <optional>
#include <vector>

#include "core/counted.h"
#include "input/mitsuba/value_text.h"
#include "input/transform_directives.h"

namespace nephroid::mitsuba {
namespace {

struct Element {
  const std::string& tag;
  const Attributes& attributes;
  const SourceLocation& where;

  const std::string* find(const std::string& key) const {
    const auto it = attributes.find(key);
    return it == attributes.end() ? nullptr : &it->second;
  }
  std::string title(const std::string& key) const { return "\"" + key + "\" of <" + tag + ">"; }
  double number(const std::string& key, double fallback) const {
    const std::string* text = find(key);
    return text ? finite_number(*text, title(key), where) : fallback;
  }
  [[noreturn]] void refuse(const std::string& message) const { throw SceneError(where, message); }
};

Vec3d three_numbers(const Element& e, const std::string& key) {
  const std::vector<double> v = finite_numbers(*e.find(key), e.title(key), e.where);
  if (v.size() == 1) return Vec3d(v[0]);
  if (v.size() != 3)
    e.refuse(e.title(key) + " has " + counted(v.size(), "number") + ", expected 1 or 3");
  return {v[0], v[1], v[2]};
}

/// The vector in "value", or in "x", "y" and "z".
Vec3d vector_of(const Element& e, double fallback) {
  if (e.find("value")) return three_numbers(e, "value");
  return {e.number("x", fallback), e.number("y", fallback), e.number("z", fallback)};
}

Mat44d rotation(const Element& e) {
  if (!e.find("angle")) e.refuse("<rotate> has no \"angle\", expected one in degrees");
  const auto matrix = rotation_matrix(e.number("angle", 0), vector_of(e, 0));
  if (!matrix)
    e.refuse(
        "the axis of <rotate> is the zero vector, expected \"x\", \"y\" or \"z\" other than 0");
  return *matrix;
}

/// Numbers of a matrix stand row by row and multiply columns: ours is the transpose.
Mat44d matrix(const Element& e) {
  const std::string* text = e.find("value");
  std::vector<double> v;
  if (text) v = finite_numbers(*text, e.title("value"), e.where);
  if (v.size() != 9 && v.size() != 16)
    e.refuse("<matrix> has " + counted(v.size(), "number") + ", expected 16 or 9");
  const size_t size = v.size() == 9 ? 3 : 4;
  Mat44d m;
  for (size_t row = 0; row < size; ++row)
    for (size_t column = 0; column < size; ++column)
      m[static_cast<int>(column)][static_cast<int>(row)] = v[row * size + column];
  return m;
}

/// Local +z looks at the target, +y is up and +x to the left: the inverse of pbrt's matrix, as it
/// has the same numbers for a frame of the other handedness.
Mat44d look_at(const Element& e) {
  if (!e.find("origin") || !e.find("target"))
    e.refuse("<lookat> lacks \"origin\" or \"target\", expected both");
  const Vec3d up = e.find("up") ? three_numbers(e, "up") : Vec3d(0, 1, 0);
  const Vec3d origin = three_numbers(e, "origin"), target = three_numbers(e, "target");
  std::optional<Mat44d> world_to_local = look_at_matrix(origin, target, up);
  // Without a usable "up" Mitsuba takes any.
  if (!world_to_local) world_to_local = look_at_matrix(origin, target, Vec3d(0, 0, 1));
  if (!world_to_local) world_to_local = look_at_matrix(origin, target, Vec3d(1, 0, 0));
  if (!world_to_local) e.refuse("<lookat> has its origin at its target, expected two points");
  return world_to_local->inverse();
}

}  // namespace

Mat44d transform_element(const std::string& tag, const Attributes& attributes,
                         const SourceLocation& where) {
  const Element e{tag, attributes, where};
  Mat44d m;
  if (tag == "translate")
    m = translation_matrix(vector_of(e, 0));
  else if (tag == "scale")
    m = scale_matrix(vector_of(e, 1));
  else if (tag == "rotate")
    m = rotation(e);
  else if (tag == "matrix")
    m = matrix(e);
  else if (tag == "lookat" || tag == "lookAt")
    m = look_at(e);
  else
    e.refuse("<" + tag +
             "> in a transform is unknown, expected translate, rotate, scale, matrix "
             "or lookat");
  if (is_singular(m))
    e.refuse("<" + tag + "> has no inverse, expected a transform that can be inverted");
  return m;
}

}  // namespace nephroid::mitsuba

// JSON for the page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/color.h"
#include "core/math.h"
#include "film/film_format.h"

namespace nephroid {

using Json = nlohmann::ordered_json;

template <class T>
Json json_of(const Imath::Vec3<T>& v) {
  return {v.x, v.y, v.z};
}
inline Json json_of(const Rgb& color) {
  return {color.r, color.g, color.b};
}
inline Json json_of(const PixelBounds& bounds) {
  return {bounds.x0, bounds.y0, bounds.x1, bounds.y1};
}
/// Texts may quote any file, and JSON holds UTF-8 only. Numbers that are not finite become null.
inline std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace nephroid

// Mitsuba scenes as text, and their pictures by path tracing, a few pixels at a time.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rendering.h"
#include "unit/input/temporary_directory.h"

namespace nephroid::testing_support {

/// `<tag name="name" value="text"/>`
std::string value(const std::string& tag, const std::string& name, const std::string& text);
/// `<tag type="type">body</tag>`, with attributes after the type.
std::string plugin(const std::string& tag, const std::string& type, const std::string& body = "",
                   const std::string& attributes = "");
/// `<transform name="toWorld">elements</transform>`
std::string to_world(const std::string& elements);
/// A texture with that file for the property `name`.
std::string bitmap(const std::string& name, const std::string& file, const std::string& body = "");

/// A square film of `size` pixels with a box filter.
std::string film_of(int size);
/// A camera at `origin` with a narrow square picture of `size` pixels.
std::string camera(const std::string& origin, const std::string& target, int size = 2,
                   double fov = 0.5, const std::string& up = "0,1,0.001");
/// A camera above the origin whose picture has the edges of the square from (-1, -1) to (1, 1).
std::string square_from_above();
/// A camera above the origin with a narrow picture.
std::string from_above();
/// A diffuse square of half width 5 in the plane of x and y, which reflects 0.6.
std::string floor_of_0_6();

/// A PFM file; `pixels` in rows from the top.
std::string pfm(int width, int height, const std::vector<Rgb>& pixels);

/// True if the colours cannot be told apart.
bool is_color(const Rgb& found, const Rgb& expected);

/// Renders scenes of a folder.
class Pictures {
 public:
  const testing::TemporaryDirectory& folder() const { return folder_; }

  std::unique_ptr<Scene> scene(const std::string& body, const std::string& version = "0.6.0");
  Film film(const std::string& body, uint32_t passes, const std::string& version = "0.6.0");
  /// The colour of the first pixel.
  Rgb color(const std::string& body, uint32_t passes = 64, const std::string& version = "0.6.0");
  Estimate mean(const std::string& body, uint32_t passes = 16);

 private:
  testing::TemporaryDirectory folder_;
};

}  // namespace nephroid::testing_support

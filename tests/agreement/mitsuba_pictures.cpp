#include "agreement/mitsuba_pictures.h"

#include <cmath>

#include "input/mitsuba/mitsuba_reader.h"

namespace nephroid::testing_support {

std::string value(const std::string& tag, const std::string& name, const std::string& text) {
  return "<" + tag + " name=\"" + name + "\" value=\"" + text + "\"/>";
}

std::string plugin(const std::string& tag, const std::string& type, const std::string& body,
                   const std::string& attributes) {
  return "<" + tag + " type=\"" + type + "\" " + attributes + ">" + body + "</" + tag + ">\n";
}

std::string to_world(const std::string& elements) {
  return "<transform name=\"toWorld\">" + elements + "</transform>";
}

std::string bitmap(const std::string& name, const std::string& file, const std::string& body) {
  return plugin("texture", "bitmap", value("string", "filename", file) + body,
                "name=\"" + name + "\"");
}

std::string film_of(int size) {
  const std::string pixels = std::to_string(size);
  return plugin("film", "hdrfilm",
                value("integer", "width", pixels) + value("integer", "height", pixels) +
                    plugin("rfilter", "box"));
}

std::string camera(const std::string& origin, const std::string& target, int size, double fov,
                   const std::string& up) {
  return plugin(
      "sensor", "perspective",
      to_world("<lookat origin=\"" + origin + "\" target=\"" + target + "\" up=\"" + up + "\"/>") +
          value("float", "fov", std::to_string(fov)) + film_of(size));
}

std::string square_from_above() {
  constexpr double kDegrees = 180 / 3.14159265358979;
  return camera("0,0,5", "0,0,0", 2, 2 * std::atan(0.2) * kDegrees);
}

std::string from_above() {
  return camera("0,0,3", "0,0,0");
}

std::string floor_of_0_6() {
  return plugin("shape", "rectangle",
                to_world("<scale value=\"5\"/>") +
                    plugin("bsdf", "twosided",
                           plugin("bsdf", "diffuse", value("spectrum", "reflectance", "0.6"))));
}

std::string pfm(int width, int height, const std::vector<Rgb>& pixels) {
  std::string bytes = "PF\n" + std::to_string(width) + " " + std::to_string(height) + "\n-1.0\n";
  for (int y = height - 1; y >= 0; --y)
    bytes.append(reinterpret_cast<const char*>(&pixels[static_cast<size_t>(y) * width]),
                 static_cast<size_t>(width) * sizeof(Rgb));
  return bytes;
}

bool is_color(const Rgb& found, const Rgb& expected) {
  const auto near = [](float a, float b) { return std::abs(a - b) < 0.05f; };
  return near(found.r, expected.r) && near(found.g, expected.g) && near(found.b, expected.b);
}

std::unique_ptr<Scene> Pictures::scene(const std::string& body, const std::string& version) {
  Diagnostics diagnostics;
  const std::string path =
      folder_.write("scene.xml", "<scene version=\"" + version + "\">\n" + body + "</scene>\n");
  return build_scene(read_mitsuba(path, {}, diagnostics), {}, diagnostics);
}

Film Pictures::film(const std::string& body, uint32_t passes, const std::string& version) {
  return render(*scene(body, version), "path", {}, 1, passes);
}

Rgb Pictures::color(const std::string& body, uint32_t passes, const std::string& version) {
  return film(body, passes, version).value(0, 0);
}

Estimate Pictures::mean(const std::string& body, uint32_t passes) {
  return mean_over_seeds(*scene(body), "path", {}, 16, passes);
}

}  // namespace nephroid::testing_support

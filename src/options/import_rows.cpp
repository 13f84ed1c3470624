#include "options/import_rows.h"

#include "core/errors.h"
#include "input/option_values.h"

namespace nephroid {
namespace {

constexpr double kLongestAnimation = 1e9;  ///< seconds
constexpr double kMostStops = 60;

void set_time(CommandLine& line, const std::string& text) {
  line.import.time = parse_seconds("--at", text, kLongestAnimation);
}

void set_shutter(CommandLine& line, const std::string& text) {
  line.import.shutter = parse_seconds("--shutter", text, kLongestAnimation);
}

void set_environment(CommandLine& line, const std::string& text) {
  if (text.empty()) throw UsageError("--environment: '' is not valid, expected an image file");
  line.import.environment = text;
}

void set_sun(CommandLine& line, const std::string& text) {
  const size_t comma = text.find(',');
  if (comma == std::string::npos)
    throw UsageError("--sun: '" + text +
                     "' is not valid, expected elevation,azimuth in degrees as in 35,120");
  line.import.sun = SunDirection{parse_number("--sun", text.substr(0, comma), 0, 90, false),
                                 parse_number("--sun", text.substr(comma + 1), -360, 360, false)};
}

void add_define(CommandLine& line, const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError("--define: '" + text + "' is not valid, expected NAME=VALUE");
  line.import.defines[text.substr(0, equals)] = text.substr(equals + 1);
}

/// Rows without their command.
const OptionDescription kRows[] = {
    {"", "--camera", "", "NAME|INDEX", "", "the first", "Picture",
     "Camera of the file, by name or index from 0; info lists them.", false,
     [](CommandLine& l, const std::string& t) { l.import.camera = t; }},
    {"", "--at", "", "TIME", "s", "0", "Picture",
     "Moment of the file's animations. The shutter opens then.", false, set_time},
    {"", "--shutter", "", "TIME", "s", "0", "Picture",
     "Time for which the shutter is open, as in 1/48s. Nodes of a glTF file that move in it are "
     "blurred; the picture gets no brighter.",
     false, set_shutter, true},
    {"", "--exposure", "", "EV", "stops", "chosen for lights of glTF and OBJ, else 0", "Picture",
     "Brighten the picture by so many stops over the scene's exposure. Each doubles all values.",
     false,
     [](CommandLine& l, const std::string& t) {
       l.import.exposure = parse_number("--exposure", t, -kMostStops, kMostStops, false);
     }},
    {"", "--floor", "", "", "", "", "Scene", "Add a matte grey floor under the lowest point.",
     false, [](CommandLine& l, const std::string&) { l.import.floor = true; }},
    {"", "--environment", "", "IMAGE", "", "none", "Scene",
     "Light the scene by an image of surroundings. It is a latitude-longitude map (2:1) or an "
     "equal-area octahedral one (1:1), and replaces infinite lights. Without other lights, a white "
     "surface under it has the value 1.",
     false, set_environment},
    {"", "--sun", "", "ELEVATION,AZIMUTH", "degrees", "none", "Scene",
     "Light the scene by a clear sky and the sun at these degrees. Azimuth counts from north to "
     "east; north is -z where +y is up. It replaces distant and infinite lights, and the exposure "
     "is set for it. "
     "The sky is Hosek and Wilkie's (2012), the air Preetham's (1999), both with turbidity 3; the "
     "sun has 0.53 degrees.",
     false, set_sun},
    {"", "--variant", "", "NAME", "", "none", "Scene", "Material variant of a glTF file.", false,
     [](CommandLine& l, const std::string& t) { l.import.variant = t; }, true},
    {"", "--solid-glass", "", "", "", "", "Scene",
     "Glass without a given thickness is solid. Otherwise glTF's transmission is a thin sheet, "
     "which casts no caustics, and a d below 1 in an MTL file is opacity unless illum says glass.",
     false, [](CommandLine& l, const std::string&) { l.import.solid_glass = true; }, true},
    {"", "--define", "", "NAME=VALUE", "", "", "Scene", "Value of $NAME in a Mitsuba scene.", true,
     add_define, true},
    {"", "--allow-outside", "", "", "", "", "Scene",
     "Files outside of the scene's folder may be read. Otherwise scenes that are not pbrt-v4 can "
     "name files in it only.",
     false, [](CommandLine& l, const std::string&) { l.import.allow_outside = true; }, true},
};

}  // namespace

std::vector<OptionDescription> import_rows(const char* command) {
  std::vector<OptionDescription> rows(std::begin(kRows), std::end(kRows));
  for (OptionDescription& row : rows) row.command = command;
  return rows;
}

}  // namespace nephroid

#include "options/picture_rows.h"

#include <iterator>

#include "core/errors.h"
#include "input/option_values.h"
#include "options/output_options.h"

namespace nephroid {
namespace {

constexpr double kMaxExposure = 1e6;

void set_heat_map(CommandLine& line, const std::string& text) {
  const bool is_png = text.size() > 4 && text.compare(text.size() - 4, 4, ".png") == 0;
  if (!is_png)
    throw UsageError("--heat: '" + text + "' is not valid, expected a name that ends in .png");
  line.compare.heat_map = text;
}

const OptionDescription kPictureRows[] = {
    {"merge", "PICTURE", "", "", "", "", "",
     "Pictures of one render, of disjoint passes (render --passes A..B), or their states, which "
     "must be beside them.",
     true, [](CommandLine& l, const std::string& t) { l.merge.inputs.push_back(t); }},
    {"merge", "--output", "-o", "OUT.exr", "", "", "",
     "Their sum, from which a render can go on; its state and a PNG are written beside it.", false,
     set_output<&CommandLine::merge>},
    {"merge", "--float", "", "", "", "", "", kFloatHelp, false, set_float<&CommandLine::merge>},
    {"mix", "PICTURE", "", "", "", "", "",
     "A picture with its layers: those of routes, and those by light of render --layers.", false,
     [](CommandLine& l, const std::string& t) { l.mix.picture = t; }},
    {"mix", "--light", "", "NAME=GAIN|R,G,B", "", "1", "",
     "Multiply the light of a lamp. A single number is exact. Three tint it: an approximation, "
     "since light is rendered in spectra. nephroid info lists the lamps as layers_by_light.",
     true,
     [](CommandLine& l, const std::string& t) {
       l.mix.mix.lights.push_back(parse_mix_gain("--light", t));
     }},
    {"mix", "--route", "", "NAME=GAIN|R,G,B", "", "1", "",
     "Multiply the light of a route in the same way. Together with --light it needs a picture of "
     "render --layers both.",
     true,
     [](CommandLine& l, const std::string& t) {
       l.mix.mix.routes.push_back(parse_mix_gain("--route", t));
     }},
    {"mix", "--output", "-o", "OUT.exr", "", "", "",
     "The mixed picture with its scaled layers. A PNG is written beside it.", false,
     set_output<&CommandLine::mix>},
    {"mix", "--float", "", "", "", "", "", kFloatHelp, false, set_float<&CommandLine::mix>},
    {"compare", "REF", "", "", "", "", "", "The reference picture.", false,
     [](CommandLine& l, const std::string& t) { l.compare.reference = t; }},
    {"compare", "TEST", "", "", "", "", "", "The picture to measure, of the same size.", false,
     [](CommandLine& l, const std::string& t) { l.compare.test = t; }},
    {"compare", "--heat", "", "OUT.png", "", "none", "",
     "Write the squared relative error of each pixel in false colours and print their scale.",
     false, set_heat_map},
    {"compare", "--subtract-reference-error", "", "", "", "", "",
     "Take the reference's own error (its stderr channels) out of the squared errors.", false,
     [](CommandLine& l, const std::string&) { l.compare.subtract_reference_error = true; }},
    {"compare", "--exposure", "", "X", "", "1", "", "Exposure of both pictures for FLIP.", false,
     [](CommandLine& l, const std::string& t) {
       l.compare.exposure =
           static_cast<float>(parse_number("--exposure", t, 0, kMaxExposure, true));
     }},
};

}  // namespace

std::vector<OptionDescription> picture_rows() {
  return {std::begin(kPictureRows), std::end(kPictureRows)};
}

}  // namespace nephroid

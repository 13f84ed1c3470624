// The rows of the option table. A new option is one row here, or in picture_rows.cpp, plus its use
// in apps/.
#include "options/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "core/errors.h"
#include "input/option_values.h"
#include "input/spelling.h"
#include "integrator/presets/estimator_table.h"
#include "integrator/presets/integrator_table.h"
#include "integrator/presets/route_presets.h"
#include "options/import_rows.h"
#include "options/output_options.h"
#include "options/picture_rows.h"
#include "options/view_rows.h"

namespace nephroid {
namespace {

constexpr double kAnyNumber = std::numeric_limits<double>::infinity();
constexpr int kMaxThreads = 4096;
/// Least value of --memory: libraries, tables and threads take half of it.
constexpr uint64_t kMinMemory = uint64_t{256} << 20;
constexpr int kMaxPilotPasses = 100000;
constexpr int64_t kMaxBenchRepeats = 1000;
constexpr int64_t kMaxBenchPasses = std::numeric_limits<uint32_t>::max() - 1;

template <auto Command>
void set_integrator(CommandLine& line, const std::string& text) {
  const std::vector<std::string> names = integrator_names();
  if (text != "scene" && std::find(names.begin(), names.end(), text) == names.end()) {
    std::string known;
    for (const std::string& name : names) known += name + ", ";
    throw UsageError("--integrator: unknown integrator '" + text + "', expected one of: " + known +
                     "scene" +
                     (route_preset(text) ? " (it is a preset: --routes " + text + ")"
                                         : did_you_mean(text, names)));
  }
  (line.*Command).routes.integrator = text;
}

void set_resolution(CommandLine& line, const std::string& text) {
  const auto [width, height] = parse_resolution("--resolution", text);
  line.render.overrides.width = width;
  line.render.overrides.height = height;
}

void set_crop(CommandLine& line, const std::string& text) {
  const auto crop = parse_crop("--crop", text);
  line.render.overrides.has_crop = true;
  std::copy(crop.begin(), crop.end(), line.render.overrides.crop);
}

template <auto Command>
void add_setting(CommandLine& line, const std::string& text) {
  (line.*Command).settings.push_back(parse_setting(text));
}

void set_learned_from(CommandLine& line, const std::string& text) {
  if (text.empty()) throw UsageError("--learned-from: '' is not valid, expected a picture");
  line.render.learned_from = text;
}
void set_layers(CommandLine& line, const std::string& text) {
  constexpr std::pair<std::string_view, LayerChoice> kChoices[] = {{"routes", LayerChoice::kRoutes},
                                                                   {"lights", LayerChoice::kLights},
                                                                   {"both", LayerChoice::kBoth}};
  for (const auto& [name, choice] : kChoices)
    if (text == name) {
      line.render.routes.layers = choice;
      return;
    }
  throw UsageError("--layers: '" + text + "' is not valid, expected routes, lights or both");
}

void set_outliers(CommandLine& line, const std::string& text) {
  if (text != "reject" && text != "off")
    throw UsageError("--outliers: '" + text + "' is not valid, expected reject or off");
  line.render.reject_outliers = text == "reject";
}

template <auto Command>
void set_routes(CommandLine& line, const std::string& text) {
  (line.*Command).routes.preset_or_file = text;
}
template <auto Command>
void add_route(CommandLine& line, const std::string& text) {
  (line.*Command).routes.routes.push_back(parse_route(text, estimator_traits()));
}
template <auto Command>
void add_aov(CommandLine& line, const std::string& text) {
  (line.*Command).routes.aovs.push_back(parse_aov(text));
}
template <auto Command>
void set_strict(CommandLine& line, const std::string&) {
  (line.*Command).routes.strict = true;
}

/// "path, sppm, ...": names in help.
std::string list_of(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}
std::vector<std::string> estimator_names() {
  std::vector<std::string> names;
  for (const EstimatorTraits* estimator : estimator_traits()) names.emplace_back(estimator->name);
  return names;
}

const std::string kIntegratorHelp =
    "Rendering algorithm. One of " + list_of(integrator_names()) +
    ", or scene (the one named in the scene file). Each is a preset of routes: path is path-only, "
    "the others have the names of theirs.";
constexpr const char* kRoutesHelp =
    "Routes by the name of a preset or from a file. A file has one route a line. Replaces "
    "--integrator.";
const std::string kRouteHelp =
    "A route: which light, by which estimator. It is a light path expression and the estimator "
    "that "
    "renders what matches it: " +
    list_of(estimator_names()) + ". The first route that matches a path owns it.";
constexpr const char* kAovHelp =
    "One more layer: the light of all paths that match. It does not matter which route renders "
    "them.";
constexpr const char* kStrictHelp = "Overlapping routes are an error.";
constexpr const char* kSettingHelp =
    "Set a number of the integrator, as in max-depth=8. May be given several times.";

void set_converted(CommandLine& line, const std::string& text) {
  if (text.size() <= 5 || !text.ends_with(".pbrt"))
    throw UsageError("OUT.pbrt: '" + text + "' is not valid, expected a name that ends in .pbrt");
  line.convert.output = text;
}

void set_stream(CommandLine& line, const std::string& text) {
  line.render.stream = parse_names("--stream", text, "picture,caustic");
}

void add_only(CommandLine& line, const std::string& text) {
  for (std::string& name : parse_names("--only", text, "cup,room"))
    line.bench.only.push_back(std::move(name));
}

constexpr CommandDescription kCommands[] = {
    {"render", "Render a scene to an EXR and a PNG."},
    {"view", "Show a scene while it renders, in the browser: look around, mix its lights."},
    {"merge", "Add up pictures of different passes of one render."},
    {"mix", "Dim, brighten and tint lights and routes of a picture, without rendering again."},
    {"info", "Describe a scene file, or the render stored in a picture."},
    {"routes", "Say who renders which light, prove it, and measure it in a scene."},
    {"compare", "Measure how far a picture is from a reference."},
    {"convert", "Write a scene as a pbrt-v4 scene, with its meshes and images beside it."},
    {"bench", "Run a suite of integrators and scenes and write its results."},
};

const OptionDescription kOptions[] = {
    {"render", "SCENE", "", "", "", "", "",
     "A scene: pbrt-v4, glTF, Mitsuba XML or OBJ; - for standard input.", false,
     [](CommandLine& l, const std::string& t) { l.render.scene = t; }},
    {"render", "--output", "-o", "OUT.exr", "",
     "SCENE.exr, or as its Film says, in the current directory", "Output",
     "The picture with all its layers. A PNG is written beside it.", false,
     set_output<&CommandLine::render>},
    {"render", "--aov", "", "NAME=EXPR", "", "", "Output", kAovHelp, true,
     add_aov<&CommandLine::render>, true},
    {"render", "--layers", "", "routes|lights|both", "", "routes", "Output",
     "Layers for nephroid mix: lights adds one for each lamp, both adds one for each route and "
     "lamp, ROUTE_LAMP. With more than 12 lamps, the 11 strongest have a layer each, and the rest "
     "share other-lights.",
     false, set_layers, true},
    {"render", "--resume", "", "", "", "", "Output",
     "Go on with the render of OUT.state, or start it. The result has the bits of an uninterrupted "
     "run.",
     false, [](CommandLine& l, const std::string&) { l.render.resume = true; }},
    {"render", "--learned-from", "", "PICTURE", "", "none", "Output",
     "Take what another task of the same render has learned from the state beside its picture, if "
     "there is one, instead of learning it again. The bits are the same.",
     false, set_learned_from, true},
    {"render", "--checkpoint", "", "TIME", "s, m or h", "60s", "Output",
     "How often the picture and OUT.state are written meanwhile. It is less often where that would "
     "take more than 2 % of the time.",
     false,
     [](CommandLine& l, const std::string& t) {
       l.render.checkpoint_interval = parse_duration("--checkpoint", t);
     }, true},
    {"render", "--strict", "", "", "", "", "Output",
     "Exit status 3 for unknown names, 1 for samples left out. A scene with unknown parameters, "
     "options and the like is not rendered; samples are left out if they are infinite or NaN, or "
     "their sums beyond their range.",
     false,
     [](CommandLine& l, const std::string&) { l.render.strict = true; }, true},
    {"render", "--no-state", "", "", "", "", "Output",
     "Leave no OUT.state beside the last picture. --resume and merge need it; pictures on the way, "
     "and that of a render that a signal stops, have one.",
     false,
     [](CommandLine& l, const std::string&) { l.render.keeps_state = false; }, true},
    {"render", "--float", "", "", "", "", "Output", kFloatHelp, false,
     set_float<&CommandLine::render>, true},
    {"render", "--stream", "", "LAYER,...", "", "none", "Output",
     "Write frames to standard output, for a viewer. They show the picture while it is made, with "
     "these layers: picture, routes, AOVs, albedo, N, Z (docs/stream.md). Messages are frames, "
     "too, and no file is written unless --output is given.",
     false, set_stream, true},
    {"render", "--quiet", "", "", "", "", "Output",
     "Print only errors, and warnings about the output file.",
     false, [](CommandLine& l, const std::string&) { l.render.quiet = true; }},
    {"render", "--integrator", "", "NAME", "", "mixed", "Algorithm", kIntegratorHelp.c_str(), false,
     set_integrator<&CommandLine::render>},
    {"render", "--routes", "", "PRESET|FILE", "", "those of the integrator", "Algorithm",
     kRoutesHelp, false, set_routes<&CommandLine::render>, true},
    {"render", "--route", "", "NAME=EXPR:ESTIMATOR", "", "", "Algorithm", kRouteHelp.c_str(), true,
     add_route<&CommandLine::render>, true},
    {"render", "--strict-routes", "", "", "", "", "Algorithm", kStrictHelp, false,
     set_strict<&CommandLine::render>, true},
    {"render", "-D", "", "KEY=VALUE", "", "", "Algorithm", kSettingHelp, true,
     add_setting<&CommandLine::render>},
    {"render", "--outliers", "", "reject|off", "", "off", "Algorithm",
     "reject keeps fireflies out of the picture. They are estimates isolated in position and "
     "brightness; the layer 'outliers' holds them until others confirm them.",
     false, set_outliers},
    {"render", "--seed", "", "S", "", "the scene's, else 0", "Algorithm",
     "Another seed gives another, independent picture.", false,
     [](CommandLine& l, const std::string& t) { l.render.seed = parse_seed("--seed", t); }},
    {"render", "--passes", "", "N|A..B", "passes",
     "the scene's pixel samples, if no other rule is given", "When to stop",
     "Stop after N passes. A..B renders pass A to pass B, as a part of a larger render; the first "
     "pass is 0.", false,
     [](CommandLine& l, const std::string& t) { l.render.passes = parse_passes("--passes", t); }},
    {"render", "--time", "", "TIME", "s, m or h", "no limit", "When to stop",
     "Stop after this time, of all runs (60s, 5m, 1h). If there is no picture by then it waits for "
     "one.",
     false,
     [](CommandLine& l, const std::string& t) {
       l.render.time_limit = parse_duration("--time", t);
     }},
    {"render", "--noise", "", "X", "relative error", "no target", "When to stop",
     "Stop when the estimated relative error is at most X. It is the root of the mean of (stderr^2 "
     "+ bias^2) / (value^2 + 0.01); not every algorithm can tell it (docs/integrators.md).",
     false,
     [](CommandLine& l, const std::string& t) {
       l.render.noise_target = parse_number("--noise", t, 0, kAnyNumber, true);
     }},
    {"render", "--resolution", "", "WxH", "pixels", "the scene's", "Picture",
     "Width and height of the full picture.", false, set_resolution},
    {"render", "--crop", "", "x0,x1,y0,y1", "0 to 1", "the scene's", "Picture",
     "Render a part. Left, right, top and bottom are fractions of the full picture.", false,
     set_crop},
    {"render", "--threads", "-t", "N", "threads", "all of the machine", "Machine",
     "Number of threads. The picture does not depend on it.", false,
     [](CommandLine& l, const std::string& t) {
       l.render.threads = static_cast<int>(parse_integer("--threads", t, 1, kMaxThreads));
     }},
    {"render", "--memory", "", "SIZE", "bytes", "what the machine has", "Machine",
     "Take no more memory than this (K, M, G: powers of 1024). A quarter of it at most is for "
     "textures and a quarter for photons, unless -D says otherwise. A render that needs more is "
     "refused before it starts.",
     false,
     [](CommandLine& l, const std::string& t) {
       l.render.memory = parse_bytes("--memory", t);
       if (l.render.memory < kMinMemory)
         throw UsageError("--memory: '" + t + "' is not valid, expected at least 256M");
     }, true},
    {"routes", "SCENE", "", "", "", "none", "",
     "A scene, - for standard input: what of the routes can occur in it, and how its light divides "
     "among them.", false,
     [](CommandLine& l, const std::string& t) { l.routes.scene = t; }},
    {"routes", "--integrator", "", "NAME", "", "mixed", "Routes", kIntegratorHelp.c_str(), false,
     set_integrator<&CommandLine::routes>},
    {"routes", "--routes", "", "PRESET|FILE", "", "those of the integrator", "Routes", kRoutesHelp,
     false, set_routes<&CommandLine::routes>},
    {"routes", "--route", "", "NAME=EXPR:ESTIMATOR", "", "", "Routes", kRouteHelp.c_str(), true,
     add_route<&CommandLine::routes>},
    {"routes", "--aov", "", "NAME=EXPR", "", "", "Routes", kAovHelp, true,
     add_aov<&CommandLine::routes>},
    {"routes", "--strict-routes", "", "", "", "", "Routes", kStrictHelp, false,
     set_strict<&CommandLine::routes>},
    {"routes", "-D", "", "KEY=VALUE", "", "", "Pilot", kSettingHelp, true,
     add_setting<&CommandLine::routes>},
    {"routes", "--passes", "", "N", "passes", "8", "Pilot",
     "Passes of the small picture that measures how the scene's light divides.", false,
     [](CommandLine& l, const std::string& t) {
       l.routes.passes = static_cast<uint32_t>(parse_integer("--passes", t, 1, kMaxPilotPasses));
     }},
    {"info", "FILE", "", "", "", "", "",
     "A scene (pbrt-v4, glTF, Mitsuba XML or OBJ), - for standard input, or an EXR picture that "
     "this program wrote.", false,
     [](CommandLine& l, const std::string& t) { l.info.file = t; }},
    {"convert", "IN", "", "", "", "", "",
     "A scene: pbrt-v4, glTF, Mitsuba XML or OBJ; - for standard input.", false,
     [](CommandLine& l, const std::string& t) { l.convert.input = t; }},
    {"convert", "OUT.pbrt", "", "", "", "", "",
     "The scene as text. Meshes and images are files beside it, OUT-1.ply, OUT-2.png ...; numbers "
     "that are taken are passed over.", false,
     set_converted},
    {"bench", "SUITE", "", "", "", "", "", "A suite (docs/bench.md has the format).", false,
     [](CommandLine& l, const std::string& t) { l.bench.suite = t; }},
    {"bench", "--time", "", "TIME", "s, m or h", "the suite's", "",
     "Every run ends after this time (60s, 5m, 1h).", false,
     [](CommandLine& l, const std::string& t) {
       l.bench.time_limit = parse_duration("--time", t);
     }},
    {"bench", "--passes", "", "N", "passes", "the suite's", "", "Every run has N passes.", false,
     [](CommandLine& l, const std::string& t) {
       l.bench.passes = static_cast<uint32_t>(parse_integer("--passes", t, 1, kMaxBenchPasses));
     }},
    {"bench", "--repeat", "", "N", "renders", "the suite's, or 1", "",
     "Every run is rendered so many times, with its seed and those that follow; errors are those "
     "of all.",
     false,
     [](CommandLine& l, const std::string& t) {
       l.bench.repeat = static_cast<uint32_t>(parse_integer("--repeat", t, 1, kMaxBenchRepeats));
     }},
    {"bench", "--out", "", "DIR", "", "the suite's name and .bench, in the current directory", "",
     "Directory of the results; runs that are there already are not repeated.",
     false, [](CommandLine& l, const std::string& t) { l.bench.directory = t; }},
    {"bench", "--only", "", "SCENE,...", "", "all", "", "Scenes of the suite, by name.", true,
     add_only},
    {"bench", "--threads", "-t", "N", "threads", "all of the machine", "",
     "Number of threads; times depend on it, passes do not.", false,
     [](CommandLine& l, const std::string& t) {
       l.bench.threads = static_cast<int>(parse_integer("--threads", t, 1, kMaxThreads));
     }},
    {"bench", "--strict-claims", "", "", "", "", "",
     "Exit status 1 if a claim of the suite is not borne out.", false,
     [](CommandLine& l, const std::string&) { l.bench.strict_claims = true; }},
    {"bench", "--quiet", "", "", "", "", "", "Print nothing but errors.", false,
     [](CommandLine& l, const std::string&) { l.bench.quiet = true; }},
};

}  // namespace

std::span<const CommandDescription> command_table() {
  return kCommands;
}
std::span<const OptionDescription> option_table() {
  static const std::vector<OptionDescription> kTable = [] {
    std::vector<OptionDescription> table;
    for (const OptionDescription& row : kOptions) {
      table.push_back(row);
      // Those about scene files follow the last argument of the commands that read one.
      const std::string name = row.name;
      if (name != "SCENE" && name != "FILE" && name != "OUT.pbrt") continue;
      const std::vector<OptionDescription> shared = import_rows(row.command);
      table.insert(table.end(), shared.begin(), shared.end());
    }
    const std::vector<OptionDescription> of_pictures = picture_rows();
    table.insert(table.end(), of_pictures.begin(), of_pictures.end());
    const std::vector<OptionDescription> view = view_rows(table);
    table.insert(table.end(), view.begin(), view.end());
    return table;
  }();
  return kTable;
}

}  // namespace nephroid

// docs/scene-support.md is current and true: the loader reads only listed parameters, reads all
// that are called rendered, and warns and fails where the page says so.
#include "options/scene_support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "input/convert/dialect.h"
#include "input/option_directive.h"
#include "input/pbrt_parser.h"
#include "options/obj_support.h"
#include "scene/scene.h"
#include "session/settings/integrator_choice.h"
#include "source_directory.h"
#include "unit/input/temporary_directory.h"
#include "unit/medium/nanovdb_writer.h"

namespace nephroid {
namespace {

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Observations from loading one scene.
struct Outcome {
  std::set<std::string> asked;  ///< parameters of the directive under test that were read
  std::string messages;         ///< warnings, notes and the error, one per line
  bool failed = false;
};

/// Loads tiny scenes with one directive under test.
class Loader {
 public:
  Loader() {
    files_.write("quad.ply",
                 "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                 "property float z\nproperty float u\nproperty float v\nelement face 2\n"
                 "property list uchar int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 1 0\n"
                 "1 1 0 1 1\n0 1 0 0 1\n3 0 1 2\n3 0 2 3\n");
    files_.write("image.ppm", "P3 2 2 255\n9 9 9 200 9 9 9 200 9 9 9 200\n");
    testing_medium::VoxelBox box;
    box.name = "density";
    box.first = {0, 0, 0};
    box.last = {1, 1, 1};
    box.value = [](int, int, int) { return 1.0f; };
    testing_medium::write_nanovdb(files_.path("cloud.nvdb"), {box});
  }

  /// Textures are loaded with both kinds of values, integrators as the scene's own choice.
  Outcome load(const std::string& directive, const std::string& type,
               const std::string& parameters) const {
    const std::string given = base(directive, type) + " " + parameters;
    if (directive != "Texture") return load_text(directive, scene(directive, type, given));
    Outcome both = load_text(directive, scene(directive, "t\" \"float\" \"" + type, given));
    const std::string spectra =
        std::regex_replace(given, std::regex("\"float (tex|v[01]|value|inside)"), "\"spectrum $1");
    const Outcome other =
        load_text(directive, scene(directive, "t\" \"spectrum\" \"" + type, spectra));
    both.asked.insert(other.asked.begin(), other.asked.end());
    both.messages += other.messages;
    both.failed = both.failed && other.failed;
    return both;
  }

 private:
  /// The parameters that the type requires.
  static std::string base(const std::string& directive, const std::string& type) {
    static const std::map<std::string, std::string> kNeeded = {
        {"Camera realistic", R"("string lensfile" "no lenses")"},
        {"Shape trianglemesh", R"("point3 P" [ 0 0 0 1 0 0 0 1 0 ])"},
        {"Shape plymesh", R"("string filename" "quad.ply")"},
        {"Shape bilinearmesh", R"("point3 P" [ 0 0 0 1 0 0 0 1 0 1 1 0 ])"},
        {"Shape loopsubdiv",
         R"("point3 P" [ 0 0 0 1 0 0 0 1 0 ] "integer indices" [ 0 1 2 ] "integer levels" 1)"},
        {"Shape curve", R"("point3 P" [ 0 0 0 1 0 0 1 1 0 2 1 0 ])"},
        {"Material mix", R"("string materials" [ "m" "m" ])"},
        {"Texture imagemap", R"("string filename" "image.ppm")"},
        {"LightSource projection", R"("string filename" "image.ppm")"},
        {"MakeNamedMedium uniformgrid", R"("float density" 1)"},
        {"MakeNamedMedium rgbgrid", R"("rgb sigma_a" [ 1 1 1 ])"},
        {"MakeNamedMedium nanovdb", R"("string filename" "cloud.nvdb")"},
    };
    const auto found = kNeeded.find(directive + " " + type);
    return found == kNeeded.end() ? "" : found->second;
  }

  static std::string scene(const std::string& directive, const std::string& type,
                           const std::string& parameters) {
    const auto line = [&](const std::string& name, const std::string& otherwise) {
      return name + (directive == name ? " \"" + type + "\" " + parameters : otherwise) + "\n";
    };
    const auto also = [&](const std::string& name) {
      return directive == name ? line(name, "") : std::string();
    };
    return line("Camera", R"( "perspective")") +
           line("Film", R"( "rgb" "integer xresolution" 4 "integer yresolution" 4)") +
           line("PixelFilter", R"( "box")") + line("Sampler", R"( "independent")") +
           line("Integrator", R"( "path" "integer maxdepth" 3)") +
           line("Accelerator", R"( "bvh")") + "WorldBegin\n" +
           (directive == "MakeNamedMedium"
                ? "MakeNamedMedium \"fog\" \"string type\" \"" + type + "\" " + parameters + "\n"
                : "") +
           also("LightSource") + "LightSource \"point\"\n" + also("Texture") + also("Material") +
           "MakeNamedMaterial \"m\" \"string type\" \"diffuse\"\nNamedMaterial \"m\"\n" +
           also("AreaLightSource") + line("Shape", R"( "disk")");
  }

  static ParameterSet* under_test(const std::string& directive, SceneDescription& d) {
    if (directive == "Camera") return &d.camera->parameters;
    if (directive == "Film") return &d.film->parameters;
    if (directive == "PixelFilter") return &d.pixel_filter->parameters;
    if (directive == "Sampler") return &d.sampler->parameters;
    if (directive == "Integrator") return &d.integrator->parameters;
    if (directive == "Accelerator") return &d.accelerator->parameters;
    if (directive == "Shape") return &d.shapes[0].parameters;
    if (directive == "Material") return &d.materials[0].parameters;
    if (directive == "Texture") return &d.textures[0].parameters;
    if (directive == "LightSource") return &d.lights[0].parameters;
    if (directive == "AreaLightSource") return &d.shapes[0].area_light->parameters;
    if (directive == "MakeNamedMedium") return &d.media[0].parameters;
    return nullptr;
  }

  Outcome load_text(const std::string& directive, const std::string& text) const {
    Outcome outcome;
    Diagnostics diagnostics;
    try {
      SceneDescription d = parse_pbrt_string(text, "t.pbrt", files_.path(), diagnostics);
      ParameterSet* parameters = under_test(directive, d);
      if (!parameters) throw std::logic_error("no such directive: " + directive);
      parameters->asked = &outcome.asked;
      const auto scene = build_scene(d, {}, diagnostics);
      const IntegratorChoice choice =
          choose_integrator(directive == "Integrator" ? "scene" : "path", scene->integrator,
                            scene->integrator_parameters, {});
      for (const std::string& said : choice.warnings) outcome.messages += said + "\n";
      for (const std::string& said : choice.notes) outcome.messages += said + "\n";
    } catch (const Error& error) {
      outcome.messages += std::string(error.what()) + "\n";
      outcome.failed = true;
    }
    for (const Warning& w : diagnostics.warnings()) outcome.messages += w.message + "\n";
    return outcome;
  }

  testing::TemporaryDirectory files_;
};

/// The parameter in scene syntax, with some value of its type.
std::string example(const FormatParameter& p) {
  const std::string type = p.type, name = p.name;
  static const std::map<std::string, std::string> kOfName = {{"mapping", "\"planar\""},
                                                             {"filename", "\"image.ppm\""},
                                                             {"aperture", "\"star\""},
                                                             {"reflectance", "[ .5 .5 .5 ]"}};
  static const std::vector<std::pair<std::string, std::string>> kOfType = {
      {"float", ".5"},         {"integer", "2"},        {"bool", "true"},
      {"string", "\"x\""},     {"point3", "[ 0 0 0 ]"}, {"vector3", "[ 0 1 0 ]"},
      {"normal", "[ 0 0 1 ]"}, {"point2", "[ 0 0 ]"},   {"rgb", "[ .5 .5 .5 ]"}};
  std::string written = type.substr(0, type.find_first_of(" ["));
  if (written == "spectrum") written = "rgb";
  if (written == "values") written = "float";
  std::string value;
  for (const auto& [known, text] : kOfType)
    if (written == known) value = text;
  EXPECT_FALSE(value.empty()) << "no example of type " << type;
  if (const auto named = kOfName.find(name); named != kOfName.end()) value = named->second;
  return "\"" + written + " " + name + "\" " + value;
}

std::vector<FormatParameter> parameters_of(const FormatType& type) {
  std::vector<FormatParameter> all;
  for (const FormatParameters& list : type.parameters)
    all.insert(all.end(), list.begin(), list.end());
  return all;
}

TEST(SceneSupport, PageIsCurrent) {
  EXPECT_EQ(read_text(testing_support::source_directory() + "/docs/scene-support.md"),
            scene_support_markdown())
      << "run tools/update_docs to make docs/scene-support.md anew";
}

TEST(ObjSupport, PageIsCurrent) {
  EXPECT_EQ(read_text(testing_support::source_directory() + "/docs/obj-support.md"),
            obj_support_markdown())
      << "run tools/update_docs to make docs/obj-support.md anew";
}

TEST(SceneSupport, ExamplesLoad) {
  // Otherwise the tests below would see only parameters read before an error.
  const Loader loader;
  const std::set<std::string> need_files = {"realistic", "measured"};
  for (const FormatKind& kind : format_kinds())
    for (const FormatType& type : kind.types) {
      if (type.support == Support::kRefused || need_files.count(type.name)) continue;
      const Outcome outcome = loader.load(kind.directive, type.name, "");
      EXPECT_FALSE(outcome.failed)
          << kind.directive << " " << type.name << ": " << outcome.messages;
    }
}

TEST(SceneSupport, LoaderAsksForWhatIsListedAndNothingElse) {
  const Loader loader;
  for (const FormatKind& kind : format_kinds()) {
    std::set<std::string> of_kind;
    for (const FormatType& type : kind.types)
      for (const FormatParameter& p : parameters_of(type)) of_kind.insert(p.name);
    for (const FormatType& type : kind.types) {
      if (type.support == Support::kRefused) continue;
      const std::string what = std::string(kind.directive) + " " + type.name;
      std::set<std::string> asked = loader.load(kind.directive, type.name, "").asked;
      for (const FormatParameter& p : parameters_of(type))
        asked.merge(loader.load(kind.directive, type.name, example(p)).asked);
      for (const FormatParameter& p : parameters_of(type))
        EXPECT_TRUE(p.support != Support::kRendered || asked.count(p.name))
            << what << ": \"" << p.name << "\" is not rendered";
      // Integrators share their parameters: the user may choose another one than the scene.
      const bool shared = std::string(kind.directive) == "Integrator";
      for (const std::string& name : asked)
        EXPECT_TRUE(type.find(name) || (shared && of_kind.count(name)))
            << what << ": \"" << name << "\" is not listed";
    }
  }
}

TEST(SceneSupport, WarningsAndErrorsComeWhereTheTablesSaySo) {
  const Loader loader;
  for (const FormatKind& kind : format_kinds()) {
    for (const FormatType& type : kind.types) {
      const std::string what = std::string(kind.directive) + " " + type.name;
      if (type.support == Support::kRefused) {
        const Outcome outcome = loader.load(kind.directive, type.name, "");
        EXPECT_TRUE(outcome.failed) << what;
        EXPECT_NE(outcome.messages.find(type.name), std::string::npos) << outcome.messages;
        continue;
      }
      for (const FormatParameter& p : parameters_of(type)) {
        if (p.support == Support::kRendered) continue;
        const std::string messages = loader.load(kind.directive, type.name, example(p)).messages;
        EXPECT_EQ(messages.find(p.name) != std::string::npos, p.support == Support::kWarned)
            << what << " " << p.name << ": " << messages;
      }
    }
  }
}

TEST(SceneSupport, OptionsWarnWhereTheTableSaysSo) {
  for (const FormatParameter& option : format_options()) {
    Diagnostics diagnostics;
    const std::string name = option.name;
    const std::string value =
        name == "rendercoordsys" ? "\"string rendercoordsys\" \"world\"" : example(option);
    build_scene(parse_pbrt_string("Option " + value + "\nWorldBegin\n", "t.pbrt", "", diagnostics),
                {}, diagnostics);
    bool warned = false;
    for (const Warning& w : diagnostics.warnings())
      warned |= w.message.find("\"" + name + "\"") != std::string::npos;
    EXPECT_EQ(warned, option.support == Support::kWarned) << name;
  }
}

TEST(SceneSupport, NamesWithoutEffectAreExplained) {
  const Loader loader;
  const auto expect = [&](const char* directive, const char* type, const char* parameter,
                          const char* message) {
    const std::string messages = loader.load(directive, type, parameter).messages;
    EXPECT_NE(messages.find(message), std::string::npos) << messages;
  };
  expect("Shape", "sphere", "\"float radus\" 1",
         "unknown parameter \"radus\" of shape \"sphere\", did you mean \"radius\"?");
  expect("Shape", "sphere", "\"float gamma\" 1",
         "unknown parameter \"gamma\" of shape \"sphere\", ignored");
  expect("Texture", "bilerp", "\"string mapping\" \"spherical\" \"float uscale\" 2",
         "parameter \"uscale\" of texture \"");
  expect("Shape", "bilinearmesh", "\"string emissionfilename\" \"x\"",
         "parameter \"emissionfilename\" of shape \"bilinearmesh\" is ignored: it tells where");
}

// Loading reaches only the branches of the examples; the loader's source text has all names.
TEST(SceneSupport, EveryNameInTheTextOfTheLoaderIsListed) {
  std::set<std::string> listed;
  for (const FormatKind& kind : format_kinds())
    for (const FormatType& type : kind.types)
      for (const FormatParameter& p : parameters_of(type)) listed.insert(p.name);
  // Roughness and index of coated conductors have a prefix.
  const std::regex getter(
      R"rx((?:\b(?:p|parameters)\.(?:get_\w+|find)\(|\b(?:float_texture|spectrum_texture|read_\w+)\((?:[\w.]+, )+(?:prefix \+ )?)"([^" ]+)")rx");
  int found = 0;
  const std::filesystem::path source(testing_support::source_directory());
  for (const char* folder : {"src/scene", "src/session", "src/integrator"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source / folder)) {
      if (!entry.is_regular_file()) continue;
      // Calls span lines: replaces white space by single spaces.
      const std::string text = std::regex_replace(read_text(entry.path()), std::regex("\\s+"), " ");
      for (std::sregex_iterator i(text.begin(), text.end(), getter), end; i != end; ++i, ++found)
        EXPECT_TRUE(listed.count((*i)[1])) << entry.path() << ": \"" << (*i)[1] << "\"";
    }
  }
  EXPECT_GT(found, 150);
}

/// True if the names that `nephroid convert` lists as the dialect have it.
bool is_listed_as_dialect(const std::string& directive, const std::string& type,
                          const std::string& parameter) {
  const std::span<const DialectName> names = dialect_names();
  return std::any_of(names.begin(), names.end(), [&](const DialectName& name) {
    return directive == name.directive && (!*name.type || type == name.type) &&
           parameter == name.parameter;
  });
}

TEST(SceneSupport, TheDialectIsListed) {
  int found = 0;
  for (const FormatKind& kind : format_kinds())
    for (const FormatType& type : kind.types) {
      const std::string note = type.note;
      if (note.ends_with("not in pbrt-v4") || note.starts_with("not of pbrt-v4")) {
        EXPECT_TRUE(is_listed_as_dialect(kind.directive, type.name, "")) << type.name;
        ++found;
        continue;
      }
      for (const FormatParameter& p : parameters_of(type)) {
        if (!std::string(p.note).ends_with("not in pbrt-v4")) continue;
        EXPECT_TRUE(is_listed_as_dialect(kind.directive, type.name, p.name))
            << type.name << " " << p.name;
        ++found;
      }
    }
  EXPECT_GT(found, 20);
}

}  // namespace
}  // namespace nephroid

// Command lines as typed by users, and the effect of the option table.
#include "options/command_line.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "core/errors.h"
#include "integrator/presets/estimator_table.h"
#include "integrator/presets/integrator_table.h"
#include "session/checkpoint/version.h"
#include "source_directory.h"

namespace nephroid {
namespace {

/// Splits at blanks.
CommandLine parse(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> arguments;
  for (std::string word; stream >> word;) arguments.push_back(word);
  return parse_command_line(arguments);
}

std::string usage_error(const std::string& text) {
  try {
    parse(text);
  } catch (const UsageError& error) {
    return error.what();
  }
  ADD_FAILURE() << "accepted: " << text;
  return "";
}

TEST(CommandLine, RenderDefaults) {
  const CommandLine line = parse("render a/b.pbrt");
  EXPECT_EQ(line.action, Action::kRender);
  EXPECT_EQ(line.render.scene, "a/b.pbrt");
  EXPECT_EQ(line.render.routes.integrator, "");
  EXPECT_EQ(line.render.output, "");
  EXPECT_FALSE(line.render.passes.has_value());
  EXPECT_FALSE(line.render.seed.has_value());
  EXPECT_EQ(line.render.time_limit, 0);
  EXPECT_EQ(line.render.noise_target, 0);
  EXPECT_EQ(line.render.threads, 0);
  EXPECT_FALSE(line.render.overrides.has_crop);
  EXPECT_EQ(line.render.overrides.width, 0);
  EXPECT_FALSE(line.render.reject_outliers);
  EXPECT_FALSE(line.render.quiet);
}

TEST(CommandLine, OutliersAreRejectedWhenAskedFor) {
  EXPECT_TRUE(parse("render s.pbrt --outliers reject").render.reject_outliers);
  EXPECT_FALSE(parse("render s.pbrt --outliers off").render.reject_outliers);
  EXPECT_EQ(usage_error("render s.pbrt --outliers yes"),
            "--outliers: 'yes' is not valid, expected reject or off");
  EXPECT_EQ(usage_error("render s.pbrt -D outlier-neighbours=1"),
            "-D outlier-neighbours: '1' is not valid, expected a whole number from 2 to 1000");
}

TEST(CommandLine, OptionsThatDoNotRepeatAreGivenOnce) {
  EXPECT_EQ(usage_error("render s.pbrt --passes 3 --passes 4"),
            "--passes is given 2 times, expected once");
  EXPECT_EQ(usage_error("render s.pbrt -o a.exr --output b.exr"),
            "--output is given 2 times, expected once");
  EXPECT_EQ(parse("render -o a.exr s.pbrt").render.scene, "s.pbrt");
}

TEST(CommandLine, RenderWithEverything) {
  const CommandLine line = parse(
      "render -o out.exr --integrator path --passes 2..5 --time 1.5m --noise 0.01 "
      "--resolution 64x48 --crop 0,0.5,0.25,1 -t 3 --seed 9 -D max-depth=7 -D "
      "specular-alpha=0.1..0.3 "
      "--quiet scene.pbrt");
  const RenderCommand& r = line.render;
  EXPECT_EQ(r.scene, "scene.pbrt");
  EXPECT_EQ(r.output, "out.exr");
  EXPECT_EQ(r.routes.integrator, "path");
  EXPECT_EQ(r.passes->first, 2u);
  EXPECT_EQ(r.passes->second, 5u);
  EXPECT_EQ(r.time_limit, 90);
  EXPECT_EQ(r.noise_target, 0.01);
  EXPECT_EQ(r.overrides.width, 64);
  EXPECT_EQ(r.overrides.height, 48);
  EXPECT_TRUE(r.overrides.has_crop);
  EXPECT_EQ(r.overrides.crop[2], 0.25f);
  EXPECT_EQ(r.threads, 3);
  EXPECT_EQ(*r.seed, 9u);
  ASSERT_EQ(r.settings.size(), 2u);
  EXPECT_EQ(r.settings[0], (std::pair<std::string, std::string>("max-depth", "7")));
  EXPECT_EQ(r.settings[1], (std::pair<std::string, std::string>("specular-alpha", "0.1..0.3")));
  EXPECT_TRUE(r.quiet);
}

TEST(CommandLine, OtherSpellings) {
  EXPECT_EQ(parse("render --output=x.exr s.pbrt").render.output, "x.exr");
  EXPECT_EQ(parse("render s.pbrt -t2").render.threads, 2);
  EXPECT_EQ(parse("render s.pbrt --threads 2").render.threads, 2);
  // A setting takes one word and does not consume the scene's name.
  EXPECT_EQ(parse("render -D radius=2 s.pbrt").render.scene, "s.pbrt");
}

TEST(CommandLine, InfoAndCompare) {
  const CommandLine info = parse("info s.pbrt");
  EXPECT_EQ(info.action, Action::kInfo);
  EXPECT_EQ(info.info.file, "s.pbrt");
  const CommandLine compare = parse("compare a.exr b.exr --heat h.png --subtract-reference-error");
  EXPECT_EQ(compare.action, Action::kCompare);
  EXPECT_EQ(compare.compare.reference, "a.exr");
  EXPECT_EQ(compare.compare.test, "b.exr");
  EXPECT_EQ(compare.compare.heat_map, "h.png");
  EXPECT_TRUE(compare.compare.subtract_reference_error);
}

TEST(CommandLine, MergeTakesAnyNumberOfPictures) {
  const CommandLine line = parse("merge b.exr a.exr c.exr -o all.exr");
  EXPECT_EQ(line.action, Action::kMerge);
  EXPECT_EQ(line.merge.inputs, (std::vector<std::string>{"b.exr", "a.exr", "c.exr"}));
  EXPECT_EQ(line.merge.output, "all.exr");
}

TEST(CommandLine, Errors) {
  EXPECT_NE(usage_error("").find("no command"), std::string::npos);
  EXPECT_EQ(
      usage_error("paint s.pbrt"),
      "unknown command 'paint', expected one of: render, view, merge, mix, info, routes, compare, "
      "convert, bench");
  EXPECT_EQ(usage_error("vase.glb"),
            "'vase.glb' is no command, expected: nephroid render vase.glb");
  EXPECT_NE(usage_error("render").find("SCENE"), std::string::npos);
  EXPECT_NE(usage_error("render a.pbrt b.pbrt").find("b.pbrt"), std::string::npos);
  EXPECT_EQ(usage_error("render s.pbrt --resumes"),
            "unknown option '--resumes', did you mean \"--resume\"? (see nephroid render --help)");
  EXPECT_EQ(usage_error("info s.pbrt --zoom=3"),
            "unknown option '--zoom' (see nephroid info --help)");
  EXPECT_EQ(usage_error("render a.pbrt --time"),
            "--time has no value, expected --time TIME (see nephroid render --help)");
  EXPECT_EQ(usage_error("render a.pbrt -o"),
            "--output has no value, expected --output OUT.exr (see nephroid render --help)");
  EXPECT_EQ(
      usage_error("rendr s.pbrt"),
      "unknown command 'rendr', expected one of: render, view, merge, mix, info, routes, compare, "
      "convert, bench, did you mean \"render\"?");
  EXPECT_NE(usage_error("merge -o c.exr").find("PICTURE"), std::string::npos);
  EXPECT_NE(usage_error("render s.pbrt --passes").find("--passes"), std::string::npos);
  EXPECT_NE(usage_error("render s.pbrt --passes 0").find("--passes: '0'"), std::string::npos);
  EXPECT_NE(usage_error("render s.pbrt --noise 0").find("--noise: '0'"), std::string::npos);
  EXPECT_NE(usage_error("render s.pbrt -t 0").find("--threads: '0'"), std::string::npos);
  EXPECT_NE(usage_error("render s.pbrt -o out.png").find(".exr"), std::string::npos);
  EXPECT_NE(usage_error("render s.pbrt -o .exr").find("--output"), std::string::npos);
  EXPECT_NE(usage_error("compare a.exr").find("TEST"), std::string::npos);
  EXPECT_NE(usage_error("compare a.exr b.exr --heat h.exr").find(".png"), std::string::npos);
  usage_error("render s.pbrt --passes 3 --passes 4");
  const std::string integrator = usage_error("render s.pbrt --integrator magic");
  for (const std::string& name : integrator_names())
    EXPECT_NE(integrator.find(name), std::string::npos) << integrator;
}

TEST(CommandLine, AllCommandsWithASceneTakeTheOptionsAboutIt) {
  const std::string options =
      " --camera 1 --at 1.5s --shutter 1/48s --variant red --solid-glass --floor --environment "
      "sky.exr --sun "
      "30,-45 "
      "--exposure -1.5 --allow-outside --define a=1 --define b=x=y";
  ImportOptions expected;
  expected.camera = "1";
  expected.variant = "red";
  expected.time = 1.5;
  expected.shutter = 1 / 48.0;
  expected.solid_glass = expected.allow_outside = expected.floor = true;
  expected.defines = {{"a", "1"}, {"b", "x=y"}};
  expected.environment = "sky.exr";
  expected.sun = SunDirection{30, -45};
  expected.exposure = -1.5;
  EXPECT_EQ(parse("render s.glb" + options).render.overrides.import, expected);
  EXPECT_EQ(parse("info s.glb" + options).info.import, expected);
  EXPECT_EQ(parse("routes s.glb" + options).routes.import, expected);
  EXPECT_EQ(parse("convert s.glb t.pbrt" + options).convert.import, expected);
  EXPECT_EQ(parse("render s.glb").render.overrides.import, ImportOptions());
  EXPECT_EQ(parse("render s.glb --at 2").render.overrides.import.time, 2);
}

TEST(CommandLine, OptionsAboutTheSceneAreChecked) {
  EXPECT_NE(usage_error("render s.obj --sun 30").find("--sun: '30'"), std::string::npos);
  EXPECT_NE(usage_error("render s.obj --sun 91,0").find("--sun: '91'"), std::string::npos);
  EXPECT_NE(usage_error("render s.obj --sun -1,0").find("--sun: '-1'"), std::string::npos);
  EXPECT_NE(usage_error("render s.obj --exposure x").find("--exposure: 'x'"), std::string::npos);
  EXPECT_NE(usage_error("render s.obj --exposure 1e9").find("--exposure"), std::string::npos);
  EXPECT_NE(usage_error("render s.obj --at -1").find("--at: '-1'"), std::string::npos);
  EXPECT_NE(usage_error("render s.obj --shutter 1/0s").find("--shutter: '1/0s'"),
            std::string::npos);
  EXPECT_NE(usage_error("render s.obj --define x").find("--define: 'x'"), std::string::npos);
  EXPECT_NE(usage_error("convert s.obj t.obj").find(".pbrt"), std::string::npos);
  EXPECT_NE(usage_error("convert s.obj").find("OUT.pbrt"), std::string::npos);
}

TEST(CommandLine, ImportOptionsAreWordsOfTheIdentity) {
  EXPECT_EQ(import_options_text({}), "");
  ImportOptions options;
  options.camera = "a%b\tc";
  options.floor = true;
  options.sun = SunDirection{5, 6};
  options.defines["n"] = "1";
  options.time = 2.5;
  options.shutter = 0.25;
  EXPECT_EQ(import_options_text(options),
            "camera=a%25b%09c at=2.5 shutter=0.25 define:n=1 floor=yes sun=5,6");
}

TEST(CommandLine, ViewHasOptionsOfItsOwnAndThoseOfRender) {
  const CommandLine line = parse_command_line({"view", "s.pbrt", "--port", "8080", "--no-browser",
                                               "--compare", "a.exr", "--save-to", "out", "--layers",
                                               "lights", "--integrator", "path", "--floor"});
  EXPECT_EQ(line.action, Action::kView);
  EXPECT_EQ(line.render.scene, "s.pbrt");
  EXPECT_EQ(line.render.routes.integrator, "path");
  EXPECT_EQ(line.render.routes.layers, LayerChoice::kLights);
  EXPECT_TRUE(line.render.overrides.import.floor);
  EXPECT_EQ(line.view.port, 8080);
  EXPECT_EQ(line.view.address, "127.0.0.1");
  EXPECT_FALSE(line.view.opens_browser);
  EXPECT_EQ(line.view.comparisons, std::vector<std::string>{"a.exr"});
  EXPECT_EQ(line.view.save_directory, "out");
  EXPECT_EQ(usage_error("view"), "SCENE is required (see nephroid view --help)");
  EXPECT_EQ(usage_error("view s.pbrt --port 0"),
            "--port: '0' is not valid, expected a whole number from 1 to 65535");
}

TEST(CommandLine, HelpAndVersion) {
  EXPECT_EQ(parse("--help").text, program_help());
  EXPECT_EQ(parse("-h").text, program_help());
  EXPECT_EQ(parse("render --help").text, command_help("render"));
  EXPECT_EQ(parse("compare -h").text, command_help("compare"));
  EXPECT_EQ(parse("--help-all").text, program_help_all());
  EXPECT_EQ(parse("render --help-all").text, command_help_all("render"));
  const CommandLine version = parse("--version");
  EXPECT_EQ(version.action, Action::kPrint);
  EXPECT_EQ(version.text.rfind(std::string("nephroid ") + kVersion, 0), 0u);
  EXPECT_EQ(parse("--options-markdown").text, options_markdown());
}

TEST(CommandLine, HelpFitsOneScreenAndHelpAllHasAllOfIt) {
  for (const CommandDescription& command : command_table()) {
    SCOPED_TRACE(command.name);
    const std::string help = command_help(command.name), all = command_help_all(command.name);
    EXPECT_LE(std::count(help.begin(), help.end(), '\n'), 40);
    EXPECT_EQ(help.find(":\n\n"), std::string::npos) << "a heading without options";
    for (const OptionDescription& option : option_table())
      if (option.command == std::string(command.name)) {
        const std::string row = std::string(option.name) + " ";
        EXPECT_EQ(help.find(row) != std::string::npos, !option.is_rare) << option.name;
        EXPECT_NE(all.find(row), std::string::npos) << option.name;
      }
  }
  for (const IntegratorSetting& setting : integrator_settings()) {
    const std::string row = std::string("\n  ") + setting.key + "=";
    EXPECT_NE(command_help_all("render").find(row), std::string::npos) << setting.key;
  }
  for (const EstimatorTraits* estimator : estimator_traits())
    EXPECT_NE(command_help_all("render").find(std::string("\n  ") + estimator->name + " "),
              std::string::npos)
        << estimator->name;
}

TEST(CommandLine, VersionIsThatOfTheBuild) {
  const std::string cmake = testing_support::read_source_file("CMakeLists.txt");
  EXPECT_NE(cmake.find(std::string("project(nephroid VERSION ") + kVersion + " "),
            std::string::npos);
}

TEST(CommandLine, MixHasGains) {
  const CommandLine line =
      parse("mix a.exr --light key=2 --light rim=0.5,1,2 --route caustic=0 -o b.exr --float");
  EXPECT_EQ(line.action, Action::kMix);
  ASSERT_EQ(line.mix.mix.lights.size(), 2u);
  EXPECT_EQ(line.mix.mix.lights[1].name, "rim");
  EXPECT_EQ(line.mix.mix.lights[1].gain.b, 2.0f);
  EXPECT_EQ(line.mix.mix.routes[0].name, "caustic");
  EXPECT_EQ(line.mix.layer_precision, LayerPrecision::kFloat);
  EXPECT_EQ(parse("render s.pbrt --layers both").render.routes.layers, LayerChoice::kBoth);
}

TEST(OptionTable, HelpHasEveryOptionAndStaysInItsColumns) {
  for (const OptionDescription& option : option_table()) {
    const std::string help = command_help_all(option.command);
    EXPECT_NE(help.find(option.name), std::string::npos) << option.name;
    EXPECT_NE(options_markdown().find(option.name), std::string::npos) << option.name;
  }
  for (const CommandDescription& command : command_table()) {
    EXPECT_NE(program_help().find(command.name), std::string::npos);
    std::istringstream lines(command_help(command.name));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
  }
}

TEST(OptionTable, NamesAreUniqueWithinACommand) {
  std::set<std::string> names;
  for (const OptionDescription& option : option_table()) {
    EXPECT_TRUE(names.insert(std::string(option.command) + option.name).second) << option.name;
    if (option.short_name[0] == '\0') continue;
    EXPECT_TRUE(names.insert(std::string(option.command) + option.short_name).second);
  }
}

TEST(OptionTable, NamesTheIntegratorsThatThereAre) {
  const auto options = option_table();
  const auto row = std::find_if(options.begin(), options.end(), [](const OptionDescription& o) {
    return std::string("--integrator") == o.name;
  });
  ASSERT_NE(row, options.end());
  for (const std::string& name : integrator_names())
    EXPECT_NE(std::string(row->help).find(name), std::string::npos) << name;
}

TEST(OptionTable, DocumentationIsCurrent) {
  EXPECT_EQ(testing_support::read_source_file("docs/options.md"), options_markdown())
      << "run tools/update_docs to make docs/options.md anew";
}

}  // namespace
}  // namespace nephroid

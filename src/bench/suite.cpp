// One function for each kind of object in the format, the top one last.
#include "bench/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "bench/suite_claims.h"
#include "bench/suite_fields.h"
#include "input/option_values.h"
#include "integrator/presets/route_presets.h"

namespace nephroid {
namespace {

constexpr uint64_t kAnySeed = std::numeric_limits<uint64_t>::max();
constexpr uint64_t kMaxPasses = std::numeric_limits<uint32_t>::max() - 1;
constexpr uint32_t kMaxRepeats = 1000;
constexpr uint64_t kLargestSide = 65536;
/// References have other random numbers than the pictures that are measured against them.
constexpr uint64_t kReferenceSeed = 12345;

std::string beside(const std::string& suite_file, const std::string& name) {
  return (std::filesystem::path(suite_file).parent_path() / name).lexically_normal().string();
}

/// Reads a name that can be part of a file's name.
std::string name_in(const Fields& fields) {
  const JsonValue value = fields.required("name");
  const std::string& name = text_of(value, "\"name\"");
  const auto is_good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == '+';
  };
  if (!name.empty() && std::all_of(name.begin(), name.end(), is_good)) return name;
  value.fail(
      fmt::format("\"{}\" is not valid as a name, expected letters, digits, -, _ and +", name));
}

template <class Named>
void check_new_name(const std::vector<Named>& others, const Named& added, const JsonValue& value) {
  for (const Named& other : others)
    if (other.name == added.name)
      value.find("name")->fail(
          fmt::format("the name \"{}\" is taken, expected another one", added.name));
}

BenchLimit limit_in(const Fields& fields) {
  BenchLimit limit;
  if (fields.has("time") && fields.has("passes"))
    fields.required("passes").fail(
        "\"time\" and \"passes\" both say when to stop, expected only one of them");
  if (const std::optional<JsonValue> time = fields.find("time"))
    limit.seconds =
        read_at(*time, [&] { return parse_duration("\"time\"", text_of(*time, "\"time\"")); });
  limit.passes = static_cast<uint32_t>(fields.integer_or("passes", 0, 1, kMaxPasses));
  return limit;
}

SettingList options_in(const Fields& fields) {
  SettingList settings;
  const std::optional<JsonValue> options = fields.find("options");
  if (!options) return settings;
  expect_type(*options, Json::value_t::object, "\"options\"");
  for (const JsonMember& member : options->members()) {
    const Json& json = member.value.json();
    const std::string text = json.is_number()
                                 ? json.dump()
                                 : text_of(member.value, fmt::format("option \"{}\"", member.key));
    settings.push_back(
        read_at(member.value, [&] { return parse_setting(member.key + "=" + text); }));
  }
  return settings;
}

/// Reads exactly one of "integrator", "routes" and "route".
RouteChoice routes_in(const Fields& fields, const std::string& what, const std::string& file) {
  if (int{fields.has("integrator")} + int{fields.has("routes")} + int{fields.has("route")} != 1)
    fields.value().fail(
        fmt::format("{} needs exactly one of \"integrator\", \"routes\" and "
                    "\"route\"",
                    what));
  RouteChoice choice;
  choice.integrator = fields.text_or("integrator", "");
  choice.preset_or_file = fields.text_or("routes", "");
  if (!choice.preset_or_file.empty() && !route_preset(choice.preset_or_file) &&
      std::filesystem::exists(beside(file, choice.preset_or_file)))
    choice.preset_or_file = beside(file, choice.preset_or_file);
  if (const std::optional<JsonValue> route = fields.find("route")) {
    expect_type(*route, Json::value_t::array, "\"route\"");
    for (const JsonValue& item : route->items())
      choice.routes.push_back(
          read_at(item, [&] { return parse_route(text_of(item, "a route"), estimator_traits()); }));
    if (route->json().empty()) route->fail("\"route\" is empty, expected at least one route");
    return choice;
  }
  const JsonValue source = fields.required(fields.has("routes") ? "routes" : "integrator");
  read_at(source, [&] { return plan_of(choice, choice.integrator); });
  return choice;
}

BenchIntegrator integrator_in(const JsonValue& value, const std::string& file) {
  const Fields fields(value, "an integrator",
                      {"name", "integrator", "routes", "route", "options", "seed", "outliers"});
  BenchIntegrator result;
  result.name = name_in(fields);
  result.routes = routes_in(fields, "an integrator", file);
  result.options = options_in(fields);
  result.seed = fields.integer_or("seed", 0, 0, kAnySeed);
  const std::string outliers = fields.text_or("outliers", "off");
  if (outliers != "off" && outliers != "reject")
    fields.required("outliers")
        .fail(fmt::format("\"outliers\" is \"{}\", expected \"off\" or \"reject\"", outliers));
  result.reject_outliers = outliers == "reject";
  return result;
}

BenchReference reference_in(const JsonValue& value, const std::string& file) {
  const Fields fields(
      value, "a reference",
      {"file", "integrator", "routes", "route", "options", "passes", "time", "seed"});
  BenchReference result;
  if (fields.has("file")) {
    if (value.json().size() > 1)
      value.fail("a reference has \"file\" and other keys, expected \"file\" alone");
    result.file = beside(file, fields.text("file"));
    return result;
  }
  result.integrator.name = "reference";
  result.integrator.routes = routes_in(fields, "a reference without a \"file\"", file);
  result.integrator.options = options_in(fields);
  result.integrator.seed = fields.integer_or("seed", kReferenceSeed, 0, kAnySeed);
  result.limit = limit_in(fields);
  if (!result.limit.is_set())
    value.fail("a reference without \"file\" has no limit, expected \"passes\" or \"time\"");
  return result;
}

/// Reads the expressions of "energy" or "layer".
std::vector<BenchEnergy> expressions_in(const Fields& fields, const std::string& key) {
  std::vector<BenchEnergy> result;
  const std::optional<JsonValue> expressions = fields.find(key);
  if (!expressions) return result;
  expect_type(*expressions, Json::value_t::object, "\"" + key + "\"");
  for (const JsonMember& member : expressions->members()) {
    const std::string& expression = text_of(member.value, "an expression of \"" + key + "\"");
    read_at(member.value, [&] { return parse_aov(member.key + "=" + expression); });
    result.push_back({member.key, expression});
  }
  return result;
}

std::vector<BenchRegion> regions_in(const Fields& fields) {
  std::vector<BenchRegion> result;
  const std::optional<JsonValue> regions = fields.find("region");
  if (!regions) return result;
  expect_type(*regions, Json::value_t::object, "\"region\"");
  for (const JsonMember& member : regions->members()) {
    expect_type(member.value, Json::value_t::array, "a region");
    float side[4] = {};
    const std::vector<JsonValue> items = member.value.items();
    bool good = items.size() == 4;
    for (size_t i = 0; good && i < 4; ++i)
      side[i] = static_cast<float>(number_of(items[i], "a side of a region", 0, 1));
    good = good && side[0] < side[1] && side[2] < side[3];
    if (!good)
      member.value.fail(
          fmt::format("region \"{}\" is not valid, expected [x0, x1, y0, "
                      "y1] with 0 <= x0 < x1 <= 1 and 0 <= y0 < y1 <= 1",
                      member.key));
    result.push_back({member.key, side[0], side[1], side[2], side[3]});
  }
  return result;
}

void read_resolution(const Fields& fields, BenchScene* scene) {
  const std::optional<JsonValue> value = fields.find("resolution");
  if (!value) return;
  expect_type(*value, Json::value_t::array, "\"resolution\"");
  const std::vector<JsonValue> items = value->items();
  if (items.size() != 2) value->fail("\"resolution\" is not valid, expected [width, height]");
  int* sides[] = {&scene->width, &scene->height};
  for (size_t i = 0; i < 2; ++i) {
    const double side = number_of(items[i], "a side of \"resolution\"", 1, kLargestSide);
    *sides[i] = static_cast<int>(side);
    if (*sides[i] != side)
      items[i].fail("a side of \"resolution\" is not whole, expected a whole number of pixels");
  }
}

/// Checks that layers have unique names, also different from those of routes.
void check_layers(const Fields& fields, const BenchSuite& suite, const BenchScene& scene) {
  const auto check = [&](const char* key, const BenchIntegrator& integrator) {
    const std::optional<JsonValue> expressions = fields.find(key);
    if (!expressions) return;
    const RouteChoice& choice = integrator.routes;
    for (const RouteDefinition& route : plan_of(choice, choice.integrator).routes)
      for (const JsonMember& member : expressions->members())
        if (member.key == route.name)
          member.value.fail(
              fmt::format("the name \"{}\" is taken by a route of {}, expected another one",
                          member.key, integrator.name));
  };
  const bool rendered = scene.reference.file.empty();
  if (rendered)
    for (const char* key : {"energy", "layer"}) check(key, scene.reference.integrator);
  for (const std::string& name : scene.integrators) {
    check("layer", *suite.find_integrator(name));
    if (!rendered) check("energy", *suite.find_integrator(name));
  }
  if (fields.has("energy") && fields.has("layer"))
    for (const JsonMember& layer : fields.required("layer").members())
      if (fields.required("energy").find(layer.key))
        layer.value.fail(
            fmt::format("the name \"{}\" is also in \"energy\", expected another name", layer.key));
}

BenchScene scene_in(const JsonValue& value, const BenchSuite& suite) {
  const Fields fields(value, "a scene",
                      {"name", "title", "file", "resolution", "exposure", "reference",
                       "integrators", "options", "time", "passes", "energy", "layer", "region"});
  BenchScene scene;
  scene.name = name_in(fields);
  scene.title = fields.text_or("title", scene.name);
  scene.file = beside(suite.file, fields.text("file"));
  read_resolution(fields, &scene);
  scene.exposure = static_cast<float>(fields.number_or("exposure", 1, 1e-6, 1e6));
  scene.reference = reference_in(fields.required("reference"), suite.file);
  for (const JsonValue& item : fields.list("integrators")) {
    const std::string& name = text_of(item, "an item of \"integrators\"");
    if (suite.find_integrator(name) == nullptr)
      item.fail(fmt::format("unknown integrator \"{}\", expected one of the suite's", name));
    scene.integrators.push_back(name);
  }
  if (scene.integrators.empty())
    for (const BenchIntegrator& integrator : suite.integrators)
      scene.integrators.push_back(integrator.name);
  scene.options = options_in(fields);
  scene.limit = limit_in(fields);
  scene.energy = expressions_in(fields, "energy");
  scene.layers = expressions_in(fields, "layer");
  check_layers(fields, suite, scene);
  scene.regions = regions_in(fields);
  return scene;
}

/// The items of a list that must not be empty.
std::vector<JsonValue> filled_list(const Fields& fields, const std::string& name) {
  const JsonValue value = fields.required(name);
  expect_type(value, Json::value_t::array, "\"" + name + "\"");
  if (value.json().empty()) value.fail(fmt::format("\"{}\" is empty, expected at least one", name));
  return value.items();
}

}  // namespace

const BenchIntegrator* BenchSuite::find_integrator(const std::string& wanted) const {
  for (const BenchIntegrator& integrator : integrators)
    if (integrator.name == wanted) return &integrator;
  return nullptr;
}

const BenchScene* BenchSuite::find_scene(const std::string& wanted) const {
  for (const BenchScene& scene : scenes)
    if (scene.name == wanted) return &scene;
  return nullptr;
}

BenchSuite parse_suite(const std::string& text, const std::string& file) {
  const Json root = parse_json(text, file);
  const Fields fields(JsonValue(root, file), "a suite",
                      {"name", "title", "description", "time", "passes", "repeat", "integrators",
                       "scenes", "claims"});
  BenchSuite suite;
  suite.file = file;
  suite.name = name_in(fields);
  suite.title = fields.text_or("title", suite.name);
  suite.description = fields.text_or("description", "");
  suite.limit = limit_in(fields);
  suite.repeat = static_cast<uint32_t>(fields.integer_or("repeat", 1, 1, kMaxRepeats));
  for (const JsonValue& item : filled_list(fields, "integrators")) {
    BenchIntegrator integrator = integrator_in(item, file);
    check_new_name(suite.integrators, integrator, item);
    suite.integrators.push_back(std::move(integrator));
  }
  for (const JsonValue& item : filled_list(fields, "scenes")) {
    BenchScene scene = scene_in(item, suite);
    check_new_name(suite.scenes, scene, item);
    suite.scenes.push_back(std::move(scene));
  }
  for (const JsonValue& item : fields.list("claims"))
    suite.claims.push_back(parse_claim(item, suite));
  return suite;
}

BenchSuite read_suite(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in.is_open() || in.bad()) throw IoError("'" + file + "' cannot be read");
  return parse_suite(text, file);
}

}  // namespace nephroid

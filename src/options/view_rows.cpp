#include "options/view_rows.h"

#include <algorithm>
#include <string_view>

#include "core/errors.h"
#include "input/option_values.h"
#include "options/import_rows.h"

namespace nephroid {
namespace {

constexpr int kMaxPort = 65535;

const OptionDescription kOwnRows[] = {
    {"view", "SCENE", "", "", "", "", "",
     "A scene (pbrt-v4, glTF, Mitsuba XML or OBJ), or an EXR picture that this program wrote.",
     false, [](CommandLine& l, const std::string& t) { l.render.scene = t; }},
    {"view", "--compare", "", "PICTURE", "", "none", "Page",
     "A picture to compare with: EXR, PNG or JPEG.", true,
     [](CommandLine& l, const std::string& t) { l.view.comparisons.push_back(t); }},
    {"view", "--save-to", "", "DIR", "", "the browser's downloads", "Page",
     "Directory for pictures and scenes that are saved on the page.", false,
     [](CommandLine& l, const std::string& t) { l.view.save_directory = t; }},
    {"view", "--port", "", "N", "", "any that is free", "Page",
     "Port of the page. A fixed one is of use for ssh -L.", false,
     [](CommandLine& l, const std::string& t) {
       l.view.port = static_cast<int>(parse_integer("--port", t, 1, kMaxPort));
     }},
    {"view", "--listen", "", "ADDRESS", "", "127.0.0.1", "Page",
     "Address to listen at. Any but the default lets other machines reach the page, without "
     "encryption.",
     false, [](CommandLine& l, const std::string& t) { l.view.address = t; }, true},
    {"view", "--no-browser", "", "", "", "", "Page",
     "Print the address of the page, but do not open it.", false,
     [](CommandLine& l, const std::string&) { l.view.opens_browser = false; }},
};

/// An option of `render` that means the same here.
struct SharedOption {
  std::string_view name;
  bool is_rare;  ///< in --help-all only: the page can change it, or few need it
};
constexpr SharedOption kShared[] = {
    {"--output", false},     {"--resume", false},     {"--aov", true},   {"--layers", false},
    {"--integrator", false}, {"--routes", true},      {"--route", true}, {"--strict-routes", true},
    {"-D", false},           {"--outliers", true},    {"--seed", true},  {"--time", true},
    {"--noise", true},       {"--resolution", false}, {"--crop", true},  {"--threads", false},
    {"--memory", true}};

}  // namespace

std::vector<OptionDescription> view_rows(std::span<const OptionDescription> table) {
  std::vector<OptionDescription> rows(std::begin(kOwnRows), std::end(kOwnRows));
  for (const OptionDescription& row : table) {
    const auto shared = std::ranges::find(kShared, std::string_view(row.name), &SharedOption::name);
    if (std::string_view(row.command) != "render" || shared == std::end(kShared)) continue;
    rows.push_back(row);
    rows.back().command = "view";
    rows.back().is_rare = shared->is_rare;
  }
  const std::vector<OptionDescription> imports = import_rows("view");
  rows.insert(rows.end(), imports.begin(), imports.end());
  return rows;
}

}  // namespace nephroid

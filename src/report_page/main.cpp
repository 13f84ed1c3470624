// The program `nephroid-bench-report`: draws the page of a results.json (docs/bench.md).
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "core/errors.h"
#include "report_page/page.h"
#include "session/checkpoint/version.h"

namespace {

int run(int argc, char** argv) {
  CLI::App app{"Draw the results of `nephroid bench` as one HTML page.", "nephroid-bench-report"};
  std::string results, page;
  app.add_option("RESULTS", results, "The results.json that `nephroid bench` wrote.")->required();
  app.add_option("-o,--out", page, "The page; report.html beside RESULTS if not given.");
  app.set_version_flag("--version", nephroid::kVersion);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(nephroid::ExitStatus::kUsage);
  }
  if (page.empty()) page = (std::filesystem::path(results).parent_path() / "report.html").string();
  nephroid::write_report(results, page);
  std::fprintf(stderr, "wrote %s\n", page.c_str());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  using nephroid::ExitStatus;
  ExitStatus status = ExitStatus::kRender;
  std::string message;
  try {
    return run(argc, argv);
  } catch (const nephroid::Error& error) {
    status = error.status();
    message = error.what();
  } catch (const std::exception& error) {
    message = error.what();
  }
  std::fprintf(stderr, "nephroid-bench-report: error: %s\n", message.c_str());
  return static_cast<int>(status);
}

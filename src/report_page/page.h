// The HTML page of a suite: one file with its pictures, plots, style and script. It must not know
// how results were measured.
#pragma once

#include <string>

#include "bench/result.h"

namespace nephroid {

/// The page. Pictures are read from the files named in the results; a message replaces one that
/// cannot be read.
std::string bench_report(const BenchResults& results);

/// Reads a results.json and writes its page. Throws IoError for a file that cannot be read or
/// written, UsageError for one that has no results.
void write_report(const std::string& results_file, const std::string& page_file);

/// RMSE at the end over all renders of the run, with its range if there are several.
std::string rmse_text(const BenchRun& run);

/// The part of the page about one scene.
std::string report_of_scene(const BenchResults& results, const BenchSceneResult& scene);

/// A table, row by row. Cells are HTML; `best` highlights a cell.
struct ReportTable {
  struct Cell {
    std::string html;
    bool best = false;
  };
  std::vector<std::string> head;
  std::vector<std::vector<Cell>> rows;  ///< the first cell is the row's name
  std::string html() const;
};

/// Style and script of the page.
extern const char* const kReportStyle;
extern const char* const kReportScript;

}  // namespace nephroid

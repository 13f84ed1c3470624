// Build-time program: make_tables DATA_FOLDER OUTPUT. Resamples the measured spectra (CSV), fits
// the sRGB coefficients, and writes all into one binary file with the layout of
// core/spectra_data.h. It must not depend on the renderer beyond these two headers.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "core/color_fit.h"
#include "core/spectra_data.h"

namespace {

using nephroid::kTableNodes;
using Columns = std::vector<std::vector<float>>;

constexpr float kFirst = 360.0f, kLast = 830.0f;  // nm

struct NamedColumns {
  std::string name;
  Columns columns;
};

/// The columns of a CSV file with one header line; every row must have the same number of fields.
Columns read_csv(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::string line;
  if (!std::getline(in, line)) throw std::runtime_error(path.string() + ": cannot be read");
  Columns columns(std::count(line.begin(), line.end(), ',') + 1);
  while (std::getline(in, line)) {
    std::stringstream fields(line);
    std::string field;
    size_t n = 0;
    for (; std::getline(fields, field, ','); ++n) {
      if (n >= columns.size()) break;
      columns[n].push_back(std::stof(field));
    }
    if (n != columns.size())
      throw std::runtime_error(path.string() + ": a row has " + std::to_string(n) +
                               " fields, expected " + std::to_string(columns.size()));
  }
  const std::vector<float>& lambda = columns[0];
  if (lambda.size() < 2 || !std::is_sorted(lambda.begin(), lambda.end()))
    throw std::runtime_error(path.string() + ": expected ascending wavelengths");
  return columns;
}

/// Extends the first and last values to just beyond the visible range, as pbrt-v4 does for measured
/// spectra.
void continue_ends(Columns& columns) {
  if (columns[0].front() > kFirst)
    for (size_t c = 0; c < columns.size(); ++c)
      columns[c].insert(columns[c].begin(), c ? columns[c].front() : kFirst - 1);
  if (columns[0].back() < kLast)
    for (size_t c = 0; c < columns.size(); ++c)
      columns[c].push_back(c ? columns[c].back() : kLast + 1);
}

/// All value columns at 360, 361, ..., 830 nm, interpolated linearly.
Columns resample(const Columns& in) {
  const std::vector<float>& lambda = in[0];
  Columns out(in.size() - 1);
  for (int i = 0; i < kTableNodes; ++i) {
    const float at = kFirst + static_cast<float>(i);
    size_t k = std::upper_bound(lambda.begin(), lambda.end(), at) - lambda.begin();
    k = std::clamp<size_t>(k, 1, lambda.size() - 1) - 1;
    const float t = (at - lambda[k]) / (lambda[k + 1] - lambda[k]);
    for (size_t c = 1; c < in.size(); ++c)
      out[c - 1].push_back((1 - t) * in[c][k] + t * in[c][k + 1]);
  }
  return out;
}

/// Scales `power` so that its integral times `y` equals that of an equal-energy spectrum of 1.
void normalise(std::vector<float>& power, const std::vector<float>& y) {
  double sum = 0, equal_energy = 0;
  for (int i = 0; i < kTableNodes; ++i) {
    sum += double(power[i]) * y[i];
    equal_energy += y[i];
  }
  for (float& p : power) p = static_cast<float>(p * equal_energy / sum);
}

std::vector<NamedColumns> read_spectra(const std::filesystem::path& folder) {
  std::vector<NamedColumns> tables;
  tables.push_back({"cie", resample(read_csv(folder / "cie-1931-2deg.csv"))});
  const std::vector<float> y = tables[0].columns[1];
  tables.push_back({"daylight", resample(read_csv(folder / "cie-daylight-basis.csv"))});
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".csv") continue;
    const std::string name = file.path().stem().string();
    if (name.starts_with("cie-")) continue;
    Columns columns = read_csv(file.path());
    continue_ends(columns);
    if (name.starts_with("illuminant-")) {
      columns = resample(columns);
      normalise(columns[0], y);
    }
    tables.push_back({name, std::move(columns)});
  }
  return tables;
}

void write(const std::filesystem::path& path, std::vector<NamedColumns> tables) {
  std::sort(tables.begin(), tables.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  std::vector<nephroid::DataEntry> entries;
  const size_t header = sizeof(nephroid::DataHeader) + tables.size() * sizeof(nephroid::DataEntry);
  const size_t start = (header + 63) / 64 * 64;
  size_t offset = start;
  for (const NamedColumns& table : tables) {
    nephroid::DataEntry entry{};
    if (table.name.size() >= sizeof entry.name)
      throw std::runtime_error(table.name + ": the name is too long");
    std::memcpy(entry.name, table.name.data(), table.name.size());
    entry.rows = static_cast<int>(table.columns[0].size());
    entry.columns = static_cast<int>(table.columns.size());
    entry.offset = static_cast<int>(offset);
    offset += table.columns[0].size() * table.columns.size() * sizeof(float);
    entries.push_back(entry);
  }

  std::ofstream out(path, std::ios::binary);
  const auto put = [&out](const void* data, size_t bytes) {
    out.write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
  };
  const nephroid::DataHeader count{static_cast<int>(tables.size())};
  put(&count, sizeof count);
  put(entries.data(), entries.size() * sizeof entries[0]);
  const std::vector<char> padding(start - header);
  put(padding.data(), padding.size());
  for (const NamedColumns& table : tables)
    for (const std::vector<float>& column : table.columns)
      put(column.data(), column.size() * sizeof(float));
  if (!out.flush()) throw std::runtime_error(path.string() + ": cannot be written");
}

void make_tables(const std::filesystem::path& folder, const std::filesystem::path& output) {
  std::vector<NamedColumns> tables = read_spectra(folder);
  const Columns& cie = tables[0].columns;
  const auto d65 = std::find_if(tables.begin(), tables.end(),
                                [](const auto& t) { return t.name == "illuminant-D65"; });
  if (d65 == tables.end()) throw std::runtime_error("illuminant-D65.csv is missing");

  const auto start = std::chrono::steady_clock::now();
  const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  nephroid::SigmoidTable srgb =
      nephroid::fit_sigmoid_table({cie[0], cie[1], cie[2], d65->columns[0]},
                                  nephroid::kSrgbPrimaries, nephroid::kTableResolution, threads);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  std::printf("sRGB coefficients: %d^3 fitted in %.2f s on %d threads\n", srgb.resolution,
              time.count(), threads);
  tables.push_back({"srgb-nodes", {std::move(srgb.nodes)}});
  tables.push_back({"srgb", {std::move(srgb.coefficients)}});
  write(output, std::move(tables));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: make_tables DATA_FOLDER OUTPUT\n";
    return 2;
  }
  try {
    make_tables(argv[1], argv[2]);
  } catch (const std::exception& e) {
    std::cerr << "make_tables: " << e.what() << "\n";
    return 1;
  }
  return 0;
}

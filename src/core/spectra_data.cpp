// Reads the directory of the embedded tables. The bytes come from tools/tables/embedded_tables.cpp.
#include "core/spectra_data.h"

#include <cstring>
#include <stdexcept>
#include <string>

extern "C" const unsigned char nephroid_data_tables[];

namespace nephroid {

std::vector<DataTable> data_tables() {
  const unsigned char* file = nephroid_data_tables;
  DataHeader header;
  std::memcpy(&header, file, sizeof header);
  std::vector<DataTable> tables;
  for (int i = 0; i < header.count; ++i) {
    const unsigned char* at = file + sizeof(DataHeader) + i * sizeof(DataEntry);
    DataEntry entry;
    std::memcpy(&entry, at, sizeof entry);
    tables.push_back({reinterpret_cast<const char*>(at), entry.rows, entry.columns,
                      reinterpret_cast<const float*>(file + entry.offset)});
  }
  return tables;
}

DataTable data_table(std::string_view name) {
  for (const DataTable& table : data_tables())
    if (table.name == name) return table;
  throw std::logic_error("no embedded table \"" + std::string(name) + "\"");
}

}  // namespace nephroid

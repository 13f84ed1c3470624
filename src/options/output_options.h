// Options of all commands that write a picture: --output and --float.
#pragma once

#include <string>

#include "core/errors.h"
#include "options/options.h"

namespace nephroid {

inline constexpr const char* kFloatHelp =
    "All layers in 32-bit floats. Otherwise R, G, B, Z, positions and variances are, and other "
    "layers are in 16 bits unless these do not hold their values.";

template <auto Command>
void set_float(CommandLine& line, const std::string&) {
  (line.*Command).layer_precision = LayerPrecision::kFloat;
}

template <auto Command>
void set_output(CommandLine& line, const std::string& text) {
  const bool is_exr = text.size() > 4 && text.compare(text.size() - 4, 4, ".exr") == 0;
  if (!is_exr)
    throw UsageError("--output: '" + text +
                     "' is not valid, expected a name that ends in .exr (a .png is written beside "
                     "it)");
  (line.*Command).output = text;
}

}  // namespace nephroid

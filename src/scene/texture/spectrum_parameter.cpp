// Scene parameters as spectra: rgb, wavelength-value pairs, named spectra, spectrum files and black
// bodies, with pbrt-v4's checks.
#include <cmath>

#include "core/counted.h"
#include "input/file_bytes.h"
#include "input/number_text.h"
#include "input/spelling.h"
#include "scene/texture/image_file.h"
#include "scene/texture/texture.h"

namespace nephroid {

namespace {

std::string quoted(const Parameter& p) {
  return "\"" + p.type + " " + p.name + "\"";
}

SpectrumPtr rgb_spectrum(const Parameter& p, SpectrumKind kind) {
  if (p.numbers.size() != 3)
    throw SceneError(
        p.where, quoted(p) + " has " + counted(p.numbers.size(), "number") + ", expected three");
  for (const double v : p.numbers) {
    if (!(v >= 0.0) || !std::isfinite(v))
      throw SceneError(
          p.where,
          quoted(p) + " has a negative or infinite component, expected finite numbers from 0");
    if (kind == SpectrumKind::kAlbedo && v > 1.0)
      throw SceneError(p.where,
                       quoted(p) + " has a component above 1, expected a reflectance in [0,1]");
  }
  const RgbColorSpace* space = RgbColorSpace::find(p.color_space);
  if (!space) throw SceneError(p.where, "unknown colour space \"" + p.color_space + "\"");
  const Rgb rgb{static_cast<float>(p.numbers[0]), static_cast<float>(p.numbers[1]),
                static_cast<float>(p.numbers[2])};
  switch (kind) {
    case SpectrumKind::kAlbedo:
      return rgb_albedo_spectrum(*space, rgb);
    case SpectrumKind::kUnbounded:
      return rgb_unbounded_spectrum(*space, rgb);
    case SpectrumKind::kIlluminant:
      break;
  }
  return rgb_illuminant_spectrum(*space, rgb);
}

/// `source` is the origin of the numbers, for messages.
SpectrumPtr pairs_spectrum(const std::vector<double>& numbers, SpectrumKind kind,
                           const SourceLocation& where, const std::string& source) {
  if (numbers.size() < 2 || numbers.size() % 2 != 0)
    throw SceneError(where, source + " has " + counted(numbers.size(), "number") +
                                ", expected pairs of a wavelength in nm and a value");
  std::vector<float> lambda, value;
  for (size_t i = 0; i < numbers.size(); i += 2) {
    if (!std::isfinite(numbers[i]) || !std::isfinite(numbers[i + 1]))
      throw SceneError(where, source + " has a number that is not finite, expected finite numbers");
    if (kind == SpectrumKind::kIlluminant && numbers[i + 1] < 0.0)
      throw SceneError(
          where, source + " has a negative value, which cannot be emitted, expected 0 or more");
    if (i > 0 && !(numbers[i] > numbers[i - 2]))
      throw SceneError(where,
                       source + " has wavelengths that do not increase, expected increasing ones");
    lambda.push_back(static_cast<float>(numbers[i]));
    value.push_back(static_cast<float>(numbers[i + 1]));
  }
  return piecewise_linear_spectrum(std::move(lambda), std::move(value));
}

/// Numbers of a text file, separated by blanks; "#" starts a comment.
std::vector<double> numbers_of_file(SceneFiles& files, const std::string& path,
                                    const SourceLocation& where) {
  const std::string text = files.read(path);
  std::vector<double> numbers;
  size_t i = 0;
  while (i < text.size()) {
    const size_t begin = text.find_first_not_of(" \t\r\n,", i);
    if (begin == std::string::npos) break;
    if (text[begin] == '#') {
      i = std::min(text.find('\n', begin), text.size());
      continue;
    }
    const size_t end = std::min(text.find_first_of(" \t\r\n,#", begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const auto number = parse_number(word);
    if (!number)
      throw SceneError(where, "spectrum file \"" + path + "\" has \"" + word.substr(0, 40) +
                                  "\" where a number was expected");
    numbers.push_back(*number);
    i = end;
  }
  return numbers;
}

std::string known_spectra() {
  std::string list;
  for (const std::string& name : named_spectra()) list += (list.empty() ? "" : ", ") + name;
  return list;
}

SpectrumPtr named_or_file(const Parameter& p, SpectrumKind kind, SceneFiles& files) {
  if (p.strings.size() != 1)
    throw SceneError(
        p.where, quoted(p) + " has " + std::to_string(p.strings.size()) + " names, expected one");
  const std::string& name = p.strings[0];
  if (SpectrumPtr s = named_spectrum(name)) return s;
  const std::string path = files.path_of(name);
  try {
    return pairs_spectrum(numbers_of_file(files, path, p.where), kind, p.where,
                          "spectrum file \"" + path + "\"");
  } catch (const IoError& e) {
    const std::string meant = did_you_mean(name, named_spectra());
    file_is_unreadable(
        p.where, "\"" + name + "\" is not the name of a known spectrum" +
                     (meant.empty() ? ", expected a file or one of " + known_spectra() : meant) +
                     " (" + e.what() + ")");
  }
}

}  // namespace

SpectrumPtr spectrum_from_parameter(const Parameter& parameter, SpectrumKind kind,
                                    SceneFiles& files) {
  const Parameter& p = parameter;
  if (p.type == "rgb") return rgb_spectrum(p, kind);
  if (p.type == "blackbody") {
    if (p.numbers.size() != 1 || !(p.numbers[0] > 0.0) || !std::isfinite(p.numbers[0]))
      throw SceneError(p.where, quoted(p) + " needs one temperature in kelvin above 0");
    return blackbody_spectrum(static_cast<float>(p.numbers[0]));
  }
  if (p.type == "spectrum")
    return p.strings.empty() ? pairs_spectrum(p.numbers, kind, p.where, quoted(p))
                             : named_or_file(p, kind, files);
  throw SceneError(p.where, quoted(p) +
                                " cannot be used here, expected a parameter of type \"rgb\", "
                                "\"spectrum\" or \"blackbody\"");
}

}  // namespace nephroid

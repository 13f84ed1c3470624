// Pictures against their reference, whole and in part.
// Who calls it: render.cpp and the report. It must not know suites' files.
#pragma once

#include "bench/result.h"
#include "film/image_io.h"

namespace nephroid {

/// R, G and B of a film, with its colour space; of one of its AOVs, if one is given.
Picture colors_of_film(const Film& film, std::optional<int> aov = std::nullopt);

/// R, G and B of a layer. Throws UsageError if the picture has no such layer.
Picture layer_of(const Picture& picture, const std::string& layer);

/// The part of a picture that a region covers: pixels whose centres it has, but at least one.
Picture part_of(const Picture& picture, const BenchRegion& region);

/// Errors of `test` against `reference`; `exposure` is for FLIP. Throws UsageError if their sizes
/// differ.
BenchErrors measure_errors(const Picture& reference, const Picture& test, float exposure);

/// Root of the mean square of the picture's standard error; empty if it has no stderr channels.
std::optional<double> own_error(const Picture& picture);

}  // namespace nephroid

// Errors of pictures, or parts of them, against their reference. It must not know suite files.
#pragma once

#include "bench/result.h"
#include "film/image_io.h"

namespace nephroid {

/// R, G and B of a film or of one of its AOVs, with its colour space.
Picture colors_of_film(const Film& film, std::optional<int> aov = std::nullopt);

/// R, G and B of a layer. Throws UsageError if the picture has no such layer.
Picture layer_of(const Picture& picture, const std::string& layer);

/// The part of a picture in a region: the pixels with their centres in it, but at least one.
Picture part_of(const Picture& picture, const BenchRegion& region);

/// Errors of `test` against `reference`; `exposure` is for FLIP. Throws UsageError if their sizes
/// differ.
BenchErrors measure_errors(const Picture& reference, const Picture& test, float exposure);

/// Root mean square of the picture's standard error; empty if it has no stderr channels.
std::optional<double> own_error(const Picture& picture);

}  // namespace nephroid

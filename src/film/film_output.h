// The channels of a film's output files and their names. It must not know estimators or scenes.
#pragma once

#include <string>

#include "film/film.h"
#include "film/image_io.h"

namespace nephroid {

/// The film as channels, in this order:
///   R G B     all routes, then a layer per route ("caustic.R" ...) and per AOV
///   outliers  if the film rejects outliers
///   albedo, N (world space), Z
///   stderr    standard error of R G B, unless a group replaces its estimates
///   bias.Y    [E4], mean of R G B, if a group estimates its bias
///   samples   estimates per pixel, the maximum over groups
/// A gbuffer film has pbrt-v4's layers instead of albedo and N, in the film's coordinate system:
/// Albedo, N (geometric), P, Ns, u, v, dzdx, dzdy, Variance, RelativeVariance.
/// check_layer_name (route/) reserves these names.
Picture film_picture(const Film& film, Metadata metadata);

/// The film's R G B times `exposure`, in sRGB primaries and transfer, interleaved bytes.
std::vector<uint8_t> film_srgb8(const Film& film, float exposure);

/// The same of a picture in memory. A channel that it lacks is black.
std::vector<uint8_t> picture_srgb8(const Picture& picture, float exposure);

/// kHalf writes layers as 16-bit floats if their values fit, which halves a file. Layers that need
/// all digits, such as R G B, Z and samples, are always 32-bit floats.
enum class LayerPrecision { kHalf, kFloat };

/// Writes the picture as EXR to `path`, row by row. Throws IoError.
void write_film_exr(const std::string& path, const Film& film, Metadata metadata,
                    LayerPrecision precision = LayerPrecision::kHalf);
/// The same, plus a PNG at png_path_beside(path).
void write_film(const std::string& path, const Film& film, Metadata metadata, float exposure,
                LayerPrecision precision = LayerPrecision::kHalf);
/// The same for a picture in memory. Channels may be 16-bit floats as in the film's files.
void write_picture(const std::string& path, const Picture& picture, float exposure,
                   LayerPrecision precision = LayerPrecision::kHalf);
/// kHalf if that loses nothing of this picture.
LayerPrecision exact_precision(const Picture& picture);
/// Writes only the PNG.
void write_preview(const std::string& path, const Film& film, float exposure);

/// "a/b.exr" -> "a/b.png".
std::string png_path_beside(const std::string& exr_path);

}  // namespace nephroid

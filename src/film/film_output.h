// What of a film goes into a file, and under which names.
// Who calls it: session. It must not know estimators or scenes.
#pragma once

#include <string>

#include "film/film.h"
#include "film/image_io.h"

namespace nephroid {

/// The film as channels: R G B (all routes), one layer per route ("caustic.R" ...) and then per AOV
/// (the same form), outliers if the film rejects them, albedo, N (world space), Z, stderr (standard
/// error of R G B), bias.Y if groups tell theirs ([E4], mean of R G B) and samples (estimates per
/// pixel, the largest of the groups). A gbuffer film has pbrt-v4's layers instead of albedo and N,
/// in the film's coordinate system: Albedo, N (geometric), P, Ns, u, v, dzdx, dzdy, Variance,
/// RelativeVariance. No route or AOV has one of these names: check_layer_name in route/.
Picture film_picture(const Film& film, Metadata metadata);

/// The film's R G B times `exposure`, in sRGB primaries and transfer, interleaved bytes.
std::vector<uint8_t> film_srgb8(const Film& film, float exposure);

/// Layers beside R G B, Z and samples are written as 16-bit floats where these hold them, which
/// halves a file, or all in 32 bits.
enum class LayerPrecision { kHalf, kFloat };

/// Writes the picture as EXR to `path`. Makes it row by row. Throws IoError.
void write_film_exr(const std::string& path, const Film& film, Metadata metadata,
                    LayerPrecision precision = LayerPrecision::kHalf);
/// The same, and its PNG to png_path_beside(path).
void write_film(const std::string& path, const Film& film, Metadata metadata, float exposure,
                LayerPrecision precision = LayerPrecision::kHalf);
/// The PNG alone.
void write_preview(const std::string& path, const Film& film, float exposure);

/// "a/b.exr" -> "a/b.png".
std::string png_path_beside(const std::string& exr_path);

}  // namespace nephroid

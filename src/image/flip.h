// FLIP: the difference of two pictures as perceived by a viewer who flips between them, from 0
// (none) to 1. Formulas [FL1] to [FL6] of docs/estimators.md. It must not know films or scenes.
// Paper: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild, FLIP: A Difference
// Evaluator for Alternating Images, HPG 2020.
#pragma once

#include <vector>

#include "film/image_io.h"

namespace nephroid {

/// Pixels per degree of the visual field, for 3840 pixels on 0.7 m seen from 0.7 m.
inline constexpr double kFlipPixelsPerDegree = 67.02064327658226;

/// The colours of a picture on a screen: R, G and B (or the first three channels) times the
/// exposure, in linear sRGB, clamped to [0,1], rows from the top. NaN is black. A picture without a
/// colour space is sRGB. Throws UsageError if it has fewer than three channels.
std::vector<Rgb> display_colors(const Picture& picture, float exposure);

/// FLIP of every pixel, in [0,1], rows from the top, for colours of display_colors.
std::vector<double> flip_errors(int width, int height, const std::vector<Rgb>& reference,
                                const std::vector<Rgb>& test,
                                double pixels_per_degree = kFlipPixelsPerDegree);

/// The mean of flip_errors of two pictures. Throws UsageError if their sizes differ.
double flip(const Picture& reference, const Picture& test, float exposure);

}  // namespace nephroid

// The small picture that a page shows until it can draw frames: a PNG, toned as the page does at
// first. It must not know the server.
#pragma once

#include <cstdint>
#include <vector>

#include "view/frame.h"

namespace nephroid {

/// The whole picture in sRGB, at most kMaxFirstPictureEdge pixels wide and high; dark outside of
/// the frame's window.
std::vector<uint8_t> first_picture_png(const PictureFrame& frame);

inline constexpr int kMaxFirstPictureEdge = 512;

}  // namespace nephroid

// Pieces of HTML: escaped text, and pictures as data URLs. It must not know results.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nephroid {

/// The text escaped for HTML and XML, for content and for attributes.
std::string html_escape(const std::string& text);

/// "data:image/png;base64,..." of interleaved sRGB bytes.
std::string png_data_url(int width, int height, const std::vector<uint8_t>& rgb);

}  // namespace nephroid

// Pieces of HTML: escaped text, numbers for readers, pictures as data.
// Who calls it: svg_plot.cpp and the report. It must not know results.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nephroid {

/// The text with what HTML and XML would misread replaced; for content and for attributes.
std::string html_escape(const std::string& text);

/// Three significant digits, or all before the point: "0.0123", "12345", "4.5e-07"; an em dash for
/// what is not finite.
std::string number_text(double value);
/// "1.23 M", the unit by thousands; "0" for 0.
std::string count_text(double value);
/// "1.23 MB", by thousands.
std::string bytes_in_words(double value);

/// "12.3 ms", "4.56 s", "7.89 min", "1.23 h".
std::string seconds_in_words(double seconds);

/// "data:image/png;base64,..." of interleaved sRGB bytes.
std::string png_data_url(int width, int height, const std::vector<uint8_t>& rgb);

}  // namespace nephroid

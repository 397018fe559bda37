// Pixels as the bytes of a PNG file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gramap {

/// `rgb` holds width × height pixels of three bytes, top row first.
std::string png_bytes(int width, int height, const std::vector<std::uint8_t>& rgb);

}  // namespace gramap

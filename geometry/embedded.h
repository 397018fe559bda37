// Files that are built into the program, so that it needs nothing beside itself wherever it is installed: the
// shipped forests, the viewer's page, three.js. cmake/Embed.cmake takes them in.
#pragma once

#include <string_view>

/// At namespace level, once in the file that uses it: declares `std::string_view embedded_NAME()`, the bytes
/// of the file that the build embeds as NAME.
#define GRAMAP_EMBEDDED(name)                                                                              \
  extern "C" const char gramap_##name##_begin[], gramap_##name##_end[];                                    \
  static std::string_view embedded_##name() {                                                              \
    return {gramap_##name##_begin, static_cast<std::size_t>(gramap_##name##_end - gramap_##name##_begin)}; \
  }

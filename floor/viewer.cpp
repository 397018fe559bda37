#include "floor/viewer.h"

#include <stdexcept>
#include <string_view>

// The page's parts are files of their own, taken into the program as they stand.
#define GRAMAP_EMBED(name, file)                                                                         \
  asm(".section .rodata\n" #name "_begin:\n.incbin \"" file "\"\n" #name "_end:\n.byte 0\n.previous\n"); \
  extern "C" const char name##_begin[];                                                                  \
  extern "C" const char name##_end[];

GRAMAP_EMBED(gramap_page_css, GRAMAP_VIEWER_DIR "/page.css")
GRAMAP_EMBED(gramap_page_js, GRAMAP_VIEWER_DIR "/page.js")
#ifdef GRAMAP_THREE_DIR
GRAMAP_EMBED(gramap_three, GRAMAP_THREE_DIR "/three.min.js")
GRAMAP_EMBED(gramap_orbit, GRAMAP_THREE_DIR "/examples/js/controls/OrbitControls.js")
#endif

namespace gramap {
namespace {

std::string base64(std::string_view bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() || k < 2 ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return safe;
}

}  // namespace

bool viewer_built() {
#ifdef GRAMAP_THREE_DIR
  return true;
#else
  return false;
#endif
}

std::string viewer_page(const std::string& title, const std::string& glb,
                        const std::vector<std::string>& plans) {
#ifdef GRAMAP_THREE_DIR
  const auto part = [](const char* begin, const char* end) { return std::string(begin, end); };
  std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" +
                     escaped(title) + "</title>\n<style>\n";
  page += part(gramap_page_css_begin, gramap_page_css_end);
  page += R"(</style>
</head>
<body>
<div id="view"></div>
<div id="plan">)";
  for (const std::string& plan : plans) page += plan;
  page += R"(</div>
<div id="tools">
<button data-view="outside">Outside</button><button data-view="bird">Bird's eye</button><button data-view="plan">From above</button><button data-view="inside">Walk</button><button data-view="drawing">Drawing</button>
<label><input type="checkbox" data-layer="ceilings" checked> ceilings</label>
<label><input type="checkbox" data-layer="furniture" checked> furniture</label>
<label><input type="checkbox" data-layer="openings" checked> doors and windows</label>
</div>
<div id="hint"></div>
<div id="side"><div id="title"></div><div id="numbers"></div>
<h2>Rooms</h2>
<table><thead><tr><th>Room</th><th>Type</th><th>scan m</th><th>width m</th><th>± cm</th><th>m²</th></tr></thead><tbody id="rooms"></tbody></table>
<p id="frame"></p></div>
<script type="application/octet-stream" id="model">)";
  page += base64(glb);
  page += "</script>\n<script>\n" + part(gramap_three_begin, gramap_three_end) + "\n</script>\n<script>\n" +
          part(gramap_orbit_begin, gramap_orbit_end) + "\n</script>\n<script>\n" +
          part(gramap_page_js_begin, gramap_page_js_end) + "</script>\n</body>\n</html>\n";
  return page;
#else
  throw std::logic_error("the viewer was not built: " + title + std::to_string(glb.size() + plans.size()));
#endif
}

}  // namespace gramap

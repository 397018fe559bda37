#include "floor/viewer.h"

#include <stdexcept>
#include <string_view>

#include "geometry/embedded.h"

GRAMAP_EMBEDDED(page_css)
GRAMAP_EMBEDDED(page_js)
#ifdef GRAMAP_THREE
GRAMAP_EMBEDDED(three)
GRAMAP_EMBEDDED(three_orbit)
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
#ifdef GRAMAP_THREE
  return true;
#else
  return false;
#endif
}

std::string viewer_page(const std::string& title, const std::string& glb,
                        const std::vector<std::string>& plans) {
#ifdef GRAMAP_THREE
  std::string page = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" +
                     escaped(title) + "</title>\n<style>\n";
  page += std::string(embedded_page_css());
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
  page += "</script>\n<script>\n" + std::string(embedded_three()) + "\n</script>\n<script>\n" +
          std::string(embedded_three_orbit()) + "\n</script>\n<script>\n" + std::string(embedded_page_js()) +
          "</script>\n</body>\n</html>\n";
  return page;
#else
  throw std::logic_error("the viewer was not built: " + title + std::to_string(glb.size() + plans.size()));
#endif
}

}  // namespace gramap

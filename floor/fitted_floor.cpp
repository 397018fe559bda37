#include "floor/fitted_floor.h"

namespace gramap {

const char* to_string(Origin origin) {
  switch (origin) {
    case Origin::observed:
      return "observed";
    case Origin::derived:
      return "derived";
    case Origin::given:
      return "given";
  }
  return "";
}

}  // namespace gramap

#include "floor/node_names.h"

namespace gramap {

std::string NodeNames::name(const std::string& wish) {
  std::string safe;
  for (const char c : wish) {
    const bool kept =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    safe += kept ? c : '_';
  }
  std::string unique = safe;
  for (int n = 2; !taken_.insert(unique).second; ++n) unique = safe + "_" + std::to_string(n);
  return unique;
}

}  // namespace gramap

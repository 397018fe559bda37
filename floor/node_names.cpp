#include "floor/node_names.h"

namespace gramap {
namespace {

std::string plain(const std::string& wish) {
  std::string safe;
  for (const char c : wish) {
    const bool kept =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    safe += kept ? c : '_';
  }
  return safe;
}

}  // namespace

std::string NodeNames::name(const std::string& wish) {
  const std::string safe = plain(wish);
  if (taken_.insert(safe).second) return safe;
  int& number = last_.try_emplace(safe, 1).first->second;
  while (true)
    if (std::string unique = safe + "_" + std::to_string(++number); taken_.insert(unique).second)
      return unique;
}

std::string NodeNames::numbered(const std::string& wish) {
  const std::string safe = plain(wish);
  int& number = last_[safe];
  while (true)
    if (std::string unique = safe + "_" + std::to_string(++number); taken_.insert(unique).second)
      return unique;
}

}  // namespace gramap

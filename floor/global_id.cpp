#include "floor/global_id.h"

#include "geometry/file.h"

namespace gramap {

std::string global_id(std::string_view identity) {
  static constexpr char kDigits[] = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";
  const std::string text(identity);
  const unsigned long long high = std::stoull(hash_hex(text + "/1"), nullptr, 16);
  const unsigned long long low = std::stoull(hash_hex("2/" + text), nullptr, 16);
  // 2 bits in the first character, 6 in each of the 21 others, the most significant first.
  std::string id;
  for (int bit = 126; bit >= 0; bit -= 6) {
    unsigned long long six = bit >= 64 ? high >> (bit - 64) : (low >> bit);
    if (bit < 64 && bit > 58) six |= high << (64 - bit);
    id += kDigits[six & (bit == 126 ? 3 : 63)];
  }
  return id;
}

}  // namespace gramap

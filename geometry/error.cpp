#include "geometry/error.h"

#include <utility>

namespace gramap {

std::string to_string(const Place& place) {
  std::string text = place.file;
  if (place.line > 0) text += ":" + std::to_string(place.line);
  if (place.line > 0 && place.column > 0) text += ":" + std::to_string(place.column);
  return text;
}

InputError::InputError(Place where, const std::string& message, std::string advice_text)
    : std::runtime_error(message), place(std::move(where)), advice(std::move(advice_text)) {}

}  // namespace gramap

// The one exception for what is wrong with the world: a bad file, an impossible floor. It is caught in one
// place, the command, which prints it and exits with 1. Defects of gramap itself are assertions or
// std::logic_error, never this.
#pragma once

#include <stdexcept>
#include <string>

namespace gramap {

/// Where in the input a fault is. Lines and columns count from 1; 0 means the whole file (or no file at all).
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};

/// "file:line:column", without the parts that are not known.
std::string to_string(const Place& place);

/// A fault of the input: where, what was wrong (one sentence, no full stop), and what to do about it.
struct InputError : std::runtime_error {
  InputError(Place where, const std::string& message, std::string advice_text = "");
  Place place;
  std::string advice;  ///< what the user can do; may be empty
};

}  // namespace gramap

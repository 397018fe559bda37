// What is said of a fault of the input.
#pragma once

#include "geometry/error.h"

namespace gramap {

/// Place, reason and advice on standard error.
void print_fault(const InputError& error);

}  // namespace gramap

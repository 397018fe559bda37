// IFC's compressed GlobalId: 22 characters for 128 bits. From a hash of what the thing is, so that it stays
// the same from run to run.
#pragma once

#include <string>
#include <string_view>

namespace gramap {

std::string global_id(std::string_view identity);

}  // namespace gramap

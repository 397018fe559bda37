// The proof taken on a model file alone: on the triangles as they stand in it, in single precision.
#pragma once

#include "floor/read_model.h"
#include "floor/verify.h"

namespace gramap {

/// Floors of rooms and undersides of walls tile each storey's outline exactly; every wall, slab, leaf, pane
/// and piece of furniture is a closed solid; floors face up and ceilings down; names are plain and unique;
/// rooms are reachable.
VerifyReport verify_file(const ReadModel& model);

}  // namespace gramap

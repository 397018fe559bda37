#include "perception/observation.h"

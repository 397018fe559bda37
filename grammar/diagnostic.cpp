#include "grammar/diagnostic.h"

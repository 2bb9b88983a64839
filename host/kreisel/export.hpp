// export.hpp - what the shared library shows.
#pragma once

#define KREISEL_API __attribute__((visibility("default")))

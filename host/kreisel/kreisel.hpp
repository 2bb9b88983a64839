// kreisel.hpp - all of the library. [docs/library.md]
#pragma once

#include "kreisel/control.hpp"
#include "kreisel/error.hpp"
#include "kreisel/inspection.hpp"
#include "kreisel/mending.hpp"
#include "kreisel/mesh.hpp"
#include "kreisel/nest.hpp"
#include "kreisel/problem.hpp"
#include "kreisel/question.hpp"
#include "kreisel/session.hpp"
#include "kreisel/verdict.hpp"

// stable_speeds.hpp - what the equations of motion add to the verdict on a body that is to spin on its tip.
#pragma once

#include "problem/problem.hpp"

namespace kreisel::core {

/// Adds gliding_stable_above_rpm and held_stable_above_rpm: the least speed above which a steady spin is
/// stable at every speed, by its spectrum (physics/steady_spin.hpp), with the tip gliding and held; NaN where
/// there is none. A good verdict says so, too.
void add_stable_speeds(Verdict& verdict, const Moments& s, double length_mm);

}  // namespace kreisel::core

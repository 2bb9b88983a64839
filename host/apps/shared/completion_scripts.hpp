// completion_scripts.hpp - the scripts by which shells ask, with @program@ in place of its name.
#pragma once

namespace kreisel::core {

extern const char* const completion_bash;
extern const char* const completion_zsh;
extern const char* const completion_fish;

}  // namespace kreisel::core

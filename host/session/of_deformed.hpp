// of_deformed.hpp - what a session keeps of a body that was deformed.
#pragma once

#include <optional>

#include "session/deformed.hpp"
#include "session/session.hpp"

namespace kreisel::core {

struct Session::OfDeformed {
  Deformed body;
  std::optional<Session> session;  ///< of the deformed body; nothing where it stays as it was
};

}  // namespace kreisel::core

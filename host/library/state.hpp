// state.hpp - what the handles of the public headers hold.
#pragma once

#include "body/source.hpp"
#include "design/design.hpp"
#include "kreisel/session.hpp"
#include "session/session.hpp"

namespace kreisel {

struct Device::State {
  core::device::Device device;
};

struct Body::State : core::Source {};

struct Session::State {
  Body body;
  core::Session session;
  std::vector<std::string> made;

  void note_made() { made.assign(session.made().begin(), session.made().end()); }
};

struct Part::State {
  std::vector<core::MaterialPart> solids;
};

/// The part of a design that was not written.
[[nodiscard]] Part part_of(const core::Design& design);

}  // namespace kreisel

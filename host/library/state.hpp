// state.hpp - what the handles of the public headers hold.
#pragma once

#include <mutex>
#include <new>
#include <stdexcept>

#include "body/source.hpp"
#include "design/design.hpp"
#include "kreisel/session.hpp"
#include "session/session.hpp"

namespace kreisel {

struct Device::State {
  core::device::Device device;
};

struct Body::State : core::Source {};

/// Runs `work`; what the host throws beside errors of ours becomes one.
template <class Work>
auto translated(const Work& work) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error("not enough memory; expected more, fewer cells or a mesh of fewer triangles");
  } catch (const std::runtime_error& error) {  // of OpenCL, or too little memory for it
    throw Error(error.what());
  }
}

namespace core {

/// A file's mesh as it is, in mm. @throws InputError  as Body::read(), but for what it bounds
[[nodiscard]] Source read_source(const std::filesystem::path& file, double mm_per_unit,
                                 const Mending& mending);
/// @throws InputError  triangles of vertices that are not there, or not finite; none
[[nodiscard]] Source source_of(Mesh mesh, const Mending& mending);

}  // namespace core

struct Session::State {
  State(std::shared_ptr<const core::Source> solid, std::shared_ptr<core::device::Device> device)
      : session(std::move(solid), std::move(device)) {}

  /// One question; says what it made, whatever came of it.
  template <class Work>
  auto asked(const Work& work) {
    const std::unique_lock alone(busy, std::try_to_lock);
    if (!alone) throw Error("a session asked by two threads at once; expected a session for each");
    struct Note {
      State& state;
      ~Note() { state.made.assign(state.session.made().begin(), state.session.made().end()); }
    } const note{*this};
    return translated(work);
  }

  core::Session session;
  std::vector<std::string> made;
  std::mutex busy;
};

struct Part::State {
  std::vector<core::MaterialPart> solids;
};

/// The part of a design that was not written.
[[nodiscard]] Part part_of(const core::Design& design);

}  // namespace kreisel

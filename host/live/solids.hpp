// solids.hpp - where a tab's body comes from: a name that is known, or the bytes of a mesh.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "body/source.hpp"
#include "control.hpp"
#include "live/setup.hpp"

namespace kreisel::core::live {

/// A mesh, and the solid that it bounds.
struct Opened {
  BodySpec spec;  ///< its name, unit and mending
  std::shared_ptr<const Source> mesh, solid;
};

/// Names that a request may open: that of the command line's body, if there is one, and those of shapes.
[[nodiscard]] std::vector<std::string> names_of(const Setup& setup);
/// The one of them that the program was started with; empty: none.
[[nodiscard]] std::string first_of(const Setup& setup);

/// The mesh of that name, neither checked nor mended. @throws InputError  none of these names
[[nodiscard]] Opened open_named(const Setup& setup, const std::string& name, const BodySpec& said);

/// The mesh in these bytes, neither checked nor mended. No file is read or written.
/// @param name  of a file, which says by its end what format it is
/// @throws InputError  as a reader says it; more triangles than the setup allows
[[nodiscard]] Opened open_sent(const Setup& setup, const std::string& name, std::string bytes,
                               const BodySpec& said);

/// The solid, mended where that is safe. @throws InputError  it bounds none; or nobody said in which unit
/// lengths are that can hardly be mm
void make_solid(Opened& opened);

}  // namespace kreisel::core::live

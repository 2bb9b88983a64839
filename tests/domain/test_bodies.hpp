// test_bodies.hpp - bodies that are made in body units, without a file, a model or a device.
#pragma once

#include <string>

#include "body/body.hpp"
#include "body/mesh_moments.hpp"
#include "body/test_meshes.hpp"

namespace kreisel::core {

/// `local` is in body units already; its own coordinates are `length` times as large.
inline Body body_of(TriangleMesh local, double length = 1) {
  Body body;
  body.name = "test";
  body.frame.length = length;
  body.axis = Vec3::UnitZ();
  body.contact = Vec3::Zero();
  body.mesh = to_model(body.frame, local);
  body.solid = reference::mesh_moments(local).value;
  body.local = std::move(local);
  return body;
}

}  // namespace kreisel::core

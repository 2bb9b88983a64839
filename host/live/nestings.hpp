// nestings.hpp - one shape in another, while a hand moves it.
#pragma once

#include <memory>

#include "live/message.hpp"
#include "live/worker.hpp"
#include "nest/decide/hybrid.hpp"
#include "run/nest_config.hpp"

namespace kreisel::core::live {

/// The fields of a nesting of this kind that a request may set: where the shapes lie and how they come apart;
/// of a search ("swarm"), how it goes on, too. None that names a shape, a device or a file.
[[nodiscard]] const Fields<NestConfig>& nest_fields(std::string_view kind);
/// One of that kind as it begins.
[[nodiscard]] NestConfig usual_nesting(std::string_view kind);

class Nestings {
 public:
  /// @param outer, inner  mm, coordinates of their own
  /// @throws InputError  shapes that nothing nests in
  Nestings(TriangleMesh outer, TriangleMesh inner, Send send);

  /// Sends the largest scale at this placement, and what blocks a larger one.
  /// @param config  of kind "scale"
  void ask(const nlohmann::json& id, const NestConfig& config);
  /// Looks for a larger one from that placement on, and sends the best whenever there is a better; a stop
  /// keeps it. @param config  of kind "swarm"
  void optimise(const nlohmann::json& id, const NestConfig& config, const std::stop_token& stop);

 private:
  [[nodiscard]] nest::Placement placement_of(const NestConfig& config) const;
  [[nodiscard]] nlohmann::json placement_json(const nest::Placement& placement) const;

  nest::Nesting nesting_;
  nest::Hybrid hybrid_;
  Send send_;
};

}  // namespace kreisel::core::live

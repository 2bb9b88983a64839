// answers.hpp - what one tab is told of its body while it drags, and when it rests.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "live/message.hpp"
#include "live/picture.hpp"
#include "live/worker.hpp"
#include "session/solved_run.hpp"

namespace kreisel::core::live {

/// Questions about one body, answered over two domains that live: the one that is asked for, and a coarse one
/// for as long as a hand moves what makes the fine one anew.
class Answers {
 public:
  Answers(std::shared_ptr<const Source> solid, std::string model, const device::Device& device, Send send);

  /// Sends the answer and what of the picture changed; at rest the certificate, too, or what cannot be met.
  /// @param id      that the answer repeats
  /// @param moving  a hand moves: another question follows
  /// @throws InputError, Interrupted, MemoryError
  void ask(const nlohmann::json& id, RunConfig question, bool moving, const Worker::Turn& turn);

 private:
  /// What a fine domain takes long to make for: while it stays as it is, it answers.
  struct Costly {
    Wall wall;
    GridSpec grid;
    BodySpec shaped;
    bool operator==(const Costly&) const = default;
  };
  [[nodiscard]] static Costly costly(const RunConfig& question);
  void certify(const nlohmann::json& id, const RunConfig& question, const Worker::Turn& turn);

  std::shared_ptr<const Source> solid_;
  std::string model_;
  Send send_;
  Session fine_, coarse_, own_rays_;
  std::optional<Costly> laid_;  ///< of the fine session
  Picture picture_;
};

}  // namespace kreisel::core::live

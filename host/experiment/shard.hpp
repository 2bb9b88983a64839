// shard.hpp - the share of an experiment that one of several processes takes, on one machine or on many.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "experiment/experiment.hpp"

namespace kreisel::core {

struct Shard {
  std::size_t number = 1, of = 1;  ///< 1 <= number <= of
};

/// "2/8". @throws InputError  anything else
[[nodiscard]] Shard shard_of(std::string_view text);

/// The experiment with the runs of that shard alone. The shards are disjoint, together they are the whole,
/// and they depend on nothing but the experiment: not on what is on record. So they need not know of each
/// other, and a shard that is begun again goes on where it was.
///
/// Runs that a table sets beside each other stay together, for their times are compared. Shards come out
/// about equal in each kind of work for itself (Effort), as nobody knows beforehand how long one kind takes
/// beside another: the heaviest first, each to the shard that has least of its kinds.
[[nodiscard]] Experiment share_of(const Experiment& experiment, const Shard& shard);

}  // namespace kreisel::core

// nest_table.hpp - tables of nestings.
#pragma once

#include "experiment/table.hpp"

namespace kreisel::core {

/// A row a nesting, beside a paper's row of the same label, as far as a comma. What is called a stand-in has
/// another shape than the paper's: the paper's scale stands in parentheses beside it.
[[nodiscard]] Tables nestings_tables(const std::vector<RecordedRun>& runs,
                                     const std::optional<Published>& published);

/// A block for each pair of shapes, a row for each label, or setting of a search without one, over all its
/// seeds; how many of them reach what a paper has of that outer shape.
[[nodiscard]] Tables nest_variants_tables(const std::vector<RecordedRun>& runs,
                                          const std::optional<Published>& published);

/// A block for each pair of shapes, a row for each resolution of the samples.
[[nodiscard]] Tables nest_accuracy_tables(const std::vector<RecordedRun>& runs,
                                          const std::optional<Published>& published);

/// A block for each run, a row for each layer from the outside in.
[[nodiscard]] Tables nest_layers_tables(const std::vector<RecordedRun>& runs,
                                        const std::optional<Published>& published);

/// A row a landscape, with the time that 256 x 256 centroids of 256 x 256 rotations take at its speed.
[[nodiscard]] Tables nest_landscape_tables(const std::vector<RecordedRun>& runs,
                                           const std::optional<Published>& published);

/// What of a configuration differs among the runs, seeds aside: "swarm = basic, topology = ring" of each;
/// "defaults" where it has nothing of that.
[[nodiscard]] std::vector<std::string> settings_of_search(const std::vector<RecordedRun>& runs);

}  // namespace kreisel::core

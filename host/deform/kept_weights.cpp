#include "deform/kept_weights.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "device/program.hpp"
#include "error.hpp"
#include "file/content_key.hpp"
#include "file/replace_file.hpp"

namespace kreisel::core {
namespace {

constexpr std::string_view version = "biharmonic weights, 1";  ///< of the numbers and of the file

/// What stands in the file ahead of the entries.
struct Head {
  std::int64_t rows, columns, entries;
  double residual, sum_off;
};
struct Entry {
  std::int32_t row, column;
  double value;
};

}  // namespace

std::filesystem::path kept_at(const Cage& cage) {
  std::string all = fmt::format("{}\n{} {} {} {}\n", version, cage.grid().cells[0], cage.grid().cells[1],
                                cage.grid().cells[2], cage.grid().finer);
  for (const std::uint8_t met : cage.met()) all += met ? '1' : '0';
  return device::cache_folder() / fmt::format("weights-{}", content_key(all));
}

std::optional<BiharmonicWeights> read_weights(const std::filesystem::path& path, const Cage& cage) {
  std::ifstream in(path, std::ios::binary);
  Head head{};
  if (!in.read(reinterpret_cast<char*>(&head), sizeof head)) return std::nullopt;
  const auto rows = static_cast<std::int64_t>(cage.nodes().size()),
             columns = static_cast<std::int64_t>(cage.handles().size());
  if (head.rows != rows || head.columns != columns || head.entries < 0 || head.entries > rows * columns)
    return std::nullopt;
  std::vector<Entry> entries(static_cast<std::size_t>(head.entries));
  if (!in.read(reinterpret_cast<char*>(entries.data()),
               static_cast<std::streamsize>(entries.size() * sizeof(Entry))))
    return std::nullopt;
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(entries.size());
  for (const Entry& e : entries) {
    if (e.row < 0 || e.row >= rows || e.column < 0 || e.column >= columns || !(e.value >= 0 && e.value <= 1))
      return std::nullopt;
    triplets.emplace_back(e.row, e.column, e.value);
  }
  BiharmonicWeights result;
  result.weights.resize(rows, columns);
  result.weights.setFromTriplets(triplets.begin(), triplets.end());
  const Eigen::VectorXd sums = result.weights * Eigen::VectorXd::Ones(columns);
  if ((sums.array() - 1).abs().maxCoeff() > 1e-8) return std::nullopt;
  result.residual = head.residual;
  result.sum_off = head.sum_off;
  return result;
}

void write_weights(const std::filesystem::path& path, const BiharmonicWeights& weights) try {
  std::vector<Entry> entries;
  entries.reserve(static_cast<std::size_t>(weights.weights.nonZeros()));
  for (int row = 0; row < weights.weights.outerSize(); ++row)
    for (NodeWeights::InnerIterator e(weights.weights, row); e; ++e)
      entries.push_back({row, static_cast<std::int32_t>(e.col()), e.value()});
  const Head head{weights.weights.rows(), weights.weights.cols(), weights.weights.nonZeros(),
                  weights.residual, weights.sum_off};
  replace_file(path, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out.write(reinterpret_cast<const char*>(&head), sizeof head);
    out.write(reinterpret_cast<const char*>(entries.data()),
              static_cast<std::streamsize>(entries.size() * sizeof(Entry)));
    out.close();
    if (!out) throw InputError("no room");
  });
} catch (const InputError&) {
}

}  // namespace kreisel::core

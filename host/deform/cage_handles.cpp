#include "deform/cage_handles.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace kreisel::core {

std::shared_ptr<const WeightedCage> weighted_cage(const TriangleMesh& mesh, int level, int fine,
                                                  const Control& control) {
  Cage cage(mesh, centred_cage_grid(mesh, level, fine));
  BiharmonicWeights weights = biharmonic_weights(cage, control);
  return std::make_shared<const WeightedCage>(WeightedCage{std::move(cage), std::move(weights)});
}

HandleWeights CageHandles::at(const Vec3& x) const {
  const Cage& cage = of_->cage;
  const Cage::Inside inside = cage.inside(x);
  const auto corners = cage.corners(inside.cell);
  const auto shares = inside.shares();
  std::vector<double> weight(count(), 0.0);
  std::vector<Vec3> gradient(count(), Vec3::Zero());
  for (std::size_t part = 0; part < 8; ++part) {
    Vec3 slope;
    for (std::size_t a = 0; a < 3; ++a) {
      double rest = inside.moved[a] ? 0 : (part >> a & 1 ? 1 : -1) / cage.grid().h();
      for (std::size_t b = 0; b < 3; ++b) {
        if (b == a) continue;
        const double t = inside.at[static_cast<Eigen::Index>(b)];
        rest *= part >> b & 1 ? t : 1 - t;
      }
      slope[static_cast<Eigen::Index>(a)] = rest;
    }
    for (NodeWeights::InnerIterator w(of_->biharmonic.weights, corners[part]); w; ++w) {
      weight[static_cast<std::size_t>(w.col())] += shares[part] * w.value();
      gradient[static_cast<std::size_t>(w.col())] += w.value() * slope;
    }
  }
  HandleWeights all;
  for (std::uint32_t k = 0; k < weight.size(); ++k)
    if (weight[k] != 0 || gradient[k] != Vec3::Zero()) all.push_back({k, weight[k], gradient[k]});
  return all;
}

Eigen::MatrixXd CageHandles::bending() const {
  const Cage& cage = of_->cage;
  const auto n = static_cast<Eigen::Index>(cage.nodes().size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::Index row = 0;
  const auto add = [&](std::initializer_list<std::pair<Cage::Place, double>> difference, double weight) {
    std::vector<std::pair<Eigen::Index, double>> terms;
    for (const auto& [place, factor] : difference) {
      const std::int32_t node = cage.node(place);
      if (node < 0) return;
      terms.emplace_back(node, factor * std::sqrt(weight));
    }
    for (const auto& [node, factor] : terms) entries.emplace_back(row, node, factor);
    ++row;
  };
  const auto moved = [](Cage::Place c, std::size_t a, int by) {
    c[a] += by;
    return c;
  };
  for (const Cage::Place& c : cage.nodes())
    for (std::size_t a = 0; a < 3; ++a) {
      add({{moved(c, a, -1), 1}, {c, -2}, {moved(c, a, 1), 1}}, 1);
      const std::size_t b = (a + 1) % 3;  // a mixed derivative counts twice
      add({{c, 1}, {moved(c, a, 1), -1}, {moved(c, b, 1), -1}, {moved(moved(c, a, 1), b, 1), 1}}, 2);
    }
  NodeWeights differences(row, n);
  differences.setFromTriplets(entries.begin(), entries.end());
  const NodeWeights bent = differences * of_->biharmonic.weights;
  const double fourth = *std::ranges::max_element(cage.grid().cells) * cage.grid().finer / 4.0;
  return std::pow(fourth, 4) / static_cast<double>(n) * Eigen::MatrixXd(NodeWeights(bent.transpose()) * bent);
}

}  // namespace kreisel::core

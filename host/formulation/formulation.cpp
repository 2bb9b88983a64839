#include "formulation/formulation.hpp"

#include <fmt/format.h>

#include "error.hpp"
#include "formulation/octree.hpp"
#include "formulation/quadric.hpp"
#include "formulation/rayrep.hpp"
#include "formulation/voxel.hpp"

namespace kreisel::core {

double SparseForm::value(std::span<const double> x) const {
  double sum = 0;
  for (const SparseRows::Entry& e : entries)
    sum += (e.row == e.column ? 0.5 : 1.0) * e.value * x[static_cast<std::size_t>(e.row)] *
           x[static_cast<std::size_t>(e.column)];
  return sum;
}

void SparseForm::add_gradient(std::span<const double> x, std::span<double> out) const {
  for (const SparseRows::Entry& e : entries) {
    const auto i = static_cast<std::size_t>(e.row), j = static_cast<std::size_t>(e.column);
    out[i] += e.value * x[j];
    if (i != j) out[j] += e.value * x[i];
  }
}

std::vector<double> Formulation::start(Start where) const {
  const Bounds& b = bounds();
  if (where == Start::lower) return b.lower;
  if (where == Start::upper) return b.upper;
  std::vector<double> x(num_variables());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = (b.lower[i] + b.upper[i]) / 2;
  return x;
}

void Formulation::warm_up() {
  const std::vector<double> x = start(Start::middle);
  std::vector<double> out(x.size());
  const Moments weight = Moments::Ones();
  (void)moments(x);
  pull_back(x, {&weight, 1}, out);
  curvature(x, weight, out);
}

namespace {

std::vector<FormulationEntry> ours() {
  return {
      {"voxel", "one fill in [0,1] an interior voxel", make_voxel, {.derivatives = true, .voxels = true}},
      {"rayrep",
       "one solid segment [z0,z1] a ray [RayRep, s. 2-3]",
       make_rayrep,
       {.derivatives = true, .heights = true},
       {"columns"},
       rayrep_fields()},
      {"octree",
       "one fill in [0,1] a cell of an octree, refined along the voids [SpinIt, s. 5]",
       make_octree,
       {.derivatives = true, .refinement = true},
       {"columns"},
       octree_fields()},
      {"quadric",
       "solid where a quadric is negative: ten coefficients, exact at the optimum [Hafner, Ly, Wojtan "
       "2024] "
       "(docs/quadric.md)",
       make_quadric,
       {.oracle = true},
       {"exact", "columns"}},
  };
}

}  // namespace

Registry<FormulationEntry>& formulations() {
  static Registry<FormulationEntry> all("formulation", ours());
  return all;
}

const FormulationEntry& find_formulation(std::string_view name) { return formulations().find(name); }

std::unique_ptr<Formulation> make_formulation(std::string_view name, const Columns& domain,
                                              const Traits& traits, const SettingTexts& settings,
                                              device::Device& device) {
  const FormulationEntry& entry = find_formulation(name);
  return entry.make(domain, traits, entry.settings.read(settings, "formulation", name), device);
}

}  // namespace kreisel::core

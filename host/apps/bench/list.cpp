#include <fmt/format.h>

#include <algorithm>

#include "apps/bench/commands.hpp"
#include "body/models.hpp"
#include "body/models/debian_meshes.hpp"
#include "experiment/experiment.hpp"
#include "formulation/formulation.hpp"
#include "problem/problem.hpp"
#include "solve/solver.hpp"

namespace kreisel::core::bench {
namespace {

void print_models() {
  fmt::print("models (--model NAME, or a mesh file; --size MM scales)\n");
  for (const Model& m : models()) fmt::print("  {:<12} {}\n", m.name, m.summary);
  fmt::print(
      "real meshes (--model NAME), longest side {:g} mm, {}\n", DebianMesh::size,
      debian_meshes_installed() ? "installed" : "not installed: apt install libcgal-demo provides them");
  for (const DebianMesh& m : debian_meshes()) fmt::print("  {:<12} {}\n", m.name, m.summary);
}

void print_experiments() {
  fmt::print("experiments (bench run NAME)\n");
  for (const std::string& name : experiment_names()) fmt::print("  {}\n", name);
}

}  // namespace

int list() {
  print_models();
  fmt::print("problems (--problem)\n");
  for (const ProblemEntry& p : problems()) fmt::print("  {:<12} {}\n", p.name, p.summary);
  fmt::print("formulations (--formulation)\n");
  for (const FormulationEntry& f : formulations()) fmt::print("  {:<12} {}\n", f.name, f.summary);
  fmt::print("solvers (--solver)\n");
  for (const SolverEntry& s : solvers()) fmt::print("  {:<12} {}\n", s.name, s.summary);
  fmt::print("which pairs work\n  {:<12}", "");
  for (const SolverEntry& s : solvers()) fmt::print(" {:<12}", s.name);
  for (const FormulationEntry& f : formulations()) {
    fmt::print("\n  {:<12}", f.name);
    for (const SolverEntry& s : solvers()) fmt::print(" {:<12}", s.works_with(f) ? "yes" : "no");
  }
  fmt::print("\n");
  fmt::print("kinds of runs (bench fields KIND: what they can be told)\n");
  for (const RunKind& kind : run_kinds()) fmt::print("  {:<12} {}\n", kind.name, kind.help);
  print_experiments();
  return done;
}

}  // namespace kreisel::core::bench

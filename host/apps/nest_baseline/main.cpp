// main.cpp - `nest_baseline`: a nesting found by a search of pagmo2, on record as `bench nest` would put it.
//
// A program of its own, called by `bench run`: with pagmo's libraries `bench` would take more memory to
// start.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "apps/shared/exit_code.hpp"
#include "apps/shared/program.hpp"
#include "apps/shared/run_options.hpp"
#include "baselines/pagmo.hpp"
#include "error.hpp"
#include "record/nest_record.hpp"

namespace {

using namespace kreisel::core;

int dispatch(int argc, char** argv) {
  CLI::App app("The largest nesting by a search of pagmo2", "nest_baseline");
  apps::RunOptions options;
  std::string record;
  options.add(app, apps::nesting_kinds());
  app.add_option("--record", record, "write the whole run as HDF5")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    throw InputError(apps::explained(app, error));
  }
  GivenFields given;
  for (const GivenText& field : options.given()) given.emplace_back(field.name, field.text);
  const NestConfig config = make_nest(given);
  const auto* search = part_of<NestSearch>(config);
  if (!search || !nest::is_baseline(search->swarm))
    throw InputError(fmt::format("swarm = '{}', {}; expected a search of pagmo's over something, by --free",
                                 search ? search->swarm : "", entry_of(config).what));
  NestHooks hooks;
  hooks.control.stop = apps::interruption();
  hooks.optimise = [](const nest::Nesting& nesting, device::Device& device, const nest::OptimiseSpec& spec,
                      const nest::OnIteration& on_iteration, const nest::SearchState*) {
    return nest::optimise_with_pagmo(nesting, device, spec, on_iteration);
  };
  const NestResult result = run_nest(config, hooks);
  if (result.ending == NestResult::Ending::interrupted) return apps::was_interrupted;
  write_nest(record, result);
  return apps::done;
}

}  // namespace

int main(int argc, char** argv) { kreisel::core::apps::run_program("nest_baseline", dispatch, argc, argv); }

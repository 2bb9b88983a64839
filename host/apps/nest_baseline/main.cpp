// main.cpp - `nest_baseline`: a nesting found by a search of pagmo2, on record as `bench nest` would put it.
//
// A program of its own, called by `bench run`: with pagmo's libraries `bench` would take more memory to
// start.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "apps/shared/exit_code.hpp"
#include "apps/shared/nest_options.hpp"
#include "apps/shared/program.hpp"
#include "baselines/pagmo.hpp"
#include "error.hpp"
#include "record/nest_record.hpp"

namespace {

using namespace kreisel::core;

int dispatch(int argc, char** argv) {
  CLI::App app("The largest nesting by a search of pagmo2", "nest_baseline");
  std::vector<std::pair<std::string, std::string>> given;
  std::string record;
  apps::add_nest_fields(app, given);
  app.add_option("--record", record, "write the whole run as HDF5")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help
    throw InputError(apps::explained(app, error));
  }
  NestConfig config;
  for (const auto& [field, text] : given) set_field(config, field, text);
  if (config.free.empty() || !nest::is_baseline(config.swarm))
    throw InputError(fmt::format("swarm = '{}', free = '{}'; expected a search of pagmo's over something",
                                 config.swarm, config.free));
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

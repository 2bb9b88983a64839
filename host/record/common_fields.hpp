// common_fields.hpp - what the records of all kinds have in common.
#pragma once

#include <map>
#include <string>
#include <type_traits>

#include "record/schema.hpp"
#include "record/values.hpp"
#include "run/run.hpp"
#include "session/provenance.hpp"

namespace kreisel::core::fields {

template <class F, class P>
void provenance_fields(F& f, P& p) {
  f.value("provenance/version", "provenance.version", p.version);
  f.value("provenance/commit", "commit", p.commit);
  f.value("provenance/compiler", "provenance.compiler", p.compiler);
  f.value("provenance/build_type", "provenance.build_type", p.build_type);
  f.value("provenance/host", "provenance.host", p.host);
  f.value("provenance/processor", "provenance.processor", p.processor);
  f.value("provenance/system", "provenance.system", p.system);
  f.value("provenance/threads", "provenance.threads", p.threads);
  f.value("provenance/device", "device", p.device);
  f.value("provenance/platform", "provenance.platform", p.platform);
  f.value("provenance/driver", "provenance.driver", p.driver);
  f.value("provenance/device_version", "provenance.device_version", p.device_version);
  f.value("provenance/device_fp64", "provenance.device_fp64", p.device_fp64);
  f.value("provenance/single_precision", "provenance.single_precision", p.single_precision);
  f.value("provenance/ipopt_version", "provenance.ipopt_version", p.ipopt_version);
  f.value("provenance/linear_solver", "provenance.linear_solver", p.linear_solver);
  f.value("provenance/blas", "provenance.blas", p.blas);
  f.value("provenance/started", "provenance.started", p.started);
  if constexpr (F::reading) p.load = std::numeric_limits<double>::quiet_NaN();  // unknown of early records
  f.late("provenance/load", "provenance.load", p.load);
}

/// Sets what a record says was asked for. What is registered in another program alone is taken as it is.
template <class Config>
void restore(Config& config, const std::map<std::string, std::string>& texts) {
  // What is not said is columns, also of a formulation whose own domain is another.
  if constexpr (std::is_base_of_v<Asked, Config>) config.domain = "columns";
  if constexpr (std::is_same_v<Config, SimulationRun>) {
    for (const auto& [name, text] : texts) {
      if (find_field(simulation_fields(), name))
        set_field(simulation_fields(), config, name, text);
      else
        set_setting(config, name, text);
    }
  } else if constexpr (std::is_base_of_v<Asked, Config>) {
    for (const auto& [name, text] : texts) {
      if (name == "problem")
        config.problem = text;
      else if (name == "formulation")
        config.formulation = text;
      else if (name == "solver")
        config.solver = text;
      else
        set_field(config, name, text);
    }
  } else {
    config = make_nest({texts.begin(), texts.end()});
  }
}

/// A configuration is a text for each field, in the file and in JSON.
template <class F, class Config>
void config_fields(F& f, Config& config) {
  std::map<std::string, std::string> texts;
  if constexpr (!F::reading) texts = describe(config);
  f.names("config", "", "config", texts);
  if constexpr (F::reading) restore(config, texts);
}

/// The optional's value; one that is read is made first.
template <class F, class T>
auto& engaged(T& optional) {
  if constexpr (F::reading) optional.emplace();
  return *optional;
}

template <class F>
void schema_fields(F& f, const Schema& schema) {
  f.stored("schema", std::string(schema.name));
  f.stored("schema_version", schema.newest);
}

}  // namespace kreisel::core::fields

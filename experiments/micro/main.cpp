// main.cpp - `kreisel_micro`: every kernel beside its plain loop and the ceilings of the machine, ray
// construction beside Embree's, and the way from mesh to domain. Google Benchmark's options apply; our own
// come first.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "error.hpp"
#include "micro.hpp"
#include "session/provenance.hpp"

namespace {

using namespace kreisel::core;
using namespace kreisel::core::micro;

constexpr const char* usage =
    "kreisel_micro [--device NAME] [--model NAME|FILE] [--benchmark_...]\n"
    "  --device   index or part of a name; default KREISEL_DEVICE, else a GPU, else PoCL\n"
    "  --model    what mesh to domain is measured on; default bird\n"
    "Defaults of Google Benchmark here: 5 repetitions, randomly interleaved, aggregates shown, and JSON in\n"
    "results/micro/COMMIT.json unless --benchmark_out says otherwise.\n";

struct Options {
  std::string device, model = "bird";
  std::vector<std::string> passed;  ///< to Google Benchmark
};

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string_view option = argv[i];
    if (option == "--help") {
      fmt::print("{}", usage);
      std::exit(0);
    }
    if (option == "--device" || option == "--model") {
      if (++i == argc) throw InputError(fmt::format("{} without a value", option));
      (option == "--device" ? options.device : options.model) = argv[i];
    } else if (option.starts_with("--benchmark_")) {
      options.passed.emplace_back(option);
    } else {
      throw InputError(fmt::format("'{}'; expected --device, --model or --benchmark_...", option));
    }
  }
  return options;
}

/// What the user did not say, before what was said.
std::vector<std::string> with_defaults(const Options& options, const Provenance& made) {
  std::vector<std::string> all = {"kreisel_micro", "--benchmark_enable_random_interleaving=true",
                                  "--benchmark_repetitions=5", "--benchmark_min_time=0.1",
                                  "--benchmark_display_aggregates_only=true"};
  const auto given = [&](std::string_view name) {
    return std::ranges::any_of(options.passed, [&](const std::string& o) { return o.starts_with(name); });
  };
  if (!given("--benchmark_out=") && !given("--benchmark_list_tests")) {
    const std::filesystem::path folder = "results/micro";
    std::filesystem::create_directories(folder);
    all.push_back(fmt::format("--benchmark_out={}", (folder / (made.commit + ".json")).string()));
  }
  all.insert(all.end(), options.passed.begin(), options.passed.end());
  return all;
}

void add_context(const Provenance& made) {
  const auto add = [](const char* name, const std::string& value) {
    benchmark::AddCustomContext(name, value);
  };
  add("version", made.version);
  add("commit", made.commit);
  add("compiler", made.compiler);
  add("build_type", made.build_type);
  add("host", made.host);
  add("processor", made.processor);
  add("system", made.system);
  add("threads", std::to_string(made.threads));
  add("device", made.device);
  add("platform", made.platform);
  add("driver", made.driver);
  add("device_version", made.device_version);
  add("started", made.started);
}

void add_ceilings(const std::string& precision, Machine& machine) {
  const auto add = [&](const char* what, double rate) {
    benchmark::AddCustomContext(fmt::format("ceiling_{}_{}", what, precision), fmt::format("{:.4g}", rate));
  };
  const device::Ceilings ceilings = device::measure(machine.device);
  add("read_bytes_per_s", ceilings.read_bytes_per_s);
  add("copy_bytes_per_s", ceilings.copy_bytes_per_s);
  add("flops", machine.device.single() ? ceilings.flops_single : ceilings.flops_double);
}

int run(int argc, char** argv) {
  const Options options = parse(argc, argv);
  Machine standard(options.device, device::Precision::automatic);
  const Provenance made = make_provenance(standard.device);
  add_context(made);
  std::unique_ptr<Machine> single;
  if (!standard.device.single())
    single = std::make_unique<Machine>(options.device, device::Precision::single);
  for (Machine* machine : {&standard, single.get()}) {
    if (!machine) continue;
    add_ceilings(machine->precision(), *machine);
    const bool with_loops = machine == &standard;
    register_rays(*machine, with_loops);
    register_quadric(*machine, with_loops);
    register_voxels(*machine, with_loops);
    register_meshes(*machine, with_loops);
  }
  register_cells(standard, options.model);
  register_domain(standard, options.model);

  std::vector<std::string> arguments = with_defaults(options, made);
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  int count = static_cast<int>(pointers.size());
  benchmark::Initialize(&count, pointers.data());
  if (count > 1) throw InputError(fmt::format("Google Benchmark does not know '{}'", pointers[1]));
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return all_agree ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const InputError& error) {
    fmt::print(stderr, "kreisel_micro: {}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "kreisel_micro: internal error: {}\n", error.what());
    return 1;
  }
}

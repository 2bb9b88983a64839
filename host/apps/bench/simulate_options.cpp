#include "apps/bench/simulate_options.hpp"

#include <fmt/format.h>

#include "apps/shared/completion.hpp"
#include "error.hpp"

namespace kreisel::core::bench {

void add_simulate_options(CLI::App& app, SimulateOptions& simulate,
                          const std::function<void(const std::string&, const std::string&)>& give) {
  app.add_option("run", simulate.record, "what `bench --record` wrote; its solid and its part move")
      ->type_name("FILE");
  const auto choices_of = [](std::string_view name) {
    return find_field(simulation_fields(), name)->choices;
  };
  offer(app.add_option_function<std::string>(
               "--mesh,--model",
               [give, &simulate](const std::string& text) {
                 simulate.mesh = true;
                 give("model", text);
               },
               "a mesh file, or a name of `bench list`: itself, and what its outermost surface encloses")
            ->type_name("NAME|FILE"),
        choices_of("model"));
  offer(app.add_option_function<std::string>(
            "--problem", [give](const std::string& text) { give("problem", text); },
            "of a mesh: spin (default), top, yoyo, stand or float"),
        choices_of("problem"));
  offer(app.add_option_function<std::string>(
            "--contact",
            [give, &simulate](const std::string& text) {
              for (const auto& [contact, name] : contacts)
                if (name == text) {
                  simulate.spec.contact = contact;
                  return;
                }
              if (text.find(',') == std::string::npos)
                throw InputError(
                    fmt::format("--contact {}; expected gliding, held, free, or a point x,y,z", text));
              give("contact", text);
            },
            "how the tip touches the ground: gliding (default), held or free; of a mesh also where: x,y,z in "
            "mm"),
        choices_of("touch"));
  for (const Field<SimulationSpec>& field : motion_fields()) {
    if (field.name == "touch") continue;  // part of --contact
    const auto set = [&simulate, &field](const std::string& text) {
      if (field.name == "omega") simulate.omega = true;
      field.set(simulate.spec, field.name, text);
    };
    const std::string option = "--" + option_of(field), help(field.help);
    if (field.name == "scan")
      app.add_flag_callback(
          option, [set] { set("yes"); }, "over a hundred speeds, too");
    else
      app.add_option_function<std::string>(option, set, help)->type_name(std::string(field.unit));
  }
  app.add_option("--axle", simulate.spec.axle_mm,
                 "yoyo: radius of the axle, mm; then it runs down its string, too");
  app.add_option("--json", simulate.json_file, "write it all as JSON; - writes it to standard output")
      ->type_name("FILE");
  app.add_option("--record", simulate.record_file, "write the simulation as HDF5")->type_name("FILE");
}

}  // namespace kreisel::core::bench

#include <fmt/format.h>

#include <span>

#include "error.hpp"
#include "record/hdf5_file.hpp"
#include "record/nest_record.hpp"
#include "record/schema.hpp"

namespace kreisel::core {
namespace {

using hdf5::Group;
using Numbers = std::vector<double>;

constexpr Schema checkpoint_schema = {"kreisel nesting checkpoint", 1, "a checkpoint of a nesting"};

void put(Group& group, const char* name, const Numbers& values) {
  group.write(name, values, {values.size()}, {"1", {}});
}
void put(Group& group, const char* name, const std::vector<int>& values) {
  group.write(name, values, {values.size()}, {"1", {}});
}

void write_swarm(Group group, const nest::SwarmState& s) {
  group.set("iteration", s.iteration);
  group.set("best_value", s.best_value);
  group.set("evaluations", static_cast<std::int64_t>(s.evaluations));
  put(group, "x", s.x);
  put(group, "v", s.v);
  put(group, "own", s.own);
  put(group, "own_value", s.own_value);
  put(group, "rose", s.rose);
  put(group, "drawn", s.drawn);
  put(group, "placed", s.placed);
  put(group, "top", s.top);
  put(group, "best", s.best);
}

nest::SwarmState read_swarm(const Group& group) {
  nest::SwarmState s;
  s.iteration = static_cast<int>(group.integer("iteration"));
  s.best_value = group.real("best_value");
  s.evaluations = static_cast<std::uint64_t>(group.integer("evaluations"));
  s.x = group.read("x").values;
  s.v = group.read("v").values;
  s.own = group.read("own").values;
  s.own_value = group.read("own_value").values;
  s.rose = group.read_integers("rose").values;
  s.drawn = group.read_integers("drawn").values;
  s.placed = group.read_integers("placed").values;
  s.top = group.read("top").values;
  s.best = group.read("best").values;
  return s;
}

void write_climb(Group group, const nest::ClimbState& c) {
  group.set("iteration", c.iteration);
  group.set("value", c.value);
  group.set("step", c.step);
  group.set("success", c.success);
  group.set("evaluations", static_cast<std::int64_t>(c.evaluations));
  put(group, "x", c.x);
  put(group, "covariance", c.covariance);
  put(group, "path", c.path);
}

nest::ClimbState read_climb(const Group& group) {
  nest::ClimbState c;
  c.iteration = static_cast<int>(group.integer("iteration"));
  c.value = group.real("value");
  c.step = group.real("step");
  c.success = group.real("success");
  c.evaluations = static_cast<std::uint64_t>(group.integer("evaluations"));
  c.x = group.read("x").values;
  c.covariance = group.read("covariance").values;
  c.path = group.read("path").values;
  return c;
}

void write_trace(Group& group, const std::vector<nest::SwarmStep>& trace) {
  Numbers rows;
  for (const nest::SwarmStep& s : trace)
    rows.insert(rows.end(), {double(s.iteration), s.best, s.mean, s.feasible, double(s.evaluations)});
  group.write("trace", rows, {trace.size(), 5}, {"1", {}});
}

std::vector<nest::SwarmStep> read_trace(const Group& group) {
  const auto table = group.read("trace");
  std::vector<nest::SwarmStep> trace;
  for (std::size_t i = 0; i + 5 <= table.values.size(); i += 5) {
    const double* row = table.values.data() + i;
    trace.push_back({int(row[0]), row[1], row[2], row[3], std::uint64_t(row[4])});
  }
  return trace;
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const NestCheckpoint& checkpoint) {
  hdf5::File file = hdf5::File::create(path);
  const nest::SearchState& state = checkpoint.state;
  file.set("schema", checkpoint_schema.name);
  file.set("schema_version", checkpoint_schema.newest);
  {
    Group config = file.new_group("config");
    for (const auto& [key, value] : describe(checkpoint.config)) config.set(key, value);
    config.set("device", checkpoint.config.device);
  }
  file.set("phase", static_cast<int>(state.phase));
  file.set("climbs", state.climbs);
  file.set("scale", state.scale);
  write_swarm(file.new_group("swarm"), state.swarm);
  write_climb(file.new_group("climb"), state.climb);
  write_trace(file, state.trace);
  put(file, "best", state.best);
  Numbers memory;
  for (const Vec3& v : state.memory) memory.insert(memory.end(), {v[0], v[1], v[2]});
  put(file, "memory", memory);
  file.write("seconds", checkpoint.seconds, {checkpoint.seconds.size()}, {"s", {}});
  file.close();
}

NestCheckpoint read_checkpoint(const std::filesystem::path& path) {
  const hdf5::File file = hdf5::File::open(path);
  const std::string name = path.string();
  require_schema(file, name, checkpoint_schema);
  NestCheckpoint checkpoint;
  const Group config = file.group("config");
  GivenFields given;
  for (const std::string& key : config.attributes())
    if (std::string value = config.text(key); !value.empty()) given.emplace_back(key, std::move(value));
  checkpoint.config = make_nest(given);
  nest::SearchState& state = checkpoint.state;
  const std::int64_t phase = file.integer("phase");
  if (phase < nest::SearchState::swarming || phase > nest::SearchState::over)
    throw InputError(fmt::format("{}: phase {}; expected 0 to 2", name, phase));
  state.phase = static_cast<nest::SearchState::Phase>(phase);
  state.climbs = static_cast<int>(file.integer("climbs"));
  state.scale = file.real("scale");
  state.swarm = read_swarm(file.group("swarm"));
  state.climb = read_climb(file.group("climb"));
  state.trace = read_trace(file);
  state.best = file.read("best").values;
  const Numbers memory = file.read("memory").values;
  for (std::size_t i = 0; i + 3 <= memory.size(); i += 3)
    state.memory.emplace_back(memory[i], memory[i + 1], memory[i + 2]);
  checkpoint.seconds = file.read("seconds").values;
  return checkpoint;
}

}  // namespace kreisel::core

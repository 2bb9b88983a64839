#include "run/nest_config.hpp"

#include <gtest/gtest.h>

#include "refusal.hpp"

namespace kreisel::core {
namespace {

/// A value for every field that is not its default.
const std::map<std::string_view, std::string_view> others = {
    {"outer", "bunny"},
    {"inner", "bear"},
    {"outer-size", "60"},
    {"inner-size", "30.5"},
    {"fineness", "7"},
    {"scale", "0.25"},
    {"rotation", "0,90,0"},
    {"centroid", "1,2,3"},
    {"plane", "0,1,0"},
    {"through", "1,2,4"},
    {"removal", "0,1,0.5 0,-1,0"},
    {"variant", "envelope"},
    {"resolution", "256"},
    {"upper", "0.75"},
    {"tolerance", "0.001"},
    {"free", "upright,position"},
    {"up", "0,1,0"},
    {"keep-out", "1,2,3,4 5,6,7,0.125"},
    {"swarm", "pagmo-de"},
    {"particles", "20"},
    {"iterations", "30"},
    {"seed", "18446744073709551615"},
    {"topology", "ring"},
    {"momentum", "decreasing"},
    {"inertia", "0.5"},
    {"last-inertia", "0.1"},
    {"own", "0.25"},
    {"social", "0.75"},
    {"placing", "random"},
    {"first-speed", "0.1"},
    {"candidates", "3"},
    {"swarms", "2"},
    {"patience", "15"},
    {"climbs", "4"},
    {"climb-iterations", "50"},
    {"climb-step", "0.01"},
    {"seconds", "1.5"},
    {"accuracy", "12"},
    {"timings", "5"},
    {"layers", "3"},
    {"within", "bear kitten"},
    {"printer-accuracy", "0.7"},
    {"wall", "0.5"},
    {"cells", "96"},
    {"landscape", "32"},
    {"rotations", "64"},
    {"view", "0,0,1"},
    {"keep-shapes", "yes"},
    {"device", "pocl"},
};

TEST(NestConfig, EveryFieldIsSetAndSaidAgainWithAllItsDigits) {
  NestConfig config;
  EXPECT_TRUE(describe(config).empty());
  for (const NestField& field : nest_fields()) {
    ASSERT_TRUE(others.contains(field.name)) << field.name;
    EXPECT_FALSE(field.help.empty()) << field.name;
    set_field(config, field.name, others.at(field.name));
    EXPECT_EQ(field.text(config), others.at(field.name)) << field.name;
  }
  const auto said = describe(config);
  EXPECT_EQ(said.size(), nest_fields().size() - 1) << "the device does not define a run";
  NestConfig again;
  for (const auto& [name, text] : said) set_field(again, name, text);
  EXPECT_EQ(describe(again), said);
}

TEST(NestConfig, NamesRunsByWhatDefinesThem) {
  NestConfig config;
  config.outer = "some/where/bunny.off";
  EXPECT_EQ(shapes_text(config), "bunny in bunny");
  EXPECT_TRUE(run_name(config).starts_with("bunny-in-bunny-scale-")) << run_name(config);
  NestConfig same = config;
  same.inner = same.outer;
  same.device = "gpu";
  EXPECT_EQ(run_name(same), run_name(config));
  same.free = "all";
  EXPECT_EQ(kind_of(same), "swarm");
  NestConfig seeded = same;
  seeded.search.swarm.seed = 2;
  EXPECT_NE(run_name(seeded), run_name(same));
  config.scale = 0.5;
  EXPECT_EQ(kind_of(config), "test");
}

TEST(NestConfig, RefusesWhatDoesNotFitInOneLine) {
  NestConfig config;
  const auto refused = [&](std::string_view name, std::string_view value, const std::string& start,
                           const std::vector<std::string>& parts = {}) {
    expect_refusal([&] { set_field(config, name, value); }, start, parts);
  };
  refused("partcles", "3", "field 'partcles' is unknown (did you mean 'particles'?)");
  refused("plane", "0,0,0", "plane = '0,0,0'", {"not zero"});
  refused("plane", "0,0", "plane = '0,0'", {"x,y,z"});
  refused("removal", "0,0,1", "removal = '0,0,1'", {"two directions"});
  refused("removal", "0,0,1 0,0,0", "removal = '0,0,0'", {"not zero"});
  refused("keep-out", "1,2,3", "keep-out = '1,2,3'", {"ball x,y,z,radius"});
  refused("keep-out", "1,2,3,-1", "keep-out = '1,2,3,-1'", {"ball"});
  refused("outer-size", "0", "outer-size = '0'", {"> 0"});
  refused("variant", "envlope", "feasibility test 'envlope' is unknown (did you mean 'envelope'?)");
  refused("free", "rotatoin", "free part 'rotatoin' is unknown (did you mean 'rotation'?)");
  refused("swarm", "hybird", "variant 'hybird' is unknown (did you mean 'hybrid'?)");
  refused("swarm", "pagmo-cma", "variant 'pagmo-cma' is unknown (did you mean 'pagmo-cmaes'?)");
  refused("topology", "rign", "topology 'rign' is unknown (did you mean 'ring'?)");
  refused("seed", "-1", "seed = '-1'", {">= 0"});
  refused("iterations", "many", "iterations = 'many'", {"whole number"});
  refused("seconds", "0", "seconds = '0'", {"> 0"});
}

TEST(NestConfig, RefusesWhatDoesNotFitTogether) {
  const auto with = [](std::vector<std::pair<const char*, const char*>> fields) {
    NestConfig config;
    for (const auto& [name, value] : fields) set_field(config, name, value);
    return config;
  };
  const auto refused = [&](const NestConfig& config, const std::string& start) {
    expect_refusal([&] { require_valid(config); }, start, {});
  };
  refused(with({}), "no outer shape");
  refused(with({{"outer", "bear"}, {"free", "all"}, {"scale", "0.5"}}), "free with scale");
  refused(with({{"outer", "bear"}, {"free", "all"}, {"accuracy", "5"}}), "accuracy with free");
  refused(with({{"outer", "bear"}, {"free", "all"}, {"particles", "0"}}), "swarm: particles = 0");
  refused(with({{"outer", "bear"}, {"free", "all"}, {"inertia", "1.5"}}), "swarm: inertia = 1.5");
  refused(with({{"outer", "bear"}, {"free", "all"}, {"climb-iterations", "-1"}}), "climb: iterations = -1");
  refused(with({{"outer", "bear"}, {"free", "all"}, {"swarm", "pagmo-de"}, {"particles", "3"}}),
          "pagmo-de with 3 particles");
  EXPECT_NO_THROW(require_valid(with({{"outer", "bear"}, {"free", "all"}, {"iterations", "0"}})));
}

}  // namespace
}  // namespace kreisel::core

#include "run/nest_config.hpp"

#include <gtest/gtest.h>

#include "refusal.hpp"

namespace kreisel::core {
namespace THIS_FILE {

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
    {"exchange", "10"},
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
  for (const NestKindEntry& kind : nest_kinds()) {
    NestConfig config;
    config.kind = kind.empty;
    EXPECT_TRUE(describe(config).empty());
    EXPECT_EQ(kind_of(config), kind.name);
    for (const Field<NestConfig>& field : kind.fields) {
      ASSERT_TRUE(others.contains(field.name)) << field.name;
      EXPECT_FALSE(field.help.empty()) << field.name;
      set_field(config, field.name, others.at(field.name));
      EXPECT_EQ(field.text(config), others.at(field.name)) << field.name;
    }
    const auto said = describe(config);
    EXPECT_EQ(said.size(), kind.fields.size() - 1) << "the device does not define a run";
    EXPECT_EQ(describe(make_nest({said.begin(), said.end()})), said) << kind.name;
  }
}

TEST(NestConfig, NamesRunsByWhatDefinesThem) {
  const NestConfig config = make_nest({{"outer", "some/where/bunny.off"}});
  EXPECT_EQ(shapes_text(config), "bunny in bunny");
  EXPECT_TRUE(run_name(config).starts_with("bunny-in-bunny-scale-")) << run_name(config);
  NestConfig same = config;
  same.inner = same.outer;
  same.device = "gpu";
  EXPECT_EQ(run_name(same), run_name(config));
  const NestConfig searched = make_nest({{"outer", config.outer}, {"free", "all"}});
  EXPECT_EQ(kind_of(searched), "swarm");
  EXPECT_NE(run_name(make_nest({{"outer", config.outer}, {"free", "all"}, {"seed", "2"}})),
            run_name(searched));
  EXPECT_EQ(kind_of(make_nest({{"scale", "0.5"}})), "test");
}

// Such records there are: what they were named must still find them.
TEST(NestConfig, NamesRunsAsEverBefore) {
  EXPECT_EQ(run_name(make_nest({{"outer", "bunny"}, {"free", "all"}, {"seed", "3"}, {"particles", "50"}})),
            "bunny-in-bunny-swarm-3af27233");
  EXPECT_EQ(
      run_name(make_nest({{"outer", "bunny"}, {"layers", "20"}, {"free", "all"}, {"within", "bear kitten"}})),
      "kitten-in-bear-in-bunny-in-bunny-layers-d00d8c11");
}

TEST(NestConfig, RefusesFieldsOfOtherKindsAndSaysWhichHaveThem) {
  const auto refused = [](const GivenFields& given, const std::string& says) {
    expect_refusal([&] { (void)make_nest(given); }, says, {});
  };
  const std::string no = " has no such field; expected a kind that has it: ";
  for (const char* field : {"centroid", "through"})
    refused({{"layers", "2"}, {"free", "all"}, {field, "0,0,0"}},
            field + (": a nesting of layers" + no + "scale, test, swarm"));
  refused({{"layers", "2"}, {"free", "all"}, {"timings", "3"}},
          "timings: a nesting of layers" + no + "scale, test, swarm");
  for (const char* field : {"particles", "seconds", "iterations"})
    refused({{field, "3"}}, field + (": a search of the scale" + no + "swarm, layers"));
  refused({{"scale", "0.5"}, {"free", "all"}}, "scale: a search over placements" + no + "test");
  refused({{"accuracy", "5"}, {"free", "all"}}, "free: a comparison of variants" + no + "swarm, layers");
  refused({{"keep-out", "0,0,0,1"}}, "keep-out: a search of the scale" + no + "swarm, layers");
  refused({{"landscape", "4"}, {"wall", "1"}}, "wall: a landscape of outlines" + no + "layers");
}

TEST(NestConfig, TakesNamesOfFilesWithSpaces) {
  const NestConfig config =
      make_nest({{"outer", "a b.obj"}, {"layers", "2"}, {"free", "all"}, {"within", "c\\ d.obj e.obj"}});
  EXPECT_EQ(config.outer, "a b.obj");
  EXPECT_EQ(std::get<NestLayers>(config.kind).within, (std::vector<std::string>{"c d.obj", "e.obj"}));
  EXPECT_EQ(describe(config).at("within"), "c\\ d.obj e.obj");
}

TEST(NestConfig, RefusesWhatDoesNotFitInOneLine) {
  const auto refused = [&](std::string_view name, std::string_view value, const std::string& start,
                           const std::vector<std::string>& parts = {}) {
    NestConfig config = make_nest({{"layers", "2"}});
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
  const auto with = [](const GivenFields& fields) { return make_nest(fields); };
  const auto refused = [&](const NestConfig& config, const std::string& start) {
    expect_refusal([&] { require_valid(config); }, start, {});
  };
  refused(with({}), "no outer shape");
  refused(with({{"outer", "bear"}, {"layers", "2"}}), "layers without free");
  refused(with({{"outer", "bear"}, {"free", "all"}, {"particles", "0"}}), "swarm: particles = 0");
  refused(with({{"outer", "bear"}, {"free", "all"}, {"inertia", "1.5"}}), "swarm: inertia = 1.5");
  refused(with({{"outer", "bear"}, {"free", "all"}, {"climb-iterations", "-1"}}), "climb: iterations = -1");
  refused(with({{"outer", "bear"}, {"free", "all"}, {"swarm", "pagmo-de"}, {"particles", "3"}}),
          "pagmo-de with 3 particles");
  EXPECT_NO_THROW(require_valid(with({{"outer", "bear"}, {"free", "all"}, {"iterations", "0"}})));
}

}  // namespace THIS_FILE
}  // namespace kreisel::core

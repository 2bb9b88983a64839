#include "run/run.hpp"

#include <gtest/gtest.h>

#include <set>

#include "experiment/experiment.hpp"
#include "refusal.hpp"
#include "table/data_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

TEST(Run, IsOfTheKindThatItsFieldsSay) {
  const auto kind = [](const std::vector<std::string_view>& names, bool nesting = false) {
    return kind_of_fields(names, nesting).name;
  };
  EXPECT_EQ(kind({}), "solve");
  EXPECT_EQ(kind({"model", "contact"}), "solve");
  EXPECT_EQ(kind({"model", "axes"}), "map");
  EXPECT_EQ(kind({"through"}), "map");
  EXPECT_EQ(kind({"tilt"}), "simulation");
  EXPECT_EQ(kind({"outer", "through"}), "scale");
  EXPECT_EQ(kind({}, true), "scale");
  EXPECT_EQ(kind({"outer", "free", "layers"}), "layers");
  EXPECT_EQ(kind({"outer", "scale"}), "test");
}

TEST(Run, RefusesFieldsOfOtherKindsAndSaysWhichHaveThem) {
  const auto refused = [](const std::vector<GivenText>& given, const std::string& says) {
    expect_refusal([&] { (void)make_run(given); }, says, {});
  };
  const std::string no = " has no such field; expected a kind that has it: ";
  refused({{"axes", "5"}, {"certify", "1e-3"}}, "certify: a map of orientations" + no + "solve");
  refused({{"axes", "5"}, {"rounding", "nearest"}},
          "rounding: a map of orientations" + no + "solve, simulation");
  refused({{"axes", "5"}, {"ipopt.tol", "1"}}, "ipopt.tol: a map of orientations" + no + "solve, simulation");
  refused({{"tilt", "1"}, {"repeat", "3"}}, "repeat: a simulation" + no + "solve");
  refused({{"outer", "bear"}, {"problem", "spin"}},
          "problem: a search of the scale" + no + "solve, map, simulation");
  refused({{"outer", "bear"}, {"problem.draft", "1"}},
          "problem.draft: a search of the scale" + no + "solve, map, simulation");
  refused({{"particles", "5"}}, "particles: a solve" + no + "swarm, layers");
  refused({{"partcles", "5"}}, "field 'partcles' is unknown (did you mean 'particles'?)");
  refused({{"iopt.tol", "5"}}, "setting 'iopt.tol': group 'iopt' is unknown (did you mean 'ipopt'?)");
  refused({{"resolution", "many", "t.toml: line 3: "}}, "t.toml: line 3: resolution = 'many'; expected");
}

TEST(Run, ReadsTheShapesThatAnyOfItsFieldsNames) {
  using Shapes = std::vector<std::string>;
  EXPECT_EQ(shapes_of(make_run({{"model", "a b.stl"}})), Shapes{"a b.stl"});
  EXPECT_EQ(shapes_of(make_run({{"axes", "5"}})), Shapes{"ellipsoid"});
  EXPECT_EQ(
      shapes_of(make_run(
          {{"outer", "x y.obj"}, {"inner", "bear"}, {"layers", "2"}, {"within", "bear k\\ l.stl c.off"}})),
      (Shapes{"x y.obj", "bear", "k l.stl", "c.off"}));
}

// Every field is documented, and no kind has one twice.
TEST(Run, EveryFieldOfEveryKindHasHelp) {
  for (const RunKind& kind : run_kinds()) {
    std::set<std::string_view> names;
    for (const auto& field : kind.fields) {
      EXPECT_FALSE(field.help.empty()) << kind.name << " " << field.name;
      EXPECT_FALSE(field.group.empty()) << kind.name << " " << field.name;
      EXPECT_TRUE(names.insert(field.name).second) << kind.name << " " << field.name;
    }
    EXPECT_TRUE(run_kind_of(kind.empty).name == kind.name);
  }
}

// What a record says of a run is enough to make it again.
TEST(Run, IsMadeAgainFromWhatItSaysOfItself) {
  std::set<std::string_view> seen;
  for (const std::string& name : experiment_names())
    for (const ExperimentRun& run : read_experiment(data_folder() / "experiments" / (name + ".toml")).runs) {
      std::vector<GivenText> said;
      for (const auto& [field, text] : describe(run.run)) said.push_back({field, text});
      if (asked_of(run.run) && text_of(run.run, "domain") == "columns") said.push_back({"domain", "columns"});
      const RunKind& kind = run_kind_of(run.run);
      seen.insert(kind.name);
      const kreisel::core::Run again = make_run(said, kind);
      EXPECT_EQ(run_name(again), run_name(run.run)) << name;
      EXPECT_EQ(describe(again), describe(run.run)) << name;
    }
  EXPECT_GE(seen.size(), 6u) << "solves, maps, simulations and four kinds of nestings come with the program";
}

// Such records there are: what they were named must still find them.
TEST(Run, IsNamedAsEverBefore) {
  const auto name = [](std::vector<GivenText> given) { return run_name(make_run(given)); };
  EXPECT_EQ(name({{"model", "bunny"},
                  {"resolution", "100"},
                  {"wall", "2%"},
                  {"axes", "2000"},
                  {"through", "centre"}}),
            "bunny-100-spin-map-9c17c3e0");
  EXPECT_EQ(name({{"outer", "bunny"}, {"free", "all"}, {"seed", "3"}, {"particles", "50"}}),
            "bunny-in-bunny-swarm-3af27233");
  EXPECT_EQ(name({}), "ellipsoid-64-spin-rayrep-ipopt-dd8434f1");
  EXPECT_EQ(name({{"formulation", "quadric"},
                  {"domain", "columns"},
                  {"wall-to", "corners"},
                  {"axis", "0,1,0.5"},
                  {"problem.lambda", "0.25"},
                  {"certify", "1e-3"},
                  {"precision", "single"}}),
            "ellipsoid-64-spin-quadric-moment-77a40bce");
}

}  // namespace THIS_FILE
}  // namespace kreisel::core

#include <gtest/gtest.h>

#include "body/test_meshes.hpp"
#include "nest/known_answers.hpp"
#include "refusal.hpp"
#include "run/nest_run.hpp"

namespace kreisel::core {
namespace THIS_FILE {

NestConfig layers_of_a_ball() {
  return make_nest({{"outer", "in words"},
                    {"layers", "2"},
                    {"free", "position,centroid-plane"},
                    {"particles", "6"},
                    {"iterations", "2"},
                    {"climb-iterations", "2"}});
}

TEST(NestHooks, OfLayersAreHeeded) {
  NestHooks hooks;
  hooks.shapes = {nest::ball(6)};
  int told = 0, searches = 0;
  hooks.on_iteration = [&](const nest::SearchState&) { return ++told < 100; };
  hooks.optimise = [&](const nest::Nesting& nesting, device::Device& device, const nest::OptimiseSpec& spec,
                       const nest::OnIteration& on_iteration, const nest::SearchState* resume) {
    ++searches;
    return nest::optimise(nesting, device, spec, on_iteration, resume);
  };
  const NestResult result = run_nest(layers_of_a_ball(), hooks);
  EXPECT_EQ(result.layers.value().layers.size(), 2u);
  EXPECT_EQ(searches, 2);
  EXPECT_GE(told, 6);

  hooks.on_iteration = [](const nest::SearchState&) { return false; };
  EXPECT_LE(run_nest(layers_of_a_ball(), hooks).layers.value().layers.size(), 1u);
}

TEST(NestHooks, KeepAndGoOnWithASearchOverPlacementsAlone) {
  NestHooks hooks;
  hooks.shapes = {nest::ball(6)};
  hooks.keep = [](const NestCheckpoint&) {};
  expect_refusal([&] { (void)run_nest(layers_of_a_ball(), hooks); }, "a checkpoint of a nesting of layers",
                 {});
  expect_refusal(
      [&] {
        (void)run_nest(make_nest({{"outer", "in words"}}), hooks);
      },
      "a checkpoint of a search of the scale", {});
  const NestCheckpoint checkpoint;
  hooks.keep = {};
  hooks.resume = &checkpoint;
  expect_refusal([&] { (void)run_nest(layers_of_a_ball(), hooks); }, "a checkpoint of a nesting of layers",
                 {});
}

}  // namespace THIS_FILE
}  // namespace kreisel::core

#include "record/record.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <thread>

#include "error.hpp"
#include "installed.hpp"
#include "places.hpp"
#include "record/hdf5_file.hpp"
#include "record/records_in.hpp"
#include "record/schema.hpp"
#include "refusal.hpp"
#include "temporary_folder.hpp"

namespace kreisel::core {
namespace THIS_FILE {

namespace fs = std::filesystem;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Every field has a value of its own, so that a swap of two cannot pass.
RunResult made_by_hand() {
  RunResult r;
  r.config.body.model = "ellipsoid";
  r.config.settings = {{"ipopt.hessian_approximation", "limited-memory"}, {"problem.lambda", "0.25"}};
  r.config.repeat = 3;
  r.provenance.version = "0.1.0";
  r.provenance.commit = "0123abc-dirty";
  r.provenance.device = "pocl-Gerät";  // not ASCII
  r.provenance.threads = 2;
  r.provenance.device_fp64 = true;
  r.provenance.started = "2024-05-06T07:08:09Z";
  r.body_name = "ellipsoid";
  r.repairs = {"merged 4 equal vertices", "turned 1 inside-out shell"};
  r.frame.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  r.frame.origin = {1, 2, 3};
  r.frame.length = r.length_mm = 30;
  r.contact = {1, 2, 3};
  r.solid_mass_grams = r.mass_unit_grams = 27;
  for (int k = 0; k < 10; ++k) {
    r.solid[k] = 1 + 0.1 * k;
    r.fixed[k] = 0.2 + 0.01 * k;
    r.interior[k] = 0.8 - 0.02 * k;
    r.outcome.moments[k] = 0.5 + 0.03 * k;
    r.rounding.moments[k] = 0.5 + 0.031 * k;
    r.verified.moments[k] = 0.5 + 0.032 * k;
  }
  r.grid = {{6, 5, 4}, {-0.3, -0.25, 0}, 0.1};
  r.wall = 0.15;
  r.intervals = {{1, 2, 0, 3}, {2, 2, 1, 4}};
  r.rays = 2;
  r.inside_voxels = 40;
  r.interior_voxels = 6;
  r.solid_objective = 1.5;
  r.variables = 4;
  r.outcome.termination = Termination::acceptable;
  r.outcome.message = "solved to acceptable level";
  r.scope = "with up to 2 g/cm^3";
  r.infeasibility = "mass is out of reach by 0.5";
  r.outcome.iterations = 2;
  r.outcome.x = {0.25, 2.5, 1.5, 3.75};
  r.outcome.objective = 0.75;
  r.outcome.violation = 1e-12;
  r.outcome.evaluations = {5, 4, 3, 2, 1};
  r.outcome.history = {{0, 1.0, 0.1, 0.2, 0.3, 0.0, 0}, {1, 0.8, 0.01, 0.02, 0.03, 0.4, 2}};
  r.samples = {{0.1, 0.3, 0.5, 0.6}, {0.2, 0.4, 0.7, 0.9}, {0.3, 0.5, 0.9, 1.2}};
  r.median = {0.2, 0.4, 0.7, 0.9};
  r.rounding.objective = 0.76;
  r.rounding.violation = 1e-4;
  r.rounding.solid_voxels = 4;
  r.rounding.void_voxels = 2;
  r.rounding.mended_voxels = 1;
  r.rounding.moved_voxels = 3;
  r.voids = {{12.5, 0.5}, {0.25}, {{{{0, 0, 1}, 4.5}, 2}}};
  r.verified.verdict = {true, "spins", {{"off_axis", 1e-5}, {"omega_min_rpm", nan}}};
  r.verified.file = "part.stl";
  r.verified.triangles = 100;
  r.verified.materials = {{"shell", 1.17, "part.stl", 80, 3.5},
                          {"interior", 8.1, "part-interior.stl", 20, 7}};
  r.verified.void_triangles = 20;
  return r;
}

/// The same, certified to be within a fifth.
RunResult certified_by_hand() {
  RunResult r = made_by_hand();
  Certificate& c = r.certificate.emplace();
  c.kind = Certificate::Kind::spin;
  c.bound = 0.6;
  c.best = 0.7;
  c.seconds = 1.25;
  c.searches = 3;
  c.message = "the gap was reached";
  c.reached = true;
  c.contrast = 0.9;
  c.spin = {.lambda = 0.25, .gamma_i = 1};
  const double infinity = std::numeric_limits<double>::infinity();
  c.boxes.push_back({.low = -infinity, .high = 0.25, .empty = true, .value = infinity, .nu = -1});
  c.boxes.push_back(
      {.low = 0.25, .high = 0.5, .value = 0.6, .t_low = 0.7, .t_high = 0.8, .u = {0.6, 0.8, 0}});
  c.boxes.push_back({.low = 0.5, .high = infinity, .empty = true, .value = infinity, .nu = 1});
  return r;
}

void expect_equal(const Seconds& got, const Seconds& want) {
  EXPECT_EQ(got.setup, want.setup);
  EXPECT_EQ(got.kernels, want.kernels);
  EXPECT_EQ(got.solve, want.solve);
  EXPECT_EQ(got.total, want.total);
}

class RunRecord : public ::testing::Test {
 protected:
  std::size_t files() const {
    return std::size_t(std::distance(fs::directory_iterator(folder_.path), fs::directory_iterator{}));
  }

  /// What read_record() says of a file it refuses.
  std::string refusal(const fs::path& path) const {
    try {
      (void)read_record(path);
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(path.string()), std::string::npos) << e.what();
      return e.what();
    }
    ADD_FAILURE() << path << " was read";
    return {};
  }

  const TemporaryFolder folder_;
};

TEST_F(RunRecord, GivesBackWhatWasWritten) {
  const RunResult r = made_by_hand();
  const fs::path path = folder_.path / "new" / "folder" / "run.h5";
  write_record(path, r);
  const Record record = read_record(path);
  EXPECT_EQ(record.path, path);
  EXPECT_EQ(record.kind, RecordKind::run);
  EXPECT_EQ(record.config(), describe(r.config));
  EXPECT_EQ(record.error, "");
  // All that people and scripts are told of a run is in its record.
  EXPECT_EQ(record.summary.whole(), to_json(r));
  const RunResult s = read_run(path);
  EXPECT_EQ(s.fixed, r.fixed);
  EXPECT_EQ(s.interior, r.interior);
  EXPECT_EQ(s.grid.origin, r.grid.origin);
  EXPECT_EQ(s.rounding.moments, r.rounding.moments);
  expect_equal(s.median, r.median);
  ASSERT_EQ(s.samples.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) expect_equal(s.samples[i], r.samples[i]);
  EXPECT_EQ(hdf5::File::open(path).group("body").text("repairs"),
            "merged 4 equal vertices\nturned 1 inside-out shell");
}

/// Files as earlier versions wrote them: first_run.h5 as the first did, without voids, materials, the memory
/// and time of the whole, and what a solve says beside its numbers.
TEST_F(RunRecord, OfAnEarlierVersionIsReadAndWhatItLacksIsUnknown) {
  const fs::path folder = fs::path(source_folder) / "tests/data/records";
  const nlohmann::json first = read_record(folder / "first_run.h5").summary.whole();
  EXPECT_EQ(first.at("termination"), "optimal");
  EXPECT_EQ(first.at("model"), "bird");
  EXPECT_EQ(first.at("grid"), (nlohmann::json{40, 30, 30}));
  EXPECT_NEAR(first.at("objective").get<double>(), 1.147469, 1e-6);
  EXPECT_TRUE(first.at("provenance").at("load").is_null());
  EXPECT_TRUE(first.at("local_minimum").is_null());
  EXPECT_TRUE(first.at("verified").at("ok").get<bool>());
  EXPECT_TRUE(first.at("bound").is_null());
  const nlohmann::json later = read_record(folder / "run_without_load.h5").summary.whole();
  EXPECT_EQ(later.at("problem"), "yoyo");
  EXPECT_TRUE(later.at("provenance").at("load").is_null());
  EXPECT_FALSE(later.at("local_minimum").is_null());
  const Record nesting = read_record(folder / "nesting.h5");
  EXPECT_EQ(nesting.kind, RecordKind::nesting);
  EXPECT_EQ(nesting.summary.at("shapes"), "dino in dino");
  EXPECT_TRUE(nesting.summary.at("valid").get<bool>());
}

TEST_F(RunRecord, OfARunThatEndedWithTheSolveSaysThatThereIsNoPart) {
  RunResult r = made_by_hand();
  r.config.part = Part::none;
  EXPECT_NE(run_name(r.config), run_name(made_by_hand().config));
  const auto path = folder_.path / "none.h5";
  write_record(path, r);
  const RunResult s = read_run(path);
  EXPECT_EQ(s.config.part, Part::none);
  EXPECT_EQ(s.outcome.objective, 0.75);
  EXPECT_EQ(hdf5::File::open(path).text("no_part"), "none made, none verified: part = none");
  EXPECT_EQ(read_record(path).summary.whole(), to_json(r));
  write_record(folder_.path / "made.h5", made_by_hand());
  EXPECT_EQ(read_run(folder_.path / "made.h5").config.part, Part::written);
  const auto json = to_json(r);
  EXPECT_TRUE(json.at("verified").is_null());
  EXPECT_TRUE(json.at("rounding").is_null());
  EXPECT_EQ(json.at("no_part"), no_part);
  EXPECT_EQ(json.at("moments"), json.at("moments_optimum"));
}

TEST_F(RunRecord, KeepsTablesWithTheirShapes) {
  RunResult r = made_by_hand();
  r.outcome.x.assign(100'000, 0.0);  // several compressed chunks
  for (std::size_t i = 0; i < r.outcome.x.size(); ++i) r.outcome.x[i] = std::sin(double(i));
  write_record(folder_.path / "run.h5", r);
  const auto file = hdf5::File::open(folder_.path / "run.h5");
  EXPECT_EQ(file.group("solve").read("x").values, r.outcome.x);
  EXPECT_EQ(file.group("solve").read("history").shape, (hdf5::Shape{2, 7}));
  EXPECT_EQ(file.group("solve").read("samples").shape, (hdf5::Shape{3, 4}));
  EXPECT_EQ(file.group("domain").read_integers("intervals").values,
            (std::vector<int>{1, 2, 0, 3, 2, 2, 1, 4}));
  const std::vector<double> by_rows = {0, -1, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_EQ(file.group("body").read("frame_rotation").values, by_rows);
  const Moments model = r.model_moments(r.outcome.moments);
  EXPECT_EQ(file.group("solve").read("moments_model").values,
            std::vector<double>(model.data(), model.data() + model.size()));
}

TEST_F(RunRecord, GoesIntoAPipeWhole) {
  const fs::path pipe = folder_.path / "run.h5", copy = folder_.path / "copy.h5";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::thread reader(
      [&] { std::ofstream(copy, std::ios::binary) << std::ifstream(pipe, std::ios::binary).rdbuf(); });
  const RunResult r = made_by_hand();
  write_record(pipe, r);
  reader.join();
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(hdf5::File::open(copy).group("solve").read("x").values, r.outcome.x);
}

TEST_F(RunRecord, OfTheAngleFormKeepsTheAngle) {
  RunResult r = made_by_hand();
  write_record(folder_.path / "trace.h5", r);
  EXPECT_FALSE(hdf5::File::open(folder_.path / "trace.h5").group("solve").has("phi"));
  r.outcome.auxiliary = {0.3};
  write_record(folder_.path / "angle.h5", r);
  const auto file = hdf5::File::open(folder_.path / "angle.h5");
  EXPECT_EQ(file.group("solve").real("phi"), 0.3);
  EXPECT_EQ(file.group("solve").text("phi_units"), "rad");
}

TEST_F(RunRecord, SaysWhetherItIsAStrictMinimumWhereThatIsKnown) {
  RunResult r = made_by_hand();
  write_record(folder_.path / "early.h5", r);  // as records were before: without it
  EXPECT_FALSE(read_run(folder_.path / "early.h5").outcome.local_minimum);
  EXPECT_TRUE(to_json(r).at("local_minimum").is_null());
  LocalMinimum& minimum = r.outcome.local_minimum.emplace();
  minimum.strict = LocalMinimum::Answer::no;
  minimum.smallest = -0.25;
  minimum.dimension = 5;
  write_record(folder_.path / "run.h5", r);
  EXPECT_EQ(read_record(folder_.path / "run.h5").summary.whole(), to_json(r));
  EXPECT_EQ(hdf5::File::open(folder_.path / "run.h5").group("solve").integer("tangent_dimension"), 5);
  const auto json = to_json(r).at("local_minimum");
  EXPECT_EQ(json.at("strict"), "no");
  EXPECT_EQ(json.at("smallest_eigenvalue"), -0.25);
  EXPECT_EQ(json.at("text"), "no, smallest eigenvalue -0.25 on the tangent space of 5 dimensions");
}

TEST_F(RunRecord, OfACertifiedRunHoldsTheProof) {
  const RunResult r = certified_by_hand();
  write_record(folder_.path / "run.h5", r);
  EXPECT_EQ(read_record(folder_.path / "run.h5").summary.whole(), to_json(r));
  const RunResult s = read_run(folder_.path / "run.h5");
  EXPECT_EQ(s.certificate.value().bound, 0.6);
  EXPECT_DOUBLE_EQ(s.gap(), 0.2);
  const auto group = hdf5::File::open(folder_.path / "run.h5").group("certificate");
  EXPECT_EQ(group.text("kind"), "spin");
  EXPECT_EQ(group.real("best"), 0.7);
  const auto boxes = group.read("boxes");
  ASSERT_EQ(boxes.shape, (hdf5::Shape{3, 14}));
  EXPECT_EQ(std::vector<double>(boxes.values.begin() + 14, boxes.values.begin() + 28),
            (std::vector<double>{0.25, 0.5, 0, 0.6, 0.7, 0.8, 0.6, 0.8, 0, 0, 0, 0, 0, 0}));
  const auto quadrics = group.read("box_quadrics");
  ASSERT_EQ(quadrics.shape, (hdf5::Shape{6, 10}));
  const Moments upper = r.certificate->boxes[1].quadric(0.5, 0.8);
  for (Eigen::Index k = 0; k < 10; ++k) EXPECT_EQ(quadrics.values[std::size_t(30 + k)], upper[k]) << k;
  // 0.6 (y^2 + z^2 - c^2) + 0.8 (x^2 + z^2 - c^2) - 0.8 (x^2 + y^2) at c = 0.5
  EXPECT_DOUBLE_EQ(upper[S1], -0.35);
  EXPECT_DOUBLE_EQ(upper[SYY], 0.6 - 0.8);
  EXPECT_DOUBLE_EQ(upper[SZZ], 1.4);
}

TEST_F(RunRecord, WithoutACertificateHasNone) {
  write_record(folder_.path / "run.h5", made_by_hand());
  EXPECT_FALSE(read_run(folder_.path / "run.h5").certificate);
}

TEST_F(RunRecord, OfAnOctreeTellsItsRoundsAndTheCellsAlongTheVoid) {
  RunResult r = made_by_hand();
  r.outcome.refinements.resize(2);
  r.outcome.refinements[0].cells.along = 11;
  r.outcome.refinements[1].cells.along = 407;
  write_record(folder_.path / "run.h5", r);
  const RunResult s = read_run(folder_.path / "run.h5");
  ASSERT_EQ(s.outcome.refinements.size(), 2u);
  EXPECT_EQ(s.outcome.refinements[1].cells.along, 407u);
  EXPECT_EQ(read_record(folder_.path / "run.h5").summary.whole(), to_json(r));
}

TEST_F(RunRecord, IsTheSameFileForTheSameResult) {
  const auto bytes = [](const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  write_record(folder_.path / "a.h5", made_by_hand());
  write_record(folder_.path / "b.h5", made_by_hand());
  EXPECT_EQ(bytes(folder_.path / "a.h5"), bytes(folder_.path / "b.h5"));
}

TEST_F(RunRecord, OfNothingButDefaultsIsReadBack) {
  write_record(folder_.path / "run.h5", RunResult{});
  const RunResult s = read_run(folder_.path / "run.h5");
  EXPECT_EQ(s.outcome.termination, Termination::failed);
  EXPECT_TRUE(s.samples.empty());
}

TEST_F(RunRecord, KeepsWhatIsNotANumber) {
  RunResult r = made_by_hand();
  r.outcome.objective = nan;
  r.rounding.objective = std::numeric_limits<double>::infinity();
  write_record(folder_.path / "run.h5", r);
  const RunResult s = read_run(folder_.path / "run.h5");
  EXPECT_TRUE(std::isnan(s.outcome.objective));
  EXPECT_EQ(s.rounding.objective, std::numeric_limits<double>::infinity());
  const auto file = hdf5::File::open(folder_.path / "run.h5");
  EXPECT_TRUE(std::isnan(file.group("verified").group("values").real("omega_min_rpm")));
}

TEST_F(RunRecord, OfAFailedRunSaysWhy) {
  const RunResult r = made_by_hand();
  const std::string log(100'000, '!');  // more than an attribute of fixed length may hold
  write_failure(folder_.path / "run.h5", r.config, r.provenance, "no interior left" + log);
  const Record s = read_record(folder_.path / "run.h5");
  EXPECT_EQ(s.error, "no interior left" + log);
  EXPECT_EQ(s.config(), describe(r.config));
  EXPECT_EQ(s.summary.at("formulation"), "rayrep");
  EXPECT_EQ(s.summary.at("commit"), r.provenance.commit);
  EXPECT_TRUE(s.summary.at("termination").is_null());
}

TEST_F(RunRecord, ReplacesAnEarlierOneAndLeavesNothingElse) {
  RunResult r = made_by_hand();
  write_record(folder_.path / "run.h5", r);
  r.outcome.iterations = 77;
  write_record(folder_.path / "run.h5", r);
  EXPECT_EQ(read_run(folder_.path / "run.h5").outcome.iterations, 77);
  EXPECT_EQ(files(), 1u);
}

TEST_F(RunRecord, LeavesNothingBehindWhenItCannotBeWritten) {
  std::ofstream(folder_.path / "file") << "no folder";  // holds for root too, unlike permissions
  EXPECT_THROW(write_record(folder_.path / "file" / "run.h5", made_by_hand()), InputError);
  EXPECT_THROW(write_text(folder_.path / "file" / "run.json", "{}"), InputError);
  fs::create_directories(folder_.path / "run.h5" / "in_the_way");  // the name is taken by a folder
  EXPECT_THROW(write_record(folder_.path / "run.h5", made_by_hand()), InputError);
  EXPECT_THROW(write_text(folder_.path / "run.h5", "{}"), InputError);
  EXPECT_EQ(files(), 2u);
  // A file system that takes no files, from root neither.
  expect_refusal([] { write_record("/proc/run.h5", made_by_hand()); }, "/proc/run.h5: its folder refuses",
                 {});
  expect_refusal([] { write_text("/proc/run.json", "{}"); }, "/proc/run.json: its folder refuses", {});
}

/// The library itself does not survive a write that fails.
TEST_F(RunRecord, OnAFullDiskTheEarlierOneStaysAlone) {
  RunResult r = made_by_hand();
  const fs::path path = folder_.path / "run.h5";
  write_record(path, r);
  r.outcome.iterations = 77;
  const auto write_without_room = [&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1024, 1024};  // bytes a file
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      write_record(path, r);
    } catch (const InputError& e) {
      std::exit(std::string(e.what()).find("expected room") != std::string::npos ? 0 : 1);
    }
    std::exit(2);
  };
  EXPECT_EXIT(write_without_room(), ::testing::ExitedWithCode(0), "");
  EXPECT_EQ(files(), 1u);
  EXPECT_EQ(read_run(path).outcome.iterations, 2);
}

TEST_F(RunRecord, RefusesWhatIsNoRecord) {
  EXPECT_NE(refusal(folder_.path / "absent.h5").find("expected an HDF5 file"), std::string::npos);
  std::ofstream(folder_.path / "text.h5") << "text";
  EXPECT_NE(refusal(folder_.path / "text.h5").find("expected an HDF5 file"), std::string::npos);
  hdf5::File::create(folder_.path / "other.h5").close();
  EXPECT_NE(refusal(folder_.path / "other.h5").find("not a record"), std::string::npos);
}

TEST_F(RunRecord, OfANewerSchemaIsRefused) {
  {
    auto file = hdf5::File::create(folder_.path / "newer.h5");
    file.set("schema", run_schema.name);
    file.set("schema_version", run_schema.newest + 1);
    file.close();
  }
  EXPECT_NE(refusal(folder_.path / "newer.h5").find("newer program"), std::string::npos);
}

TEST_F(RunRecord, CutShortIsRefused) {
  write_record(folder_.path / "run.h5", made_by_hand());
  fs::resize_file(folder_.path / "run.h5", fs::file_size(folder_.path / "run.h5") / 2);
  (void)refusal(folder_.path / "run.h5");
}

TEST(RecordJson, HasTheDocumentedNames) {
  const RunResult r = made_by_hand();
  const nlohmann::json j = to_json(r);
  EXPECT_EQ(j.at("model"), "ellipsoid");
  EXPECT_EQ(j.at("repairs"), (nlohmann::json{"merged 4 equal vertices", "turned 1 inside-out shell"}));
  EXPECT_EQ(j.at("problem"), "spin");
  EXPECT_EQ(j.at("formulation"), "rayrep");
  EXPECT_EQ(j.at("solver"), "ipopt");
  EXPECT_EQ(j.at("grid"), (nlohmann::json{6, 5, 4}));
  EXPECT_EQ(j.at("variables"), 4);
  EXPECT_EQ(j.at("iterations"), 2);
  EXPECT_EQ(j.at("termination"), "acceptable");
  EXPECT_EQ(j.at("objective"), 0.75);
  EXPECT_EQ(j.at("constraint_violation"), 1e-12);
  const Moments model = r.model_moments(r.rounding.moments);
  ASSERT_EQ(j.at("moments").size(), 10u);
  for (std::size_t k = 0; k < 10; ++k) EXPECT_EQ(j.at("moments")[k], model[Eigen::Index(k)]);
  EXPECT_EQ(j.at("moments_frame").at("origin"), (nlohmann::json{0.0, 0.0, 0.0}));
  EXPECT_EQ(j.at("moments_frame").at("axes")[1], (nlohmann::json{0.0, 1.0, 0.0}));
  const nlohmann::json median = {{"setup", 0.2}, {"kernels", 0.4}, {"solve", 0.7}, {"total", 0.9}};
  EXPECT_EQ(j.at("seconds"), median);
  EXPECT_EQ(j.at("samples").size(), 3u);
  EXPECT_EQ(j.at("samples")[1], median);
  EXPECT_EQ(j.at("domain"), "columns");
  EXPECT_EQ(j.at("frame").at("length"), 30.0);
  EXPECT_EQ(j.at("frame").at("rotation")[0], (nlohmann::json{0.0, -1.0, 0.0}));
  EXPECT_EQ(j.at("weights"), (nlohmann::json{{"lambda", 0.25}, {"gamma_i", 1.0}}));
  EXPECT_EQ(j.at("wall"), 0.15 * 30);
  EXPECT_EQ(j.at("density"), 1.0);
  EXPECT_TRUE(j.at("bound").is_null());
  EXPECT_TRUE(j.at("gap").is_null());
  EXPECT_EQ(j.at("verified").at("ok"), true);
  EXPECT_EQ(j.at("verified").at("text"), "spins");
  EXPECT_EQ(j.at("verified").at("off_axis"), 1e-5);
  EXPECT_EQ(j.at("device"), "pocl-Gerät");
  EXPECT_EQ(j.at("commit"), "0123abc-dirty");
}

TEST(RecordJson, HasTheBoundOfACertifiedRun) {
  RunResult r = certified_by_hand();
  const nlohmann::json j = to_json(r);
  EXPECT_EQ(j.at("bound"), 0.6);
  EXPECT_DOUBLE_EQ(j.at("gap").get<double>(), 0.2);
  EXPECT_EQ(j.at("certificate"), "spin");
  EXPECT_EQ(j.at("boxes"), 3);
  EXPECT_EQ(j.at("certify_seconds"), 1.25);
  r.certificate->bound = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(to_json(r).at("gap").is_null());
}

TEST(RecordJson, TurnsWhatIsNotANumberIntoNull) {
  RunResult r = made_by_hand();
  r.outcome.objective = -std::numeric_limits<double>::infinity();
  const nlohmann::json j = to_json(r);
  EXPECT_TRUE(j.at("objective").is_null());
  EXPECT_TRUE(j.at("verified").at("omega_min_rpm").is_null());
}

TEST(RecordJson, CanBeDumpedWhateverBytesAPathHas) {
  RunResult r = made_by_hand();
  r.verified.file = "part\xff.stl";
  EXPECT_NO_THROW((void)to_json(r).dump());
}

/// A record for a reader of another language; where KREISEL_TEST_RECORD names a file it stays there.
TEST_F(RunRecord, IsReadByH5py) {
  const std::string python = "/usr/bin/python3";
  KREISEL_NEEDS(imports("h5py"), "h5py");
  const char* kept = std::getenv("KREISEL_TEST_RECORD");
  const fs::path path = kept != nullptr && *kept != '\0' ? fs::path(kept) : folder_.path / "run.h5";
  const fs::path script = fs::path(source_folder) / "tests/record/h5py_test.py";
  const std::string command = python + " '" + script.string() + "' '" + path.string() + "'";
  RunResult angle = made_by_hand();
  angle.outcome.auxiliary = {0.3};
  for (const RunResult& result : {certified_by_hand(), made_by_hand(), angle}) {
    write_record(path, result);
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
  }
}

}  // namespace THIS_FILE
}  // namespace kreisel::core

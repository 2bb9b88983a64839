// session.hpp - a body that lives, and questions that are cheap.
//
// Model coordinates, mm, g, g/cm^3; what ends in _body is in the body frame and its units (docs/library.md).
// Device and Body are handles: a copy shares, and any thread may read.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kreisel/control.hpp"
#include "kreisel/mending.hpp"
#include "kreisel/mesh.hpp"
#include "kreisel/question.hpp"
#include "kreisel/verdict.hpp"

namespace kreisel {

/// An OpenCL device. Sessions share it, each with a queue and kernels of its own.
class KREISEL_API Device {
 public:
  /// Opens it. @param selector  an index or part of a name of `bench devices`; empty: $KREISEL_DEVICE, a GPU,
  ///                            PoCL, the first there is
  /// @throws InputError  no such device
  explicit Device(const std::string& selector = {});
  [[nodiscard]] std::string name() const;

 private:
  friend class Session;
  struct State;
  std::shared_ptr<const State> state_;
};

/// A solid: its mesh mended where that is safe, and checked.
class KREISEL_API Body {
 public:
  /// Reads OFF, OBJ, PLY, STL or 3MF. @param mm_per_unit  of formats that do not say what their lengths are
  /// in
  /// @param mending  what is allowed to make it a solid
  /// @throws InputError  no readable file, or no solid: open, inside out in part, several pieces
  [[nodiscard]] static Body read(const std::filesystem::path& file, double mm_per_unit = 1,
                                 const Mending& mending = {});
  /// A model by its name in `bench list`. @throws InputError  no such model, says the nearest
  [[nodiscard]] static Body model(const std::string& name);
  /// @throws InputError  no solid
  explicit Body(Mesh mesh, const Mending& mending = {});

  /// As mended, mm.
  [[nodiscard]] const Mesh& mesh() const;
  /// Of all of it at density 1: mm^3, mm^4, mm^5. On the host, in double, from the triangles.
  [[nodiscard]] Moments moments() const;
  /// What was mended, one line each.
  [[nodiscard]] const std::vector<std::string>& repairs() const;

 private:
  friend class Session;
  friend KREISEL_API Verdict verify(const std::vector<std::filesystem::path>&, const Body&, const Question&);
  struct State;
  explicit Body(std::shared_ptr<const State> state);
  std::shared_ptr<const State> state_;
};

/// What became of a body whose shape was free to change (the field `deform`). Model coordinates, mm.
/// [docs/deformation.md]
struct Deformation {
  std::string reached;         ///< all (that was asked), constraints (it balances, no more) or nothing
  double largest_mm = 0;       ///< displacement of a vertex
  double largest_percent = 0;  ///< the same, of the longest side
  Vec3 where = Vec3::Zero();   ///< of that vertex, before
  double volume_before_mm3 = 0, volume_after_mm3 = 0;
  double least_determinant = 1;  ///< of the motion: how much space shrinks anywhere
  /// With the same triangles; where nothing is kept, `before` is moved to lie as near to `after` as may be.
  Mesh before, after;
};

/// The answer to a question, before anything is meshed.
struct Solution {
  Question question;
  enum class End { optimal, acceptable, infeasible, failed } end = End::failed;
  std::string message;   ///< the solver's own words
  double objective = 0;  ///< f, normalised: the same for every formulation of one body and problem
  double violation = 0;  ///< largest of the constraints, body units
  Moments moments = Moments::Zero();  ///< of the whole solid: g, g mm, g mm^2
  /// Coefficients of the quadric that is negative where the heavier material goes; of the quadric alone.
  std::optional<Moments> quadric_body = {};
  std::vector<double> variables;  ///< of the formulation, in the frame of its rays
  std::optional<double> bound =
      {};  ///< no interior of the domain has less: where it was asked for, and found
  std::optional<Deformation> deformation = {};  ///< where one was asked for; then all is of the deformed body
  std::vector<std::string> unmet;               ///< where infeasible: what cannot be met
  Verdict verdict;                              ///< of these moments, where feasible; not of a mesh
  /// x_body = rotation (x - origin) / length.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vec3 origin = Vec3::Zero();
  double length_mm = 1;
  double setup_seconds = 0, solve_seconds = 0;

  [[nodiscard]] bool feasible() const { return end == End::optimal || end == End::acceptable; }
};

/// How a part is finished.
struct PartSpec {
  double accuracy =
      0.4;  ///< of the printer, mm: no thinner wall; voids under a cube of five times as much stay filled
  std::string cut =
      {};            ///< "auto", by the planes that open all voids; or "NX,NY,NZ,D", N . x = D; empty: none
  double pegs = 0;   ///< radius of pins that align the halves of a cut, mm
  double drain = 0;  ///< radius of a hole into every void, mm
  bool lay_flat = false;  ///< pieces of a cut beside each other, each on its cut
  /// How far the surface of voids may be off for fewer triangles, mm; nothing: a tenth of the accuracy; 0:
  /// every triangle stays.
  std::optional<double> tolerance = {};
};

/// What is printed or cast, in memory.
struct KREISEL_API Part {
  std::vector<Mesh> meshes;           ///< closed; one a solid and material
  std::vector<std::string> names;     ///< part, shell, interior, filling, upper, lower
  std::vector<double> densities;      ///< g/cm^3
  Moments moments = Moments::Zero();  ///< of all of them: g, g mm, g mm^2
  std::size_t voids = 0;
  double wall_mm = 0;   ///< thinnest between outside and void; infinite without voids
  double thinnest = 0;  ///< thinnest of its material, walls and webs between voids, mm
  Verdict verdict;      ///< of the meshes, as a file in single precision holds them

  /// A file each beside `file`, or one 3MF with an object each, under temporary names and then renamed.
  /// @return  what was written  @throws InputError  a format there is not, a disk that is full
  std::vector<std::filesystem::path> write(const std::filesystem::path& file) const;

  struct State;
  std::shared_ptr<const State> state;  ///< how it is written: names, places
};

/// Reads the files again and judges them by exact criteria; host, double precision.
/// @param files  of one part, as Part::write() names them, not laid flat
/// @throws InputError  a file that cannot be read; what is no solid gives a verdict that says so
KREISEL_API Verdict verify(const std::vector<std::filesystem::path>& files, const Body& body,
                           const Question& question);

/// Where a body can spin, or float.
struct KREISEL_API Map {
  std::vector<Vec3> axes, contacts;  ///< model coordinates, mm
  std::vector<bool> feasible, ok;    ///< is there an interior; does it do what was asked
  std::vector<double> objective;     ///< NaN where infeasible
  std::optional<std::size_t> best;   ///< the best that is ok, else the best that is feasible
  Question asked;

  /// The question of one axis. @pre  i < axes.size()
  [[nodiscard]] Question question(std::size_t i) const;
};

/// A body with its domain, kept between questions. One thread at a time; two sessions in two threads are
/// independent. Solves by Ipopt wait for each other: MUMPS of Debian 12 is not re-entrant.
///
/// A weight, target or draft makes the problem anew; densities pose and problem; axis, contact and up these
/// two (of the quadric on exact rays with a wall in mm and no certificate; else the domain and formulation,
/// too); wall, cells and kind domain and formulation; size all but the mesh. [docs/library.md]
class KREISEL_API Session {
 public:
  explicit Session(Body body, const Device& device = Device());
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  /// @throws InputError  a question that does not fit  @throws Interrupted  by `control`
  [[nodiscard]] Solution solve(const Question& question, const Control& control = {});
  /// Meshes the interior, finishes and judges the part. Takes seconds. Solves again about the question's own
  /// axis, for the mesh is cut along its rays.
  /// @throws InputError  an infeasible question, a wall thinner than the printer's accuracy
  [[nodiscard]] Part part(const Solution& solution, const PartSpec& spec = {}, const Control& control = {});
  /// Of an infeasible solution: what would help, in a sentence; empty otherwise. Takes many solves.
  [[nodiscard]] std::string remedies(const Solution& solution, const Control& control = {});
  /// Every orientation over the domain at hand. @param axes  directions, spread evenly over the sphere
  /// @param centre  through the solid's centre of mass, on a peg; else through the lowest point
  /// @throws InputError  a problem other than spin or float, another formulation than quadric
  [[nodiscard]] Map map(const Question& question, int axes = 2000, bool centre = false,
                        const Control& control = {});
  /// The stages that the last question made anew: device, mesh, body, pose, domain, problem, formulation.
  [[nodiscard]] const std::vector<std::string>& made() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace kreisel

// formulation.hpp - how an interior is described by variables: x -> s(x) over a domain.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "domain/columns.hpp"
#include "domain/octree.hpp"
#include "formulation/support_oracle.hpp"
#include "formulation/voxel_set.hpp"
#include "problem/problem.hpp"

namespace kreisel::core {

/// Where a solve starts: at the bounds, or half way between them. [RayRep, s. 3.3]
enum class Start { lower, middle, upper };

struct Bounds {
  std::vector<double> lower, upper;
};

/// Sparse linear constraints of the formulation's own, lower <= A x <= upper.
struct SparseRows {
  struct Entry {
    int row, column;
    double value;
  };
  std::vector<Entry> entries;
  std::vector<double> lower, upper;  ///< one a row; may be infinite
};

/// x^T R x / 2 with a constant, sparse, symmetric, positive semidefinite R.
struct SparseForm {
  std::vector<SparseRows::Entry> entries;  ///< of R, row >= column: each pair once

  [[nodiscard]] double value(std::span<const double> x) const;
  /// out += R x.
  void add_gradient(std::span<const double> x, std::span<double> out) const;
};

/// What became of the variables at the optimum of one refinement.
struct CellCounts {
  std::size_t fractional = 0;  ///< neither empty nor full
  std::size_t coarse = 0;      ///< of these, such as can still be split
  std::size_t finest = 0;      ///< variables that cannot be split
  std::size_t along = 0;       ///< of these, such as share a face with the other side of the void's surface
  double weight = 0;           ///< of the regulariser
};

/// An interior rounded to what can be built, and what that cost.
struct Rounded {
  VoxelSet solid;          ///< which interior voxels stay solid
  std::size_t mended = 0;  ///< voxels filled so that the void surface is a manifold
};

/// Variables x of a domain, their moments s(x) at unit density in body units, and the derivatives.
/// Each method that touches x costs one kernel pass.
class Formulation {
 public:
  static constexpr std::size_t most_weights = 10;

  virtual ~Formulation() = default;

  [[nodiscard]] virtual std::string_view name() const = 0;  ///< stable: part of the results path
  [[nodiscard]] virtual std::size_t num_variables() const = 0;
  [[nodiscard]] virtual const Bounds& bounds() const = 0;
  [[nodiscard]] virtual SparseRows own_constraints() const { return {}; }
  [[nodiscard]] virtual bool moments_are_linear() const { return false; }

  /// s(x). @param x  num_variables() values
  [[nodiscard]] virtual Moments moments(std::span<const double> x) = 0;

  /// (ds/dx)^T w for every w of `weights`, at most most_weights: out[r * num_variables() + i].
  virtual void pull_back(std::span<const double> x, std::span<const Moments> weights,
                         std::span<double> out) = 0;

  /// Diagonal of sum_k w_k d2s_k/dx2, its only entries. Zero when moments_are_linear().
  virtual void curvature(std::span<const double> x, const Moments& weight, std::span<double> out) = 0;

  /// How many of the variables, the last ones, move the body itself, its skin included: with them the moments
  /// of what is not designed change, too. Of these there are first derivatives alone.
  [[nodiscard]] virtual std::size_t moving() const { return 0; }
  /// What they change MassModel::fixed by.
  [[nodiscard]] virtual Moments moved(std::span<const double> /*x*/) { return Moments::Zero(); }
  /// out += (d moved/dx)^T w for every w of `weights`, laid out as in pull_back().
  virtual void add_moved(std::span<const double> /*x*/, std::span<const Moments> /*weights*/,
                         std::span<double> /*out*/) {}

  /// What is minimised besides the problem's objective, so that there is one best x; nullptr: nothing.
  [[nodiscard]] virtual const SparseForm* regulariser() const { return nullptr; }

  /// Whether its variables are cells of different sizes that refine() splits and merges.
  [[nodiscard]] virtual bool refines() const { return false; }
  /// Refines the variables where the optimum x asks for it; x becomes where the next solve starts.
  /// @return  false when no other solve is asked for: then the moments of x have not changed
  [[nodiscard]] virtual bool refine(std::vector<double>& /*x*/) { return false; }
  /// Back to the variables before the first refine().
  virtual void restart() {}
  [[nodiscard]] virtual CellCounts count_cells(std::span<const double> /*x*/) const { return {}; }

  /// Which cells the variables are the fills of, in their order; empty: of none.
  [[nodiscard]] virtual std::vector<Cube> cells() const { return {}; }

  /// Its settings as they are in force, defaults included.
  [[nodiscard]] virtual SettingTexts settings() const { return {}; }

  /// The nearest interior made of whole voxels. [RayRep, s. 3.4]
  [[nodiscard]] virtual Rounded round(std::span<const double> x) const = 0;

  [[nodiscard]] virtual std::vector<double> start(Start where) const;

  /// The domain's support function, of a formulation that works on it; else nullptr.
  [[nodiscard]] virtual SupportOracle* oracle() { return nullptr; }

  /// Runs every kernel once, so that no timed solve pays for compiling.
  virtual void warm_up();
};

/// What a solver may find in a formulation.
struct Offers {
  bool derivatives = false;  ///< of the moments in bounded variables: pull_back() and curvature()
  bool refinement = false;   ///< refines()
  bool voxels = false;       ///< each variable is the fill of one voxel
  bool heights = false;      ///< variables are heights along rays, where material begins and ends
  bool oracle = false;       ///< oracle()

  [[nodiscard]] bool has(const Offers& needs) const {
    return (derivatives || !needs.derivatives) && (refinement || !needs.refinement) &&
           (voxels || !needs.voxels) && (heights || !needs.heights) && (oracle || !needs.oracle);
  }
};

struct FormulationEntry {
  std::string name, summary;
  /// The domain and the device outlive the formulation.
  std::unique_ptr<Formulation> (*make)(const Columns& domain, const Traits& traits, const Settings& settings,
                                       device::Device& device);
  Offers offers = {.derivatives = true};
  std::vector<std::string> domains = {"columns"};  ///< that it works on, its own first: columns, exact
  SettingTable settings = {};                      ///< that `make` reads
};

/// Those that there are, and such as were added.
[[nodiscard]] Registry<FormulationEntry>& formulations();

/// @throws InputError  unknown formulation (names those there are)
[[nodiscard]] const FormulationEntry& find_formulation(std::string_view name);

/// @throws InputError  unknown formulation, unknown or unfit setting
[[nodiscard]] std::unique_ptr<Formulation> make_formulation(std::string_view name, const Columns& domain,
                                                            const Traits& traits,
                                                            const SettingTexts& settings,
                                                            device::Device& device);

}  // namespace kreisel::core

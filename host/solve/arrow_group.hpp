// arrow_group.hpp - blocks of equal size in front of an arrow's border, eliminated beside each other.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace kreisel::core {

/// The blocks of one size: those of one row are a diagonal.
///
/// An entry of all blocks lies in one array, so that every step is one over vectors: the blocks' lower
/// triangles, then their rows of F, the columns that tie them to the border. Each block is inverted by
/// itself, with complete pivoting (SymmetricIndefinite); with the inverse, a solve has neither branches nor
/// pivots, and one step of refinement within the block gives back what explicit inverses lose.
class ArrowGroup {
 public:
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;

  /// @param rows    of a block, at most arrow_block
  /// @param blocks  their rows of K, block after block
  ArrowGroup(int rows, const std::vector<int>& blocks);

  /// Says where the entries are: from `begin` of the store on.
  /// @param tied  places in the border that a block of the group is tied to, ascending
  /// @return      the end
  std::size_t lay_out(std::vector<int> tied, std::size_t begin);
  /// Where entry (i, j) of a block is in the store.
  [[nodiscard]] std::size_t own(std::size_t block, int i, int j) const;
  /// Where the entry that ties row i of a block to a place in the border is.
  [[nodiscard]] std::size_t tie(std::size_t block, int i, int place) const;

  /// Inverts the blocks and takes F D^-1 F^T from `schur`. Blocks that are singular, or whose |D^-1 F^T| may
  /// be larger than `growth`, are delayed: they stay out of it.
  /// @return  negative eigenvalues of the blocks that are not delayed
  int eliminate(std::span<const double> store, double growth, Matrix& schur);
  /// Those that the last elimination delayed.
  [[nodiscard]] const std::vector<std::size_t>& delayed() const { return delayed_; }

  /// x = D^-1 (r - F^T y) in the rows of the blocks that are not delayed; F x is added to `sum`.
  void behind_border(std::span<const double> store, std::span<const double> r, const Vector& y,
                     std::span<double> x, Vector& sum) const;

  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] std::size_t count() const { return count_; }
  /// Row i of a block, as a row of K.
  [[nodiscard]] int row(std::size_t block, int i) const {
    return index_[static_cast<std::size_t>(i) * count_ + block];
  }
  [[nodiscard]] const std::vector<int>& tied() const { return tied_; }

 private:
  struct Chunk;
  struct Part;
  [[nodiscard]] std::size_t chunks() const;
  template <class Body>
  void for_chunks(const Body& body) const;
  [[nodiscard]] static std::size_t triangle(int i, int j);
  [[nodiscard]] std::size_t nth_tie(std::size_t block, int i, std::ptrdiff_t k) const;
  void invert(std::span<const double> store, const Chunk& chunk, double growth, Part& part);
  void sum_up(std::span<const double> store, const Chunk& chunk, Matrix& sum) const;

  int rows_;
  std::size_t count_;
  std::vector<int> index_;  ///< rows of K: the first of all blocks, then the second
  std::vector<int> tied_;
  std::size_t begin_ = 0;        ///< in the store
  std::vector<double> inverse_;  ///< lower triangles, as in the store; 0 where delayed
  std::vector<std::size_t> delayed_;
};

}  // namespace kreisel::core

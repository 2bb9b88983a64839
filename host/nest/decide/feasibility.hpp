// feasibility.hpp - does B nest in A, and if not, where?
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "device/device.hpp"
#include "nest/decide/nesting.hpp"

namespace kreisel::core::nest {

/// Why a placement is no nesting. [Nest, s. 5] numbers the rules; docs/nesting.md draws them.
enum class Fault {
  none,
  outside,     ///< this point of T(B) lies outside A; where sampled, outside A's box
  swept,       ///< rule 1: A is, or would be swept, through this point of T(B)
  uncovered,   ///< rule 2: nothing of A lies beyond this point of T(B)
  sticks_out,  ///< rule 3: A's surface beyond this point of T(B) is seen from outside
};

/// The answer, with the first fault met.
struct Verdict {
  Fault fault = Fault::none;
  int half = 0;               ///< that finds it: 0 plus, 1 minus
  Vec3 point = Vec3::Zero();  ///< of T(B), nesting units
  int x = -1, y = -1;         ///< pixel of that half's view, where it was sampled

  [[nodiscard]] bool valid() const { return fault == Fault::none; }
};

/// One line. @param nesting  the point is given in the outer file's coordinates
[[nodiscard]] std::string to_string(const Verdict& verdict, const Nesting& nesting);

/// One way of deciding. Not to be shared by threads.
class Feasibility {
 public:
  virtual ~Feasibility() = default;
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// @throws InputError  as require_valid()
  [[nodiscard]] virtual Verdict check(const Placement& placement) = 0;
  /// Many at once; answers in order.
  [[nodiscard]] virtual std::vector<Verdict> check(std::span<const Placement> placements);
};

/// The names that make_feasibility() takes. @throws InputError  (require_test) none of them
[[nodiscard]] std::vector<std::string> feasibility_tests();
void require_test(std::string_view name);

/// A feasibility test by name: `peel`, `envelope`, `exact`, `hybrid`.
/// @param resolution  pixels along a side of each view, 1 to 16384; `exact` and `hybrid` have no views
/// @throws InputError  unknown name, resolution out of range
[[nodiscard]] std::unique_ptr<Feasibility> make_feasibility(std::string_view name, device::Device& device,
                                                            const Nesting& nesting, int resolution = 512);

}  // namespace kreisel::core::nest

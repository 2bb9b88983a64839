#include "fabricate/loose_pieces.hpp"

#include <algorithm>
#include <functional>
#include <iterator>

#include "mesh/io/encode.hpp"
#include "mesh/solid/components.hpp"

namespace kreisel::core {

std::vector<double> loose_pieces(const std::vector<MaterialPart>& parts) {
  std::vector<double> pieces;
  for (const MaterialPart& part : parts) {
    const TriangleMesh whole = joined(part.surfaces, part.name);
    const std::vector<Shell> all = shells(whole);
    const auto around = enclosing_shells(whole, all);
    std::vector<double> volumes(all.size());
    for (std::size_t s = 0; s < all.size(); ++s) {
      // A cavity is of the piece that is the closest around it, which has the most around itself.
      std::size_t of = s;
      if (all[s].volume < 0)
        for (const std::uint32_t outer : around[s])
          if (of == s || around[outer].size() > around[of].size()) of = outer;
      volumes[of] += all[s].volume;
    }
    std::ranges::copy_if(volumes, std::back_inserter(pieces), [](double v) { return v > 0; });
  }
  std::ranges::sort(pieces, std::greater<>());
  return pieces;
}

}  // namespace kreisel::core
